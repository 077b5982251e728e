// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/tangent_planes_internal.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

// A permutation by a fixed rule: planes in random order cut off few corners each.
std::vector<int> Shuffled(int count) {
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::uint64_t state = 0x9e3779b97f4a7c15u;
  for (int i = count - 1; i > 0; --i) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    std::swap(order[i], order[(state >> 33) % static_cast<std::uint64_t>(i + 1)]);
  }
  return order;
}

}  // namespace

bool IsConvexBody(const TriangleMesh& mesh) {
  if (mesh.components().size() != 1) return false;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_kind(e) == EdgeKind::kReflex) return false;
  }
  return true;
}

std::vector<HalfSpace> OwnPlanes(const TriangleMesh& mesh, const GaussArrangement& arrangement) {
  const std::vector<IntegerVector> points = ToCommonIntegers(mesh.vertices());
  IntegerVector sum = {Integer(0), Integer(0), Integer(0)};
  for (const IntegerVector& point : points) sum = sum + point;
  const Integer count = mesh.vertex_count();
  std::vector<HalfSpace> planes(arrangement.vertices.size());
  for (int f = 0; f < mesh.face_count(); ++f) {
    const int i = arrangement.vertex_of_face[f];
    const IntegerVector& normal = arrangement.vertices[i].exact;
    planes[i] = {normal, Dot(normal, Multiple(count, points[mesh.face(f)[0]]) + -sum)};
  }
  return planes;
}

// Points of one circle on the sphere, which symmetric bodies have everywhere, would make corners of
// many planes. Normals 2^-53 apart, the two halves of a rounded square, lie 2^-106 deep below each
// other's planes: finer than that, each keeps the arcs on its own side. A normal of 192 digits
// makes the offset as fine.
HalfSpace NearlyTangentPlane(const Direction& direction, int number) {
  const int shift = std::max(0, 192 - DigitsOf(direction.exact));
  const IntegerVector normal = Shifted(direction.exact, shift);
  const Integer length = sqrt(Dot(normal, normal)) + 1;
  const std::uint64_t spread = static_cast<std::uint64_t>(number + 1) * 0x9e3779b97f4a7c15u;
  return {normal, length + ((length * Integer(spread >> 32)) >> 160)};
}

HalfSpace RoundedTangentPlane(const Direction& direction) {
  const Vector3d both[] = {direction.unit, Vector3d::Ones()};
  std::vector<IntegerVector> integers = ToCommonIntegers(both);
  return {std::move(integers[0]), std::move(integers[1][0])};
}

HalfSpaceIntersection IntersectionOf(const std::vector<Direction>& directions,
                                     const std::vector<HalfSpace>& planes, bool keep_all,
                                     std::vector<int>* plane_of_vertex) {
  int digits = 0;
  for (const HalfSpace& plane : planes) {
    digits = std::max(
        {digits, DigitsOf(plane.normal), DigitsOf({plane.offset, Integer(0), Integer(0)})});
  }
  HalfSpaceIntersection polyhedron(digits);
  plane_of_vertex->assign(directions.size(), -1);
  for (const int i : Shuffled(static_cast<int>(directions.size()))) {
    polyhedron.Cut(directions[i], planes[i], keep_all);
    (*plane_of_vertex)[i] = polyhedron.plane_count() - 1;
  }
  return polyhedron;
}

}  // namespace touchstone::internal
