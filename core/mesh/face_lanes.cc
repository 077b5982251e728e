// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/face_lanes.h"

#include <algorithm>
#include <cmath>

#include "touchstone/core/mesh/lanes_internal.h"

namespace touchstone {

using Eigen::Vector3d;

TOUCHSTONE_VECTOR_CLONES
void FindSlabs(std::span<const Vector3d> directions, std::span<FaceLanes> lanes) {
  for (std::size_t l = 0; l < lanes.size(); ++l) {
    FaceLanes& leaf = lanes[l];
    const double n[] = {directions[l][0], directions[l][1], directions[l][2]};
    double low[kTreeWidth], high[kTreeWidth];
    for (int i = 0; i < kTreeWidth; ++i) {
      const double a = n[0] * leaf.corners[0][0][i] + n[1] * leaf.corners[0][1][i] +
                       n[2] * leaf.corners[0][2][i],
                   b = n[0] * leaf.corners[1][0][i] + n[1] * leaf.corners[1][1][i] +
                       n[2] * leaf.corners[1][2][i],
                   c = n[0] * leaf.corners[2][0][i] + n[1] * leaf.corners[2][1][i] +
                       n[2] * leaf.corners[2][2][i];
      const double least = a < b ? a : b, most = a < b ? b : a;
      low[i] = least < c ? least : c;
      high[i] = most < c ? c : most;
    }
    double lowest, highest;
    internal::FindExtent(low, high, &lowest, &highest);
    leaf.direction = directions[l];
    leaf.length = std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]);
    leaf.low = lowest;
    leaf.high = highest;
  }
}

}  // namespace touchstone
