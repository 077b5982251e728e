// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TESTS_CD_DUAL_BRUTE_FORCE_H_
#define TOUCHSTONE_TESTS_CD_DUAL_BRUTE_FORCE_H_

#include <array>
#include <optional>

#include "touchstone/core/base/dyadic.h"
#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/cd_dual/result.h"
#include "touchstone/core/convex/convex_polyhedron.h"

namespace touchstone::testing {

// An exact fraction with a positive denominator.
struct Fraction {
  Dyadic numerator, denominator;
  friend int Compare(const Fraction& a, const Fraction& b) {
    return (a.numerator * b.denominator - b.numerator * a.denominator).sign();
  }
  double ToDouble() const { return RatioToDouble(numerator, denominator); }
};

// Where the ray from c through o leaves M, by looking at the plane of every pair of features that
// could span a face: each face of P, each face of Q, each pair of edges (either sense), its support
// taken over all vertices. Every such plane supports M and every facet of M is among them, so the
// least ray parameter is the exit. Exact; O(E^2 n).
struct BruteForceExit {
  Fraction parameter;  // s: o is at 1
  Verdict verdict;
  // The least parameter over the classes, as the phases define them: every face of P with its
  // support; every face of Q; every pair of edges whose common normal has exactly these edges as
  // supporting features (nothing if there is none).
  Fraction face_vertex, vertex_face;
  std::optional<Fraction> edge_edge;
};
BruteForceExit FindExitByBruteForce(const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                                    const RelativePose& pose, int interior_p, int interior_q);

// The ray parameter of the plane that supports M along the normal of the two features.
Fraction ParameterOf(const ConvexPolyhedron& p, const ConvexPolyhedron& q, const RelativePose& pose,
                     int interior_p, int interior_q, FaceClass face_class, Feature feature_p,
                     Feature feature_q);

}  // namespace touchstone::testing

#endif  // TOUCHSTONE_TESTS_CD_DUAL_BRUTE_FORCE_H_
