// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/nef_minkowski.h"

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

// A body from points and its own loops, reversed for the reflected one.
class Builder : public CGAL::Modifier_base<Polyhedron::HalfedgeDS> {
 public:
  Builder(const ExactBodyData& body, const std::vector<IntegerVector>& points, bool reverse)
      : body_(body), points_(points), reverse_(reverse) {}

  void operator()(Polyhedron::HalfedgeDS& structure) override {
    CGAL::Polyhedron_incremental_builder_3<Polyhedron::HalfedgeDS> builder(structure, true);
    builder.begin_surface(points_.size(), body_.face_count);
    for (const IntegerVector& x : points_) {
      builder.add_vertex(Kernel::Point_3(ToField(x[0]), ToField(x[1]), ToField(x[2])));
    }
    for (int f = 0; f < body_.face_count; ++f) {
      const std::span<const int> loop = body_.face(f);
      builder.begin_facet();
      for (std::size_t k = 0; k < loop.size(); ++k) {
        builder.add_vertex_to_facet(loop[reverse_ ? loop.size() - 1 - k : k]);
      }
      builder.end_facet();
    }
    builder.end_surface();
  }

 private:
  const ExactBodyData& body_;
  const std::vector<IntegerVector>& points_;
  bool reverse_;
};

Nef MakeNef(const ExactBodyData& body, const std::vector<IntegerVector>& points, bool reverse) {
  Builder builder(body, points, reverse);
  Polyhedron polyhedron;
  polyhedron.delegate(builder);
  return Nef(polyhedron);
}

// The least integer that makes all of them whole.
Integer CommonDenominator(const std::vector<mpq_class>& values) {
  Integer common = 1;
  for (const mpq_class& value : values) common = lcm(common, value.get_den());
  return common;
}

ExactPlane ToPlane(const Kernel::Plane_3& plane) {
  std::vector<mpq_class> e = {ToRational(plane.a()), ToRational(plane.b()), ToRational(plane.c()),
                              ToRational(plane.d())};
  const Integer common = CommonDenominator(e);
  for (mpq_class& value : e) value *= common;
  return MakePlane({e[0].get_num(), e[1].get_num(), e[2].get_num()}, Integer(-e[3].get_num()));
}

}  // namespace

MinkowskiDifference NefMinkowski(const PlacedPair& pair) {
  // P's points as differences from Q's vertex 0, and Q's reflected from there: their sum is M.
  std::vector<IntegerVector> points_p, points_q;
  for (int a = 0; a < pair.p().vertex_count; ++a) points_p.push_back(pair.Difference({a, 0}));
  for (int b = 0; b < pair.q().vertex_count; ++b) {
    points_q.push_back(pair.Difference({0, b}) - pair.Difference({0, 0}));
  }
  Nef nef_p = MakeNef(pair.p(), points_p, false), nef_q = MakeNef(pair.q(), points_q, true);
  const Nef sum = CGAL::minkowski_sum_3(nef_p, nef_q);

  std::vector<ExactPlane> planes;
  for (Nef::Halffacet_const_iterator f = sum.halffacets_begin(); f != sum.halffacets_end(); ++f) {
    ExactPlane plane = ToPlane(f->plane());
    if (Dot(plane.normal, pair.c()) < plane.offset) planes.push_back(std::move(plane));
  }
  std::vector<IntegerVector> points;
  for (Nef::Vertex_const_iterator v = sum.vertices_begin(); v != sum.vertices_end(); ++v) {
    points.push_back({ToRational(v->point().x()).get_num(), ToRational(v->point().y()).get_num(),
                      ToRational(v->point().z()).get_num()});
  }
  MinkowskiDifference result;
  result.facets = ClassifyFacets(pair, std::move(planes));
  result.vertices = Corners(std::move(points), result.facets);
  return result;
}

}  // namespace touchstone::exact
