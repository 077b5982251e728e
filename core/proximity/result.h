// SPDX-License-Identifier: MIT
//
// What the proximity queries return. M, c, o, vertex pairs and facets are those of
// cd_dual/result.h; all points and directions are in P's frame, all lengths in the caller's unit.
//
// How errors are stated: a BoundedValue holds |value - exact| <= error, and wherever the answer is
// final (`optimal`, `minimal`, certainty kExact) error <= 1e-12 condition |value|. Distance and
// depth move by no more than the bodies' points do, so their condition is size / value; a travel's
// is divided by the cosine between the direction and the facet's normal. `size` is the largest
// coordinate of P, of the placed Q and of the translation, added up.
#ifndef TOUCHSTONE_CORE_PROXIMITY_RESULT_H_
#define TOUCHSTONE_CORE_PROXIMITY_RESULT_H_

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "touchstone/core/cd_dual/result.h"

namespace touchstone {

// A facet of M and the features of P and Q whose sum it is, by exact dimensions: its plane's normal
// is the direction in which these features support their bodies.
struct ContactFacet {
  FaceClass face_class;
  Feature feature_p, feature_q;
  // Three vertices of the facet, not collinear, counterclockwise from outside M. Their closed
  // triangle holds the point of the facet that the query is about.
  std::array<VertexPair, 3> triangle;
};

enum class DistanceKind {
  kSeparate,
  kMeet,       // they share a point: distance zero
  kUndecided,  // kFloat: the bounds did not decide
};

// The Euclidean distance, which is that of o from M.
struct DistanceResult {
  DistanceKind kind = DistanceKind::kUndecided;
  Tier tier = Tier::kNone;  // the arithmetic that proved the answer

  BoundedValue distance;  // zero, without error, for kMeet
  // lower <= exact distance <= upper, each by something that stands alone: the bodies are at least
  // `lower` apart along `direction`, and the two points are at most `upper` apart.
  double lower = 0.0, upper = 0.0;

  // The rest is present for kSeparate.
  //
  // One to three vertices of M whose hull holds the point x of M that is taken for the nearest to
  // o, as a sum with positive weights; `simplex_size` of them. `optimal`: x is proven to be the
  // nearest point of M, by signs alone: M lies on the far side of the plane through x with normal
  // x. Always so under kExact.
  std::array<VertexPair, 3> simplex;
  int simplex_size = 0;
  bool optimal = false;
  // Closest points: x is their difference, and with the weights of x over `simplex` they are sums
  // of vertices of P and of Q. Each is within `point_error` of that exact point.
  Eigen::Vector3d point_on_p = Eigen::Vector3d::Zero();
  Eigen::Vector3d point_on_q = Eigen::Vector3d::Zero();
  double point_error = 0.0;
  // From P to Q, of unit length up to rounding.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  // What supports P along -x and Q along x, by exact dimensions: larger than what the closest
  // points lie in where features are parallel. Present when `optimal`.
  std::optional<Feature> feature_p, feature_q;

  // For kMeet, the proof of it.
  Certificate certificate;
  // c, where the certificate speaks of it.
  int interior_p = 0, interior_q = 0;

  PhaseCounts counts;  // faces_visited: simplices
  long exact_signs = 0;
};

// The least translation that leaves the bodies just touching, which is o's way to the boundary of
// M.
struct PenetrationResult {
  // kSeparate and kTouch: depth zero, with the certificate. kUndecided only under kFloat.
  Verdict verdict = Verdict::kUndecided;
  Tier tier = Tier::kNone;

  BoundedValue depth;
  // lower <= exact depth <= upper: M holds the ball of radius `lower` around o, and lies below the
  // plane across `direction` at height `upper`.
  double lower = 0.0, upper = 0.0;

  // The rest is present for kOverlap.
  //
  // Q moved by `translation` just touches P: it is the foot of o on the facet's plane. Within
  // `foot_error` of the exact foot.
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  double foot_error = 0.0;
  // The facet's outward normal, of unit length up to rounding.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  // The facet, proven to be one; the foot lies in its triangle. Always present under kExact. For
  // kTouch: the facet that holds o.
  std::optional<ContactFacet> facet;
  // No facet of M is nearer to o, by exact signs: lower is then the depth up to rounding. Always so
  // under kExact.
  bool minimal = false;
  // Deepest points: vertices of P and Q summed with the weights of the foot in the triangle;
  // point_on_p - point_on_q is the translation. Each within `point_error`.
  Eigen::Vector3d point_on_p = Eigen::Vector3d::Zero();
  Eigen::Vector3d point_on_q = Eigen::Vector3d::Zero();
  double point_error = 0.0;

  // On request, the proof of `lower`: a closed surface of triangles of points of M (c among them at
  // times), all counterclockwise seen from outside and from o strictly on the inner side, none
  // nearer than `lower`. So it winds around the ball, and the ball is in M.
  std::vector<std::array<VertexPair, 3>> inner_polytope;

  // For kSeparate and kTouch.
  Certificate certificate;
  // c, where the certificate or the inner polytope speak of it.
  int interior_p = 0, interior_q = 0;

  PhaseCounts counts;  // faces_visited: triangles of the inner polytope taken up
  long exact_signs = 0;
  bool warm = false;  // the cache's polytope served
};

enum class TravelKind {
  kInterval,   // they meet exactly for the travels in [enter, leave]
  kNever,      // they miss each other, however far Q travels either way
  kUndecided,  // kFloat: the bounds did not decide
};

// One end of the interval.
struct TravelEnd {
  BoundedValue travel;
  // The facet of M by which the line leaves M there, never parallel to it; the line crosses its
  // triangle.
  std::optional<ContactFacet> facet;
};

// For which t do P and Q + t s meet? Those with t s in M: a closed interval, or none.
struct DirectionalResult {
  TravelKind kind = TravelKind::kUndecided;
  Tier tier = Tier::kNone;

  // For kInterval, enter <= leave; equal where the line touches M in one point. Under kExact the
  // signs are exact: enter.travel.value <= 0 <= leave.travel.value if and only if P and Q meet as
  // they are, and a travel of zero has no error.
  TravelEnd enter, leave;
  // The line runs in the boundary of M and nowhere inside: for no travel do P and Q overlap. Known
  // under kExact.
  bool grazing = false;

  // For kNever, the proof. N = (w1 - w0) x s for these two vertices of M: N.x <= N.w0 < 0 for all x
  // in M, while N.(t s) = 0.
  std::array<VertexPair, 2> separator;

  PhaseCounts counts;
  long exact_signs = 0;
};

// What the paper's own construction (section 6) makes of the question.
enum class PublishedTravelKind {
  kTravel,      // a travel at which P and Q touch
  kNever,       // no triangle of the fan holds the shadow of o
  kCoincident,  // c = o: it points nowhere
  kOnBoundary,  // c is on the boundary of M, where the formula for d divides by zero
};

struct PublishedTravel {
  PublishedTravelKind kind = PublishedTravelKind::kNever;
  // The three corners of the fan's triangle, and the weights u, v, w of the shadow of o in it; in
  // doubles, as is all of this.
  std::array<VertexPair, 3> corners;
  std::array<double, 3> weights{};
  double c_travel = 0.0;  // k: c = k s
  // For kTravel: t, from g, with the face that SEARCH-FV, SEARCH-VF and SEARCH-EE end on.
  double travel = 0.0;
  FaceClass face_class = FaceClass::kFaceVertex;
  Feature feature_p, feature_q;
};

std::string_view ToString(DistanceKind);
std::string_view ToString(TravelKind);
std::string_view ToString(PublishedTravelKind);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_PROXIMITY_RESULT_H_
