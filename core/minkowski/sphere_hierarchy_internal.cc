// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/sphere_hierarchy_internal.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "touchstone/core/base/vector_clones.h"
#include "touchstone/core/minkowski/normal_cone_internal.h"

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;
using Node = SphereConeTree::Node;
constexpr int kWidth = SphereConeTree::kWidth;

// Cosines and sines are moved by this much towards wider cones, and radii grow by this factor: a
// pose may be off orthonormal by 1e-6, unit vectors and roundings by far less.
constexpr double kPadding = 1e-5;

// The smallest sphere round two.
void GrowSphere(FeatureBound* all, const FeatureBound& more) {
  const Vector3d way = more.center - all->center;
  const double distance = way.norm();
  if (distance + more.radius <= all->radius) return;
  if (distance + all->radius <= more.radius) {
    all->center = more.center;
    all->radius = more.radius;
    return;
  }
  const double radius = 0.5 * (distance + all->radius + more.radius);
  all->center += ((radius - all->radius) / distance) * way;
  all->radius = radius * (1.0 + 1e-12);
}

// Parts `items` at `at` along the coordinate in which they spread most: of their places, or of
// their normals, which are as far apart as they look on a sphere of a quarter of the size.
void PartAt(std::span<const FeatureBound> bounds, std::span<int> items, std::ptrdiff_t at,
            double size) {
  using Place = Eigen::Matrix<double, 6, 1>;
  const auto place_of = [&](int k) {
    Place place;
    place << bounds[k].center, 0.25 * size * bounds[k].cone.axis;
    return place;
  };
  Place low = place_of(items[0]), high = low;
  for (const int k : items) {
    low = low.cwiseMin(place_of(k));
    high = high.cwiseMax(place_of(k));
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  std::nth_element(items.begin(), items.begin() + at, items.end(), [&](int i, int j) {
    const double x = place_of(i)[axis], y = place_of(j)[axis];
    return x != y ? x < y : i < j;
  });
}

void PartIntoRuns(std::span<const FeatureBound> bounds, std::span<int> items, std::ptrdiff_t run,
                  double size, std::vector<std::span<int>>* runs) {
  const std::ptrdiff_t count = (std::ssize(items) + run - 1) / run;
  if (count <= 1) {
    runs->push_back(items);
    return;
  }
  const std::ptrdiff_t at = count / 2 * run;
  PartAt(bounds, items, at, size);
  PartIntoRuns(bounds, items.first(at), run, size, runs);
  PartIntoRuns(bounds, items.subspan(at), run, size, runs);
}

double SizeOf(std::span<const FeatureBound> bounds, std::span<const int> items) {
  Vector3d low = bounds[items[0]].center, high = low;
  for (const int k : items) {
    low = low.cwiseMin(bounds[k].center);
    high = high.cwiseMax(bounds[k].center);
  }
  return (high - low).norm();
}

// Bit i of masks[j]: lane i of `a` and lane j of `b` have cones that meet and spheres whose sum
// meets the ball. Cones of angles s and t meet iff their axes make an angle of at most s + t, of
// cosine cos s cos t - sin s sin t; always, where that is a half-space or more.
TOUCHSTONE_VECTOR_CLONES
void MeetingLanes(const Node& a, const Node& b, int lanes_of_b, const Vector3d& center,
                  double radius, std::uint8_t masks[kWidth]) {
  for (int j = 0; j < lanes_of_b; ++j) {
    const double x = center[0] - b.center[0][j], y = center[1] - b.center[1][j],
                 z = center[2] - b.center[2][j], r = radius + b.radius[j];
    std::int64_t meets[kWidth];
    for (int i = 0; i < kWidth; ++i) {
      const double dx = a.center[0][i] - x, dy = a.center[1][i] - y, dz = a.center[2][i] - z;
      const double reach = a.radius[i] + r;
      const double cosine =
          a.axis[0][i] * b.axis[0][j] + a.axis[1][i] * b.axis[1][j] + a.axis[2][i] * b.axis[2][j];
      const double least = a.cosine[i] * b.cosine[j] - a.sine[i] * b.sine[j];
      const bool is_near = dx * dx + dy * dy + dz * dz <= reach * reach;
      const bool is_wide = (cosine >= least) | (a.cosine[i] < -1.0) | (b.cosine[j] < -1.0);
      meets[i] = is_near & is_wide ? std::int64_t{1} << i : 0;
    }
    std::int64_t mask = 0;
    for (int i = 0; i < kWidth; ++i) mask |= meets[i];
    masks[j] = static_cast<std::uint8_t>(mask);
  }
}

// A lane alone, as a node of one lane.
void CopyLane(const Node& node, int lane, Node* alone) {
  for (int to = 0; to < kWidth; ++to) {
    for (int i = 0; i < 3; ++i) {
      alone->center[i][to] = node.center[i][lane];
      alone->axis[i][to] = node.axis[i][lane];
    }
    alone->radius[to] = node.radius[lane];
    alone->cosine[to] = node.cosine[lane];
    alone->sine[to] = node.sine[lane];
    alone->children[to] = node.children[lane];
  }
  alone->lane_count = 1;
}

FeatureBound BoundOfPoints(std::span<const Vector3d> points, const NormalCone& cone) {
  Vector3d low = points[0], high = points[0];
  for (const Vector3d& x : points) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  FeatureBound bound{0.5 * low + 0.5 * high, 0.0, cone};
  for (const Vector3d& x : points) bound.radius = std::max(bound.radius, (x - bound.center).norm());
  return bound;
}

SphereConeTree FaceTree(const TriangleMesh& mesh) {
  std::vector<FeatureBound> bounds;
  std::vector<int> items;
  for (int f = 0; f < mesh.face_count(); ++f) {
    const Triangle& face = mesh.face(f);
    const Vector3d corners[] = {mesh.vertex(face[0]), mesh.vertex(face[1]), mesh.vertex(face[2])};
    bounds.push_back(BoundOfPoints(corners, {mesh.face_normal(f), 1.0}));
    items.push_back(f);
  }
  return SphereConeTree(bounds, std::move(items));
}

SphereConeTree VertexTree(const TriangleMesh& mesh, const GaussMap& map) {
  std::vector<FeatureBound> bounds;
  std::vector<int> items;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    bounds.push_back({mesh.vertex(v), 0.0, map.vertex_cone(v)});
    const VertexKind kind = map.vertex_kind(v);
    if (kind == VertexKind::kCorner || kind == VertexKind::kSpecial) items.push_back(v);
  }
  return SphereConeTree(bounds, std::move(items));
}

SphereConeTree EdgeTree(const TriangleMesh& mesh, const GaussMap& map) {
  std::vector<FeatureBound> bounds;
  std::vector<int> items;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int h = mesh.half_edge_of(e);
    const Vector3d ends[] = {mesh.vertex(mesh.tail(h)), mesh.vertex(mesh.head(h))};
    bounds.push_back(BoundOfPoints(ends, map.edge_cone(e)));
    if (mesh.edge_kind(e) == EdgeKind::kConvex) items.push_back(e);
  }
  return SphereConeTree(bounds, std::move(items));
}

}  // namespace

SphereConeTree::SphereConeTree(std::span<const FeatureBound> bounds, std::vector<int> items) {
  if (!items.empty()) AddNode(bounds, items);
}

FeatureBound SphereConeTree::AddNode(std::span<const FeatureBound> bounds, std::span<int> items) {
  const std::size_t index = nodes_.size();
  nodes_.emplace_back();
  std::ptrdiff_t run = 1;
  while (run * kWidth < std::ssize(items)) run *= kWidth;
  std::vector<std::span<int>> runs;
  PartIntoRuns(bounds, items, run, SizeOf(bounds, items), &runs);
  nodes_[index].lane_count = static_cast<int>(runs.size());
  FeatureBound all{};
  for (std::size_t lane = 0; lane < runs.size(); ++lane) {
    const int child = static_cast<int>(nodes_.size());
    const bool is_item = runs[lane].size() == 1;
    const FeatureBound bound = is_item ? bounds[runs[lane][0]] : AddNode(bounds, runs[lane]);
    Node& node = nodes_[index];
    for (std::size_t to = lane; to < kWidth; ++to) {  // unused lanes repeat the last one
      for (int i = 0; i < 3; ++i) {
        node.center[i][to] = bound.center[i];
        node.axis[i][to] = bound.cone.axis[i];
      }
      node.radius[to] = bound.radius * (1.0 + kPadding);
      // Below -1 for all directions.
      const bool is_all = bound.cone.cosine <= 0.0;
      node.cosine[to] = is_all ? -2.0 : bound.cone.cosine - kPadding;
      node.sine[to] = is_all ? 0.0 : SineOf(bound.cone.cosine) + kPadding;
      node.children[to] = is_item ? ~runs[lane][0] : child;
    }
    if (lane == 0) {
      all = bound;
    } else {
      GrowSphere(&all, bound);
      all.cone = ConeRound(all.cone, bound.cone);
    }
  }
  return all;
}

PlacedSphereConeTree::PlacedSphereConeTree(SphereConeTree tree)
    : tree_(std::move(tree)), placed_(tree_.nodes().size()), stamps_(tree_.nodes().size(), 0) {}

void PlacedSphereConeTree::Place(const Eigen::Matrix3d& linear, const Vector3d& shift, double scale,
                                 double sense, double widening) {
  widening_cosine_ = std::cos(widening);
  widening_sine_ = std::sin(widening);
  linear_ = sense * linear;
  turn_ = linear_ / scale;
  shift_ = sense * shift;
  scale_ = scale;
  if (++stamp_ == 0) {
    std::fill(stamps_.begin(), stamps_.end(), 0);
    stamp_ = 1;
  }
}

void PlacedSphereConeTree::PlaceNode(int i) {
  const Node& node = tree_.nodes()[i];
  Node& placed = placed_[i];
  for (int k = 0; k < 3; ++k) {
    for (int lane = 0; lane < kWidth; ++lane) {
      placed.center[k][lane] = linear_(k, 0) * node.center[0][lane] +
                               linear_(k, 1) * node.center[1][lane] +
                               linear_(k, 2) * node.center[2][lane] + shift_[k];
      placed.axis[k][lane] = turn_(k, 0) * node.axis[0][lane] + turn_(k, 1) * node.axis[1][lane] +
                             turn_(k, 2) * node.axis[2][lane];
    }
  }
  for (int lane = 0; lane < kWidth; ++lane) {
    // Places are off by a few units of the pair's size, which is one.
    placed.radius[lane] = scale_ * node.radius[lane] + 0x1p-44;
    // Wider than a half-space is all directions.
    const double cosine = node.cosine[lane] * widening_cosine_ - node.sine[lane] * widening_sine_;
    const bool is_all = node.cosine[lane] < -1.0 || cosine <= 0.0;
    placed.cosine[lane] = is_all ? -2.0 : cosine;
    placed.sine[lane] =
        is_all ? 0.0 : node.sine[lane] * widening_cosine_ + node.cosine[lane] * widening_sine_;
    placed.children[lane] = node.children[lane];
  }
  placed.lane_count = node.lane_count;
  stamps_[i] = stamp_;
}

SphereHierarchy::SphereHierarchy(const TriangleMesh& a, const GaussMap& map_a,
                                 const TriangleMesh& b, const GaussMap& map_b) {
  for (const int body : {0, 1}) {
    const TriangleMesh& mesh = body == 0 ? a : b;
    const GaussMap& map = body == 0 ? map_a : map_b;
    trees_[body].emplace_back(FaceTree(mesh));
    trees_[body].emplace_back(VertexTree(mesh, map));
    trees_[body].emplace_back(EdgeTree(mesh, map));
  }
}

void SphereHierarchy::Place(const MeshPair& pair, double widening) {
  const double scale = pair.scale();
  for (PlacedSphereConeTree& tree : trees_[0]) {
    tree.Place(scale * Eigen::Matrix3d::Identity(), Vector3d::Zero(), scale, 1.0, widening);
  }
  for (PlacedSphereConeTree& tree : trees_[1]) {
    tree.Place(scale * pair.pose().rotation(), scale * pair.pose().translation(), scale, -1.0, 0.0);
  }
}

void SphereHierarchy::Candidates(const Vector3d& center, double radius,
                                 std::vector<SumFacet>* candidates) {
  Pairs(kFaces, kVertices, SumFacetKind::kFaceVertex, center, radius, candidates);
  Pairs(kVertices, kFaces, SumFacetKind::kVertexFace, center, radius, candidates);
  Pairs(kEdges, kEdges, SumFacetKind::kEdgeEdge, center, radius, candidates);
}

void SphereHierarchy::Pairs(Kind kind_a, Kind kind_b, SumFacetKind kind, const Vector3d& center,
                            double radius, std::vector<SumFacet>* candidates) {
  PlacedSphereConeTree &tree_a = trees_[0][kind_a], &tree_b = trees_[1][kind_b];
  if (tree_a.empty() || tree_b.empty()) return;
  // A node, or ~(8 node + lane) for a lane that holds an item.
  stack_.assign(1, {0, 0});
  Node alone_a, alone_b;
  while (!stack_.empty()) {
    const auto [i, j] = stack_.back();
    stack_.pop_back();
    if (i < 0) CopyLane(tree_a.node(~i / kWidth), ~i % kWidth, &alone_a);
    if (j < 0) CopyLane(tree_b.node(~j / kWidth), ~j % kWidth, &alone_b);
    const Node& a = i < 0 ? alone_a : tree_a.node(i);
    const Node& b = j < 0 ? alone_b : tree_b.node(j);
    std::uint8_t masks[kWidth];
    MeetingLanes(a, b, b.lane_count, center, radius, masks);
    for (int k = 0; k < b.lane_count; ++k) {
      unsigned mask = masks[k] & ((1u << a.lane_count) - 1);
      for (; mask != 0; mask &= mask - 1) {
        const int lane = std::countr_zero(mask);
        const int child_a = a.children[lane], child_b = b.children[k];
        if (child_a < 0 && child_b < 0) {
          candidates->push_back({kind, false, ~child_a, ~child_b});
          continue;
        }
        stack_.emplace_back(child_a >= 0 ? child_a
                            : i < 0      ? i
                                         : ~(kWidth * i + lane),
                            child_b >= 0 ? child_b
                            : j < 0      ? j
                                         : ~(kWidth * j + k));
      }
    }
  }
}

}  // namespace touchstone::internal
