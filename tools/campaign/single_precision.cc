// SPDX-License-Identifier: MIT
#include "touchstone/tools/campaign/single_precision.h"

#include <cmath>
#include <limits>

#include "touchstone/tools/suites/shapes.h"

namespace touchstone {
namespace {

// Coordinates whose products of three neither overflow nor vanish in floats; what lies outside is
// no question for single precision.
constexpr double kLeast = 1e-9, kMost = 1e9;

bool InRange(double x) {
  return x == 0.0 || (std::fabs(x) >= kLeast * 1e-9 && std::fabs(x) <= kMost);
}

double ToFloat(double x) { return static_cast<double>(static_cast<float>(x)); }

std::optional<ConvexPolyhedron> RoundBody(const ConvexPolyhedron& body) {
  if (body.max_coordinate() < kLeast || body.max_coordinate() > kMost) return std::nullopt;
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& v : body.vertices())
    points.emplace_back(ToFloat(v[0]), ToFloat(v[1]), ToFloat(v[2]));
  const StatusOr<ConvexPolyhedron> hull = HullBody(points, FacetStyle::kMerged);
  if (!hull.ok()) return std::nullopt;
  return *hull;
}

}  // namespace

std::optional<PlacedPair> RoundedPairs::Round(const PlacedPair& pair) {
  const std::optional<ConvexPolyhedron> p = rounded_.Get(pair.p, RoundBody);
  const std::optional<ConvexPolyhedron> q = rounded_.Get(pair.q, RoundBody);
  if (!p || !q) return std::nullopt;
  Eigen::Matrix3d rotation;
  Eigen::Vector3d translation;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) rotation(i, j) = ToFloat(pair.pose.rotation()(i, j));
    if (!InRange(pair.pose.translation()[i])) return std::nullopt;
    translation[i] = ToFloat(pair.pose.translation()[i]);
  }
  const StatusOr<RelativePose> pose = RelativePose::Make(rotation, translation);
  if (!pose.ok()) return std::nullopt;
  return PlacedPair{*p, *q, *pose};
}

}  // namespace touchstone
