// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/nef_sum_internal.h"

#include <CGAL/Nef_polyhedron_3.h>  // before minkowski_sum_3.h, which leans on it
#include <CGAL/minkowski_sum_3.h>

#include "touchstone/exact/nef_kernel_internal.h"

namespace touchstone::exact {
namespace {

// The plane's four coefficients, times what makes them whole.
std::pair<IntegerVector, Integer> ToPlane(const Kernel::Plane_3& plane) {
  mpq_class e[] = {ToRational(plane.a()), ToRational(plane.b()), ToRational(plane.c()),
                   ToRational(plane.d())};
  Integer common = 1;
  for (const mpq_class& value : e) common = lcm(common, value.get_den());
  for (mpq_class& value : e) value *= common;
  return {{e[0].get_num(), e[1].get_num(), e[2].get_num()}, Integer(-e[3].get_num())};
}

}  // namespace

NefSum SumOfNefPolyhedra(const IntegerPolyhedron& a, const IntegerPolyhedron& b) {
  Nef nef_a = MakeNef(a), nef_b = MakeNef(b);
  const Nef sum = CGAL::minkowski_sum_3(nef_a, nef_b);
  NefSum result;
  for (Nef::Halffacet_const_iterator f = sum.halffacets_begin(); f != sum.halffacets_end(); ++f) {
    result.planes.push_back(ToPlane(f->plane()));
  }
  for (Nef::Vertex_const_iterator v = sum.vertices_begin(); v != sum.vertices_end(); ++v) {
    // Sums of whole points: the denominators are one.
    result.points.push_back({ToRational(v->point().x()).get_num(),
                             ToRational(v->point().y()).get_num(),
                             ToRational(v->point().z()).get_num()});
  }
  return result;
}

}  // namespace touchstone::exact
