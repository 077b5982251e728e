// SPDX-License-Identifier: MIT
//
// Signs that names decide where roundings cannot, against big numbers.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "touchstone/core/minkowski/convolution.h"
#include "touchstone/core/minkowski/sum_geometry_internal.h"
#include "touchstone/tests/minkowski/local_sum_checks.h"
#include "touchstone/tests/testing/random.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone::internal {
namespace {

using touchstone::testing::PoseOf;

int ExactOrder(SumGeometry* geometry, int x, int y, int axis) {
  const ExactPoint a = geometry->Exact(x), b = geometry->Exact(y);
  return (a.coordinates[axis] * b.denominator - b.coordinates[axis] * a.denominator).sign();
}

// The vertices that edges lead to from one.
std::vector<int> NeighborsOf(const TriangleMesh& mesh, int vertex) {
  std::vector<int> neighbors;
  for (const int h : mesh.vertex_half_edges(vertex)) neighbors.push_back(mesh.head(h));
  return neighbors;
}

// Quadrilaterals of a torus are flat up to rounding: the plane of one half passes within 1e-16 of
// the apex of the other, and cuts the edges that leave it at points that no double tells apart.
TEST(SumSigns, PointsBesideAVertexAreInOrder) {
  touchstone::testing::Random random(19);
  long beside = 0, needed_exact = 0;
  for (const std::string name : {"torus", "tori", "cup"}) {
    SCOPED_TRACE(name);
    const TriangleMesh mesh = MustBuild(NamedShape(name, 200));
    for (const bool is_of_a : {true, false}) {
      const MeshPair pair(mesh, mesh, PoseOf(random.Rotation()));
      SumGeometry geometry(pair);
      const auto add_vertex = [&](int v) {
        return geometry.AddVertex(is_of_a ? SumVertex{v, 0} : SumVertex{0, v});
      };
      for (int h = 0; h < 3 * mesh.face_count(); ++h) {
        const int face = TriangleMesh::face_of(h);
        SumFacet facet;
        facet.kind = is_of_a ? SumFacetKind::kFaceVertex : SumFacetKind::kVertexFace;
        facet.a = is_of_a ? face : 0;
        facet.b = is_of_a ? 0 : face;
        const auto& [u, v, w] = mesh.face(face);
        const std::array<int, 4> corners = {add_vertex(u), add_vertex(v), add_vertex(w),
                                            add_vertex(w)};
        const int plane = geometry.AddFacetPlane(facet, corners);
        const int apex = mesh.apex(mesh.twin(h));
        const int side = geometry.Side(add_vertex(apex), plane);
        std::vector<int> points;
        for (const int end : NeighborsOf(mesh, apex)) {
          if (geometry.Side(add_vertex(end), plane) * side >= 0) continue;
          points.push_back(geometry.AddOnEdge(add_vertex(apex), add_vertex(end), plane));
        }
        for (std::size_t i = 0; i < points.size(); ++i) {
          for (std::size_t j = 0; j < i; ++j) {
            for (int axis = 0; axis < 3; ++axis) {
              const SumPoint &x = geometry.point(points[i]), &y = geometry.point(points[j]);
              beside += std::abs(x.rounded[axis] - y.rounded[axis]) <= x.error + y.error;
              const long before = geometry.exact_count();
              const int order = geometry.Compare(points[i], points[j], axis);
              needed_exact += geometry.exact_count() - before;
              ASSERT_EQ(order, ExactOrder(&geometry, points[i], points[j], axis))
                  << h << ' ' << i << ' ' << j << ' ' << axis;
            }
          }
        }
      }
    }
  }
  EXPECT_GT(beside, 500);
  EXPECT_LT(needed_exact, beside / 10);
}

}  // namespace
}  // namespace touchstone::internal
