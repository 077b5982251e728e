// SPDX-License-Identifier: GPL-3.0-or-later
//
//   paper    here              meaning, P's frame
//   c, o     interior point of M, origin
//   s                          ray parameter: the point c + s (o - c); c at 0, o at 1
//   d(f)     signed_distance   (1/s - 1) / |c| for the plane that the ray crosses at s
//   g        exit_travel       (1 - s) |c|
#ifndef TOUCHSTONE_EXACT_DECIDE_H_
#define TOUCHSTONE_EXACT_DECIDE_H_

#include <gmpxx.h>

#include <Eigen/Core>
#include <array>
#include <optional>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/cd_dual/result.h"
#include "touchstone/exact/exact_body.h"

namespace touchstone::exact {

// Where the ray from c through o leaves M.
struct ExactExit {
  mpq_class parameter;                 // s > 0, exact: below 1 separate, 1 touch, above 1 overlap
  double signed_distance = 0.0;        // d, to the nearest double
  double exit_travel = 0.0;            // g, to the nearest double
  Eigen::Vector3d exit_point;          // each coordinate to the nearest double
  double normal_cosine = 0.0;          // |n.c| / |c| for the unit normal n of the facet
  FaceClass face_class;                // by the dimensions of the two supporting features
  std::array<VertexPair, 3> triangle;  // counterclockwise from outside; crossed by the ray
};

struct ExactDecision {
  Verdict verdict = Verdict::kUndecided;  // never kUndecided once returned
  double interior_distance = 0.0;         // |c|, to the nearest double
  mpq_class interior_distance_squared;    // |c|^2, exact
  std::optional<ExactExit> exit;          // absent only when c = o
};

// The exact verdict of the placed bodies and the facet of M that the ray from
// c = interior_point(interior_p) of P - (R interior_point(interior_q) of Q + t) through o leaves
// by.
//
// Algorithm: a triangle of points of M that the ray crosses is pushed outward by exact support
// queries along its normal until nothing of M lies beyond its plane. The first triangle is the part
// of P's boundary that the ray from P's own interior point leaves P by, shifted by Q's interior
// point. The ray is perturbed symbolically, so that it never meets an edge, the crossing moves
// strictly outward at every step, and no triangle comes twice: it ends. It uses no result of the
// core. Requires interior points that are strictly interior (ExactBody::InteriorPointIsInterior).
// Complexity: O(m + n) a step, 10 to 30 steps in practice.
ExactDecision Decide(const ExactBody& p, const ExactBody& q, const RelativePose& pose,
                     int interior_p = 0, int interior_q = 0);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_DECIDE_H_
