// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/common_point.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

namespace touchstone {
namespace {

// Of c and of the three points; they sum to one.
using Weights = std::array<double, 4>;

// Shares of a positive sum; rounding may leave a share of zero a little below.
Weights Normalised(Weights shares) {
  double sum = 0.0;
  for (double& share : shares) {
    share = std::max(share, 0.0);
    sum += share;
  }
  for (double& share : shares) share /= sum;
  return shares;
}

Weights InDoubles(const MinkowskiDifference& m, const std::array<VertexPair, 3>& triangle,
                  bool touch) {
  const Eigen::Vector3d x = m.Point(triangle[0]), y = m.Point(triangle[1]),
                        z = m.Point(triangle[2]);
  const Eigen::Vector3d yz = y.cross(z);
  return Normalised(
      {touch ? 0.0 : x.dot(yz), -m.c().dot(yz), -m.c().dot(z.cross(x)), -m.c().dot(x.cross(y))});
}

Weights InBigNumbers(Signs* signs, const std::array<VertexPair, 3>& triangle, bool touch) {
  const ExactDifference& big = signs->exact();
  const DyadicVector x = big.Point(triangle[0]), y = big.Point(triangle[1]),
                     z = big.Point(triangle[2]), c = big.Point(kInteriorDifference);
  const Dyadic zero(0);
  const std::array<Dyadic, 4> shares = {touch ? zero : Determinant(x, y, z),
                                        zero - Determinant(y, z, c), zero - Determinant(z, x, c),
                                        zero - Determinant(x, y, c)};
  const Dyadic sum = shares[0] + shares[1] + shares[2] + shares[3];
  Weights weights;
  for (int i = 0; i < 4; ++i) weights[i] = RatioToDouble(shares[i], sum);
  return Normalised(weights);
}

// The two sides of the identity, rounded; where they meet is as good as their distance.
CommonPoint Combine(const MinkowskiDifference& m, const std::array<VertexPair, 3>& triangle,
                    const Weights& weights) {
  Eigen::Vector3d in_p = weights[0] * m.PointOfP(kInteriorPoint);
  Eigen::Vector3d in_q = weights[0] * m.PointOfQ(kInteriorPoint);
  for (int i = 0; i < 3; ++i) {
    in_p += weights[i + 1] * m.PointOfP(triangle[i].p);
    in_q += weights[i + 1] * m.PointOfQ(triangle[i].q);
  }
  const Eigen::Vector3d other = m.pose().rotation() * in_q + m.pose().translation();
  // Weights sum to one within 8 u, each sum of four products rounds five times: 16 u of the size on
  // either side, which four coordinate errors (5.1 u of the size, and the pose's own) exceed; in
  // three coordinates.
  const double rounding = 4.0 * 1.8 * m.coordinate_error() / m.scale();
  return {0.5 * in_p + 0.5 * other, 0.51 * (in_p - other).norm() + rounding};
}

}  // namespace

std::optional<CommonPoint> FindCommonPoint(Signs* signs, const Certificate& certificate) {
  const MinkowskiDifference& m = signs->difference();
  switch (certificate.kind) {
    case CertificateKind::kCoincidentInterior:
      return CommonPoint{m.PointOfP(kInteriorPoint), m.coordinate_error() / m.scale() * 1.8};
    case CertificateKind::kEnclosingTetrahedron:
    case CertificateKind::kTouchingFacet: {
      const bool touch = certificate.kind == CertificateKind::kTouchingFacet;
      const CommonPoint rounded =
          Combine(m, certificate.points, InDoubles(m, certificate.points, touch));
      const double good = 64.0 * m.coordinate_error() / m.scale();
      if (rounded.error <= good) return rounded;  // false for NaN
      return Combine(m, certificate.points, InBigNumbers(signs, certificate.points, touch));
    }
    default:
      return std::nullopt;
  }
}

}  // namespace touchstone
