// SPDX-License-Identifier: MIT
//
// Bodies and motions for tests of scenes.
#ifndef TOUCHSTONE_TESTS_SCENE_WORLDS_H_
#define TOUCHSTONE_TESTS_SCENE_WORLDS_H_

#include <Eigen/Core>
#include <vector>

#include "touchstone/core/scene/scene.h"
#include "touchstone/tests/testing/random.h"

namespace touchstone::testing {

WorldPose At(const Eigen::Vector3d& translation);
// A rotation about a random axis by at most `angle`.
Eigen::Matrix3d RandomTurn(Random& random, double angle);
// Any rotation, anywhere in the cube [-extent, extent]^3.
WorldPose RandomPose(Random& random, double extent);
// The pose moved by at most `step` and turned by at most `angle`. Rotations stay rigid: one that
// has drifted is made orthonormal.
WorldPose Nudged(Random& random, const WorldPose& pose, double step, double angle);

SceneShape BoxShape(const Eigen::Vector3d& half_extents);
SceneShape HullShape(int vertices, std::uint64_t seed);
// A cross of three boxes, and an L of two that overlap.
SceneShape CrossShape();
SceneShape MeshShape(const char* name, int faces, double scale);
// Hulls, boxes, needles, compounds and meshes; meshes only where asked for.
std::vector<SceneShape> MixedShapes(bool with_meshes);

// What any two placed shapes do, part by part, by Collide and Membership alone.
Verdict VerdictOf(const SceneShape& a, const WorldPose& pose_a, const SceneShape& b,
                  const WorldPose& pose_b);

}  // namespace touchstone::testing

#endif  // TOUCHSTONE_TESTS_SCENE_WORLDS_H_
