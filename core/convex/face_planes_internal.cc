// SPDX-License-Identifier: MIT
#include "touchstone/core/convex/face_planes_internal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "touchstone/core/base/dyadic.h"

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;
using Plane = std::array<int, 3>;

Vector3d Cross(const Vector3d& u, const Vector3d& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

double SquaredLength(const Vector3d& u) { return u[0] * u[0] + u[1] * u[1] + u[2] * u[2]; }

Vector3d Difference(const Orientation& orientation, int to, int from) {
  return orientation.point(to).scaled - orientation.point(from).scaled;
}

// Three vertices of the loop that span a triangle as wide as two passes find, in the loop's order.
Plane SpreadVertices(const Orientation& orientation, std::span<const int> loop) {
  if (loop.size() == 3) return {loop[0], loop[1], loop[2]};
  const int size = static_cast<int>(loop.size());
  int second = 1;
  double best = -1.0;
  for (int i = 1; i < size; ++i) {
    const double squared = SquaredLength(Difference(orientation, loop[i], loop[0]));
    if (squared > best) best = squared, second = i;
  }
  const Vector3d base = Difference(orientation, loop[second], loop[0]);
  int third = second == 1 ? 2 : 1;
  best = -1.0;
  for (int i = 1; i < size; ++i) {
    if (i == second) continue;
    const Vector3d cross = Cross(base, Difference(orientation, loop[i], loop[0]));
    const double squared = SquaredLength(cross);
    if (squared > best) best = squared, third = i;
  }
  return {loop[0], loop[std::min(second, third)], loop[std::max(second, third)]};
}

// An axis that the plane's normal has an exactly known sign along; none if the three are collinear.
std::optional<FaceAxis> FindAxis(const Orientation& orientation, const Plane& plane) {
  const Vector3d normal = Cross(Difference(orientation, plane[1], plane[0]),
                                Difference(orientation, plane[2], plane[0]));
  std::array<int, 3> axes = {0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(),
                   [&](int i, int j) { return std::abs(normal[i]) > std::abs(normal[j]); });
  for (int axis : axes) {
    const int sign = orientation.ExactTurn(plane[0], plane[1], plane[2], axis);
    if (sign != 0) return FaceAxis{axis, sign};
  }
  return std::nullopt;
}

// The plane of the loop with its axis; none if all vertices are collinear.
std::optional<std::pair<Plane, FaceAxis>> FindPlane(const Orientation& orientation,
                                                    std::span<const int> loop) {
  const Plane spread = SpreadVertices(orientation, loop);
  if (const auto axis = FindAxis(orientation, spread)) return std::pair(spread, *axis);
  // The spread was judged in doubles, which tell nothing of a face far smaller than the body.
  for (std::size_t i = 2; i < loop.size(); ++i) {
    const Plane plane = {loop[0], loop[1], loop[i]};
    if (const auto axis = FindAxis(orientation, plane)) return std::pair(plane, *axis);
  }
  return std::nullopt;
}

// The same plane, begun at the vertex opposite its longest edge: the angle there is the widest.
Plane BeginAtWidestAngle(const Orientation& orientation, const Plane& plane) {
  int widest = 0;
  double longest = -1.0;
  for (int i = 0; i < 3; ++i) {
    const double squared =
        SquaredLength(Difference(orientation, plane[(i + 2) % 3], plane[(i + 1) % 3]));
    if (squared > longest) longest = squared, widest = i;
  }
  return {plane[widest], plane[(widest + 1) % 3], plane[(widest + 2) % 3]};
}

// Whether a comes before b in the order of coordinates. Along a convex loop this order rises once
// and falls once.
bool IsBefore(const Vector3d& a, const Vector3d& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

class FaceChecker {
 public:
  FaceChecker(const Orientation& orientation, std::span<const int> loop, int face)
      : orientation_(orientation), loop_(loop), face_(face) {}

  Status CheckPlanar(const Plane& plane) const {
    for (int v : loop_) {
      if (v == plane[0] || v == plane[1] || v == plane[2]) continue;
      if (orientation_.ExactSide(plane, v) != 0) {
        return Fail(StatusCode::kNonPlanarFace, v,
                    "vertex " + std::to_string(v) + " of face " + std::to_string(face_) +
                        " is not exactly in the plane of its vertices " + std::to_string(plane[0]) +
                        ", " + std::to_string(plane[1]) + ", " + std::to_string(plane[2]) +
                        "; triangulate the face, or take the convex hull of the vertices");
      }
    }
    return {};
  }

  // A loop in a plane is a convex simple polygon iff no turn goes right or back (the turns then add
  // up to 2 pi times a winding number) and that number is one: it counts the times that the order
  // of coordinates begins to rise.
  Status CheckConvex(const FaceAxis& axis) const {
    const std::size_t size = loop_.size();
    int reversals = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const int a = loop_[i], b = loop_[(i + 1) % size], c = loop_[(i + 2) % size];
      const int turn = axis.sign * orientation_.ExactTurn(a, b, c, axis.axis);
      const bool reversal = IsBefore(exact(a), exact(b)) != IsBefore(exact(b), exact(c));
      if (turn < 0 || (turn == 0 && reversal)) {
        return Fail(
            StatusCode::kNotConvex, b,
            "face " + std::to_string(face_) + " is not convex at its vertex " + std::to_string(b));
      }
      if (reversal) ++reversals;
    }
    if (reversals != 2) {
      return Fail(StatusCode::kNotConvex, -1,
                  "the loop of face " + std::to_string(face_) + " winds more than once");
    }
    return {};
  }

  Status Fail(StatusCode code, int other, std::string message) const {
    return {code, ElementKind::kFace, face_, other, std::move(message)};
  }

 private:
  const Vector3d& exact(int v) const { return orientation_.point(v).exact; }

  const Orientation& orientation_;
  const std::span<const int> loop_;
  const int face_;
};

}  // namespace

Status BuildFacePlanes(const Orientation& orientation, ConvexPolyhedronData* data,
                       std::vector<FaceAxis>* axes) {
  const int face_count = data->face_count();
  data->face_planes.resize(face_count);
  data->face_normals.resize(face_count);
  axes->resize(face_count);
  for (int f = 0; f < face_count; ++f) {
    const std::span<const int> loop(data->face_vertices.data() + data->face_begin[f],
                                    data->face_vertices.data() + data->face_begin[f + 1]);
    const FaceChecker checker(orientation, loop, f);
    const auto found = FindPlane(orientation, loop);
    if (!found) {
      return checker.Fail(StatusCode::kDegenerateFace, -1,
                          "all vertices of face " + std::to_string(f) + " are collinear");
    }
    const auto& [plane, axis] = *found;
    if (loop.size() > 3) {
      if (Status status = checker.CheckPlanar(plane); !status.ok()) return status;
      if (Status status = checker.CheckConvex(axis); !status.ok()) return status;
    }
    data->face_planes[f] = BeginAtWidestAngle(orientation, plane);
    data->face_normals[f] = orientation.UnitNormal(data->face_planes[f]);
    (*axes)[f] = axis;
  }
  return {};
}

}  // namespace touchstone::internal
