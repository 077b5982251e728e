// SPDX-License-Identifier: MIT
//
//   here        meaning
//   s           the direction of travel; the line {t s} runs through o
//   shadow      the projection along s to a plane across it; the line's is the point o
//   M           {a - b}; P and Q + t s meet iff t s is in M
#ifndef TOUCHSTONE_CORE_PROXIMITY_LINE_H_
#define TOUCHSTONE_CORE_PROXIMITY_LINE_H_

#include <Eigen/Core>
#include <array>
#include <optional>

#include "touchstone/core/cd_dual/signs.h"

namespace touchstone {

// A vertex of M, or c, seen along the line: scaled, its shadow (x, y) and its height z, o at zero.
struct LinePoint {
  VertexPair pair;
  double x = 0.0, y = 0.0, z = 0.0;
};

// M seen along the line: s is the upward z axis, o at height 0. Rounded: a proposal.
class LineFrame {
 public:
  LineFrame(const MinkowskiDifference& m, const Eigen::Vector3d& s);

  // The vertex of M that is extreme along (nx, ny, nz); a point of M.
  LinePoint Support(double nx, double ny, double nz, PhaseCounts* counts) const;
  LinePoint Point(VertexPair pair) const;
  // A vector of P's frame in this one.
  Eigen::Vector3d Along(const Eigen::Vector3d& in_p) const { return axes_.transpose() * in_p; }

 private:
  const MinkowskiDifference& m_;
  Eigen::Matrix3d axes_;  // columns: the frame's axes in P
};

// What the search in doubles proposes.
struct LineProposal {
  enum class Kind {
    kCrossed,  // the line goes in through `lower` and out through `upper`
    kMissed,   // M's shadow is beyond that of the segment `edge`, seen from o
    kStuck,
  };
  Kind kind = Kind::kStuck;
  // Triangles of M's vertices that the line crosses, counterclockwise from outside; nothing of M
  // lies beyond them.
  std::array<VertexPair, 3> upper, lower;
  std::array<VertexPair, 2> edge;
};

// Stops after a fixed number of rounds at the latest.
LineProposal SearchLine(const MinkowskiDifference& m, const Eigen::Vector3d& s,
                        PhaseCounts* counts);

// s as signs need it: over the power of two that brings its largest entry into [1/2, 1), which no
// sign notices; small entries may round to zero in `scaled`, not in `exact`.
struct LineDirection {
  explicit LineDirection(const Eigen::Vector3d& s);
  Eigen::Vector3d scaled;
  int exponent = 0;  // s = scaled 2^exponent
  DyadicVector exact;
};

// s.(a x b): positive when the line lies to the left of a -> b, seen against s.
std::optional<int> LineSide(Signs* signs, const LineDirection& s, VertexPair a, VertexPair b);

// The exact answer for LineProposal: the line is moved off every vertex and edge by a symbolic step
// towards c and along the axes, e c + e^2 x + e^3 y + e^4 z, e smaller than any number in sight. A
// line that meets M is moved into its inside by that, and one that misses it still does; and the
// facets found hold for the line itself, for the triangles are closed. With `outward`, the line is
// moved away from c instead: it then meets M only if the line itself meets M's inside.
//
// Terminates: among the shadow's edges the crossing with the ray from c moves strictly outward, and
// along the line that with the triangle does.
LineProposal FindExactLine(Signs* signs, const LineDirection& s, bool outward, PhaseCounts* counts);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_PROXIMITY_LINE_H_
