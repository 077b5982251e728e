// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/membership.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <optional>
#include <tuple>

#include "touchstone/core/mesh/point_in_mesh_internal.h"
#include "touchstone/core/mesh/triangle_contact_internal.h"
#include "touchstone/core/mesh/triangle_lanes_internal.h"

namespace touchstone {
namespace {

using internal::ExactContact;
using internal::Triage;

std::pair<int, int> FacesOf(const Crossing& crossing) {
  const int of_edge = TriangleMesh::face_of(crossing.half_edge);
  return crossing.edge_is_of_a ? std::pair(of_edge, crossing.face)
                               : std::pair(crossing.face, of_edge);
}

// Nodes compared from the first on where the children that share most are followed first: what
// crosses is found early by that, if anything does.
constexpr int kOrdered = 16;
// Pairs of faces of two leaves from which on it pays to part them together; the first of all are
// compared alone, for where bodies overlap deeply one of them crosses.
constexpr int kMany = 4, kAlone = 8;

bool AreMany(std::uint64_t pairs) {
  for (int i = 1; i < kMany; ++i) pairs &= pairs - 1;
  return pairs != 0;
}

class Query {
 public:
  Query(const MeshPair& pair, const Translation& x, const MembershipOptions& options,
        MembershipCache* cache)
      : pair_(pair),
        x_(x),
        offset_(internal::MakeOffset(pair, x)),
        is_exact_(options.certainty == Certainty::kExact),
        contacts_(options.contacts),
        cache_(*cache) {}

  MembershipResult Run() {
    cache_.unsure.clear();
    if (RememberedCross() || SurfacesCross()) return Decide(Verdict::kOverlap, Tier::kBound);
    FindTouched(!contacts_.empty());
    for (const auto& [face_a, face_b] : contacts_) MarkTouched(face_a, face_b);
    if (cache_.unsure.empty()) {
      const Verdict otherwise = contacts_.empty() ? Verdict::kSeparate : Verdict::kTouch;
      return DecideByContainment(otherwise, Tier::kBound);
    }
    if (!is_exact_) return DecideUnsureInDoubles();
    return DecideUnsureExactly();
  }

 private:
  MembershipResult Decide(Verdict verdict, Tier tier) {
    result_.verdict = verdict;
    result_.tier = tier;
    return result_;
  }

  Triage Compare(int face_a, int face_b) {
    ++result_.triangle_tests;
    const Triage triage =
        internal::TriageTriangles(pair_, face_a, face_b, offset_, &cache_.crossing);
    if (triage == Triage::kCross) {
      result_.face_a = face_a;
      result_.face_b = face_b;
    }
    return triage;
  }

  // The edge and the face that crossed last time, then all of their two faces.
  bool RememberedCross() {
    const Crossing crossing = cache_.crossing;
    const TriangleMesh &a = pair_.a().mesh, &b = pair_.b().mesh;
    const TriangleMesh& of_edge = crossing.edge_is_of_a ? a : b;
    const TriangleMesh& of_face = crossing.edge_is_of_a ? b : a;
    if (crossing.half_edge < 0 || crossing.half_edge >= of_edge.half_edge_count() ||
        crossing.face < 0 || crossing.face >= of_face.face_count()) {
      return false;
    }
    const auto [face_a, face_b] = FacesOf(crossing);
    if (!IsPrismOf(crossing) && cache_.prism.Make(pair_, crossing) &&
        cache_.prism.Holds(pair_, x_)) {
      result_.face_a = face_a;
      result_.face_b = face_b;
      return true;
    }
    return Compare(face_a, face_b) == Triage::kCross;
  }

  bool IsPrismOf(const Crossing& crossing) const {
    return cache_.prism.crossing() == crossing && cache_.prism.IsOf(pair_);
  }

  // Compares the trees from the roots down. A leaf is paired with the nodes of the other tree until
  // it meets leaves.
  bool SurfacesCross() {
    cache_.stack.clear();
    cache_.stack.emplace_back(0, 0);
    while (!cache_.stack.empty()) {
      const auto [a, b] = cache_.stack.back();
      cache_.stack.pop_back();
      ++result_.box_tests;
      const BoxNode &node_a = pair_.a().tree.node(a), &node_b = pair_.b().tree.node(b);
      if (node_a.leaf >= 0 && node_b.leaf >= 0) {
        if (CompareLeaves(node_a, node_b)) return true;
      } else {
        CompareNodes(a, node_a, b, node_b);
      }
    }
    return false;
  }

  void CompareNodes(int a, const BoxNode& node_a, int b, const BoxNode& node_b) {
    std::uint8_t masks[kTreeWidth];
    MeetingLanes(node_a, node_b, offset_.value, offset_.error, masks);
    std::uint64_t hits;  // bit 8 j + i: lanes i of A and j of B
    std::memcpy(&hits, masks, sizeof hits);
    // Of a leaf all lanes are one.
    if (node_a.leaf >= 0) {
      for (int j = 0; j < node_b.lane_count; ++j) {
        if (masks[j] != 0) cache_.stack.emplace_back(a, node_b.children[j]);
      }
      return;
    }
    if (node_b.leaf >= 0) {
      for (std::uint64_t of_a = OfAny(hits); of_a != 0; of_a &= of_a - 1) {
        cache_.stack.emplace_back(node_a.children[std::countr_zero(of_a)], b);
      }
      return;
    }
    const bool in_order = result_.box_tests <= kOrdered;
    double most = -1.0;
    std::size_t best = 0;
    for (; hits != 0; hits &= hits - 1) {
      const int bit = std::countr_zero(hits), i = bit % kTreeWidth, j = bit / kTreeWidth;
      cache_.stack.emplace_back(node_a.children[i], node_b.children[j]);
      if (!in_order) continue;
      const double shared = SharedVolume(node_a, i, node_b, j);
      if (shared > most) most = shared, best = cache_.stack.size() - 1;
    }
    if (most >= 0.0) std::swap(cache_.stack[best], cache_.stack.back());
  }

  static std::uint64_t OfAny(std::uint64_t bytes) {
    bytes |= bytes >> 32;
    bytes |= bytes >> 16;
    return (bytes | bytes >> 8) & 0xff;
  }

  bool CompareLeaves(const BoxNode& leaf_a, const BoxNode& leaf_b) {
    const FaceLanes &lanes_a = pair_.a().leaves[leaf_a.leaf],
                    &lanes_b = pair_.b().leaves[leaf_b.leaf];
    std::uint64_t pairs =
        in_eights_ ? internal::MeetingFacesInEights(pair_.a(), leaf_a, pair_.b(), leaf_b, offset_)
                   : internal::MeetingFacesInFours(pair_.a(), leaf_a, pair_.b(), leaf_b, offset_);
    for (; pairs != 0; pairs &= pairs - 1) {
      if (result_.triangle_tests >= kAlone) pairs = WithoutParted(lanes_a, lanes_b, pairs);
      if (pairs == 0) break;
      const int bit = std::countr_zero(pairs), i = bit % kTreeWidth, j = bit / kTreeWidth;
      if (CompareFaces(~leaf_a.children[i], ~leaf_b.children[j])) return true;
    }
    return false;
  }

  // Parts pairs of faces, as long as they are many, until the first that is left cannot be.
  std::uint64_t WithoutParted(const FaceLanes& lanes_a, const FaceLanes& lanes_b,
                              std::uint64_t pairs) {
    for (int round = 0; round < internal::kPartingRounds && AreMany(pairs);) {
      const std::uint64_t before = pairs, first = pairs & -pairs;
      pairs = internal::PartFirst(lanes_a, lanes_b, offset_, pairs, round);
      result_.triangle_tests += std::popcount(before ^ pairs);
      round = (pairs & first) == 0 ? 0 : round + 1;
    }
    return pairs;
  }

  bool CompareFaces(int face_a, int face_b) {
    const Triage triage = Compare(face_a, face_b);
    if (triage == Triage::kUnsure && !IsContact(face_a, face_b)) {
      cache_.unsure.emplace_back(face_a, face_b);
    }
    return triage == Triage::kCross;
  }

  double SharedVolume(const BoxNode& node_a, int i, const BoxNode& node_b, int j) const {
    double volume = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double move = offset_.value[axis];
      volume *= std::min(node_a.high[axis][i], node_b.high[axis][j] + move) -
                std::max(node_a.low[axis][i], node_b.low[axis][j] + move);
    }
    return std::abs(volume);
  }

  bool IsContact(int face_a, int face_b) const {
    return std::find(contacts_.begin(), contacts_.end(), std::pair(face_a, face_b)) !=
           contacts_.end();
  }

  MembershipResult DecideUnsureInDoubles() {
    // A component that is proven to lie inside settles it, whatever the rest does.
    const auto contained = FindContained(nullptr);
    if (contained && *contained) return Decide(Verdict::kOverlap, Tier::kBound);
    return Decide(Verdict::kUndecided, Tier::kNone);
  }

  MembershipResult DecideUnsureExactly() {
    ExactContact contact(pair_, x_);
    if (contacts_.empty()) FindTouched(true);
    bool is_touching = !contacts_.empty();
    for (const auto& [face_a, face_b] : cache_.unsure) {
      ++result_.exact_tests;
      const Verdict verdict = contact.Meet(face_a, face_b);
      if (verdict == Verdict::kSeparate) continue;
      if (!is_touching || verdict == Verdict::kOverlap) {
        result_.face_a = face_a;
        result_.face_b = face_b;
      }
      if (verdict == Verdict::kOverlap) return Decide(verdict, Tier::kExact);
      is_touching = true;
      MarkTouched(face_a, face_b);
    }
    return DecideByContainment(is_touching ? Verdict::kTouch : Verdict::kSeparate, Tier::kExact);
  }

  // Marks no component (`none`), or room for marks.
  void FindTouched(bool make_room) {
    cache_.touched_a.assign(make_room ? pair_.a().mesh.components().size() : 0, 0);
    cache_.touched_b.assign(make_room ? pair_.b().mesh.components().size() : 0, 0);
  }

  void MarkTouched(int face_a, int face_b) {
    if (cache_.touched_a.empty()) return;
    cache_.touched_a[pair_.a().mesh.component_of_face(face_a)] = 1;
    cache_.touched_b[pair_.b().mesh.component_of_face(face_b)] = 1;
  }

  MembershipResult DecideByContainment(Verdict otherwise, Tier tier) {
    std::optional<ExactContact> contact;
    const auto contained = FindContained(is_exact_ ? &contact : nullptr);
    if (!contained) return Decide(Verdict::kUndecided, Tier::kNone);
    if (contact) tier = Tier::kExact;
    if (*contained) {
      result_.face_a = result_.face_b = -1;
      return Decide(Verdict::kOverlap, tier);
    }
    return Decide(otherwise, tier);
  }

  // Whether a component of either surface that the other does not meet lies inside the other
  // solid: one of its vertices does. Nothing if doubles cannot tell and `contact` is null.
  std::optional<bool> FindContained(std::optional<ExactContact>* contact) {
    const std::optional<bool> in_b = FindContained(true, contact);
    if (in_b && *in_b) return true;
    const std::optional<bool> in_a = FindContained(false, contact);
    if (in_a && *in_a) return true;
    if (!in_a || !in_b) return std::nullopt;
    return false;
  }

  std::optional<bool> FindContained(bool components_of_a, std::optional<ExactContact>* contact) {
    const PlacedMesh& inner = components_of_a ? pair_.a() : pair_.b();
    const PlacedMesh& outer = components_of_a ? pair_.b() : pair_.a();
    const std::vector<std::uint8_t>& touched =
        components_of_a ? cache_.touched_a : cache_.touched_b;
    bool is_sure = true;
    const auto components = inner.mesh.components();
    for (std::size_t i = 0; i < components.size(); ++i) {
      if (!touched.empty() && touched[i] != 0) continue;
      const int v = inner.mesh.face(components[i].first_face)[0];
      const Eigen::Vector3d point = components_of_a
                                        ? Eigen::Vector3d(inner.points[v] - offset_.value)
                                        : Eigen::Vector3d(inner.points[v] + offset_.value);
      std::optional<bool> inside = internal::TriageInside(outer, point, offset_.error);
      if (!inside && contact != nullptr) {
        if (!*contact) contact->emplace(pair_, x_);
        inside = internal::IsInside(outer, point, offset_.error, [&](int w) {
          return components_of_a ? (*contact)->PointOfB(w) - (*contact)->PointOfA(v)
                                 : (*contact)->PointOfA(w) - (*contact)->PointOfB(v);
        });
      }
      if (inside && *inside) return true;
      is_sure &= inside.has_value();
    }
    if (!is_sure) return std::nullopt;
    return false;
  }

  const MeshPair& pair_;
  const Translation& x_;
  const internal::Offset offset_;
  const bool is_exact_;
  const std::span<const std::pair<int, int>> contacts_;
  MembershipCache& cache_;
  const bool in_eights_ = internal::HasEights();
  MembershipResult result_;
};

MembershipResult Search(const MeshPair& pair, const Translation& x,
                        const MembershipOptions& options, MembershipCache* cache) {
  MembershipCache own;
  return Query(pair, x, options, cache != nullptr ? cache : &own).Run();
}

}  // namespace

MembershipResult Membership(const MeshPair& pair, const Translation& x,
                            const MembershipOptions& options, MembershipCache* cache) {
  assert(x.value.allFinite());
  if (cache == nullptr || !(cache->prism.crossing() == cache->crossing) ||
      !cache->prism.IsOf(pair) || !cache->prism.Holds(pair, x)) {
    return Search(pair, x, options, cache);
  }
  MembershipResult result;
  result.verdict = Verdict::kOverlap;
  result.tier = Tier::kBound;
  std::tie(result.face_a, result.face_b) = FacesOf(cache->crossing);
  return result;
}

void Membership(const MeshPair& pair, std::span<const Eigen::Vector3d> translations,
                std::span<MembershipResult> results, const MembershipOptions& options,
                MembershipCache* cache) {
  assert(translations.size() == results.size());
  MembershipCache own;
  MembershipCache* shared = cache != nullptr ? cache : &own;
  for (std::size_t i = 0; i < translations.size(); ++i) {
    results[i] = Membership(pair, translations[i], options, shared);
  }
}

}  // namespace touchstone
