// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/nef_mesh_sum.h"

#include <CGAL/Nef_polyhedron_3.h>  // before minkowski_sum_3.h, which leans on it
#include <CGAL/boost/graph/convert_nef_polyhedron_to_polygon_mesh.h>
#include <CGAL/minkowski_sum_3.h>

#include <algorithm>

#include "touchstone/exact/nef_kernel_internal.h"

namespace touchstone::exact {
namespace {

RationalPoint ToPoint(const Kernel::Point_3& x) {
  return {ToRational(x.x()), ToRational(x.y()), ToRational(x.z())};
}

std::vector<std::vector<int>> LoopsOf(const TriangleMesh& mesh) {
  std::vector<std::vector<int>> loops;
  for (const auto& face : mesh.faces()) loops.emplace_back(face.begin(), face.end());
  return loops;
}

}  // namespace

NefMeshSum MakeNefMeshSum(const PlacedMeshPair& pair) {
  IntegerPolyhedron a{{}, LoopsOf(pair.a())}, b{{}, LoopsOf(pair.b())};
  for (int v = 0; v < pair.a().vertex_count(); ++v) a.points.push_back(pair.point_a(v));
  for (int v = 0; v < pair.b().vertex_count(); ++v) b.points.push_back(-pair.point_b(v));
  for (std::vector<int>& loop : b.loops) std::reverse(loop.begin(), loop.end());

  // Of the interiors: sums of closed sets swallow what fits exactly.
  Nef nef_a = MakeNef(a).interior(), nef_b = MakeNef(b).interior();
  const Nef open = CGAL::minkowski_sum_3(nef_a, nef_b);
  const Nef closed = open.closure().regularization();
  NefMeshSum sum;
  std::vector<Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
  CGAL::convert_nef_polyhedron_to_polygon_soup(closed, points, polygons, true);
  for (const Kernel::Point_3& x : points) sum.points.push_back(ToPoint(x));
  for (const auto& polygon : polygons) {
    sum.triangles.push_back(
        {static_cast<int>(polygon[0]), static_cast<int>(polygon[1]), static_cast<int>(polygon[2])});
  }
  const Nef slots = closed.interior() - open;
  for (auto v = slots.vertices_begin(); v != slots.vertices_end(); ++v) {
    if (v->mark()) sum.slot_samples.push_back(ToPoint(v->point()));
  }
  for (auto e = slots.halfedges_begin(); e != slots.halfedges_end(); ++e) {
    if (!e->mark() || e->is_twin()) continue;
    sum.slot_samples.push_back(ToPoint(CGAL::midpoint(e->source()->point(), e->target()->point())));
  }
  return sum;
}

}  // namespace touchstone::exact
