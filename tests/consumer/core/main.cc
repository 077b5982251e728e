// SPDX-License-Identifier: MIT
#include <cstdio>
#include <vector>

#include "touchstone/core/cd_dual/cd_dual.h"

int main() {
  const std::vector<Eigen::Vector3d> vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<std::vector<int>> faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  const auto body = touchstone::ConvexPolyhedron::Build(vertices, faces);
  if (!body.ok()) {
    std::puts(body.status().ToString().c_str());
    return 1;
  }
  const auto pose = touchstone::RelativePose::Make(Eigen::Matrix3d::Identity(), {2, 0, 0});
  const touchstone::CollideResult result = touchstone::Collide(*body, *body, *pose);
  std::printf("%s\n", std::string(touchstone::ToString(result.verdict)).c_str());
  return result.verdict == touchstone::Verdict::kSeparate ? 0 : 1;
}
