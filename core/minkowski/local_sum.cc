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
      internal::AssembleLocalSum(pair_, gathered_, scaled, scope, &membership_cache_, &sum_);
    }
    FindChanges();
    return sum_;
  }

  const LocalSum& sum() const { return sum_; }
  const MeshPair& pair() const { return pair_; }

 private:
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
        internal::SelectFacets(pair_, all, ball, &near_, &gathered_);
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
    supported_.clear();
    candidates_.clear();
    hierarchy_->NearBall(ball.center(), ball.gathering_reach(), &candidates_);
    sum_.candidates = static_cast<long>(candidates_.size());
    for (const SumFacet& candidate : candidates_) {
      const internal::FacetCorners corners = internal::RoundedCorners(pair_, candidate);
      if (!internal::MeetsBall(corners, ball)) continue;
      const auto facet = Supported(&signs, candidate);
      if (!facet) continue;
      near_.Add(internal::BoxOf(pair_, corners));
      supported_.emplace_back(*facet, 1);
    }
    if (!near_.empty()) GatherCrossers(ball, &signs);
    SortSupported();
  }

  void SortSupported() {
    std::sort(supported_.begin(), supported_.end());
    gathered_.facets.clear();
    gathered_.is_active.clear();
    for (const auto& [facet, is_active] : supported_) {
      gathered_.facets.push_back(facet);
      gathered_.is_active.push_back(is_active);
    }
  }

  // Those of the list that support now: first those that meet the ball, then those near one.
  void GatherByGapFilling(const internal::ScaledBall& ball) {
    internal::SupportSigns signs(pair_, map_a_, map_b_);
    const long gatherings = gap_filler_->gatherings();
    const std::vector<internal::GapCandidate>& candidates =
        gap_filler_->Candidates(pair_, map_a_, map_b_, ball, &*hierarchy_);
    sum_.reused = gap_filler_->gatherings() == gatherings;
    sum_.candidates = static_cast<long>(candidates.size());
    near_.Clear();
    supported_.clear();
    others_.clear();
    for (const auto& [candidate, always_supports] : candidates) {
      const std::optional<SumFacet> facet =
          always_supports ? candidate : Supported(&signs, candidate);
      if (!facet) continue;
      const internal::FacetCorners corners = internal::RoundedCorners(pair_, *facet);
      const Box3 box = internal::BoxOf(pair_, corners);
      if (internal::MeetsBall(corners, ball)) {
        near_.Add(box);
        supported_.emplace_back(*facet, 1);
      } else {
        others_.emplace_back(*facet, box);
      }
    }
    for (const auto& [facet, box] : others_) {
      if (near_.MeetsAny(box)) supported_.emplace_back(facet, 0);
    }
    SortSupported();
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
      if (!facet || !near_.MeetsAny(box) || internal::MeetsBall(corners, ball)) continue;
      supported_.emplace_back(*facet, 0);
    }
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
  std::optional<internal::SphereHierarchy> hierarchy_;
  std::optional<internal::GapFiller> gap_filler_;
  MembershipCache membership_cache_;
  internal::NearBoxes near_;
  std::vector<SumFacet> candidates_;
  std::vector<std::pair<SumFacet, char>> supported_;
  std::vector<std::pair<SumFacet, Box3>> others_;
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
