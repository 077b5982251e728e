// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/link.h"

#include <algorithm>
#include <cassert>
#include <climits>
#include <cmath>

namespace touchstone {
namespace {

using Direction = LinkDirection;

// Coordinates of at most 1, each off by 2^-53: a determinant of three passes five roundings on six
// terms, 6 * 5.01 * 2^-52, and 18 data errors of 2^-53 times products of two.
constexpr double kDeterminantError = 64 * 0x1p-52;

// The side of the plane through z and a that b lies on: 1 when z, a, b turn counterclockwise seen
// from outside the sphere.
int Turn(const Direction& z, const Direction& a, const Direction& b) {
  const Eigen::Vector3d &x = z.rounded, &y = a.rounded, &w = b.rounded;
  const double value = x[0] * (y[1] * w[2] - y[2] * w[1]) + x[1] * (y[2] * w[0] - y[0] * w[2]) +
                       x[2] * (y[0] * w[1] - y[1] * w[0]);
  if (value > kDeterminantError) return 1;
  if (value < -kDeterminantError) return -1;
  return Determinant(z.exact, a.exact, b.exact).sign();
}

bool IsZero(const DyadicVector& v) {
  return v[0].sign() == 0 && v[1].sign() == 0 && v[2].sign() == 0;
}

bool IsParallel(const Direction& a, const Direction& b) {
  // A coordinate of the cross product is off by less than 8 units.
  const Eigen::Vector3d &x = a.rounded, &y = b.rounded;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if (std::abs(x[i] * y[j] - x[j] * y[i]) > 8 * 0x1p-52) return false;
  }
  return IsZero(Cross(a.exact, b.exact));
}

// For parallel directions: 1 equal, -1 opposite.
int Sense(const Direction& a, const Direction& b) { return Dot(a.exact, b.exact).sign(); }

bool IsSame(const Direction& a, const Direction& b) { return IsParallel(a, b) && Sense(a, b) > 0; }
bool IsOpposite(const Direction& a, const Direction& b) {
  return IsParallel(a, b) && Sense(a, b) < 0;
}

// The sign of the angle's cosine at z between the sides to a and to b.
int CosineSign(const Direction& z, const Direction& a, const Direction& b) {
  return Dot(Cross(z.exact, a.exact), Cross(z.exact, b.exact)).sign();
}

// Whether z lies strictly within the side from p to q.
bool IsWithin(const Direction& z, const Direction& p, const Direction& q) {
  if (Turn(z, p, q) != 0) return false;
  const DyadicVector normal = Cross(p.exact, q.exact);
  return Dot(Cross(p.exact, z.exact), normal).sign() > 0 &&
         Dot(Cross(z.exact, q.exact), normal).sign() > 0;
}

// Whether the sides p1 p2 and q1 q2 cross, each strictly within the other, by the turns of three of
// their ends each. The third condition tells a crossing from one with the antipodes of the other.
bool CrossBySigns(int p1_p2_q1, int p1_p2_q2, int q1_q2_p1, int q1_q2_p2) {
  return p1_p2_q1 * p1_p2_q2 < 0 && q1_q2_p1 * q1_q2_p2 < 0 && p1_p2_q1 * q1_q2_p1 < 0;
}

// An open sector at a point: counterclockwise from one side to the other.
struct Sector {
  const Direction *begin, *end;
};

// How far the side to d lies from the side to s, turning counterclockwise at z: 0 not at all, 1
// less than half a turn, 2 half a turn, 3 more.
int HalfTurns(const Direction& z, const Direction& s, const Direction& d) {
  const int turn = Turn(z, s, d);
  if (turn > 0) return 1;
  if (turn < 0) return 3;
  return CosineSign(z, s, d) > 0 ? 0 : 2;
}

// Whether turning counterclockwise from the sector's begin one meets the side to d at once or
// before its end.
bool IsInHalfOpen(const Direction& z, const Sector& sector, const Direction& d) {
  const int at = HalfTurns(z, *sector.begin, d), end = HalfTurns(z, *sector.begin, *sector.end);
  if (at == 0) return true;
  if (at != end) return at < end;
  return at != 2 && Turn(z, d, *sector.end) > 0;
}

bool SectorsOverlap(const Direction& z, const Sector& s, const Sector& t) {
  return IsInHalfOpen(z, s, *t.begin) || IsInHalfOpen(z, t, *s.begin);
}

const Direction& At(const Link& link, std::size_t i) { return link[i % link.size()]; }

Sector CornerSector(const Link& link, std::size_t i) {
  return {&At(link, i + 1), &At(link, i + link.size() - 1)};
}
// On the left of side i.
Sector SideSector(const Link& link, std::size_t i) { return {&At(link, i + 1), &At(link, i)}; }

enum class Meeting { kNone, kTouch, kOverlap };

// Looks at corners of p that lie on q: in corners of q too if `with_corners`.
Meeting CornersOn(const Link& p, const Link& q, bool with_corners) {
  Meeting meeting = Meeting::kNone;
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = 0; j < q.size(); ++j) {
      Sector sector;
      if (with_corners && IsSame(p[i], q[j])) {
        sector = CornerSector(q, j);
      } else if (IsWithin(p[i], q[j], At(q, j + 1))) {
        sector = SideSector(q, j);
      } else {
        continue;
      }
      if (SectorsOverlap(p[i], CornerSector(p, i), sector)) return Meeting::kOverlap;
      meeting = Meeting::kTouch;
    }
  }
  return meeting;
}

bool SidesCross(const Link& p, const Link& q) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Direction &p1 = p[i], &p2 = At(p, i + 1);
    for (std::size_t j = 0; j < q.size(); ++j) {
      const Direction &q1 = q[j], &q2 = At(q, j + 1);
      const int a = Turn(p1, p2, q1), b = Turn(p1, p2, q2);
      if (a * b >= 0) continue;
      if (CrossBySigns(a, b, Turn(q1, q2, p1), Turn(q1, q2, p2))) return true;
    }
  }
  return false;
}

}  // namespace

LinkDirection MakeLinkDirection(const DyadicVector& exact) {
  LinkDirection direction{exact, Eigen::Vector3d::Zero()};
  int exponents[3], greatest = INT_MIN;
  for (int i = 0; i < 3; ++i) {
    direction.rounded[i] = exact[i].ToScaledDouble(&exponents[i]);
    if (direction.rounded[i] != 0.0) greatest = std::max(greatest, exponents[i]);
  }
  for (int i = 0; i < 3; ++i) {
    if (direction.rounded[i] == 0.0) continue;
    direction.rounded[i] =
        std::ldexp(direction.rounded[i], std::max(-1100, exponents[i] - greatest));
  }
  return direction;
}

// Walks from z to a point m of one of its sides,
// chosen so that no corner is on the way, and counts the sides crossed.
bool LinkHolds(const Link& q, const LinkDirection& z) {
  const std::size_t n = q.size();
  for (std::size_t j = 0; j < n; ++j) {
    const int arrival = Turn(q[j], At(q, j + 1), z);
    if (arrival == 0) continue;
    // Each corner is in the way for one m at most, so one of n + 1 does.
    for (std::size_t k = 1; k <= n + 1; ++k) {
      const Dyadic weight(static_cast<int>(k));
      DyadicVector sum;
      for (int i = 0; i < 3; ++i) sum[i] = q[j].exact[i] + weight * At(q, j + 1).exact[i];
      const Direction m = MakeLinkDirection(sum);
      bool is_clear = true, inside = arrival > 0;
      for (std::size_t i = 0; i < n && is_clear; ++i) {
        if (i == j) continue;
        const Direction &r = q[i], &s = At(q, i + 1);
        const int a = Turn(z, m, r), b = Turn(z, m, s);
        // The antipode of z is on every great circle through z, but on no walk.
        is_clear = (a != 0 || IsOpposite(z, r)) && (b != 0 || IsOpposite(z, s));
        if (a * b < 0 && CrossBySigns(a, b, Turn(r, s, z), Turn(r, s, m))) inside = !inside;
      }
      if (is_clear) return inside;
    }
  }
  assert(false);  // not all sides lie on great circles through z
  return false;
}

bool LinksOverlap(const Link& p, const Link& q) {
  if (SidesCross(p, q)) return true;
  const Meeting corners_of_p = CornersOn(p, q, true);
  if (corners_of_p == Meeting::kOverlap) return true;
  const Meeting corners_of_q = CornersOn(q, p, false);
  if (corners_of_q == Meeting::kOverlap) return true;
  if (corners_of_p != Meeting::kNone || corners_of_q != Meeting::kNone) return false;
  return LinkHolds(q, p[0]) || LinkHolds(p, q[0]);
}

// The half-edges come counterclockwise seen from outside the solid, with the solid on the right.
Link VertexLink(const TriangleMesh& mesh, int v) {
  Link link;
  for (const int h : mesh.vertex_half_edges(v)) {
    link.push_back(
        MakeLinkDirection(ToDyadic(mesh.vertex(mesh.head(h))) - ToDyadic(mesh.vertex(v))));
  }
  std::reverse(link.begin(), link.end());
  return link;
}

}  // namespace touchstone
