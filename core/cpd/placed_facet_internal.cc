// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/placed_facet_internal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "touchstone/core/cpd/contact_name_internal.h"
#include "touchstone/core/minkowski/convolution.h"

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

bool IsOnSegment(const Vector3d& from, const Vector3d& to, const Vector3d& x) {
  const Vector3d side = to - from;
  const double length = side.norm(), along = side.dot(x - from);
  return along >= -kPatchSlack * length && along <= (length + kPatchSlack) * length &&
         side.cross(x - from).norm() <= kPatchSlack * length;
}

}  // namespace

PlacedFacet PlaceCorners(const MeshPair& pair, const SumFacet& name) {
  PlacedFacet facet;
  const SumCorners corners = CornersOf(pair, name);
  facet.count = corners.count;
  for (int k = 0; k < corners.count; ++k) {
    facet.corners[k] = EstimateVertex(pair, corners.vertices[k]);
    facet.low = k == 0 ? facet.corners[k] : Vector3d(facet.low.cwiseMin(facet.corners[k]));
    facet.high = k == 0 ? facet.corners[k] : Vector3d(facet.high.cwiseMax(facet.corners[k]));
  }
  return facet;
}

void PlacePlane(const MeshPair& pair, const SumFacet& name, PlacedFacet* facet) {
  const PlaneEstimate plane = EstimatePlane(pair, name);
  facet->normal = plane.normal;
  facet->offset = plane.offset;
}

bool HoldsInPlane(const PlacedFacet& facet, const Vector3d& x) {
  for (int k = 0; k < facet.count; ++k) {
    const Vector3d side = facet.corners[k + 1 == facet.count ? 0 : k + 1] - facet.corners[k];
    if (facet.normal.cross(side).dot(x - facet.corners[k]) < -kPatchSlack * side.norm()) {
      return false;
    }
  }
  return true;
}

bool Holds(const PlacedFacet& facet, const Vector3d& x) {
  return std::abs(Height(facet, x)) <= kPatchSlack && HoldsInPlane(facet, x);
}

bool IsOnEdge(const PlacedFacet& facet, const Vector3d& u, const Vector3d& v) {
  for (int k = 0; k < facet.count; ++k) {
    const Vector3d &from = facet.corners[k], &to = facet.corners[(k + 1) % facet.count];
    if (IsOnSegment(from, to, u) && IsOnSegment(from, to, v)) return true;
  }
  return false;
}

bool PassesThrough(const PlacedFacet& facet, const PlacedFacet& own,
                   const std::array<Vector3d, 3>& triangle) {
  const Vector3d* corners[3] = {&triangle[0], &triangle[1], &triangle[2]};
  const auto parts = [](double least, double most) {
    return least >= -kPatchSlack || most <= kPatchSlack;
  };
  if (!Meet(facet, corners[0]->cwiseMin(*corners[1]).cwiseMin(*corners[2]),
            corners[0]->cwiseMax(*corners[1]).cwiseMax(*corners[2]))) {
    return false;
  }
  double least = 1e300, most = -1e300;
  for (const Vector3d* corner : corners) {
    const double height = Height(facet, *corner);
    least = std::min(least, height);
    most = std::max(most, height);
  }
  const bool is_coplanar = least >= -kPatchSlack && most <= kPatchSlack;
  if (!is_coplanar && parts(least, most)) return false;
  double heights[4];
  for (int c = 0; c < facet.count; ++c) heights[c] = Height(own, facet.corners[c]);
  // What the triangle's plane cuts from the facet.
  std::array<Vector3d, 8> cut;
  int count = 0;
  for (int c = 0; c < facet.count; ++c) {
    const int next = c + 1 == facet.count ? 0 : c + 1;
    if (std::abs(heights[c]) <= kPatchSlack) cut[count++] = facet.corners[c];
    if (std::min(heights[c], heights[next]) < -kPatchSlack &&
        std::max(heights[c], heights[next]) > kPatchSlack) {
      cut[count++] = facet.corners[c] + heights[c] / (heights[c] - heights[next]) *
                                            (facet.corners[next] - facet.corners[c]);
    }
  }
  if (count == 0) return false;
  // A line in the plane that parts them: along a side of the triangle, or of what was cut.
  for (int c = 0; c < 3; ++c) {
    const Vector3d &u = *corners[c], &v = *corners[(c + 1) % 3];
    const Vector3d inward = own.normal.cross(v - u);
    const double slack = kPatchSlack * inward.norm();
    bool is_outside = true;
    for (int n = 0; n < count; ++n) is_outside &= inward.dot(cut[n] - u) <= slack;
    if (is_outside) return false;
  }
  for (int n = 0; n < count && count > 1; ++n) {
    const Vector3d across = own.normal.cross(cut[(n + 1) % count] - cut[n]);
    const double slack = kPatchSlack * across.norm();
    double low = 1e300, high = -1e300, own_low = 0.0, own_high = 0.0;
    for (const Vector3d* corner : corners) {
      low = std::min(low, across.dot(*corner - cut[n]));
      high = std::max(high, across.dot(*corner - cut[n]));
    }
    for (int m = 0; m < count; ++m) {
      own_low = std::min(own_low, across.dot(cut[m] - cut[n]));
      own_high = std::max(own_high, across.dot(cut[m] - cut[n]));
    }
    if (low >= own_high - slack || high <= own_low + slack) return false;
  }
  return true;
}

}  // namespace touchstone::internal
