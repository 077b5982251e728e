// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/nearest_points.h"

#include <algorithm>

namespace touchstone {

using Eigen::Vector3d;

namespace {

using Corners = std::array<Vector3d, 3>;

double Part(double value, double whole) {
  return whole > 0.0 ? std::clamp(value / whole, 0.0, 1.0) : 0.0;
}

void OfferSegments(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d,
                   NearestPoints* best) {
  const Vector3d u = b - a, v = d - c, w = c - a;
  const double uu = u.dot(u), vv = v.dot(v), uv = u.dot(v), uw = u.dot(w), vw = v.dot(w);
  double s = Part(uw * vv - vw * uv, uu * vv - uv * uv);
  const double t = Part(s * uv - vw, vv);
  s = Part(t * uv + uw, uu);
  best->Offer(a + s * u, c + t * v);
}

// The point of the triangle under p, where p lies over its inside; the sides are the segments'.
bool FootOf(const Vector3d& p, const Corners& t, Vector3d* foot) {
  const Vector3d u = t[1] - t[0], v = t[2] - t[0], w = p - t[0];
  const double uu = u.dot(u), vv = v.dot(v), uv = u.dot(v), uw = u.dot(w), vw = v.dot(w);
  const double det = uu * vv - uv * uv;
  if (!(det > 0.0)) return false;
  const double along_u = (vv * uw - uv * vw) / det, along_v = (uu * vw - uv * uw) / det;
  if (!(along_u >= 0.0 && along_v >= 0.0 && along_u + along_v <= 1.0)) return false;
  *foot = t[0] + along_u * u + along_v * v;
  return true;
}

}  // namespace

void NearestPoints::Offer(const Vector3d& on_a, const Vector3d& on_b) {
  const double candidate = (on_b - on_a).squaredNorm();
  if (!(candidate < squared)) return;
  x = on_a;
  y = on_b;
  squared = candidate;
}

NearestPoints NearestPointsOf(const std::array<Vector3d, 3>& a, const std::array<Vector3d, 3>& b) {
  NearestPoints best;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      OfferSegments(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3], &best);
    }
  }
  Vector3d foot;
  for (int k = 0; k < 3; ++k) {
    if (FootOf(b[k], a, &foot)) best.Offer(foot, b[k]);
    if (FootOf(a[k], b, &foot)) best.Offer(a[k], foot);
  }
  return best;
}

}  // namespace touchstone
