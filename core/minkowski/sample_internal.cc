// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/sample_internal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

// A point with big numbers and its rounding, in A's frame and true lengths.
struct Sample {
  Vector3d rounded;
  double error;
  ExactPoint exact;
};

// The weighted mean of points, exactly, with its rounding.
Sample MeanOf(SumGeometry* geometry, const std::array<int, 3>& points) {
  Sample sample;
  Dyadic product(1);
  for (const int x : points) product = product * geometry->Exact(x).denominator;
  sample.exact.coordinates = {Dyadic(0), Dyadic(0), Dyadic(0)};
  for (int k = 0; k < 3; ++k) {
    const Dyadic others = geometry->Exact(points[(k + 1) % 3]).denominator *
                          geometry->Exact(points[(k + 2) % 3]).denominator;
    sample.exact.coordinates =
        sample.exact.coordinates + others * geometry->Exact(points[k]).coordinates;
  }
  sample.exact.denominator = Dyadic(3) * product * geometry->factor();
  double largest = 0.0;
  for (int i = 0; i < 3; ++i) {
    sample.rounded[i] = RatioToDouble(sample.exact.coordinates[i], sample.exact.denominator);
    largest = std::max(largest, std::abs(sample.rounded[i]));
  }
  sample.error = kUnit * largest;
  return sample;
}

// A number near `value` of few bits, so that exact numbers made with it stay short.
double Short(double value) { return std::round(value * 0x1p20) * 0x1p-20; }

// corner + s (next - corner) + t (previous - corner) near a triangle's middle, for short s and t;
// and its rounding in true lengths.
struct PlaceInFacet {
  double s, t;
  Vector3d rounded;
  double error;
};

// If doubles can tell that it lies inside.
std::optional<PlaceInFacet> TryInFacet(SumGeometry* geometry, const ArrangedFacet& facet,
                                       const std::array<int, 3>& triangle) {
  const int last = facet.corners[facet.count - 1];
  const SumPoint &p = geometry->point(facet.corners[0]), &q = geometry->point(facet.corners[1]),
                 &r = geometry->point(last);
  Vector3d middle = Vector3d::Zero();
  for (const int x : triangle) middle += geometry->point(x).rounded / 3.0;
  const Vector3d u = q.rounded - p.rounded, v = r.rounded - p.rounded, w = middle - p.rounded;
  const Vector3d normal = u.cross(v);
  const double squared = normal.squaredNorm();
  const double s = Short(w.cross(v).dot(normal) / squared);
  const double t = Short(u.cross(w).dot(normal) / squared);
  if (!(std::abs(s) < 2.0 && std::abs(t) < 2.0)) return std::nullopt;
  SumPoint x{SumPointForm::kVertex, {}, p.rounded + s * u + t * v, 0.0};
  // Weights of at most 5, 2 and 2 in size; six roundings of numbers of at most 10.
  x.error = 10.0 * std::max({p.error, q.error, r.error}) + 100.0 * kUnit;
  const int axis = geometry->NormalAxis(facet.plane);
  const auto turn = [&](int k) {
    return SumGeometry::TriageTurn(geometry->point(triangle[k]),
                                   geometry->point(triangle[(k + 1) % 3]), x, axis);
  };
  if (turn(0) == 0 || turn(1) != turn(0) || turn(2) != turn(0)) return std::nullopt;
  const double scale = geometry->pair().scale();
  return PlaceInFacet{s, t, x.rounded / scale, x.error / scale};
}

Sample MakeExact(SumGeometry* geometry, const ArrangedFacet& facet, const PlaceInFacet& place) {
  const DyadicVector& origin = geometry->Exact(facet.corners[0]).coordinates;
  const DyadicVector u = geometry->Exact(facet.corners[1]).coordinates - origin;
  const DyadicVector v = geometry->Exact(facet.corners[facet.count - 1]).coordinates - origin;
  return {place.rounded,
          place.error,
          {origin + Dyadic(place.s) * u + Dyadic(place.t) * v, geometry->factor()}};
}

// Whether all vertices of a face but those of the contact lie certainly on one side of the
// contact's plane, whose normal is given, through a vertex of it.
bool IsClearOf(const PlacedMesh& placed, int face, const Vector3d& normal, double normal_error,
               int on_plane, int also_on_plane, int side) {
  for (const int w : placed.mesh.face(face)) {
    if (w == on_plane || w == also_on_plane) continue;
    const Vector3d way = placed.points[w] - placed.points[on_plane];
    const double error = 1.01 * (2.0 * placed.point_error + kUnit * way.cwiseAbs().maxCoeff());
    if (TriageSign(HeightAlong(normal, normal_error, way, error)) != side) return false;
  }
  return true;
}

// The faces that meet at a contact strictly within the facet's features, each pair of them in that
// point alone: they lie on either side of the facet's plane. What supports does not overlap.
std::vector<std::pair<int, int>> ContactsIn(const SumGeometry& geometry,
                                            const ArrangedFacet& facet) {
  const MeshPair& pair = geometry.pair();
  const SumPlane& plane = geometry.plane(facet.plane);
  const SumFacet& name = facet.name;
  std::vector<std::pair<int, int>> contacts;
  if (name.kind == SumFacetKind::kEdgeEdge) {
    const TriangleMesh &a = pair.a().mesh, &b = pair.b().mesh;
    const int ha = a.half_edge_of(name.a), hb = b.half_edge_of(name.b);
    for (const int of_a : {ha, a.twin(ha)}) {
      for (const int of_b : {hb, b.twin(hb)}) {
        if (IsClearOf(pair.a(), of_a / 3, plane.normal, plane.normal_error, a.tail(ha), a.head(ha),
                      -1) &&
            IsClearOf(pair.b(), of_b / 3, plane.normal, plane.normal_error, b.tail(hb), b.head(hb),
                      1)) {
          contacts.emplace_back(of_a / 3, of_b / 3);
        }
      }
    }
    return contacts;
  }
  const bool is_face_of_a = name.kind == SumFacetKind::kFaceVertex;
  const PlacedMesh& of_vertex = is_face_of_a ? pair.b() : pair.a();
  const int vertex = is_face_of_a ? name.b : name.a;
  for (const int h : of_vertex.mesh.vertex_half_edges(vertex)) {
    const int face = TriangleMesh::face_of(h);
    if (!IsClearOf(of_vertex, face, plane.normal, plane.normal_error, vertex, vertex,
                   is_face_of_a ? 1 : -1)) {
      continue;
    }
    contacts.emplace_back(is_face_of_a ? name.a : face, is_face_of_a ? face : name.b);
  }
  return contacts;
}

Verdict InDoubles(const MeshPair& pair, const Vector3d& rounded, double error,
                  std::span<const std::pair<int, int>> contacts, MembershipCache* cache) {
  Translation x(rounded);
  x.error = error;
  return Membership(pair, x, {Certainty::kFloat, contacts}, cache).verdict;
}

Verdict Exactly(const MeshPair& pair, const Sample& sample, MembershipCache* cache) {
  return Membership(pair, Translation(sample.rounded, sample.error, sample.exact), {}, cache)
      .verdict;
}

}  // namespace

Verdict VerdictIn(SumGeometry* geometry, const ArrangedFacet& facet,
                  const std::array<int, 3>& triangle, MembershipCache* cache) {
  const MeshPair& pair = geometry->pair();
  const auto place = TryInFacet(geometry, facet, triangle);
  if (!place) return Exactly(pair, MeanOf(geometry, triangle), cache);
  const auto contacts = ContactsIn(*geometry, facet);
  const Verdict verdict = InDoubles(pair, place->rounded, place->error, contacts, cache);
  if (verdict != Verdict::kUndecided) return verdict;
  return Exactly(pair, MakeExact(geometry, facet, *place), cache);
}

Verdict VerdictBetween(SumGeometry* geometry, int x, int y, MembershipCache* cache) {
  const SumPoint &p = geometry->point(x), &q = geometry->point(y);
  // A third of the way back: thirds are as good as halves. Within the sum of a third of one error
  // and two of the other; three roundings of numbers below eight.
  const double error = std::max(p.error, q.error) + 32.0 * kUnit;
  if (error < 0x1p-30) {
    const double scale = geometry->pair().scale();
    const Vector3d middle = (p.rounded + 2.0 * q.rounded) / 3.0;
    const Verdict verdict = InDoubles(geometry->pair(), middle / scale, error / scale, {}, cache);
    if (verdict != Verdict::kUndecided) return verdict;
  }
  return Exactly(geometry->pair(), MeanOf(geometry, {x, y, y}), cache);
}

bool FaceOneSide(const SumGeometry& geometry, std::span<const FacingPlane> planes) {
  Vector3d direction = Vector3d::Zero();
  for (const auto& [plane, along] : planes) {
    direction += (along != 0 ? 1.0 : -1.0) * geometry.plane(plane).normal.normalized();
  }
  return std::all_of(planes.begin(), planes.end(), [&](const FacingPlane& each) {
    const SumPlane& own = geometry.plane(each[0]);
    const int sign = TriageSign(HeightAlong(own.normal, own.normal_error, direction, 0.0));
    return sign == (each[1] != 0 ? 1 : -1);
  });
}

double SquaredArea(const SumGeometry& geometry, const std::array<int, 3>& triangle) {
  const Vector3d& o = geometry.point(triangle[0]).rounded;
  return (geometry.point(triangle[1]).rounded - o)
      .cross(geometry.point(triangle[2]).rounded - o)
      .squaredNorm();
}

}  // namespace touchstone::internal
