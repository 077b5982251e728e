// SPDX-License-Identifier: MIT
//
// What proves that points lie in M°: prisms and balls, met and recalled.
#include <Eigen/Geometry>
#include <algorithm>
#include <bit>

#include "touchstone/core/cpd/depth_searcher_internal.h"
#include "touchstone/core/cpd/passage_internal.h"
#include "touchstone/core/mesh/inner_balls.h"

namespace touchstone::internal {
namespace {

constexpr double kBallShrink = 1.0 - 4e-6;
constexpr double kNew = 1.0 - 0x1p-6;   // of a ball's radius: that much no other may hold
constexpr double kGoodDepth = 0x1p-14;  // of a point in a prism that is worth cutting by
constexpr int kEnough = 8;              // such prisms at a point

}  // namespace

using Eigen::Vector3d;

void DepthSearcher::RecallWitnesses() {
  for (const auto& [f, g] : s_.ball_faces) AddBall(nullptr, f, g);
  Prism prism;
  for (const PrismName& name : s_.prism_names) {
    const TriangleMesh& of_edge = (name.edge_is_of_a ? pair_.a() : pair_.b()).mesh;
    const TriangleMesh& of_face = (name.edge_is_of_a ? pair_.b() : pair_.a()).mesh;
    if (name.edge >= of_edge.edge_count() || name.face >= of_face.face_count()) continue;
    if (MakePrism(pair_, a_, b_, name, &prism)) AddPrism(prism);
  }
}

int DepthSearcher::AddPrism(const Prism& prism) {
  s_.prism_uses.push_back(0);
  ++result_.prisms;
  return s_.prisms.Add(prism);
}

void DepthSearcher::AddBall(const Vector3d* x, int face_a, int face_b) {
  if (face_a >= pair_.a().mesh.face_count() || face_b >= pair_.b().mesh.face_count()) return;
  const InnerBall &p = a_.ball(face_a), &q = b_.ball(face_b);
  if (p.radius <= 0.0 || q.radius <= 0.0) return;
  const double scale = pair_.scale();
  const Vector3d centre = scale * p.centre - (pair_.pose().rotation() * (scale * q.centre) +
                                              scale * pair_.pose().translation());
  const double radius = kBallShrink * scale * (p.radius + q.radius) - 0x1p-46;
  if (!(radius > 0.0)) return;
  if (x != nullptr && (*x - centre).norm() >= radius) return;
  // Faces beside each other mostly share theirs.
  if (s_.balls.Holds(centre, kNew * radius)) return;
  ++result_.balls;
  s_.balls.Add({centre, radius});
  s_.met_balls.emplace_back(face_a, face_b);
}

double DepthSearcher::AddWitness(const Vector3d& x, int face_a, int face_b) {
  if (face_a < 0) {
    AddClearance(x);
    return 0.0;
  }
  AddBall(&x, face_a, face_b);
  const MovedFace p(pair_.a(), face_a, Vector3d::Zero()), q(pair_.b(), face_b, x);
  double most = 0.0;
  PrismName best;
  VisitPassages(p, 0, 3, q, 0.0, [&](int k, double margin) {
    if (margin > most) most = margin, best = {true, a_.mesh().edge_of(3 * face_a + k), face_b};
  });
  VisitPassages(q, 0, 3, p, 0.0, [&](int k, double margin) {
    if (margin > most) most = margin, best = {false, b_.mesh().edge_of(3 * face_b + k), face_a};
  });
  Prism prism;
  if (!(most > 0.0) || !MakePrism(pair_, a_, b_, best, &prism)) return 0.0;
  const double margin = prism.Margin(x);
  if (margin > 0.0) AddPrism(prism);
  return std::max(0.0, margin);
}

void DepthSearcher::AddClearance(const Vector3d& x) {
  const double error = 2.0 * (pair_.a().point_error + pair_.b().point_error) + 0x1p-48;
  const auto try_components = [&](const PlacedMesh& inner, const PlacedMesh& outer, double sign) {
    for (const MeshComponent& component : inner.mesh.components()) {
      const Vector3d at = inner.points[inner.mesh.face(component.first_face)[0]] + sign * x;
      const auto radius = InnerClearance(outer, at, error);
      if (!radius) continue;
      ++result_.balls;
      s_.balls.Add({x, *radius});
    }
  };
  try_components(pair_.a(), pair_.b(), -1.0);
  try_components(pair_.b(), pair_.a(), 1.0);
}

void DepthSearcher::AddAllWitnesses(const Vector3d& x) {
  int good = 0;
  s_.membership.stack.clear();
  s_.membership.stack.emplace_back(0, 0);
  auto& stack = s_.membership.stack;
  const BoxTree &tree_a = pair_.a().tree, &tree_b = pair_.b().tree;
  while (!stack.empty()) {
    const auto [i, j] = stack.back();
    stack.pop_back();
    // Faces are compared with nodes lane by lane.
    BoxNode single;
    const auto as_node = [&](const PlacedMesh& placed, const BoxTree& tree,
                             int index) -> const BoxNode& {
      if (index >= 0) return tree.node(index);
      const Triangle& face = placed.mesh.face(~index);
      for (int axis = 0; axis < 3; ++axis) {
        const auto [low, high] =
            std::minmax({placed.points[face[0]][axis], placed.points[face[1]][axis],
                         placed.points[face[2]][axis]});
        for (int lane = 0; lane < kTreeWidth; ++lane) {
          single.low[axis][lane] = lane == 0 ? low : 1e300;
          single.high[axis][lane] = lane == 0 ? high : -1e300;
        }
      }
      for (int lane = 0; lane < kTreeWidth; ++lane) single.children[lane] = index;
      single.lane_count = 1;
      return single;
    };
    const BoxNode& node_a = as_node(pair_.a(), tree_a, i);
    const BoxNode& node_b = as_node(pair_.b(), tree_b, j);
    std::uint8_t masks[kTreeWidth];
    MeetingLanes(node_a, node_b, x, 0x1p-46, masks);
    for (int lane = 0; lane < node_b.lane_count; ++lane) {
      for (unsigned mask = masks[lane]; mask != 0; mask &= mask - 1) {
        const int of_a = node_a.children[std::countr_zero(mask)], of_b = node_b.children[lane];
        if (of_a < 0 && of_b < 0) {
          if (AddWitness(x, ~of_a, ~of_b) > kGoodDepth && ++good >= kEnough) return;
        } else {
          stack.emplace_back(of_a, of_b);
        }
      }
    }
  }
}

}  // namespace touchstone::internal
