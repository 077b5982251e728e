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

// Bit i: lane i of the node and the other bound have cones that meet and spheres whose sum comes
// within the target's reach of its box. Cones of angles s and t meet iff their axes make an angle
// of at most s + t, of cosine cos s cos t - sin s sin t.
TOUCHSTONE_VECTOR_CLONES
unsigned MeetingLanes(const Node& node, const LaneBound& other, const GatherTarget& target) {
  const double x = target.center[0] - other.center[0], y = target.center[1] - other.center[1],
               z = target.center[2] - other.center[2], r = target.reach + other.radius;
  const double half_x = target.half[0], half_y = target.half[1], half_z = target.half[2];
  std::int64_t meets[kWidth];
  for (int i = 0; i < kWidth; ++i) meets[i] = std::int64_t{1} << i;
  for (int i = 0; i < kWidth; ++i) {
    const double dx = std::abs(node.center[0][i] - x) - half_x;
    const double dy = std::abs(node.center[1][i] - y) - half_y;
    const double dz = std::abs(node.center[2][i] - z) - half_z;
    // Twice what is beyond the box along each axis, and nothing within.
    const double ex = dx + std::abs(dx), ey = dy + std::abs(dy), ez = dz + std::abs(dz);
    const double reach = 2.0 * (node.radius[i] + r);
    const double cosine = node.axis[0][i] * other.axis[0] + node.axis[1][i] * other.axis[1] +
                          node.axis[2][i] * other.axis[2];
    const double least = node.cosine[i] * other.cosine - node.sine[i] * other.sine;
    // In a form that compilers know to put into lanes.
    meets[i] = ((ex * ex + ey * ey + ez * ez > reach * reach) | (cosine < least)) ? 0 : meets[i];
  }
  std::int64_t mask = 0;
  for (int i = 0; i < kWidth; ++i) mask |= meets[i];
  return static_cast<unsigned>(mask) & ((1u << node.lane_count) - 1);
}

LaneBound LaneOf(const Node& node, int lane) {
  return {{node.center[0][lane], node.center[1][lane], node.center[2][lane]},
          node.radius[lane],
          {node.axis[0][lane], node.axis[1][lane], node.axis[2][lane]},
          node.cosine[lane],
          node.sine[lane]};
}

// Round the sum of two lanes' spheres.
Box3 BoxOfSum(const Node& a, int lane_a, const Node& b, int lane_b) {
  const Vector3d center(a.center[0][lane_a] + b.center[0][lane_b],
                        a.center[1][lane_a] + b.center[1][lane_b],
                        a.center[2][lane_a] + b.center[2][lane_b]);
  const Vector3d reach = Vector3d::Constant(a.radius[lane_a] + b.radius[lane_b]);
  return {center - reach, center + reach};
}

// Widened by the padding.
LaneBound Padded(const FeatureBound& bound) {
  const bool is_all = bound.cone.cosine <= 0.0;
  const Vector3d &center = bound.center, &axis = bound.cone.axis;
  return {{center[0], center[1], center[2]},
          bound.radius * (1.0 + kPadding),
          {axis[0], axis[1], axis[2]},
          is_all ? kAllCosine : bound.cone.cosine - kPadding,
          is_all ? kAllSine : SineOf(bound.cone.cosine) + kPadding};
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
    const LaneBound padded = Padded(bound);
    Node& node = nodes_[index];
    for (std::size_t to = lane; to < kWidth; ++to) {  // unused lanes repeat the last one
      for (int i = 0; i < 3; ++i) {
        node.center[i][to] = padded.center[i];
        node.axis[i][to] = padded.axis[i];
      }
      node.radius[to] = padded.radius;
      node.cosine[to] = padded.cosine;
      node.sine[to] = padded.sine;
      node.children[to] = is_item ? ~runs[lane][0] : child;
    }
    if (lane == 0) {
      all = bound;
    } else {
      GrowSphere(&all, bound);
      all.cone = ConeRound(all.cone, bound.cone);
    }
  }
  nodes_[index].all = Padded(all);
  return all;
}

PlacedSphereConeTree::PlacedSphereConeTree(SphereConeTree tree)
    : tree_(std::move(tree)), placed_(tree_.nodes().size()), stamps_(tree_.nodes().size(), 0) {}

void PlacedSphereConeTree::Place(const Eigen::Matrix3d& linear, const Vector3d& shift, double scale,
                                 double sense, double widening) {
  // A stays where it is while the scale does.
  if (stamp_ != 0 && linear_ == sense * linear && shift_ == sense * shift && scale_ == scale &&
      widening_ == widening) {
    return;
  }
  widening_ = widening;
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
    PlaceSize(node.radius[lane], node.cosine[lane], node.sine[lane], &placed.radius[lane],
              &placed.cosine[lane], &placed.sine[lane]);
    placed.children[lane] = node.children[lane];
  }
  const LaneBound& all = node.all;
  for (int k = 0; k < 3; ++k) {
    placed.all.center[k] = linear_(k, 0) * all.center[0] + linear_(k, 1) * all.center[1] +
                           linear_(k, 2) * all.center[2] + shift_[k];
    placed.all.axis[k] =
        turn_(k, 0) * all.axis[0] + turn_(k, 1) * all.axis[1] + turn_(k, 2) * all.axis[2];
  }
  PlaceSize(all.radius, all.cosine, all.sine, &placed.all.radius, &placed.all.cosine,
            &placed.all.sine);
  placed.lane_count = node.lane_count;
  stamps_[i] = stamp_;
}

void PlacedSphereConeTree::PlaceSize(double radius, double cosine, double sine,
                                     double* placed_radius, double* placed_cosine,
                                     double* placed_sine) const {
  // Places are off by a few units of the pair's size, which is one.
  *placed_radius = scale_ * radius + 0x1p-44;
  // Wider than a half-space is all directions.
  const double wider = cosine * widening_cosine_ - sine * widening_sine_;
  const bool is_all = cosine < -1.0 || wider <= 0.0;
  *placed_cosine = is_all ? kAllCosine : wider;
  *placed_sine = is_all ? kAllSine : sine * widening_cosine_ + cosine * widening_sine_;
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

void SphereHierarchy::NearBall(const Vector3d& center, double radius,
                               std::vector<SumFacet>* candidates) {
  AllPairs({center, Vector3d::Zero(), radius}, nullptr, candidates);
}

// The box that holds all goes first: half of what its middle and sides are rounded by.
void SphereHierarchy::NearAnyOf(const NearBoxes& near, std::vector<SumFacet>* candidates) {
  const Box3& all = near.all();
  const Vector3d half = 0.5 * all.high - 0.5 * all.low;
  AllPairs({0.5 * all.low + 0.5 * all.high, half, 0x1p-44}, &near, candidates);
}

void SphereHierarchy::AllPairs(const GatherTarget& target, const NearBoxes* near,
                               std::vector<SumFacet>* candidates) {
  Pairs(kFaces, kVertices, SumFacetKind::kFaceVertex, target, near, candidates);
  Pairs(kVertices, kFaces, SumFacetKind::kVertexFace, target, near, candidates);
  Pairs(kEdges, kEdges, SumFacetKind::kEdgeEdge, target, near, candidates);
}

// Of two nodes the larger is opened first, against all of the other: few of its lanes are left.
void SphereHierarchy::Pairs(Kind kind_a, Kind kind_b, SumFacetKind kind, const GatherTarget& target,
                            const NearBoxes* near, std::vector<SumFacet>* candidates) {
  PlacedSphereConeTree &tree_a = trees_[0][kind_a], &tree_b = trees_[1][kind_b];
  if (tree_a.empty() || tree_b.empty()) return;
  const auto each = [](unsigned mask, const auto& visit) {
    for (; mask != 0; mask &= mask - 1) visit(std::countr_zero(mask));
  };
  // A node, or ~(8 node + lane) for a lane that holds an item.
  stack_.assign(1, {0, 0});
  while (!stack_.empty()) {
    const auto [i, j] = stack_.back();
    stack_.pop_back();
    const int node_a = i < 0 ? ~i / kWidth : i, node_b = j < 0 ? ~j / kWidth : j;
    const Node& a = tree_a.node(node_a);
    const Node& b = tree_b.node(node_b);
    const auto add = [&](int k, int l) {
      const int child_a = a.children[k], child_b = b.children[l];
      if (child_a < 0 && child_b < 0) {
        candidates->push_back({kind, false, ~child_a, ~child_b});
      } else if (near == nullptr || near->MeetsAny(BoxOfSum(a, k, b, l))) {
        stack_.emplace_back(child_a >= 0 ? child_a : ~(kWidth * node_a + k),
                            child_b >= 0 ? child_b : ~(kWidth * node_b + l));
      }
    };
    if (i < 0) {
      const int k = ~i % kWidth;
      each(MeetingLanes(b, LaneOf(a, k), target), [&](int l) { add(k, l); });
    } else if (j < 0) {
      const int l = ~j % kWidth;
      each(MeetingLanes(a, LaneOf(b, l), target), [&](int k) { add(k, l); });
    } else if (a.all.radius >= b.all.radius) {
      each(MeetingLanes(a, b.all, target),
           [&](int k) { each(MeetingLanes(b, LaneOf(a, k), target), [&](int l) { add(k, l); }); });
    } else {
      each(MeetingLanes(b, a.all, target),
           [&](int l) { each(MeetingLanes(a, LaneOf(b, l), target), [&](int k) { add(k, l); }); });
    }
  }
}

}  // namespace touchstone::internal
