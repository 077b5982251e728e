// SPDX-License-Identifier: MIT
//
// A plane is n . y = c for any n in doubles, so it knows no error of its own; what is bounded are
// heights along it. With L the sum of |n_i|, coordinates of points at most 1 and reach = 2 + |x|:
// n . a, n . b and n . x are off by three products and two sums, 3.01 units of L reach together;
// n . a - n . x and the least height on top by two roundings, 2.02 units of L reach and one of that
// height. Whether the result is above n . b is told exactly. The offset's error is 2.02 units of
// reach at least, so that is below 2.6 L error; points and offset add L error. Below 3.7 in all,
// where the least height has 4.04 (MakeOffset).
#include "touchstone/core/mesh/triangle_lanes_internal.h"

#include <bit>
#include <cmath>
#include <cstring>

#include "touchstone/core/base/vector_clones.h"
#include "touchstone/core/mesh/lanes_internal.h"

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

// Lanes some corner of which is below n . y = high, and some above n . y = low: clear bits 63.
template <class Vector, class Bits>
TOUCHSTONE_INLINE void FindBeyond(const double n[3], double low, double high, const Vector* x,
                                  int step, Bits* beyond) {
  const Vector a = n[0] * x[0] + n[1] * x[step] + n[2] * x[2 * step],
               b = n[0] * x[3 * step] + n[1] * x[4 * step] + n[2] * x[5 * step],
               c = n[0] * x[6 * step] + n[1] * x[7 * step] + n[2] * x[8 * step];
  const Bits below = (Bits)(a - high) | (Bits)(b - high) | (Bits)(c - high),
             above = (Bits)(low - a) | (Bits)(low - b) | (Bits)(low - c);
  *beyond = ~(below & above);
}

template <bool kInEights>
TOUCHSTONE_INLINE std::uint64_t NotBeyond(const double n[3], double low, double high,
                                          const FaceLanes& lanes) {
  if constexpr (kInEights) {
    Flags beyond;
    FindBeyond(n, low, high, reinterpret_cast<const Reals*>(lanes.corners), 1, &beyond);
    return ClearLanes(beyond);
  } else {
    const auto* x = reinterpret_cast<const HalfReals*>(lanes.corners);
    HalfFlags beyond[2];
    FindBeyond(n, low, high, x, 2, &beyond[0]);
    FindBeyond(n, low, high, x + 1, 2, &beyond[1]);
    return ClearLanes(beyond[0], beyond[1]);
  }
}

// Lanes that a slab of the other body does not part from what it holds. `sign` is 1 for lanes of B,
// which the offset moves, and -1 for those of A.
template <bool kInEights>
TOUCHSTONE_INLINE std::uint64_t NotPartedBySlab(const FaceLanes& slab, const FaceLanes& lanes,
                                                double sign, const Offset& offset) {
  const double n[] = {slab.direction[0], slab.direction[1], slab.direction[2]};
  const Vector3d& move = offset.value;
  const double shift = sign * (n[0] * move[0] + n[1] * move[1] + n[2] * move[2]);
  const double least = offset.for_length * slab.length + kUnderflow;
  return NotBeyond<kInEights>(n, slab.low - shift - least, slab.high - shift + least, lanes);
}

// The pairs among lanes `of_a` and `of_b` whose boxes meet.
TOUCHSTONE_INLINE std::uint64_t Meeting(const BoxNode& a, const BoxNode& b, const Offset& offset,
                                        std::uint64_t of_a, std::uint64_t of_b) {
  const auto* lows = reinterpret_cast<const Reals*>(a.low);
  const auto* highs = reinterpret_cast<const Reals*>(a.high);
  const Lanes lanes = {lows[0], lows[1], lows[2], highs[0], highs[1], highs[2]};
  const Vector3d& move = offset.value;
  std::uint64_t pairs = 0;
  for (; of_b != 0; of_b &= of_b - 1) {
    const int j = std::countr_zero(of_b);
    double low[3], high[3];
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = b.low[axis][j] + move[axis] - offset.error;
      high[axis] = b.high[axis][j] + move[axis] + offset.error;
    }
    Flags misses;
    FindMisses(lanes, low, high, &misses);
    pairs |= (ClearLanes(misses) & of_a) << (kTreeWidth * j);
  }
  return pairs;
}

// Directions across two sides u and v, and where they run: of points 0 to 2 of A and 3 to 5 of B.
// In round 0 first those of one face: its normal.
using Indices = std::int64_t __attribute__((vector_size(8 * kTreeWidth)));
struct Sides {
  Indices u_from, u_to, v_from, v_to;
};
constexpr Sides kSides[kPartingRounds] = {{{0, 3, 0, 1, 2, 0, 1, 2},
                                           {1, 4, 1, 2, 0, 1, 2, 0},
                                           {0, 3, 3, 3, 3, 4, 4, 4},
                                           {2, 5, 4, 4, 4, 5, 5, 5}},
                                          {{0, 1, 2, 0, 1, 2, 0, 1},
                                           {1, 2, 0, 1, 2, 0, 1, 2},
                                           {5, 5, 5, 5, 5, 5, 5, 5},
                                           {3, 3, 3, 3, 3, 3, 3, 3}}};

using Points = double[3][kTreeWidth];

// Along each of eight directions the range of the points `first` to first + 2.
TOUCHSTONE_INLINE void FindRanges(const Points& directions, const Points& points, int first,
                                  double low[kTreeWidth], double high[kTreeWidth]) {
  const auto &x = points[0], &y = points[1], &z = points[2];
  for (int i = 0; i < kTreeWidth; ++i) {
    const double nx = directions[0][i], ny = directions[1][i], nz = directions[2][i];
    const double a = nx * x[first] + ny * y[first] + nz * z[first],
                 b = nx * x[first + 1] + ny * y[first + 1] + nz * z[first + 1],
                 c = nx * x[first + 2] + ny * y[first + 2] + nz * z[first + 2];
    const double least = a < b ? a : b, most = a < b ? b : a;
    low[i] = least < c ? least : c;
    high[i] = most < c ? c : most;
  }
}

// How much further coordinates are at some of the points than at others.
TOUCHSTONE_INLINE void FindWays(const Reals& x, const Indices& from, const Indices& to,
                                Reals* ways) {
#ifdef __clang__  // has no shuffle by a variable
  for (int i = 0; i < kTreeWidth; ++i) (*ways)[i] = x[to[i]] - x[from[i]];
#else
  *ways = __builtin_shuffle(x, to) - __builtin_shuffle(x, from);
#endif
}

// Of the directions the one along which the triangles are farthest apart; nothing depends on it
// being so.
TOUCHSTONE_INLINE void FindDirection(const Points& points, const Sides& sides, double best[3]) {
  Reals x, y, z;
  std::memcpy(&x, points[0], sizeof x);
  std::memcpy(&y, points[1], sizeof y);
  std::memcpy(&z, points[2], sizeof z);
  Reals ux, uy, uz, vx, vy, vz;
  FindWays(x, sides.u_from, sides.u_to, &ux);
  FindWays(y, sides.u_from, sides.u_to, &uy);
  FindWays(z, sides.u_from, sides.u_to, &uz);
  FindWays(x, sides.v_from, sides.v_to, &vx);
  FindWays(y, sides.v_from, sides.v_to, &vy);
  FindWays(z, sides.v_from, sides.v_to, &vz);
  const Reals across[3] = {uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx};
  const Reals squares = across[0] * across[0] + across[1] * across[1] + across[2] * across[2];
  Points directions;
  double squared[kTreeWidth], gaps[kTreeWidth];
  std::memcpy(directions, across, sizeof directions);
  std::memcpy(squared, &squares, sizeof squared);
  double low_a[kTreeWidth], high_a[kTreeWidth], low_b[kTreeWidth], high_b[kTreeWidth];
  FindRanges(directions, points, 0, low_a, high_a);
  FindRanges(directions, points, 3, low_b, high_b);
  for (int i = 0; i < kTreeWidth; ++i) {
    const double one = low_b[i] - high_a[i], other = low_a[i] - high_b[i];
    const double gap = one < other ? other : one;
    gaps[i] = gap * std::abs(gap) / (squared[i] + kUnderflow);
  }
  double least, most;
  FindExtent(gaps, gaps, &least, &most);
  Reals all;
  std::memcpy(&all, gaps, sizeof all);
  const int widest = std::countr_zero(ClearLanes((Flags)(all - most))) % kTreeWidth;
  for (int axis = 0; axis < 3; ++axis) best[axis] = directions[axis][widest];
}

// The least and the greatest height of each lane's corners along n.
TOUCHSTONE_INLINE void FindHeights(const double n[3], const FaceLanes& lanes,
                                   double low[kTreeWidth], double high[kTreeWidth]) {
  const auto &p = lanes.corners[0], &q = lanes.corners[1], &r = lanes.corners[2];
  for (int i = 0; i < kTreeWidth; ++i) {
    const double a = n[0] * p[0][i] + n[1] * p[1][i] + n[2] * p[2][i],
                 b = n[0] * q[0][i] + n[1] * q[1][i] + n[2] * q[2][i],
                 c = n[0] * r[0][i] + n[1] * r[1][i] + n[2] * r[2][i];
    const double least = a < b ? a : b, most = a < b ? b : a;
    low[i] = least < c ? least : c;
    high[i] = most < c ? c : most;
  }
}

// The pairs that no plane across n parts.
TOUCHSTONE_INLINE std::uint64_t NotPartedAcross(const double n[3], const FaceLanes& lanes_a,
                                                const FaceLanes& lanes_b, const Offset& offset,
                                                std::uint64_t pairs) {
  const Vector3d& move = offset.value;
  const double shift = n[0] * move[0] + n[1] * move[1] + n[2] * move[2];
  const double length = std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]);
  const double least = offset.for_length * length + kUnderflow;
  double up[kTreeWidth], down[kTreeWidth], low[kTreeWidth], high[kTreeWidth];
  FindHeights(n, lanes_a, down, up);
  FindHeights(n, lanes_b, low, high);
  for (int i = 0; i < kTreeWidth; ++i) {
    up[i] = up[i] - shift + least;
    down[i] = down[i] - shift - least;
  }
  Reals ups, downs;
  std::memcpy(&ups, up, sizeof ups);
  std::memcpy(&downs, down, sizeof downs);
  for (int j = 0; j < kTreeWidth; ++j) {
    if ((pairs >> (kTreeWidth * j) & 0xff) == 0) continue;
    const Flags doubtful = (Flags)(low[j] - ups) & (Flags)(downs - high[j]);
    pairs &= ~(ClearLanes(doubtful) << (kTreeWidth * j));
  }
  return pairs;
}

template <bool kInEights>
TOUCHSTONE_INLINE std::uint64_t MeetingFacesOf(const PlacedMesh& a, const BoxNode& leaf_a,
                                               const PlacedMesh& b, const BoxNode& leaf_b,
                                               const Offset& offset) {
  const FaceLanes &lanes_a = a.leaves[leaf_a.leaf], &lanes_b = b.leaves[leaf_b.leaf];
  const std::uint64_t of_b =
      ((1u << leaf_b.lane_count) - 1) & NotPartedBySlab<kInEights>(lanes_a, lanes_b, 1.0, offset);
  if (of_b == 0) return 0;
  const std::uint64_t of_a =
      ((1u << leaf_a.lane_count) - 1) & NotPartedBySlab<kInEights>(lanes_b, lanes_a, -1.0, offset);
  if (of_a == 0) return 0;
  return Meeting(leaf_a, leaf_b, offset, of_a, of_b);
}

}  // namespace

bool HasEights() {
#ifdef TOUCHSTONE_HAS_AVX512_CLONES
  return __builtin_cpu_supports("avx512f");
#else
  return false;
#endif
}

TOUCHSTONE_VECTOR_CLONES
std::uint64_t MeetingFacesInEights(const PlacedMesh& a, const BoxNode& leaf_a, const PlacedMesh& b,
                                   const BoxNode& leaf_b, const Offset& offset) {
  return MeetingFacesOf<true>(a, leaf_a, b, leaf_b, offset);
}

TOUCHSTONE_VECTOR_CLONES
std::uint64_t MeetingFacesInFours(const PlacedMesh& a, const BoxNode& leaf_a, const PlacedMesh& b,
                                  const BoxNode& leaf_b, const Offset& offset) {
  return MeetingFacesOf<false>(a, leaf_a, b, leaf_b, offset);
}

// One direction a call: of a loop here GCC 12 takes all loads out, and spills them.
TOUCHSTONE_VECTOR_CLONES
std::uint64_t PartFirst(const FaceLanes& lanes_a, const FaceLanes& lanes_b, const Offset& offset,
                        std::uint64_t pairs, int round) {
  const int first = std::countr_zero(pairs), i = first % kTreeWidth, j = first / kTreeWidth;
  Points points = {};
  for (int axis = 0; axis < 3; ++axis) {
    for (int k = 0; k < 3; ++k) {
      points[axis][k] = lanes_a.corners[k][axis][i] - offset.value[axis];
      points[axis][3 + k] = lanes_b.corners[k][axis][j];
    }
  }
  double direction[3];
  FindDirection(points, kSides[round], direction);
  return NotPartedAcross(direction, lanes_a, lanes_b, offset, pairs);
}

}  // namespace touchstone::internal
