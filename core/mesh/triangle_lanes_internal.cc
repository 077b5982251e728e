// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/triangle_lanes_internal.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "touchstone/core/base/vector_clones.h"

namespace touchstone::internal {
namespace {

constexpr double kUnderflow = 0x1p-1000;
constexpr int kManyForSides = 3;  // lanes in doubt from which on it pays to look at all at once

}  // namespace

using Eigen::Vector3d;

void TriangleLanes::Gather(const PlacedMesh& body, const BoxNode& node, const Offset& offset) {
  faces = 0;
  for (int lane = 0; lane < kTreeWidth; ++lane) {
    const bool is_face = node.children[lane] < 0;
    const int face = is_face ? ~node.children[lane] : 0;
    faces |= is_face ? 1u << lane : 0;
    const Triangle& vertices = body.mesh.face(face);
    const FacePlane& plane = body.planes[face];
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) corners[k][i][lane] = body.points[vertices[k]][i];
      normal[i][lane] = plane.normal[i];
    }
    height[lane] = plane.height;
    least[lane] = LeastHeight(plane, offset);
  }
}

// Lanes that the planes do not part, as Triager::PlaneOfA and PlaneOfB.
TOUCHSTONE_INLINE std::uint64_t NotPartedByPlanes(const FacePlane& plane,
                                                  const Vector3d* const own[3],
                                                  const TriangleLanes& lanes, const double move[3],
                                                  double least) {
  const double n[] = {plane.normal[0], plane.normal[1], plane.normal[2]};
  const double height = plane.height - (n[0] * move[0] + n[1] * move[1] + n[2] * move[2]);
  double low[kTreeWidth], high[kTreeWidth], low_own[kTreeWidth], high_own[kTreeWidth];
  for (int i = 0; i < kTreeWidth; ++i) low[i] = low_own[i] = 1e300, high[i] = high_own[i] = -1e300;
  for (int k = 0; k < 3; ++k) {
    const auto& corner = lanes.corners[k];
    const double x = (*own[k])[0], y = (*own[k])[1], z = (*own[k])[2];
    for (int i = 0; i < kTreeWidth; ++i) {
      const double above = n[0] * corner[0][i] + n[1] * corner[1][i] + n[2] * corner[2][i] - height;
      low[i] = above < low[i] ? above : low[i];
      high[i] = above > high[i] ? above : high[i];
      const double nx = lanes.normal[0][i], ny = lanes.normal[1][i], nz = lanes.normal[2][i];
      const double own_above = nx * x + ny * y + nz * z -
                               (lanes.height[i] + (nx * move[0] + ny * move[1] + nz * move[2]));
      low_own[i] = own_above < low_own[i] ? own_above : low_own[i];
      high_own[i] = own_above > high_own[i] ? own_above : high_own[i];
    }
  }
  std::int64_t doubtful[kTreeWidth], mask = 0;
  for (int i = 0; i < kTreeWidth; ++i) doubtful[i] = std::int64_t{1} << i;
  for (int i = 0; i < kTreeWidth; ++i) {
    const bool is_parted = (low[i] > least) | (high[i] < -least) | (low_own[i] > lanes.least[i]) |
                           (high_own[i] < -lanes.least[i]);
    doubtful[i] = is_parted ? 0 : doubtful[i];
  }
  for (int i = 0; i < kTreeWidth; ++i) mask |= doubtful[i];
  return static_cast<std::uint64_t>(mask);
}

// Lanes that no plane along a side of either parts: a side u of one and v of the other have the
// normal u x v, off by two roundings on each of two paths and what the sides are off by, at most e;
// heights over it are off as over a face's plane. Both ends of a side are as high, exactly.
TOUCHSTONE_INLINE std::uint64_t NotPartedBySides(const double own[3][3], const TriangleLanes& lanes,
                                                 const Offset& offset) {
  const double e = 2.0 * offset.error;
  std::int64_t doubtful[kTreeWidth], mask = 0;
  for (int i = 0; i < kTreeWidth; ++i) doubtful[i] = std::int64_t{1} << i;
  for (int k = 0; k < 3; ++k) {
    const double* const p = own[k];
    const double* const q = own[(k + 2) % 3];  // off the side
    const double* const next = own[(k + 1) % 3];
    const double ux = next[0] - p[0], uy = next[1] - p[1], uz = next[2] - p[2];
    const double lu = std::max(std::max(std::abs(ux), std::abs(uy)), std::abs(uz));
    for (int m = 0; m < 3; ++m) {
      const auto &from = lanes.corners[m], &to = lanes.corners[(m + 1) % 3],
                 &off = lanes.corners[(m + 2) % 3];
      for (int i = 0; i < kTreeWidth; ++i) {
        const double vx = to[0][i] - from[0][i], vy = to[1][i] - from[1][i],
                     vz = to[2][i] - from[2][i];
        const double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
        const double lv = std::abs(vx) + std::abs(vy) + std::abs(vz);
        const double error = 1.01 * (2.0 * e * (lu + lv + e) + 6.2 * kUnit * lu * lv) + kUnderflow;
        const double least = offset.for_length * (std::abs(nx) + std::abs(ny) + std::abs(nz)) +
                             offset.for_error * error + kUnderflow;
        const double a = nx * p[0] + ny * p[1] + nz * p[2], b = nx * q[0] + ny * q[1] + nz * q[2];
        const double c = nx * from[0][i] + ny * from[1][i] + nz * from[2][i],
                     d = nx * off[0][i] + ny * off[1][i] + nz * off[2][i];
        const double low = a < b ? a : b, high = a < b ? b : a;
        const double low_lane = c < d ? c : d, high_lane = c < d ? d : c;
        const bool is_parted = (low_lane - high > least) | (low - high_lane > least);
        doubtful[i] = is_parted ? 0 : doubtful[i];
      }
    }
  }
  for (int i = 0; i < kTreeWidth; ++i) mask |= doubtful[i];
  return static_cast<std::uint64_t>(mask);
}

TOUCHSTONE_VECTOR_CLONES
std::uint8_t LanesNotParted(const PlacedMesh& body, int face, const TriangleLanes& lanes,
                            const Vector3d& move, const Offset& offset) {
  const FacePlane& plane = body.planes[face];
  const Triangle& vertices = body.mesh.face(face);
  const Vector3d* const own[] = {&body.points[vertices[0]], &body.points[vertices[1]],
                                 &body.points[vertices[2]]};
  const double by[] = {move[0], move[1], move[2]};
  std::uint64_t mask =
      lanes.faces & NotPartedByPlanes(plane, own, lanes, by, LeastHeight(plane, offset));
  if (std::popcount(mask) >= kManyForSides) {
    double moved[3][3];
    for (int k = 0; k < 3; ++k) {
      for (int axis = 0; axis < 3; ++axis) moved[k][axis] = (*own[k])[axis] - by[axis];
    }
    mask &= NotPartedBySides(moved, lanes, offset);
  }
  return static_cast<std::uint8_t>(mask | ~lanes.faces);
}

}  // namespace touchstone::internal
