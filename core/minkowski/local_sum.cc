// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/local_sum.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "touchstone/core/base/enum_names.h"
#include "touchstone/core/mesh/membership.h"
#include "touchstone/core/minkowski/gap_filling_internal.h"
#include "touchstone/core/minkowski/gather_internal.h"
#include "touchstone/core/minkowski/gauss_map.h"
#include "touchstone/core/minkowski/local_assembly_internal.h"
#include "touchstone/core/minkowski/sphere_hierarchy_internal.h"

namespace touchstone {
namespace {

constexpr std::string_view kBuilders[] = {"full", "brute-force", "sphere-hierarchy", "gap-filling"};

Status StatusOf(const Ball& ball) {
  if (!ball.center.allFinite() || !std::isfinite(ball.radius)) {
    return {StatusCode::kNonFinite, ElementKind::kNone, -1, -1, "the ball is NaN or infinite"};
  }
  if (ball.radius < 0.0) {
    return {StatusCode::kOutOfRange, ElementKind::kNone, -1, -1, "the ball's radius is negative"};
  }
  // As for a pose's translation.
  if (std::max(ball.center.cwiseAbs().maxCoeff(), ball.radius) > 1e100) {
    return {StatusCode::kOutOfRange, ElementKind::kNone, -1, -1, "the ball is above 1e100"};
  }
  return {};
}

}  // namespace

std::string_view ToString(LocalBuilder builder) { return EnumName(kBuilders, builder); }

std::optional<LocalBuilder> LocalBuilderFromString(std::string_view word) {
  const auto found = std::find(std::begin(kBuilders), std::end(kBuilders), word);
  if (found == std::end(kBuilders)) return std::nullopt;
  return static_cast<LocalBuilder>(found - std::begin(kBuilders));
}

class LocalMinkowskiSum::Implementation {
 public:
  Implementation(TriangleMesh a, TriangleMesh b, const LocalSumOptions& options)
      : options_(options), map_a_(a), map_b_(b), pair_(std::move(a), std::move(b), RelativePose()) {
    if (options_.builder == LocalBuilder::kSphereHierarchy ||
        options_.builder == LocalBuilder::kGapFilling) {
      hierarchy_.emplace(pair_.a().mesh, map_a_, pair_.b().mesh, map_b_);
      gap_filler_.emplace(pair_.b().mesh);
    }
  }

  const LocalSum& Update(const RelativePose& pose, const Ball& ball) {
    std::swap(facets_before_, sum_.facets);
    Clear();
    sum_.status = StatusOf(ball);
    pair_.Place(pose);
    if (sum_.status.ok()) {
      const internal::ScaledBall scaled(pair_, ball);
      Gather(scaled);
      sum_.gathered = std::count(gathered_.is_active.begin(), gathered_.is_active.end(), 1);
      const auto scope = options_.builder == LocalBuilder::kFull ? internal::AssemblyScope::kWhole
                                                                 : internal::AssemblyScope::kBall;
      internal::AssembleLocalSum(&geometry_, gathered_, scaled, scope, &membership_cache_, &sum_);
    }
    FindChanges();
    return sum_;
  }

  const LocalSum& sum() const { return sum_; }
  const MeshPair& pair() const { return pair_; }

 private:
  // A candidate of gap filling, in this update.
  struct GapFacet {
    std::optional<SumFacet> facet;  // if it supports, once that is asked
    bool is_asked = false, is_active = false;
    int number = -1;  // in the gathering
  };

  // Keeps the storage.
  void Clear() {
    sum_.status = {};
    sum_.rounding = 0.0;
    sum_.reused = false;
    sum_.detached_patches = 0;
    for (long* count : {&sum_.candidates, &sum_.gathered, &sum_.facet_pairs, &sum_.crossings,
                        &sum_.cells, &sum_.patches, &sum_.memberships, &sum_.exact_signs}) {
      *count = 0;
    }
    const auto clear = [](auto&... lists) { (lists.clear(), ...); };
    clear(sum_.names, sum_.vertices, sum_.facets, sum_.changes, sum_.dropped, sum_.triangles,
          sum_.facet_of_triangle, sum_.cell_of_triangle, sum_.neighbors, sum_.triangle_normals,
          sum_.vertex_normals, sum_.is_border_vertex, sum_.sheets, sum_.facet_of_sheet,
          sum_.segments, sum_.points);
  }

  void Gather(const internal::ScaledBall& ball) {
    switch (options_.builder) {
      case LocalBuilder::kFull:
        gathered_.facets = ReducedConvolution(pair_, map_a_, map_b_).facets;
        gathered_.is_active.assign(gathered_.facets.size(), 1);
        sum_.candidates = static_cast<long>(gathered_.facets.size());
        break;
      case LocalBuilder::kBruteForce: {
        const std::vector<SumFacet> all = ReducedConvolution(pair_, map_a_, map_b_).facets;
        sum_.candidates = static_cast<long>(all.size());
        internal::SelectFacets(pair_, all, ball, &near_, &gathering_);
        gathering_.MoveTo(&gathered_);
        break;
      }
      case LocalBuilder::kSphereHierarchy:
        GatherByHierarchy(ball);
        break;
      case LocalBuilder::kGapFilling:
        GatherByGapFilling(ball);
        break;
    }
  }

  // Those that meet the ball first; then whatever is near one of them.
  void GatherByHierarchy(const internal::ScaledBall& ball) {
    internal::SupportSigns signs(pair_, map_a_, map_b_);
    hierarchy_->Place(pair_);
    near_.Clear();
    gathering_.Clear();
    candidates_.clear();
    hierarchy_->NearBall(ball.center(), ball.gathering_reach(), &candidates_);
    sum_.candidates = static_cast<long>(candidates_.size());
    for (const SumFacet& candidate : candidates_) {
      const internal::FacetCorners corners = internal::RoundedCorners(pair_, candidate);
      if (!internal::MeetsBall(corners, ball)) continue;
      const auto facet = Supported(&signs, candidate);
      if (!facet) continue;
      const Box3 box = internal::BoxOf(pair_, corners);
      FindHits(box);
      AddHit(*facet, true);
      near_.Add(box);
    }
    if (!near_.empty()) GatherCrossers(ball, &signs);
    gathering_.MoveTo(&gathered_);
  }

  void GatherCrossers(const internal::ScaledBall& ball, internal::SupportSigns* signs) {
    candidates_.clear();
    hierarchy_->NearAnyOf(near_, &candidates_);
    sum_.candidates += static_cast<long>(candidates_.size());
    for (const SumFacet& candidate : candidates_) {
      const internal::FacetCorners corners = internal::RoundedCorners(pair_, candidate);
      const Box3 box = internal::BoxOf(pair_, corners);
      if (!near_.MayMeetAny(box)) continue;
      const auto facet = Supported(signs, candidate);
      if (!facet) continue;
      FindHits(box);
      if (!hits_.empty() && !internal::MeetsBall(corners, ball)) AddHit(*facet, false);
    }
  }

  // Active facets that a box meets: they are numbered as their boxes are.
  void FindHits(const Box3& box) {
    hits_.clear();
    near_.Meeting(box, &hits_);
  }

  void AddHit(const SumFacet& facet, bool is_active) {
    const int number = gathering_.Add(facet, is_active);
    for (const int active : hits_) gathering_.AddNear(active, number);
  }

  void GatherByGapFilling(const internal::ScaledBall& ball) {
    internal::SupportSigns signs(pair_, map_a_, map_b_);
    const long gatherings = gap_filler_->gatherings();
    const std::vector<internal::GapCandidate>& candidates =
        gap_filler_->Candidates(pair_, map_a_, map_b_, ball, &*hierarchy_);
    sum_.reused = gap_filler_->gatherings() == gatherings;
    sum_.candidates = static_cast<long>(candidates.size());
    gathering_.Clear();
    if (internal::GapPairs* pairs = gap_filler_->pairs()) {
      GatherByPairs(candidates, ball, &signs, pairs);
    } else {
      GatherByBoxes(candidates, ball, &signs);
    }
    gathering_.MoveTo(&gathered_);
  }

  // Those of the list that support now: first those that meet the ball, then those near one.
  void GatherByBoxes(std::span<const internal::GapCandidate> candidates,
                     const internal::ScaledBall& ball, internal::SupportSigns* signs) {
    near_.Clear();
    others_.clear();
    for (const internal::GapCandidate& candidate : candidates) {
      const std::optional<SumFacet> facet = Supported(signs, candidate);
      if (!facet) continue;
      const internal::FacetCorners corners = internal::RoundedCorners(pair_, *facet);
      const Box3 box = internal::BoxOf(pair_, corners);
      if (candidate.may_meet_ball && internal::MeetsBall(corners, ball)) {
        FindHits(box);
        AddHit(*facet, true);
        near_.Add(box);
      } else {
        others_.emplace_back(*facet, box);
      }
    }
    for (const auto& [facet, box] : others_) {
      FindHits(box);
      if (!hits_.empty()) AddHit(facet, false);
    }
  }

  // The same, but those that are not parted from one.
  void GatherByPairs(std::span<const internal::GapCandidate> candidates,
                     const internal::ScaledBall& ball, internal::SupportSigns* signs,
                     internal::GapPairs* pairs) {
    gap_facets_.assign(candidates.size(), {});
    for (int i = 0; i < static_cast<int>(candidates.size()); ++i) {
      if (!candidates[i].may_meet_ball) continue;
      GapFacet& found = gap_facets_[i];
      found = {Supported(signs, candidates[i]), true};
      if (!found.facet || !internal::MeetsBall(pairs->CornersOf(i, *found.facet), ball)) continue;
      found.is_active = true;
      found.number = gathering_.Add(*found.facet, true);
      pairs->List(i, *found.facet);
    }
    for (internal::GapPair& pair : pairs->pairs()) {
      GapFacet &x = gap_facets_[pair.i], &y = gap_facets_[pair.j];
      if (!pairs->HasExpired(pair) || !(x.is_active || y.is_active)) continue;
      if (!y.is_asked) y = {Supported(signs, candidates[pair.j]), true};
      if (!x.facet || !y.facet || pairs->IsParted(*x.facet, *y.facet, &pair)) continue;
      for (GapFacet* found : {&x, &y}) {
        if (found->number < 0) found->number = gathering_.Add(*found->facet, false);
      }
      gathering_.AddNear(x.number, y.number);
    }
  }

  std::optional<SumFacet> Supported(internal::SupportSigns* signs,
                                    const internal::GapCandidate& candidate) {
    return candidate.always_supports ? candidate.facet : Supported(signs, candidate.facet);
  }

  std::optional<SumFacet> Supported(internal::SupportSigns* signs, const SumFacet& candidate) {
    return internal::SupportedFacet(signs, pair_.a().mesh, pair_.b().mesh, candidate);
  }

  // Both lists are sorted.
  void FindChanges() {
    sum_.changes.assign(sum_.facets.size(), FacetChange::kNew);
    auto before = facets_before_.begin();
    for (std::size_t f = 0; f < sum_.facets.size(); ++f) {
      while (before != facets_before_.end() && *before < sum_.facets[f]) {
        sum_.dropped.push_back(*before++);
      }
      if (before == facets_before_.end() || *before != sum_.facets[f]) continue;
      sum_.changes[f] = FacetChange::kKept;
      ++before;
    }
    sum_.dropped.insert(sum_.dropped.end(), before, facets_before_.end());
  }

  const LocalSumOptions options_;
  GaussMap map_a_, map_b_;
  MeshPair pair_;
  internal::SumGeometry geometry_{pair_};
  std::optional<internal::SphereHierarchy> hierarchy_;
  std::optional<internal::GapFiller> gap_filler_;
  MembershipCache membership_cache_;
  internal::NearBoxes near_;
  std::vector<SumFacet> candidates_;
  internal::FacetGathering gathering_;
  std::vector<int> hits_;
  std::vector<std::pair<SumFacet, Box3>> others_;
  std::vector<GapFacet> gap_facets_;
  internal::GatheredFacets gathered_;
  std::vector<SumFacet> facets_before_;
  LocalSum sum_;
};

LocalMinkowskiSum::LocalMinkowskiSum(TriangleMesh a, TriangleMesh b, const LocalSumOptions& options)
    : implementation_(std::make_unique<Implementation>(std::move(a), std::move(b), options)) {}
LocalMinkowskiSum::~LocalMinkowskiSum() = default;
LocalMinkowskiSum::LocalMinkowskiSum(LocalMinkowskiSum&&) noexcept = default;
LocalMinkowskiSum& LocalMinkowskiSum::operator=(LocalMinkowskiSum&&) noexcept = default;

const LocalSum& LocalMinkowskiSum::Update(const RelativePose& pose, const Ball& ball) {
  return implementation_->Update(pose, ball);
}
const LocalSum& LocalMinkowskiSum::sum() const { return implementation_->sum(); }
const MeshPair& LocalMinkowskiSum::pair() const { return implementation_->pair(); }

}  // namespace touchstone
