// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/triangle_contact_internal.h"

#include <algorithm>
#include <optional>

namespace touchstone::internal {
namespace {

std::array<int, 3> Sides(const DyadicVector& normal, const DyadicVector& origin,
                         const std::array<DyadicVector, 3>& points) {
  std::array<int, 3> sides;
  for (int k = 0; k < 3; ++k) sides[k] = Dot(normal, points[k] - origin).sign();
  return sides;
}

bool AreAllOnOneSide(const std::array<int, 3>& sides) {
  return sides[0] != 0 && sides[0] == sides[1] && sides[1] == sides[2];
}

// An axis along which v is not zero, or -1.
int AxisOf(const DyadicVector& v) {
  for (int axis = 0; axis < 3; ++axis) {
    if (v[axis].sign() != 0) return axis;
  }
  return -1;
}

// Coordinate `axis` of u x v.
Dyadic CrossAlong(int axis, const DyadicVector& u, const DyadicVector& v) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  return u[i] * v[j] - u[j] * v[i];
}

// Whether value / whole lies strictly between 0 and 1.
bool IsProperFraction(const Dyadic& value, const Dyadic& whole) {
  return value.sign() * whole.sign() > 0 && (whole - value).sign() * whole.sign() > 0;
}

}  // namespace

ExactContact::ExactContact(const MeshPair& pair, const Translation& x)
    : pair_(pair), exact_(pair), denominator_(1) {
  const Dyadic& factor = exact_.pose().factor();
  has_denominator_ = x.exact != nullptr;
  shift_ = factor * (has_denominator_ ? x.exact->coordinates : ToDyadic(x.value));
  if (has_denominator_) denominator_ = x.exact->denominator;
}

DyadicVector ExactContact::PointOfA(int v) {
  return has_denominator_ ? denominator_ * exact_.PointOfA(v) : exact_.PointOfA(v);
}

DyadicVector ExactContact::PointOfB(int v) {
  return (has_denominator_ ? denominator_ * exact_.PointOfB(v) : exact_.PointOfB(v)) + shift_;
}

Verdict ExactContact::Meet(int face_a, int face_b) {
  Corners c{face_a, face_b, {}, {}, {}, {}};
  for (int k = 0; k < 3; ++k) {
    c.a[k] = PointOfA(pair_.a().mesh.face(face_a)[k]);
    c.b[k] = PointOfB(pair_.b().mesh.face(face_b)[k]);
  }
  c.normal_a = Cross(c.a[1] - c.a[0], c.a[2] - c.a[0]);
  const std::array<int, 3> sides_of_b = Sides(c.normal_a, c.a[0], c.b);
  if (AreAllOnOneSide(sides_of_b)) return Verdict::kSeparate;
  c.normal_b = Cross(c.b[1] - c.b[0], c.b[2] - c.b[0]);
  const std::array<int, 3> sides_of_a = Sides(c.normal_b, c.b[0], c.a);
  if (AreAllOnOneSide(sides_of_a)) return Verdict::kSeparate;

  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    if ((sides_of_b[k] * sides_of_b[next] < 0 && EdgePassesThrough(c.b[k], c.b[next], c.a)) ||
        (sides_of_a[k] * sides_of_a[next] < 0 && EdgePassesThrough(c.a[k], c.a[next], c.b))) {
      return Verdict::kOverlap;
    }
  }
  found_contact_ = false;
  if (VerticesMeet(c, sides_of_a, sides_of_b) || EdgesMeet(c)) return Verdict::kOverlap;
  return found_contact_ ? Verdict::kTouch : Verdict::kSeparate;
}

// The line passes strictly between all three corners.
bool ExactContact::EdgePassesThrough(const DyadicVector& from, const DyadicVector& to,
                                     const Points& triangle) {
  const DyadicVector edge = to - from;
  int first = 0;
  for (int i = 0; i < 3; ++i) {
    const int turn =
        Determinant(triangle[(i + 1) % 3] - triangle[i], edge, from - triangle[i]).sign();
    if (turn == 0 || (i > 0 && turn != first)) return false;
    first = turn;
  }
  return true;
}

std::optional<Feature> ExactContact::On(const TriangleMesh& mesh, int face, const Points& corners,
                                        const DyadicVector& normal, const DyadicVector& point) {
  const int axis = AxisOf(normal);
  std::array<bool, 3> is_on_side;
  for (int i = 0; i < 3; ++i) {
    const Dyadic turn = CrossAlong(axis, corners[(i + 1) % 3] - corners[i], point - corners[i]);
    if (turn.sign() * normal[axis].sign() < 0) return std::nullopt;
    is_on_side[i] = turn.sign() == 0;
  }
  for (int i = 0; i < 3; ++i) {
    if (is_on_side[i] && is_on_side[(i + 2) % 3]) {
      return Feature{FeatureKind::kVertex, mesh.face(face)[i]};
    }
  }
  for (int i = 0; i < 3; ++i) {
    if (is_on_side[i]) return Feature{FeatureKind::kEdge, mesh.edge_of(3 * face + i)};
  }
  return Feature{FeatureKind::kFace, face};
}

bool ExactContact::VerticesMeet(const Corners& c, const std::array<int, 3>& sides_of_a,
                                const std::array<int, 3>& sides_of_b) {
  const TriangleMesh &a = pair_.a().mesh, &b = pair_.b().mesh;
  for (int k = 0; k < 3; ++k) {
    if (sides_of_b[k] == 0) {
      const auto on = On(a, c.face_a, c.a, c.normal_a, c.b[k]);
      if (on && Overlaps(*on, {FeatureKind::kVertex, b.face(c.face_b)[k]})) return true;
    }
    if (sides_of_a[k] == 0) {
      const auto on = On(b, c.face_b, c.b, c.normal_b, c.a[k]);
      if (on && Overlaps({FeatureKind::kVertex, a.face(c.face_a)[k]}, *on)) return true;
    }
  }
  return false;
}

// Crossings of edges, each strictly within, that are not parallel: where a_i + s u = b_j + t v,
// with w from a_i to b_j, s (u x v) = w x v and t (u x v) = w x u.
bool ExactContact::EdgesMeet(const Corners& c) {
  for (int i = 0; i < 3; ++i) {
    const DyadicVector u = c.a[(i + 1) % 3] - c.a[i];
    for (int j = 0; j < 3; ++j) {
      const DyadicVector v = c.b[(j + 1) % 3] - c.b[j], w = c.b[j] - c.a[i];
      const DyadicVector normal = Cross(u, v);
      const int axis = AxisOf(normal);
      if (axis < 0 || Dot(normal, w).sign() != 0) continue;
      if (!IsProperFraction(CrossAlong(axis, w, v), normal[axis]) ||
          !IsProperFraction(CrossAlong(axis, w, u), normal[axis])) {
        continue;
      }
      const Feature edge_a{FeatureKind::kEdge, pair_.a().mesh.edge_of(3 * c.face_a + i)};
      const Feature edge_b{FeatureKind::kEdge, pair_.b().mesh.edge_of(3 * c.face_b + j)};
      if (Overlaps(edge_a, edge_b)) return true;
    }
  }
  return false;
}

bool ExactContact::Overlaps(Feature a, Feature b) {
  found_contact_ = true;
  if (!seen_.insert({static_cast<int>(a.kind), a.index, static_cast<int>(b.kind), b.index})
           .second) {
    return false;
  }
  return LinksOverlap(LinkAt(true, a), LinkAt(false, b));
}

Link ExactContact::LinkAt(bool is_a, Feature feature) const {
  const TriangleMesh& mesh = is_a ? pair_.a().mesh : pair_.b().mesh;
  Link link;
  const auto add = [&](int to, int from) {
    const DyadicVector difference = ToDyadic(mesh.vertex(to)) - ToDyadic(mesh.vertex(from));
    link.push_back(MakeLinkDirection(is_a ? exact_.pose().FromP(difference)
                                          : exact_.pose().DifferenceFromQ(difference)));
  };
  // Counterclockwise seen from outside the solid, that is with the solid on the right.
  switch (feature.kind) {
    case FeatureKind::kVertex:
      for (const int h : mesh.vertex_half_edges(feature.index)) add(mesh.head(h), feature.index);
      break;
    case FeatureKind::kEdge: {
      const int h = mesh.half_edge_of(feature.index);
      add(mesh.head(h), mesh.tail(h));
      add(mesh.apex(h), mesh.tail(h));
      add(mesh.tail(h), mesh.head(h));
      add(mesh.apex(mesh.twin(h)), mesh.tail(h));
      break;
    }
    case FeatureKind::kFace:
      for (int k = 0; k < 3; ++k) {
        add(mesh.face(feature.index)[(k + 1) % 3], mesh.face(feature.index)[k]);
      }
      break;
  }
  std::reverse(link.begin(), link.end());
  return link;
}

}  // namespace touchstone::internal
