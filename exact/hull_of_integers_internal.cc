// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/hull_of_integers_internal.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <map>

namespace touchstone::exact {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

Kernel::FT ToField(const Integer& value) {
  if (mpz_sizeinbase(value.get_mpz_t(), 2) <= 53) return Kernel::FT(value.get_d());
  return Kernel::FT(Kernel::FT::Exact_type(mpq_class(value).get_mpq_t()));
}

}  // namespace

std::vector<std::array<int, 3>> HullOfIntegers(const std::vector<IntegerVector>& integers) {
  std::vector<Point> points;
  std::map<Point, int> index;
  for (const IntegerVector& x : integers) {
    points.emplace_back(ToField(x[0]), ToField(x[1]), ToField(x[2]));
    index.emplace(points.back(), static_cast<int>(points.size()) - 1);
  }
  Mesh hull;
  CGAL::convex_hull_3(points.begin(), points.end(), hull);
  std::vector<std::array<int, 3>> triangles;
  for (const Mesh::Face_index f : hull.faces()) {
    std::array<int, 3>& triangle = triangles.emplace_back();
    int k = 0;
    for (const Mesh::Vertex_index v : hull.vertices_around_face(hull.halfedge(f))) {
      triangle[k++] = index.at(hull.point(v));
    }
  }
  return triangles;
}

}  // namespace touchstone::exact
