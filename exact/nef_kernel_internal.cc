// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/nef_kernel_internal.h"

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <sstream>
#include <utility>
#include <vector>

namespace touchstone::exact {
namespace {

using Polyhedron = CGAL::Polyhedron_3<Kernel>;

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

// What hangs together, each facing outward.
std::vector<IntegerPolyhedron> Components(const IntegerPolyhedron& body) {
  std::vector<int> parent(body.points.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&](int v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const std::vector<int>& loop : body.loops) {
    for (const int v : loop) parent[find(v)] = find(loop[0]);
  }
  std::map<int, IntegerPolyhedron> by_root;
  std::vector<int> number(body.points.size());
  for (std::size_t v = 0; v < body.points.size(); ++v) {
    IntegerPolyhedron& own = by_root[find(static_cast<int>(v))];
    number[v] = static_cast<int>(own.points.size());
    own.points.push_back(body.points[v]);
  }
  for (std::vector<int> loop : body.loops) {
    IntegerPolyhedron& own = by_root[find(loop[0])];
    for (int& v : loop) v = number[v];
    own.loops.push_back(std::move(loop));
  }
  std::vector<IntegerPolyhedron> components;
  for (auto& [root, own] : by_root) {
    Integer volume = 0;
    for (const std::vector<int>& loop : own.loops) {
      for (std::size_t k = 2; k < loop.size(); ++k) {
        volume += Determinant(own.points[loop[0]], own.points[loop[k - 1]], own.points[loop[k]]);
      }
    }
    if (sgn(volume) < 0) {
      for (std::vector<int>& loop : own.loops) std::reverse(loop.begin(), loop.end());
    }
    components.push_back(std::move(own));
  }
  return components;
}

}  // namespace

Kernel::FT ToField(const Integer& value) {
  std::istringstream text(value.get_str());
  Kernel::FT::Exact_type exact;
  text >> exact;
  return Kernel::FT(exact);
}

Kernel::FT ToField(const mpq_class& value) {
  return ToField(Integer(value.get_num())) / ToField(Integer(value.get_den()));
}

mpq_class ToRational(const Kernel::FT& value) {
  std::ostringstream text;
  text << value.exact();
  mpq_class result(text.str());
  result.canonicalize();
  return result;
}

// CGAL fills whatever a surface bounds: nested components are joined one by one, and what lies
// within an odd number of them is solid.
Nef MakeNef(const IntegerPolyhedron& body) {
  Nef solid;
  for (const IntegerPolyhedron& component : Components(body)) {
    Builder builder(component);
    Polyhedron polyhedron;
    polyhedron.delegate(builder);
    solid = solid.is_empty() ? Nef(polyhedron) : solid.symmetric_difference(Nef(polyhedron));
  }
  return solid;
}

}  // namespace touchstone::exact
