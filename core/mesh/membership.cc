// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/membership.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <optional>

#include "touchstone/core/mesh/point_in_mesh_internal.h"
#include "touchstone/core/mesh/triangle_contact_internal.h"

namespace touchstone {
namespace {

using internal::ExactContact;
using internal::Triage;

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
    if (WitnessCrosses() || SurfacesCross()) return Decide(Verdict::kOverlap, Tier::kBound);
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
    const Triage triage = internal::TriageTriangles(pair_, face_a, face_b, offset_);
    if (triage == Triage::kCross) {
      result_.face_a = face_a;
      result_.face_b = face_b;
      cache_.witness = {face_a, face_b};
    }
    return triage;
  }

  bool WitnessCrosses() {
    const auto [face_a, face_b] = cache_.witness;
    if (face_a < 0 || face_a >= pair_.a().mesh.face_count() || face_b < 0 ||
        face_b >= pair_.b().mesh.face_count()) {
      return false;
    }
    return Compare(face_a, face_b) == Triage::kCross;
  }

  // Compares the trees from the roots down. A child that is a face is paired with the nodes of
  // the other tree until it meets faces.
  bool SurfacesCross() {
    cache_.stack.clear();
    cache_.stack.emplace_back(0, 0);
    while (!cache_.stack.empty()) {
      const auto [a, b] = cache_.stack.back();
      cache_.stack.pop_back();
      if (CompareNodes(a, b)) return true;
    }
    return false;
  }

  bool CompareNodes(int a, int b) {
    ++result_.box_tests;
    BoxNode single;
    if (a < 0 || b < 0) single = a < 0 ? SingleFace(pair_.a(), ~a) : SingleFace(pair_.b(), ~b);
    const BoxNode& node_a = a >= 0 ? pair_.a().tree.node(a) : single;
    const BoxNode& node_b = b >= 0 ? pair_.b().tree.node(b) : single;
    std::uint8_t masks[kTreeWidth];
    MeetingLanes(node_a, node_b, offset_.value, offset_.error, masks);
    for (int j = 0; j < node_b.lane_count; ++j) {
      for (unsigned mask = masks[j]; mask != 0; mask &= mask - 1) {
        const int child_a = node_a.children[std::countr_zero(mask)];
        const int child_b = node_b.children[j];
        if (child_a >= 0 || child_b >= 0) {
          cache_.stack.emplace_back(child_a, child_b);
          continue;
        }
        const Triage triage = Compare(~child_a, ~child_b);
        if (triage == Triage::kCross) return true;
        if (triage == Triage::kUnsure && !IsContact(~child_a, ~child_b)) {
          cache_.unsure.emplace_back(~child_a, ~child_b);
        }
      }
    }
    return false;
  }

  bool IsContact(int face_a, int face_b) const {
    return std::find(contacts_.begin(), contacts_.end(), std::pair(face_a, face_b)) !=
           contacts_.end();
  }

  // A face as a node of one lane.
  static BoxNode SingleFace(const PlacedMesh& mesh, int face) {
    BoxNode node;
    for (int lane = 0; lane < kTreeWidth; ++lane) {
      for (int axis = 0; axis < 3; ++axis) {
        node.low[axis][lane] = 1e300;
        node.high[axis][lane] = -1e300;
      }
      node.children[lane] = ~face;
    }
    const Triangle& corners = mesh.mesh.face(face);
    const auto &a = mesh.points[corners[0]], &b = mesh.points[corners[1]],
               &c = mesh.points[corners[2]];
    for (int axis = 0; axis < 3; ++axis) {
      node.low[axis][0] = std::min({a[axis], b[axis], c[axis]});
      node.high[axis][0] = std::max({a[axis], b[axis], c[axis]});
    }
    node.lane_count = 1;
    return node;
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
  MembershipResult result_;
};

}  // namespace

MembershipResult Membership(const MeshPair& pair, const Translation& x,
                            const MembershipOptions& options, MembershipCache* cache) {
  assert(x.value.allFinite());
  MembershipCache own;
  return Query(pair, x, options, cache != nullptr ? cache : &own).Run();
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
