// SPDX-License-Identifier: MIT
#include "touchstone/tests/scene/worlds.h"

#include <Eigen/Geometry>

#include "touchstone/core/cd_dual/cd_dual.h"
#include "touchstone/core/mesh/membership.h"
#include "touchstone/tests/testing/shapes.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone::testing {

using Eigen::Matrix3d;
using Eigen::Vector3d;

WorldPose At(const Vector3d& translation) { return {Matrix3d::Identity(), translation}; }

Matrix3d RandomTurn(Random& random, double angle) {
  const Vector3d axis(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1));
  if (!(axis.norm() > 1e-3)) return Matrix3d::Identity();
  return Eigen::AngleAxisd(random.Uniform(-angle, angle), axis.normalized()).toRotationMatrix();
}

WorldPose RandomPose(Random& random, double extent) {
  return {RandomTurn(random, 3.14),
          Vector3d(random.Uniform(-extent, extent), random.Uniform(-extent, extent),
                   random.Uniform(-extent, extent))};
}

WorldPose Nudged(Random& random, const WorldPose& pose, double step, double angle) {
  WorldPose moved = pose;
  moved.rotation = RandomTurn(random, angle) * pose.rotation;
  if ((moved.rotation.transpose() * moved.rotation - Matrix3d::Identity()).norm() > 1e-12) {
    moved.rotation = Eigen::Quaterniond(moved.rotation).normalized().toRotationMatrix();
  }
  moved.translation += Vector3d(random.Uniform(-step, step), random.Uniform(-step, step),
                                random.Uniform(-step, step));
  return moved;
}

SceneShape BoxShape(const Vector3d& half_extents) {
  return SceneShape::Convex(MustBuild(Box(half_extents)));
}

SceneShape HullShape(int vertices, std::uint64_t seed) {
  return SceneShape::Convex(MustBuild(RoundBody(vertices, {1.0, 0.8, 0.6}, seed)));
}

SceneShape CrossShape() {
  const std::vector<ConvexPolyhedron> bars = {MustBuild(Box({1.5, 0.25, 0.25})),
                                              MustBuild(Box({0.25, 1.5, 0.25})),
                                              MustBuild(Box({0.25, 0.25, 1.5}))};
  return *SceneShape::Compound(bars);
}

SceneShape MeshShape(const char* name, int faces, double scale) {
  return SceneShape::Mesh(
      touchstone::MustBuild(Moved(NamedShape(name, faces), scale, Vector3d::Zero())));
}

std::vector<SceneShape> MixedShapes(bool with_meshes) {
  std::vector<SceneShape> shapes = {HullShape(40, 1),
                                    HullShape(12, 2),
                                    BoxShape({1, 1, 1}),
                                    BoxShape({0.05, 0.05, 2.5}),
                                    BoxShape({3, 3, 0.125}),
                                    CrossShape(),
                                    SceneShape::Convex(MustBuild(SubdividedCube(2, true))),
                                    SceneShape::Convex(MustBuild(Prism(40, 0.5)))};
  if (with_meshes) {
    shapes.push_back(MeshShape("torus", 200, 0.5));
    shapes.push_back(MeshShape("u", 0, 0.5));
    shapes.push_back(MeshShape("hollow", 0, 0.5));
    shapes.push_back(MeshShape("tori", 200, 0.3));
  }
  return shapes;
}

Verdict VerdictOf(const SceneShape& a, const WorldPose& pose_a, const SceneShape& b,
                  const WorldPose& pose_b) {
  const auto pose = RelativePose::FromWorld(pose_a, pose_b);
  Verdict strongest = Verdict::kSeparate;
  for (int i = 0; i < a.part_count(); ++i) {
    for (int j = 0; j < b.part_count(); ++j) {
      const ScenePart &p = a.part(i), &q = b.part(j);
      const Verdict verdict =
          p.is_convex() && q.is_convex()
              ? Collide(p.convex(), q.convex(), *pose).verdict
              : Membership(MeshPair(p.mesh(), q.mesh(), *pose), Vector3d(Vector3d::Zero())).verdict;
      if (verdict == Verdict::kOverlap) return verdict;
      if (verdict == Verdict::kTouch) strongest = verdict;
    }
  }
  return strongest;
}

}  // namespace touchstone::testing
