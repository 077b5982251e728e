// SPDX-License-Identifier: GPL-3.0-or-later
//
// The common point, where a result names one: due to touch and overlap only, and beyond no face of
// either body by more than its error.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "touchstone/exact/faces.h"
#include "touchstone/exact/judge/checks.h"
#include "touchstone/exact/judge/values.h"

namespace touchstone::exact {
namespace {

Real Along(const IntegerVector& n, const std::array<Real, 3>& x) {
  return Real(n[0]) * x[0] + Real(n[1]) * x[1] + Real(n[2]) * x[2];
}

// How far x lies beyond the plane, in true lengths.
Real Beyond(const PlacedPair& pair, const IntegerVector& n, const Integer& value,
            const std::array<Real, 3>& x) {
  const Real length =
      Sqrt(Real(n[0]) * Real(n[0]) + Real(n[1]) * Real(n[1]) + Real(n[2]) * Real(n[2]));
  return pair.ToLength((Along(n, x) - Real(value)) / length);
}

// Whether doubles prove that x, in the body's own frame and off by at most `off` a coordinate, is
// strictly behind face f: the determinant of three differences, scaled to at most 2 by a power of
// two, has six products below 8 with at most 8 roundings each, 384u < 2^-44; moving x by `off`
// moves it by three components of the normal, each at most 8.
bool IsBehind(const ExactBodyData& body, int f, const Eigen::Vector3d& x, double off) {
  const double reach = std::max(body.max_coordinate, x.cwiseAbs().maxCoeff());
  if (!(reach > 1e-250 && reach < 1e250)) return false;
  const double scale = std::ldexp(1.0, -std::ilogb(reach) - 1);
  const std::span<const int> loop = body.face(f);
  const Eigen::Vector3d first = Vertex(body, loop[0]);
  const Eigen::Vector3d ab = scale * (Vertex(body, loop[1]) - first);
  const Eigen::Vector3d ac = scale * (Vertex(body, loop[2]) - first);
  return ab.cross(ac).dot(scale * (x - first)) < -0x1p-43 - 25.0 * (scale * off);
}

// A point in Q's frame, and how far each coordinate may be off.
struct PointInQ {
  Eigen::Vector3d x;
  double off;
};

// Solves R x_q + t = x. How far the solution is off follows from what is left over: with u = 2^-53,
// rotation and translation off by 4u of themselves and the sum rounded, that is known to 16u of the
// terms' sizes, and R is near enough to a rotation that no row of its inverse sums to more than 2.
std::optional<PointInQ> InFrameOfQ(const PlacedPair& pair, const Eigen::Vector3d& x) {
  const Eigen::Matrix3d& r = pair.rotation();
  if (!((r.transpose() * r - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 0x1p-10))
    return std::nullopt;
  PointInQ point;
  point.x = r.transpose() * (x - pair.translation());
  point.x += r.transpose() * (x - pair.translation() - r * point.x);
  const Eigen::Vector3d rest = x - pair.translation() - r * point.x;
  const double terms = x.cwiseAbs().maxCoeff() + pair.translation().cwiseAbs().maxCoeff() +
                       3.0 * point.x.cwiseAbs().maxCoeff();
  point.off = 2.0 * (rest.cwiseAbs().maxCoeff() + 0x1p-48 * terms);
  return point;
}

}  // namespace

void CheckCommonPoint(const JudgeContext& context) {
  const CollideResult& result = context.result;
  if (!result.common_point.has_value()) return;
  if (result.verdict != Verdict::kTouch && result.verdict != Verdict::kOverlap) {
    return context.Add(FindingKind::kValueOutOfBounds, "a common point of bodies apart");
  }
  const auto& [point, error] = *result.common_point;
  if (!point.allFinite() || !std::isfinite(error) || error < 0) {
    return context.Add(FindingKind::kValueOutOfBounds, "the common point is none");
  }
  // As good as coordinates are: values.h.
  if (error > kErrorFactor * kConditionFactor * context.pair.size()) {
    context.Add(FindingKind::kLooseBound, "the common point's error is larger than it may be");
  }
  const PlacedPair& pair = context.pair;
  const std::array<Real, 3> x = {pair.FromLength(Real(point[0])), pair.FromLength(Real(point[1])),
                                 pair.FromLength(Real(point[2]))};
  const Real allowed = Real(error) + Scale(Real(pair.size()), -200);
  const auto check = [&](const IntegerVector& n, const Integer& value, const char* body, int f) {
    if (Beyond(pair, n, value, x) > allowed) {
      context.Add(FindingKind::kValueOutOfBounds,
                  "the common point lies beyond face " + std::to_string(f) + " of " + body);
    }
  };
  for (int f = 0; f < pair.p().face_count; ++f) {
    if (IsBehind(pair.p(), f, point, 0.0)) continue;
    const IntegerVector n = pair.p().Normal(f);
    check(n, pair.ValueP(n, pair.p().face(f)[0]), "P", f);
  }
  const std::optional<PointInQ> in_q = InFrameOfQ(pair, point);
  for (int f = 0; f < pair.q().face_count; ++f) {
    if (in_q.has_value() && IsBehind(pair.q(), f, in_q->x, in_q->off)) continue;
    const IntegerVector n = pair.NormalFromQ(pair.q().Normal(f));
    check(n, pair.ValueQ(pair.ToQ(n), n, pair.q().face(f)[0]), "Q", f);
  }
}

}  // namespace touchstone::exact
