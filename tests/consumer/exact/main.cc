// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <vector>

#include "touchstone/core/cd_dual/cd_dual.h"
#include "touchstone/exact/convex_hull.h"
#include "touchstone/exact/judge.h"

int main() {
  const std::vector<Eigen::Vector3d> points = {
      {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.1, 0.1, 0.1}};
  const auto body = touchstone::exact::ConvexHull(points);
  if (!body.ok()) {
    std::puts(body.status().ToString().c_str());
    return 1;
  }
  const auto pose = touchstone::RelativePose::Make(Eigen::Matrix3d::Identity(), {2, 0, 0});
  const touchstone::CollideResult result = touchstone::Collide(*body, *body, *pose);
  const auto findings = touchstone::exact::Judge(*body, *body, *pose, result);
  for (const auto& finding : findings) std::puts(finding.detail.c_str());
  return findings.empty() ? 0 : 1;
}
