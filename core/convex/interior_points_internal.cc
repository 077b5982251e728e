// SPDX-License-Identifier: MIT
#include "touchstone/core/convex/interior_points_internal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "touchstone/core/convex/convexity_internal.h"

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

class InteriorSearch {
 public:
  InteriorSearch(const Orientation& orientation, const ConvexPolyhedronData& data)
      : orientation_(orientation), data_(data) {}

  // Whether the point is strictly below all planes. Begins with the plane that refused the last
  // candidate, which mostly refuses its neighbours too.
  bool IsInside(const Vector3d& point) {
    const ScaledPoint scaled = orientation_.Scale(point);
    const auto below = [&](int f) {
      return orientation_.ExactSide(data_.face_plane(f), scaled) < 0;
    };
    if (!below(refusing_face_)) return false;
    for (int f = 0; f < data_.face_count(); ++f) {
      if (!below(f)) {
        refusing_face_ = f;
        return false;
      }
    }
    return true;
  }
  int refusing_face() const { return refusing_face_; }

  // `seed` or a double next to it, at most one unit in the last place off in each coordinate, that
  // is inside and not `other`.
  std::optional<Vector3d> InsideNear(const Vector3d& seed, const Vector3d* other) {
    static constexpr std::array<int, 3> kSteps = {0, 1, -1};
    for (int x : kSteps) {
      for (int y : kSteps) {
        for (int z : kSteps) {
          const Vector3d candidate(Step(seed[0], x), Step(seed[1], y), Step(seed[2], z));
          if (other != nullptr && candidate == *other) continue;
          if (candidate.cwiseAbs().maxCoeff() > data_.max_coordinate) continue;
          if (IsInside(candidate)) return candidate;
        }
      }
    }
    return std::nullopt;
  }

 private:
  static double Step(double x, int direction) {
    if (direction == 0) return x;
    const double infinity = std::numeric_limits<double>::infinity();
    return std::nextafter(x, direction > 0 ? infinity : -infinity);
  }

  const Orientation& orientation_;
  const ConvexPolyhedronData& data_;
  int refusing_face_ = 0;
};

Vector3d Mean(const ConvexPolyhedronData& data) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& vertex : data.vertices) sum += vertex;
  return sum / static_cast<double>(data.vertices.size());
}

// At most 32 vertices spread over the index range, the one farthest from `from` first.
std::vector<int> SpreadVertices(const Orientation& orientation, const ConvexPolyhedronData& data,
                                const Vector3d& from) {
  const Vector3d scaled = orientation.Scale(from).scaled;
  int farthest = 0;
  double best = -1.0;
  for (int v = 0; v < data.vertex_count(); ++v) {
    const Vector3d d = orientation.point(v).scaled - scaled;
    const double squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    if (squared > best) best = squared, farthest = v;
  }
  std::vector<int> chosen = {farthest};
  const int stride = data.vertex_count() / 32 + 1;
  for (int v = 0; v < data.vertex_count(); v += stride) {
    if (v != farthest) chosen.push_back(v);
  }
  return chosen;
}

// A point off `from` towards three of the vertices by unequal parts: on none of the axes, diagonals
// and mid-planes that symmetrical bodies have. Rays between such points seldom meet an edge or a
// vertex of M, where signs vanish and doubles cannot decide.
Vector3d OffSymmetry(const ConvexPolyhedronData& data, const Vector3d& from,
                     const std::vector<int>& spread, std::size_t k, double fraction) {
  static constexpr std::array<double, 3> kParts = {1.0, 0.59, 0.37};
  Vector3d point = from;
  for (std::size_t i = 0; i < kParts.size(); ++i) {
    const int v = spread[(k + i) % spread.size()];
    point += fraction * kParts[i] * (data.vertices[v] - from);
  }
  return point;
}

std::optional<Vector3d> FindFirst(InteriorSearch& search, const ConvexPolyhedronData& data,
                                  const Vector3d& mean, const std::vector<int>& spread) {
  const Vector3d near_mean = OffSymmetry(data, mean, spread, 0, 1.0 / 32);
  if (search.IsInside(near_mean)) return near_mean;
  if (search.IsInside(mean)) return mean;
  if (const auto found = search.InsideNear(mean, nullptr)) return found;
  for (int v : spread) {
    const Vector3d seed = mean + 0.5 * (data.vertices[v] - mean);
    if (const auto found = search.InsideNear(seed, nullptr)) return found;
  }
  return std::nullopt;
}

std::optional<Vector3d> FindSecond(InteriorSearch& search, const ConvexPolyhedronData& data,
                                   const Vector3d& first, const std::vector<int>& spread) {
  for (std::size_t k = 0; k < spread.size(); ++k) {
    for (double fraction : {0.25, 0.125}) {
      const Vector3d candidate = OffSymmetry(data, first, spread, k, fraction);
      if (candidate != first && search.IsInside(candidate)) return candidate;
    }
  }
  for (int v : spread) {
    for (double fraction : {0.25, 0.125, 0.5}) {
      const Vector3d seed = first + fraction * (data.vertices[v] - first);
      if (const auto found = search.InsideNear(seed, &first)) return found;
    }
  }
  return std::nullopt;
}

}  // namespace

bool IsStrictlyInside(const Orientation& orientation, const ConvexPolyhedronData& data,
                      const Vector3d& point) {
  return InteriorSearch(orientation, data).IsInside(point);
}

Status FindInteriorPoints(const Orientation& orientation, ConvexPolyhedronData* data) {
  InteriorSearch search(orientation, *data);
  const Vector3d mean = Mean(*data);
  const std::vector<int> spread = SpreadVertices(orientation, *data, mean);
  const auto first = FindFirst(search, *data, mean, spread);
  if (!first) {
    // A candidate is a mean of vertices up to rounding, and an exact mean of vertices none of which
    // is beyond a plane is not beyond it. So unless the body is as thin as a rounding, the plane
    // that refused has a vertex beyond.
    const int f = search.refusing_face();
    if (const auto v = FindVertexBeyond(orientation, *data, f)) return VertexBeyondFace(f, *v);
    return {StatusCode::kNoInteriorPoint, ElementKind::kNone, -1, -1,
            "too thin: no point with double coordinates was proven strictly inside"};
  }
  data->interior[0] = *first;
  const auto second = FindSecond(search, *data, *first, spread);
  if (!second) {
    return {StatusCode::kNoInteriorPoint, ElementKind::kNone, -1, -1,
            "too thin: only one point with double coordinates was proven strictly inside"};
  }
  data->interior[1] = *second;
  return {};
}

}  // namespace touchstone::internal
