// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/nef_sum_internal.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>
#include <CGAL/minkowski_sum_3.h>

#include <sstream>

namespace touchstone::exact {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;

// By way of decimal text: whatever the kernel's exact type is, both sides read and write it.
Kernel::FT ToField(const Integer& value) {
  std::istringstream text(value.get_str());
  Kernel::FT::Exact_type exact;
  text >> exact;
  return Kernel::FT(exact);
}

mpq_class ToRational(const Kernel::FT& value) {
  std::ostringstream text;
  text << value.exact();
  mpq_class result(text.str());
  result.canonicalize();
  return result;
}

class Builder : public CGAL::Modifier_base<Polyhedron::HalfedgeDS> {
 public:
  explicit Builder(const IntegerPolyhedron& body) : body_(body) {}

  void operator()(Polyhedron::HalfedgeDS& structure) override {
    CGAL::Polyhedron_incremental_builder_3<Polyhedron::HalfedgeDS> builder(structure, true);
    builder.begin_surface(body_.points.size(), body_.loops.size());
    for (const IntegerVector& x : body_.points) {
      builder.add_vertex(Kernel::Point_3(ToField(x[0]), ToField(x[1]), ToField(x[2])));
    }
    for (const std::vector<int>& loop : body_.loops) {
      builder.begin_facet();
      for (const int v : loop) builder.add_vertex_to_facet(v);
      builder.end_facet();
    }
    builder.end_surface();
  }

 private:
  const IntegerPolyhedron& body_;
};

Nef MakeNef(const IntegerPolyhedron& body) {
  Builder builder(body);
  Polyhedron polyhedron;
  polyhedron.delegate(builder);
  return Nef(polyhedron);
}

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
