// SPDX-License-Identifier: MIT
//
// What a convex collision query returns. The words are the same in code, JSON, tests and documents.
//
//   paper     here                       meaning
//   P, Q      p, q                       the bodies; Q placed in P's frame by a RelativePose
//   M         Minkowski difference       {a - b : a in P, b in Q}, in P's frame
//   c         interior_difference        p_i - (R q_j + t) for stored interior points: strictly
//   inside M o         the origin f_opt     ExitFace                   the facet of M that the ray
//   from c through o leaves M by d(f)      signed_distance            -k / (|c| (k - N.c)) for the
//   facet in the plane N.x = k g         exit_travel                d |c|^2 / (1 + d |c|): Q moved
//   by g c/|c| just touches P
#ifndef TOUCHSTONE_CORE_CD_DUAL_RESULT_H_
#define TOUCHSTONE_CORE_CD_DUAL_RESULT_H_

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "touchstone/core/base/verdict.h"

namespace touchstone {

enum class Search {
  kPublished,  // the paper to the letter: exists to be judged; its verdict is not proven
  kPhased,     // the paper's three phases, made correct
  kPortal,     // a triangle of M's vertices that the ray crosses, pushed outward
};

// The dimensions of the two features whose sum is the facet of M: P's first.
enum class FaceClass { kFaceVertex, kVertexFace, kEdgeEdge, kFaceEdge, kEdgeFace, kFaceFace };

// The point p_vertex - (R q_vertex + t) of M.
struct VertexPair {
  int p = -1;
  int q = -1;
  friend bool operator==(const VertexPair&, const VertexPair&) = default;
};

// A facet of M that the ray from c through o leaves M by (one of them, where it meets an edge).
struct ExitFace {
  FaceClass face_class;
  Feature feature_p, feature_q;
  // Three vertices of the facet, not collinear, counterclockwise from outside M; the ray crosses
  // their closed triangle.
  std::array<VertexPair, 3> triangle;
};

// A number with its error: |value - exact| <= error. `condition` is the first-order factor by which
// relative errors of the coordinates grow in the exact value: error <= 1e-12 * condition * |value|
// wherever the value is not zero.
struct BoundedValue {
  double value = 0.0;
  double error = 0.0;
  double condition = 1.0;
};

enum class CertificateKind {
  kNone,
  kSeparatingDirection,   // max over P of n.p < min over Q of n.q, n = `direction` taken exactly
  kSeparatingFacet,       // the same, n = the exact normal of the plane of `points` (M, outward)
  kEnclosingTetrahedron,  // o = l0 c + sum li vi over c and `points`, l0 > 0, li >= 0, not flat
  kCoincidentInterior,    // c = o exactly
  kTouchingFacet,         // the plane of `points` supports M and holds o, as does their triangle
};

// A proof of the verdict that stands alone: checkable exactly in O(m + n) without any Minkowski
// sum.
struct Certificate {
  CertificateKind kind = CertificateKind::kNone;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  // in P's frame
  std::array<VertexPair, 3> points;                     // counterclockwise from outside M
};

// Where the decision was made.
enum class Phase {
  kStart,       // before any search: c = o, or the bodies' balls or ellipsoids are apart
  kFaceVertex,  // SEARCH-FV
  kVertexFace,  // SEARCH-VF
  kEdgeEdge,    // SEARCH-EE
  kOverlay,     // kPhased: the move across the overlay of the two Gauss maps
  kPortal,      // the portal search: kPortal, and kPhased where parallel features stop its phases
  kExact,       // the exact portal search that finishes what doubles could not
  kCache,       // what the caller's cache held, proven anew
};
inline constexpr int kPhaseCount = 8;

// What a phase says of the best face it found.
enum class PhaseClaim {
  kNotRun,
  kEmpty,    // it ran and met no face of its class
  kLocal,    // better than its neighbours; nothing later rests on more
  kMaximum,  // no face of its class has a larger signed distance
};

struct PhaseReport {
  PhaseClaim claim = PhaseClaim::kNotRun;
  std::optional<FaceClass> face_class;  // of the phase's best face, with its features and distance
  Feature feature_p, feature_q;
  double signed_distance = 0.0;
};

struct PhaseCounts {
  int faces_visited = 0;  // signed distances evaluated; for a portal search, triangles
  int support_calls = 0;
  int climb_steps = 0;
  int arc_tests = 0;
};

enum class Termination {
  kOptimal,     // the exit face was found (and, unless kPublished, proven)
  kEarlyExit,   // the verdict was certain before the exit face was
  kCoincident,  // c = o
  kUndecided,   // kFloat: the bounds did not decide
};

// One face visited. The portal searches visit triangles, which are not faces, and leave no trace.
struct TraceStep {
  Phase phase;
  FaceClass face_class;
  Feature feature_p, feature_q;
  double signed_distance;
  bool accepted;  // became the best face so far
};

// A point that both bodies hold, up to `error`: neither is further from it.
struct CommonPoint {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  // in P's frame
  double error = 0.0;
};

struct CollideResult {
  Verdict verdict = Verdict::kUndecided;
  Tier tier = Tier::kNone;
  Phase phase = Phase::kStart;  // where the verdict was decided
  Termination termination = Termination::kUndecided;

  // The choice of c: interior points `interior_p` of P and `interior_q` of Q, and c rounded.
  int interior_p = 0;
  int interior_q = 0;
  Eigen::Vector3d interior_difference = Eigen::Vector3d::Zero();

  // Present when the search ran to the exit face: absent after an early exit, for c = o under early
  // exit, and under kFloat where a sign that the face rests on stayed open.
  std::optional<ExitFace> face;
  std::optional<BoundedValue> signed_distance;  // d
  std::optional<BoundedValue> exit_travel;      // g
  std::optional<Eigen::Vector3d> exit_point;    // on M's boundary, P's frame
  double exit_point_error = 0.0;                // bound on its distance from the exact point

  Certificate certificate;
  // On request, where they touch or overlap.
  std::optional<CommonPoint> common_point;

  // How many signs doubles left open and big numbers settled.
  long exact_signs = 0;

  // SEARCH-FV, SEARCH-VF, SEARCH-EE; kPortal reports only the class of its final face.
  std::array<PhaseReport, 3> phases;
  std::array<PhaseCounts, kPhaseCount> counts;  // by Phase
  std::vector<TraceStep> trace;                 // on request
};

std::string_view ToString(Verdict);
std::string_view ToString(Tier);
std::string_view ToString(Search);
std::string_view ToString(Certainty);
std::string_view ToString(FaceClass);
std::string_view ToString(FeatureKind);
std::string_view ToString(CertificateKind);
std::string_view ToString(Phase);
std::string_view ToString(PhaseClaim);
std::string_view ToString(Termination);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CD_DUAL_RESULT_H_
