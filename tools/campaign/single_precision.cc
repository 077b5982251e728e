// SPDX-License-Identifier: MIT
#include "touchstone/tools/campaign/single_precision.h"

#include <cmath>
#include <limits>

#include "touchstone/tools/suites/shapes.h"

namespace touchstone {
namespace {

constexpr double kLeast = 1e-9, kMost = 1e9;

double ToFloat(double x) { return static_cast<double>(static_cast<float>(x)); }

std::optional<ConvexPolyhedron> RoundBody(const ConvexPolyhedron& body) {
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& v : body.vertices())
    points.emplace_back(ToFloat(v[0]), ToFloat(v[1]), ToFloat(v[2]));
  const StatusOr<ConvexPolyhedron> hull = HullBody(points, FacetStyle::kMerged);
  if (!hull.ok()) return std::nullopt;
  return *hull;
}

}  // namespace

bool IsInReachOfFloats(const PlacedPair& pair) {
  const auto is_within = [](double size) { return size >= kLeast && size <= kMost; };
  return is_within(pair.p.max_coordinate()) && is_within(pair.q.max_coordinate()) &&
         pair.pose.translation().cwiseAbs().maxCoeff() <= kMost;
}

std::optional<PlacedPair> RoundedPairs::Round(const PlacedPair& pair) {
  if (!IsInReachOfFloats(pair)) return std::nullopt;
  const std::optional<ConvexPolyhedron> p = rounded_.Get(pair.p, RoundBody);
  const std::optional<ConvexPolyhedron> q = rounded_.Get(pair.q, RoundBody);
  if (!p || !q) return std::nullopt;
  Eigen::Matrix3d rotation;
  Eigen::Vector3d translation;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) rotation(i, j) = ToFloat(pair.pose.rotation()(i, j));
    translation[i] = ToFloat(pair.pose.translation()[i]);
  }
  const StatusOr<RelativePose> pose = RelativePose::Make(rotation, translation);
  if (!pose.ok()) return std::nullopt;
  return PlacedPair{*p, *q, *pose};
}

}  // namespace touchstone
