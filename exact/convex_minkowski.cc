// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/convex_minkowski.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
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

MinkowskiDifference ConvexMinkowski(const PlacedPair& pair) {
  std::vector<IntegerVector> differences;
  for (int a = 0; a < pair.p().vertex_count; ++a) {
    for (int b = 0; b < pair.q().vertex_count; ++b) differences.push_back(pair.Difference({a, b}));
  }
  std::sort(differences.begin(), differences.end());
  differences.erase(std::unique(differences.begin(), differences.end()), differences.end());
  std::vector<Point> points;
  std::map<Point, int> index;
  for (const IntegerVector& x : differences) {
    points.emplace_back(ToField(x[0]), ToField(x[1]), ToField(x[2]));
    index.emplace(points.back(), static_cast<int>(points.size()) - 1);
  }
  Mesh hull;
  CGAL::convex_hull_3(points.begin(), points.end(), hull);

  std::vector<ExactPlane> planes;
  std::vector<IntegerVector> used;
  for (const Mesh::Vertex_index v : hull.vertices()) used.push_back(differences[index.at(hull.point(v))]);
  for (const Mesh::Face_index f : hull.faces()) {
    std::vector<const IntegerVector*> corner;
    for (const Mesh::Vertex_index v : hull.vertices_around_face(hull.halfedge(f))) {
      corner.push_back(&differences[index.at(hull.point(v))]);
    }
    const IntegerVector n = Cross(*corner[1] - *corner[0], *corner[2] - *corner[0]);
    planes.push_back(MakePlane(n, Dot(n, *corner[0])));
  }
  MinkowskiDifference result;
  result.facets = ClassifyFacets(pair, std::move(planes));
  result.vertices = Corners(std::move(used), result.facets);
  return result;
}

}  // namespace touchstone::exact
