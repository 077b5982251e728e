// SPDX-License-Identifier: MIT
//
// The signs that a proof rests on: filtered in doubles with derived bounds, exact where the filter
// fails and the caller allows it.
#ifndef TOUCHSTONE_CORE_CD_DUAL_SIGNS_H_
#define TOUCHSTONE_CORE_CD_DUAL_SIGNS_H_

#include <Eigen/Core>
#include <array>
#include <optional>

#include "touchstone/core/base/exact_pose.h"
#include "touchstone/core/cd_dual/minkowski_difference.h"

namespace touchstone {

enum class Body { kP, kQ };

// M with big numbers: points exact up to one positive factor common to the query (1, or det Rp when
// the pose came from two world poses: then M is formed as det(Rp) a - adj(Rp)(Rq b + tq - tp)).
class ExactDifference {
 public:
  explicit ExactDifference(const MinkowskiDifference& m) : m_(m), pose_(m.pose()) {}

  DyadicVector Point(VertexPair pair) const;
  // (a_to - a_from) as an edge of M, or -(b_to - b_from) for Q: what M's plane through one sees.
  DyadicVector Edge(Body body, int to, int from) const;
  // The factor by which points are multiplied: divide lengths by it.
  const Dyadic& factor() const { return pose_.factor(); }

 private:
  const MinkowskiDifference& m_;
  ExactPose pose_;
};

// A plane through three points of M that are not collinear: its normal (w2 - w1) x (w3 - w1),
// approximately and on demand exactly.
struct FacetPlane {
  std::array<VertexPair, 3> points;
  Eigen::Vector3d normal;  // scaled; each coordinate within normal_error of the exact one
  double normal_error = 0.0;
  std::optional<DyadicVector> exact_normal;
};

// Signs for one query. Each returns -1, 0 or 1, or nothing when doubles cannot tell and the
// certainty is kFloat.
class Signs {
 public:
  Signs(const MinkowskiDifference& m, Certainty certainty) : m_(m), certainty_(certainty) {}

  const MinkowskiDifference& difference() const { return m_; }

  // det [x y z] of three points of M (c among them, if wished): det[w1 w2 w3] > 0 says that o lies
  // on the inner side of the plane through w1, w2, w3, counterclockwise from outside.
  std::optional<int> Determinant(VertexPair x, VertexPair y, VertexPair z);

  // n . w for a direction of doubles, taken exactly, and a point of M.
  std::optional<int> AlongDirection(const Eigen::Vector3d& n, VertexPair w);

  FacetPlane Plane(const std::array<VertexPair, 3>& points) const;

  // n . (a_to - a_from) for P, n . -(R b_to - R b_from) for Q: positive when moving from `from` to
  // `to` on that body moves M's point outward through the plane.
  std::optional<int> AlongNormal(FacetPlane* plane, Body body, int to, int from);

  // How many signs needed big numbers.
  long exact_count() const { return exact_count_; }
  bool exact_allowed() const { return certainty_ == Certainty::kExact; }
  // For signs that others take by big numbers.
  const ExactDifference& exact();
  void CountExact() { ++exact_count_; }

 private:
  // The second filter of Determinant, finer for slivers.
  std::optional<int> HeightOverOrigin(VertexPair x, VertexPair y, VertexPair z) const;

  const MinkowskiDifference& m_;
  Certainty certainty_;
  std::optional<ExactDifference> exact_;
  long exact_count_ = 0;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CD_DUAL_SIGNS_H_
