// SPDX-License-Identifier: MIT
#include "touchstone/tests/cd_dual/brute_force.h"

#include <vector>

namespace touchstone::testing {
namespace {

struct Placed {
  std::vector<DyadicVector> p, q;  // in P's frame
  DyadicVector c;

  Placed(const ConvexPolyhedron& body_p, const ConvexPolyhedron& body_q, const RelativePose& pose,
         int interior_p, int interior_q) {
    const auto place = [&](const Eigen::Vector3d& x) {
      DyadicVector image;
      for (int i = 0; i < 3; ++i) {
        image[i] =
            Dot(ToDyadic(pose.rotation().row(i)), ToDyadic(x)) + Dyadic(pose.translation()[i]);
      }
      return image;
    };
    for (const auto& v : body_p.vertices()) p.push_back(ToDyadic(v));
    for (const auto& v : body_q.vertices()) q.push_back(place(v));
    c = ToDyadic(body_p.interior_point(interior_p)) - place(body_q.interior_point(interior_q));
  }

  static Dyadic Max(const std::vector<DyadicVector>& points, const DyadicVector& n, int* count) {
    Dyadic best = Dot(n, points[0]);
    *count = 0;
    for (const auto& x : points) {
      const Dyadic value = Dot(n, x);
      const int sign = (value - best).sign();
      if (sign > 0) {
        best = value;
        *count = 1;
      } else if (sign == 0) {
        ++*count;
      }
    }
    return best;
  }

  // The parameter at which the ray meets the supporting plane with outward normal n, if it faces
  // it.
  std::optional<Fraction> Parameter(const DyadicVector& n, int* tied_p, int* tied_q) const {
    const Dyadic toward = -Dot(n, c);
    if (toward.sign() <= 0) return std::nullopt;
    const DyadicVector opposite = {-n[0], -n[1], -n[2]};
    const Dyadic support = Max(p, n, tied_p) + Max(q, opposite, tied_q);
    return Fraction{support - Dot(n, c), toward};
  }

  DyadicVector NormalP(const ConvexPolyhedron& body, int f) const {
    const auto& x = body.face_plane(f);
    return Cross(p[x[1]] - p[x[0]], p[x[2]] - p[x[0]]);
  }
  DyadicVector NormalQ(const ConvexPolyhedron& body, int f) const {  // of -Q, hence inward for Q
    const auto& x = body.face_plane(f);
    return Cross(q[x[2]] - q[x[0]], q[x[1]] - q[x[0]]);
  }
  DyadicVector NormalEE(const ConvexPolyhedron& body_p, int e_p, const ConvexPolyhedron& body_q,
                        int e_q) const {
    return Cross(p[body_p.edge(e_p).head] - p[body_p.edge(e_p).tail],
                 q[body_q.edge(e_q).head] - q[body_q.edge(e_q).tail]);
  }
};

void Lower(std::optional<Fraction>* least, const std::optional<Fraction>& candidate) {
  if (candidate && (!*least || Compare(*candidate, **least) < 0)) *least = candidate;
}

DyadicVector Negated(const DyadicVector& n) { return {-n[0], -n[1], -n[2]}; }

}  // namespace

BruteForceExit FindExitByBruteForce(const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                                    const RelativePose& pose, int interior_p, int interior_q) {
  const Placed placed(p, q, pose, interior_p, interior_q);
  std::optional<Fraction> least, face_vertex, vertex_face, edge_edge;
  int tied_p = 0, tied_q = 0;
  for (int f = 0; f < p.face_count(); ++f) {
    Lower(&face_vertex, placed.Parameter(placed.NormalP(p, f), &tied_p, &tied_q));
  }
  for (int f = 0; f < q.face_count(); ++f) {
    Lower(&vertex_face, placed.Parameter(placed.NormalQ(q, f), &tied_p, &tied_q));
  }
  Lower(&least, face_vertex);
  Lower(&least, vertex_face);
  for (int e_p = 0; e_p < p.edge_count(); ++e_p) {
    for (int e_q = 0; e_q < q.edge_count(); ++e_q) {
      const DyadicVector n = placed.NormalEE(p, e_p, q, e_q);
      if (n[0].sign() == 0 && n[1].sign() == 0 && n[2].sign() == 0) continue;
      for (const DyadicVector& normal : {n, Negated(n)}) {
        const auto parameter = placed.Parameter(normal, &tied_p, &tied_q);
        Lower(&least, parameter);
        // Two tied vertices on each side: since the edges lie across n, they are these edges iff
        // their ends are among the tied.
        if (!parameter || tied_p != 2 || tied_q != 2) continue;
        int unused = 0;
        const bool own_p =
            (Dot(normal, placed.p[p.edge(e_p).tail]) - Placed::Max(placed.p, normal, &unused))
                .sign() == 0;
        const DyadicVector down = Negated(normal);
        const bool own_q =
            (Dot(down, placed.q[q.edge(e_q).tail]) - Placed::Max(placed.q, down, &unused)).sign() ==
            0;
        if (own_p && own_q) Lower(&edge_edge, parameter);
      }
    }
  }
  BruteForceExit out{*least, Verdict::kUndecided, *face_vertex, *vertex_face, edge_edge};
  const int beyond_origin = (least->numerator - least->denominator).sign();
  out.verdict = beyond_origin > 0   ? Verdict::kOverlap
                : beyond_origin < 0 ? Verdict::kSeparate
                                    : Verdict::kTouch;
  return out;
}

Fraction ParameterOf(const ConvexPolyhedron& p, const ConvexPolyhedron& q, const RelativePose& pose,
                     int interior_p, int interior_q, FaceClass face_class, Feature feature_p,
                     Feature feature_q) {
  const Placed placed(p, q, pose, interior_p, interior_q);
  int tied_p = 0, tied_q = 0;
  if (feature_p.kind == FeatureKind::kFace) {
    return *placed.Parameter(placed.NormalP(p, feature_p.index), &tied_p, &tied_q);
  }
  if (feature_q.kind == FeatureKind::kFace) {
    return *placed.Parameter(placed.NormalQ(q, feature_q.index), &tied_p, &tied_q);
  }
  (void)face_class;
  std::optional<Fraction> least;
  const DyadicVector n = placed.NormalEE(p, feature_p.index, q, feature_q.index);
  Lower(&least, placed.Parameter(n, &tied_p, &tied_q));
  Lower(&least, placed.Parameter(Negated(n), &tied_p, &tied_q));
  return *least;
}

}  // namespace touchstone::testing
