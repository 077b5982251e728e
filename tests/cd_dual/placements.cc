// SPDX-License-Identifier: MIT
#include "touchstone/tests/cd_dual/placements.h"

#include <Eigen/Geometry>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "touchstone/tests/testing/shapes.h"

namespace touchstone::testing {
namespace {

Mesh LatticeTetrahedron(Random* random, int reach) {
  for (;;) {
    Mesh mesh;
    for (int i = 0; i < 4; ++i) {
      mesh.vertices.emplace_back(random->Int(-reach, reach), random->Int(-reach, reach),
                                 random->Int(-reach, reach));
    }
    auto& v = mesh.vertices;
    const double volume = (v[1] - v[0]).cross(v[2] - v[0]).dot(v[3] - v[0]);
    if (volume == 0.0) continue;
    if (volume > 0.0) std::swap(v[1], v[2]);
    mesh.faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
    return mesh;
  }
}

Eigen::Vector3d LatticePoint(Random* random, int reach) {
  return {double(random->Int(-reach, reach)), double(random->Int(-reach, reach)),
          double(random->Int(-reach, reach))};
}

}  // namespace

RelativePose MustPose(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation) {
  auto pose = RelativePose::Make(rotation, translation);
  if (!pose.ok()) {
    std::fprintf(stderr, "%s\n", pose.status().ToString().c_str());
    std::abort();
  }
  return *pose;
}

Eigen::Matrix3d AxisRotation(Random* random) {
  static constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                        {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  const auto& order = kOrders[random->Int(0, 5)];
  Eigen::Matrix3d r = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 3; ++i) r(i, order[i]) = random->Int(0, 1) ? 1.0 : -1.0;
  if (r.determinant() < 0.0) r.row(2) *= -1.0;
  return r;
}

std::vector<Placement> SmallPlacements(std::uint64_t seed, int count) {
  Random random(seed);
  std::vector<Placement> placements;
  for (int i = 0; i < count; ++i) {
    const auto box = [&] {
      return MustBuild(Box(Eigen::Vector3d(random.Int(1, 3), random.Int(1, 3), random.Int(1, 3))));
    };
    switch (i % 6) {
      case 0:
        placements.push_back({"boxes on a lattice", box(), box(),
                              MustPose(AxisRotation(&random), LatticePoint(&random, 5))});
        break;
      case 1:
        placements.push_back(
            {"turned boxes", box(), box(),
             MustPose(random.Rotation(), 5.0 * random.Unit() * random.Direction())});
        break;
      case 2:
        placements.push_back({"lattice tetrahedra", MustBuild(LatticeTetrahedron(&random, 4)),
                              MustBuild(LatticeTetrahedron(&random, 4)),
                              MustPose(AxisRotation(&random), LatticePoint(&random, 4))});
        break;
      case 3: {  // design section 5: elongated tetrahedra with many ties
        const auto stretched = [&] {
          Mesh mesh = LatticeTetrahedron(&random, 3);
          for (auto& v : mesh.vertices) v[0] *= 13.0;
          return MustBuild(mesh);
        };
        placements.push_back({"stretched tetrahedra", stretched(), stretched(),
                              MustPose(Eigen::Matrix3d::Identity(), LatticePoint(&random, 8))});
        break;
      }
      case 4:
        placements.push_back({"prism and bipyramid", MustBuild(Prism(random.Int(3, 7), 1.0)),
                              MustBuild(Bipyramid(random.Int(3, 6), 1.0)),
                              MustPose(random.Int(0, 1) ? AxisRotation(&random) : random.Rotation(),
                                       2.2 * random.Unit() * random.Direction())});
        break;
      default: {
        const auto round = [&] {
          return MustBuild(
              RoundBody(random.Int(8, 14), Eigen::Vector3d(random.Int(1, 4), 1, 1), random.Bits()));
        };
        placements.push_back(
            {"round bodies", round(), round(),
             MustPose(random.Rotation(), 5.0 * random.Unit() * random.Direction())});
      }
    }
  }
  return placements;
}

}  // namespace touchstone::testing
