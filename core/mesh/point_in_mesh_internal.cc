// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/point_in_mesh_internal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

constexpr double kUnderflow = 0x1p-1000;

// A ray from a point along +axis or -axis.
struct AxisRay {
  Vector3d point;
  double error;  // boxes within this of the ray count
  int axis;
  bool is_positive;
};

// Calls visit(face) for faces whose boxes the ray may meet, until it returns false.
template <class Visit>
bool ForFacesAlong(const BoxTree& tree, const AxisRay& ray, const Visit& visit) {
  const int i = (ray.axis + 1) % 3, j = (ray.axis + 2) % 3;
  const auto meets = [&](const BoxNode& node, int lane) {
    return node.low[i][lane] <= ray.point[i] + ray.error &&
           node.high[i][lane] >= ray.point[i] - ray.error &&
           node.low[j][lane] <= ray.point[j] + ray.error &&
           node.high[j][lane] >= ray.point[j] - ray.error &&
           (ray.is_positive ? node.high[ray.axis][lane] >= ray.point[ray.axis] - ray.error
                            : node.low[ray.axis][lane] <= ray.point[ray.axis] + ray.error);
  };
  // Depth first; a mesh of 2^28 faces has ten levels.
  std::array<int, 8 * 12> stack;
  int size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const BoxNode& node = tree.node(stack[--size]);
    for (int lane = 0; lane < node.lane_count; ++lane) {
      if (!meets(node, lane)) continue;
      const int child = node.children[lane];
      if (child >= 0) {
        stack[size++] = child;
      } else if (!visit(~child)) {
        return false;
      }
    }
  }
  return true;
}

enum class Passage { kMisses, kCrosses, kUnsure };

Passage TriagePassage(const PlacedMesh& mesh, int face, const AxisRay& ray) {
  const int i = (ray.axis + 1) % 3, j = (ray.axis + 2) % 3;
  Vector3d corner[3];
  for (int k = 0; k < 3; ++k) corner[k] = mesh.points[mesh.mesh.face(face)[k]] - ray.point;
  int positive = 0, negative = 0;
  for (int k = 0; k < 3; ++k) {
    const Vector3d &u = corner[k], &v = corner[(k + 1) % 3];
    const double left = u[i] * v[j], right = u[j] * v[i];
    // Two roundings on each path, and the data: |u| e + |v| e + e e on either.
    const double error = 1.01 * (2.1 * kUnit * (std::abs(left) + std::abs(right)) +
                                 ray.error * (std::abs(u[i]) + std::abs(u[j]) + std::abs(v[i]) +
                                              std::abs(v[j]) + 2.0 * ray.error)) +
                         kUnderflow;
    positive += left - right > error;
    negative += left - right < -error;
  }
  if (positive > 0 && negative > 0) return Passage::kMisses;
  if (positive < 3 && negative < 3) return Passage::kUnsure;
  // The line crosses the triangle. Where, by the side of its plane that the point lies on.
  const FacePlane& plane = mesh.planes[face];
  const Vector3d difference = mesh.points[plane.vertex] - ray.point;
  const int side = TriageSign(HeightAlong(plane.normal, plane.error, difference, ray.error));
  if (side == 0) return Passage::kUnsure;
  const bool faces_along = (positive == 3) == ray.is_positive;
  return (side > 0) == faces_along ? Passage::kCrosses : Passage::kMisses;
}

// As in enclosure_internal.cc: the ray runs along +x and its start is moved by (0, ε, ε²).
bool CrossesExactly(const std::array<DyadicVector, 3>& corner) {
  const auto is_beyond = [](const DyadicVector& u) { return u[1].sign() > 0; };
  const auto passes_above = [&](const DyadicVector* u, const DyadicVector* v) {
    if (!is_beyond(*v)) std::swap(u, v);
    // (v_y - u_y)(-u_z) - (v_z - u_z)(-u_y) < 0, where v_y > u_y.
    const int turn = ((*v)[2] * (*u)[1] - (*v)[1] * (*u)[2]).sign();
    if (turn != 0) return turn < 0;
    return ((*v)[2] - (*u)[2]).sign() > 0;
  };
  bool inside = false;
  for (int k = 0; k < 3; ++k) {
    const DyadicVector &u = corner[k], &v = corner[(k + 1) % 3];
    if (is_beyond(u) != is_beyond(v)) inside ^= passes_above(&u, &v);
  }
  if (!inside) return false;
  const DyadicVector normal = Cross(corner[1] - corner[0], corner[2] - corner[0]);
  return Dot(normal, corner[0]).sign() * normal[0].sign() > 0;
}

}  // namespace

std::optional<bool> TriageInside(const PlacedMesh& mesh, const Vector3d& point, double error) {
  const Vector3d &low = mesh.tree.low(), &high = mesh.tree.high();
  for (int axis = 0; axis < 3; ++axis) {
    if (point[axis] < low[axis] - error || point[axis] > high[axis] + error) return false;
  }
  for (int direction = 0; direction < 6; ++direction) {
    const AxisRay ray{point, error, direction % 3, direction < 3};
    bool inside = false;
    const bool is_sure = ForFacesAlong(mesh.tree, ray, [&](int face) {
      const Passage passage = TriagePassage(mesh, face, ray);
      inside ^= passage == Passage::kCrosses;
      return passage != Passage::kUnsure;
    });
    if (is_sure) return inside;
  }
  return std::nullopt;
}

bool IsInside(const PlacedMesh& mesh, const Vector3d& point, double error,
              const std::function<DyadicVector(int)>& difference) {
  if (const auto inside = TriageInside(mesh, point, error)) return *inside;
  bool inside = false;
  ForFacesAlong(mesh.tree, {point, error, 0, true}, [&](int face) {
    const Triangle& corners = mesh.mesh.face(face);
    inside ^=
        CrossesExactly({difference(corners[0]), difference(corners[1]), difference(corners[2])});
    return true;
  });
  return inside;
}

}  // namespace touchstone::internal
