// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/feature_tree.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "touchstone/core/minkowski/normal_cone_internal.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;
using internal::kAllCosine;
using internal::kAllSine;
using internal::SineOf;

constexpr int kWidth = kFeatureTreeWidth;
constexpr double kPadding = 1e-5;
// Measured on the paper's scenes: 3 to 7 do as well; at 2 tori take half as many pairs of nodes
// again, at 10 spoon and cup a quarter.
constexpr double kNormalWeight = 6.0;
constexpr int kBoundSteps = 64;  // towards the least sphere and cone

// Parts `items` at `at` by place, or by normal where these spread over more of the sphere than
// places over the body's size.
void PartAt(std::span<const FeatureBound> bounds, double size, std::span<int> items,
            std::ptrdiff_t at) {
  Vector3d low[2], high[2];
  for (int k = 0; k < 2; ++k) low[k].setConstant(1e300), high[k].setConstant(-1e300);
  for (const int item : items) {
    const Vector3d* values[] = {&bounds[item].centre, &bounds[item].cone.axis};
    for (int k = 0; k < 2; ++k) {
      low[k] = low[k].cwiseMin(*values[k]);
      high[k] = high[k].cwiseMax(*values[k]);
    }
  }
  int place = 0, normal = 0;
  const double extent = (high[0] - low[0]).maxCoeff(&place);
  const double spread = (high[1] - low[1]).maxCoeff(&normal);
  const bool is_by_normal = spread * size > kNormalWeight * extent;
  const auto value = [&](int item) {
    return is_by_normal ? bounds[item].cone.axis[normal] : bounds[item].centre[place];
  };
  std::nth_element(items.begin(), items.begin() + at, items.end(), [&](int i, int j) {
    const double x = value(i), y = value(j);
    return x != y ? x < y : i < j;
  });
}

void PartIntoRuns(std::span<const FeatureBound> bounds, double extent, std::span<int> items,
                  std::ptrdiff_t size, std::vector<std::span<int>>* runs) {
  const std::ptrdiff_t count = (std::ssize(items) + size - 1) / size;
  if (count <= 1) {
    runs->push_back(items);
    return;
  }
  const std::ptrdiff_t at = count / 2 * size;
  PartAt(bounds, extent, items, at);
  PartIntoRuns(bounds, extent, items.first(at), size, runs);
  PartIntoRuns(bounds, extent, items.subspan(at), size, runs);
}

// Sets the pole and the belt of a bound round the items: the direction that their rays leave most
// free. A normal between rays r_k is their mean over its length, and that is at least the cosine of
// the item's cone: so it is off the plane by no more than the furthest ray over that.
void SetBelt(std::span<const FeatureBound> bounds, std::span<const int> items,
             FeatureBound* bound) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const int item : items) {
    if (bounds[item].rays.empty() || bounds[item].cone.cosine <= 0.0) return;
    for (const Vector3d& ray : bounds[item].rays) spread += ray * ray.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  bound->pole = axes.eigenvectors().col(0).normalized();
  bound->belt = 0.0;
  for (const int item : items) {
    for (const Vector3d& ray : bounds[item].rays) {
      bound->belt =
          std::max(bound->belt, std::abs(ray.dot(bound->pole)) / bounds[item].cone.cosine);
    }
  }
}

// How high a feature's centre lies above a point along the normals of its cone.
struct HeightRange {
  double low, high;
};

HeightRange HeightsAbove(const Vector3d& point, const FeatureBound& bound) {
  const Vector3d d = bound.centre - point;
  const double length = d.norm();
  if (bound.cone.cosine <= 0.0) return {-length, length};
  // With θ the angle from the axis and α that of the cone: |d| cos(θ ± α), but where that passes
  // the direction of d or its opposite.
  const double along = bound.cone.axis.dot(d),
               across = std::sqrt(std::max(0.0, length * length - along * along));
  const double cosine = bound.cone.cosine, sine = SineOf(cosine);
  const bool holds_up = along >= 0.0 && across * cosine <= along * sine;
  const bool holds_down = along <= 0.0 && across * cosine <= -along * sine;
  return {holds_down ? -length : along * cosine - across * sine,
          holds_up ? length : along * cosine + across * sine};
}

// A sphere round the items' spheres that is near the least: its centre steps towards what reaches
// furthest from it, each time less far. Source: Badoiu, Clarkson, "Smaller core-sets for balls"
// (2003).
void SetSphere(std::span<const FeatureBound> bounds, std::span<const int> items,
               FeatureBound* bound) {
  Vector3d low = Vector3d::Constant(1e300), high = -low;
  for (const int item : items) {
    low = low.cwiseMin(Vector3d(bounds[item].centre.array() - bounds[item].radius));
    high = high.cwiseMax(Vector3d(bounds[item].centre.array() + bounds[item].radius));
  }
  Vector3d centre = 0.5 * (low + high);
  bound->radius = 1e300;
  for (int step = 0; step < kBoundSteps; ++step) {
    double radius = -1.0;
    Vector3d furthest = centre;
    for (const int item : items) {
      const Vector3d way = bounds[item].centre - centre;
      const double length = way.norm(), reach = length * (1.0 + 1e-12) + bounds[item].radius;
      if (!(reach > radius)) continue;
      radius = reach;
      furthest = length > 0.0 ? Vector3d(centre + (reach / length) * way) : centre;
    }
    if (radius < bound->radius) bound->radius = radius, bound->centre = centre;
    centre += (furthest - centre) / (step + 3.0);
  }
}

// cos(angle of the items' normals to the axis), the smallest, and what is that far off: what rays
// span is within a cone of less than a right angle if they are.
struct FurthestNormal {
  double cosine = 1.0;
  Vector3d direction;
};

FurthestNormal FurthestFrom(const Vector3d& axis, std::span<const FeatureBound> bounds,
                            std::span<const int> items) {
  FurthestNormal furthest;
  furthest.direction = axis;
  const auto take = [&](double cosine, const Vector3d& direction) {
    if (cosine < furthest.cosine) furthest = {cosine, direction};
  };
  for (const int item : items) {
    const NormalCone& cone = bounds[item].cone;
    for (const Vector3d& ray : bounds[item].rays) take(axis.dot(ray), ray);
    if (!bounds[item].rays.empty()) continue;
    const double cosine = std::clamp(axis.dot(cone.axis), -1.0, 1.0);
    take(cosine * cone.cosine - SineOf(cosine) * SineOf(cone.cosine), cone.axis);
  }
  return furthest;
}

// A cone round the items' normals that is near the least, by the same steps; all directions where
// it would be a half-space or more.
NormalCone ConeRoundItems(std::span<const FeatureBound> bounds, std::span<const int> items) {
  Vector3d axis = Vector3d::Zero();
  for (const int item : items) {
    if (bounds[item].cone.cosine <= 0.0) return {};
    axis += bounds[item].cone.axis;
  }
  NormalCone best;
  for (int step = 0; step < kBoundSteps && axis.norm() > 1e-3; ++step) {
    axis.normalize();
    const FurthestNormal furthest = FurthestFrom(axis, bounds, items);
    if (furthest.cosine - 1e-9 > best.cosine) best = {axis, furthest.cosine - 1e-9};
    axis += (furthest.direction - axis) / (step + 2.0);
  }
  return best.cosine > 0.0 ? best : NormalCone{};
}

// Makes the nodes of a tree.
class TreeMaker {
 public:
  explicit TreeMaker(std::span<const FeatureBound> bounds) : bounds_(bounds) {}

  std::vector<FeatureNode> Make(std::span<int> items) {
    Vector3d low = bounds_[items[0]].centre, high = low;
    for (const int item : items) {
      low = low.cwiseMin(bounds_[item].centre);
      high = high.cwiseMax(bounds_[item].centre);
    }
    extent_ = (high - low).maxCoeff();
    AddNode(items, -1, -1);
    return std::move(nodes_);
  }

 private:
  // A lane's bound, and what is under it.
  struct Branch {
    FeatureBound bound;
    int child = 0;
    std::span<const int> items;
  };

  void AddNode(std::span<int> items, int parent, int parent_lane) {
    const int index = static_cast<int>(nodes_.size());
    nodes_.emplace_back();
    nodes_[index].parent = parent;
    nodes_[index].parent_lane = parent_lane;
    std::ptrdiff_t size = 1;
    while (size * kWidth < std::ssize(items)) size *= kWidth;
    std::vector<std::span<int>> runs;
    PartIntoRuns(bounds_, extent_, items, size, &runs);
    const int count = static_cast<int>(runs.size());
    for (int lane = 0; lane < kWidth; ++lane) {
      Branch branch;
      if (lane < count) {
        const std::span<int> run = runs[lane];
        branch.items = run;
        branch.child = run.size() == 1 ? ~run[0] : static_cast<int>(nodes_.size());
        branch.bound = BoundRound(run);
        if (run.size() > 1) AddNode(run, index, lane);
        SetBelt(bounds_, run, &branch.bound);
      }
      SetLane(branch, lane, &nodes_[index]);
    }
    nodes_[index].lane_count = count;
  }

  FeatureBound BoundRound(std::span<const int> items) const {
    if (items.size() == 1) return bounds_[items[0]];
    FeatureBound bound;
    SetSphere(bounds_, items, &bound);
    bound.cone = ConeRoundItems(bounds_, items);
    return bound;
  }

  void SetLane(const Branch& branch, int lane, FeatureNode* node) const {
    const FeatureBound& bound = branch.bound;
    for (int i = 0; i < 3; ++i) {
      node->centre[i][lane] = bound.centre[i];
      node->axis[i][lane] = bound.cone.axis[i];
      node->pole[i][lane] = bound.pole[i];
    }
    node->radius[lane] = bound.radius * (1.0 + kPadding);
    node->cosine[lane] = bound.cone.cosine <= 0.0 ? kAllCosine : bound.cone.cosine - kPadding;
    node->sine[lane] = bound.cone.cosine <= 0.0 ? kAllSine : SineOf(bound.cone.cosine) + kPadding;
    node->belt[lane] = bound.belt + kPadding;
    node->children[lane] = branch.child;
    double low = 0.0, high = 0.0;
    if (!branch.items.empty()) low = 1e300, high = -1e300;
    for (const int item : branch.items) {
      const HeightRange range = HeightsAbove(bound.centre, bounds_[item]);
      low = std::min(low, range.low);
      high = std::max(high, range.high);
    }
    node->lift[lane] = 0.5 * (low + high);
    node->flat[lane] = 0.5 * (high - low) + kPadding * bound.radius;
  }

  const std::span<const FeatureBound> bounds_;
  std::vector<FeatureNode> nodes_;
  double extent_ = 0.0;
};

std::vector<int> AllUpTo(int count) {
  std::vector<int> items(count);
  std::iota(items.begin(), items.end(), 0);
  return items;
}

}  // namespace

FeatureTree::FeatureTree(std::span<const FeatureBound> bounds, std::vector<int> items) {
  if (items.empty()) return;
  nodes_ = std::make_shared<const std::vector<FeatureNode>>(TreeMaker(bounds).Make(items));
}

FeatureTree FaceTree(const TriangleMesh& mesh) {
  std::vector<FeatureBound> bounds(mesh.face_count());
  for (int f = 0; f < mesh.face_count(); ++f) {
    const Triangle& face = mesh.face(f);
    const Vector3d &a = mesh.vertex(face[0]), &b = mesh.vertex(face[1]), &c = mesh.vertex(face[2]);
    bounds[f].centre = (a + b + c) / 3.0;
    for (const int v : face) {
      bounds[f].radius = std::max(bounds[f].radius, (mesh.vertex(v) - bounds[f].centre).norm());
    }
    bounds[f].cone = {mesh.face_normal(f), 1.0};
    bounds[f].rays = {mesh.face_normal(f)};
  }
  return FeatureTree(bounds, AllUpTo(mesh.face_count()));
}

FeatureTree VertexTree(const TriangleMesh& mesh, const GaussMap& map) {
  std::vector<FeatureBound> bounds(mesh.vertex_count());
  std::vector<int> items;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const VertexKind kind = map.vertex_kind(v);
    if (kind != VertexKind::kCorner && kind != VertexKind::kSpecial) continue;
    bounds[v] = {.centre = mesh.vertex(v), .cone = map.vertex_cone(v)};
    bounds[v].rays.assign(map.rays(v).begin(), map.rays(v).end());
    items.push_back(v);
  }
  return FeatureTree(bounds, std::move(items));
}

FeatureTree ConvexEdgeTree(const TriangleMesh& mesh, const GaussMap& map) {
  std::vector<FeatureBound> bounds(mesh.edge_count());
  std::vector<int> items;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_kind(e) != EdgeKind::kConvex) continue;
    const int h = mesh.half_edge_of(e);
    const Vector3d &a = mesh.vertex(mesh.tail(h)), &b = mesh.vertex(mesh.head(h));
    bounds[e] = {.centre = 0.5 * (a + b), .radius = 0.5 * (b - a).norm(), .cone = map.edge_cone(e)};
    bounds[e].rays = {mesh.face_normal(TriangleMesh::face_of(h)),
                      mesh.face_normal(TriangleMesh::face_of(mesh.twin(h)))};
    items.push_back(e);
  }
  return FeatureTree(bounds, std::move(items));
}

}  // namespace touchstone
