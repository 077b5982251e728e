// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/surface_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "touchstone/core/mesh/nearest_points.h"
#include "touchstone/core/mesh/tree_items.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double BoxesApart(const TreeItem& a, const TreeItem& b) {
  const Vector3d gap = (b.low - a.high).cwiseMax(a.low - b.high).cwiseMax(0.0);
  return gap.norm();
}

// Coordinates are those of the placed pair, at most one in size.
class Search {
 public:
  Search(const MeshPair& pair, SurfaceDistanceCache* cache)
      : pair_(pair),
        queue_(cache->queue),
        point_error_(pair.a().point_error + pair.b().point_error) {}

  SurfaceDistanceResult Run() {
    queue_.clear();
    Push({0.0, 0, 0});
    while (!queue_.empty()) {
      std::pop_heap(queue_.begin(), queue_.end(), IsLater);
      const Waiting next = queue_.back();
      queue_.pop_back();
      if (next.apart >= upper_) break;
      Open(next.a, next.b);
    }
    Finish();
    return result_;
  }

 private:
  using Waiting = SurfaceDistanceCache::Waiting;

  static bool IsLater(const Waiting& x, const Waiting& y) {
    return std::tie(x.apart, x.a, x.b) > std::tie(y.apart, y.a, y.b);
  }

  void Push(const Waiting& waiting) {
    queue_.push_back(waiting);
    std::push_heap(queue_.begin(), queue_.end(), IsLater);
  }

  // Boxes are of rounded points: these are off by point_error_ along each axis, the gap of the
  // boxes by a rounding, and the norm by three: below 1.75 point_error_ + 8 units.
  void Open(int code_a, int code_b) {
    const PlacedMesh &a = pair_.a(), &b = pair_.b();
    TreeItem items_a[kTreeWidth], items_b[kTreeWidth];
    const int count_a = ItemsOf(a.tree, a.points, a.mesh.faces(), code_a, items_a);
    const int count_b = ItemsOf(b.tree, b.points, b.mesh.faces(), code_b, items_b);
    result_.node_pairs += static_cast<long>(count_a) * count_b;
    const double slack = 1.75 * point_error_ + 8.0 * kUnit;
    for (int i = 0; i < count_a; ++i) {
      for (int j = 0; j < count_b; ++j) {
        const double apart = BoxesApart(items_a[i], items_b[j]) - slack;
        if (apart >= upper_) continue;
        if (items_a[i].child < 0 && items_b[j].child < 0) {
          Compare(~items_a[i].child, ~items_b[j].child);
        } else {
          Push({apart, items_a[i].child, items_b[j].child});
        }
      }
    }
  }

  static Corners CornersOf(const PlacedMesh& placed, int face) {
    const Triangle& f = placed.mesh.face(face);
    return {placed.points[f[0]], placed.points[f[1]], placed.points[f[2]]};
  }

  // x and y are off their faces by 10 units each and the points' errors along each axis, their
  // difference by 3 units more; the norm by 4 units of itself.
  void Compare(int face_a, int face_b) {
    ++result_.face_pairs;
    const Corners a = CornersOf(pair_.a(), face_a), b = CornersOf(pair_.b(), face_b);
    const NearestPoints between = NearestPointsOf(a, b);
    const double distance = std::sqrt(between.squared);
    const double upper = distance * (1.0 + 4.0 * kUnit) + 1.75 * (point_error_ + 24.0 * kUnit);
    // What is proven to be further than this pair or another need not be proven better.
    lower_ = std::min(lower_, LowerBound(a, b, between, std::min(upper, upper_)));
    if (!(upper < upper_)) return;
    upper_ = upper;
    result_.distance = distance;
    result_.face_a = face_a;
    result_.face_b = face_b;
    result_.point_on_a = between.x;
    result_.point_on_b = between.y;
  }

  // n.b - n.a of all corners, at least; each height is off by three products and sums, 3.01 units
  // of |n|_1 <= 1.74, and |n|_1 times the point's error; the difference by a rounding of at most
  // 3.5. |n| is one up to 4 units.
  double Gap(const Vector3d& n, const Corners& a, const Corners& b) const {
    const double highest_a = std::max({n.dot(a[0]), n.dot(a[1]), n.dot(a[2])});
    const double lowest_b = std::min({n.dot(b[0]), n.dot(b[1]), n.dot(b[2])});
    return (1.0 - 8.0 * kUnit) * ((lowest_b - highest_a) - 1.75 * point_error_ - 16.0 * kUnit);
  }

  // The best of a few directions: between the nearest points; made square to a side of either face,
  // since the difference of near points knows little of their direction; and square to two sides,
  // the faces' normals among them. Not above `enough` unless the first is.
  double LowerBound(const Corners& a, const Corners& b, const NearestPoints& between,
                    double enough) const {
    double best = 0.0;
    const auto offer = [&](const Vector3d& direction) {
      const double length = direction.norm();
      if (!(length > 0x1p-500)) return;
      const Vector3d n = direction / length;
      best = std::max({best, Gap(n, a, b), Gap(-n, a, b)});
    };
    const Vector3d first = between.y - between.x;
    offer(first);
    // Already as good as any can be: within the roundings.
    if (best >= enough - 4.0 * point_error_ - 64.0 * kUnit) return best;
    std::array<Vector3d, 6> sides;
    for (int k = 0; k < 3; ++k) {
      sides[k] = (a[(k + 1) % 3] - a[k]).normalized();
      sides[3 + k] = (b[(k + 1) % 3] - b[k]).normalized();
    }
    for (const Vector3d& side : sides) {
      const Vector3d square = (first - side.dot(first) * side).normalized();
      offer(square - side.dot(square) * side);
    }
    for (int i = 0; i < 6; ++i) {
      for (int j = i + 1; j < 6; ++j) {
        const Vector3d across = sides[i].cross(sides[j]).normalized();
        // Twice made square, so that it is to units however parallel the sides are.
        offer(across - sides[i].dot(across) * sides[i]);
      }
    }
    return best;
  }

  void Finish() {
    const double unscale = 1.0 / pair_.scale();
    const Vector3d between = result_.point_on_b - result_.point_on_a;
    result_.direction = between.stableNormalized();
    result_.distance *= unscale;
    result_.lower_bound = std::max(0.0, std::min(lower_, upper_)) * unscale;
    result_.upper_bound = upper_ * unscale;
    result_.point_on_a *= unscale;
    result_.point_on_b *= unscale;
  }

  const MeshPair& pair_;
  std::vector<Waiting>& queue_;
  const double point_error_;
  double lower_ = kInfinity, upper_ = kInfinity;
  SurfaceDistanceResult result_;
};

}  // namespace

SurfaceDistanceResult SurfaceDistance(const MeshPair& pair, SurfaceDistanceCache* cache) {
  SurfaceDistanceCache own;
  return Search(pair, cache != nullptr ? cache : &own).Run();
}

}  // namespace touchstone
