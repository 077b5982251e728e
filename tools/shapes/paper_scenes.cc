// SPDX-License-Identifier: MIT
#include "touchstone/tools/shapes/paper_scenes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <numbers>
#include <utility>

#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kFullTurn = 2.0 * std::numbers::pi;

// Turns A a little at the start, so that no edges or faces of the two bodies stay parallel by
// accident: cones have bases of 500 slivers in one plane.
Matrix3d Tilted(const Matrix3d& rotation) {
  return AngleAxisd(0.1, Vector3d(0.36, 0.48, 0.8)).toRotationMatrix() * rotation;
}

// The radius of a sphere round the middle of the shape's box that holds it.
double BoundingRadius(const Shape& shape) {
  Vector3d low = shape.vertices[0], high = low;
  for (const Vector3d& v : shape.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  const Vector3d middle = 0.5 * (low + high);
  double radius = 0.0;
  for (const Vector3d& v : shape.vertices) radius = std::max(radius, (v - middle).norm());
  return radius;
}

// Lengths as the shapes have them, scaled at the end.
PaperScene Scaled(PaperScene scene) {
  const double scale = kPaperSumRadius / (BoundingRadius(scene.a) + BoundingRadius(scene.b));
  scene.a = Moved(std::move(scene.a), scale, Vector3d::Zero());
  scene.b = Moved(std::move(scene.b), scale, Vector3d::Zero());
  for (Vector3d* length : {&scene.start.translation, &scene.pivot, &scene.travel}) {
    *length *= scale;
  }
  return scene;
}

// The middle of the cone's axis stays in the middle of the bar along x.
PaperScene ConeAxes() {
  const Vector3d from(3.0, 0.5, 0.5);
  return {"cone-axes",
          Moved(NamedShape("cone", 1000), 1.0, {0, 0, -2}),
          NamedShape("axes", 36),
          {Tilted(Matrix3d::Identity()), from},
          Vector3d(0.36, 0.8, 0.48),
          from,
          Vector3d(-2.5, 0.0, 0.0),
          kFullTurn};
}

PaperScene SpoonCup() {
  const Matrix3d leaning = AngleAxisd(-1.25, Vector3d::UnitY()).toRotationMatrix();
  const Vector3d bowl(-0.15, 0.0, 1.0);
  return {"spoon-cup",
          NamedShape("spoon", 1300),
          NamedShape("cup", 1008),
          {leaning, bowl},
          leaning.col(0),
          bowl,
          Vector3d::Zero(),
          kFullTurn};
}

PaperScene FishTorus() {
  const Matrix3d upright =
      Tilted(AngleAxisd(-0.5 * std::numbers::pi, Vector3d::UnitY()).toRotationMatrix());
  const Vector3d middle(1.0, 0.0, 0.0);
  return {"fish-torus",
          NamedShape("fish", 950),
          NamedShape("torus", 1600),
          {upright, middle},
          upright.col(0),
          middle,
          Vector3d::Zero(),
          kFullTurn};
}

PaperScene TorusTorus() {
  const Matrix3d upright =
      Tilted(AngleAxisd(0.5 * std::numbers::pi, Vector3d::UnitX()).toRotationMatrix());
  return {"torus-torus",
          NamedShape("torus", 2000),
          NamedShape("torus", 2000),
          {upright, Vector3d(1.25, 0.0, 0.0)},
          Vector3d::UnitZ(),
          Vector3d::Zero(),
          Vector3d::Zero(),
          kFullTurn};
}

}  // namespace

WorldPose PaperScene::PlacementOfA(double s) const {
  const Matrix3d rotation = AngleAxisd(s * turn, axis).toRotationMatrix();
  return {rotation * start.rotation, rotation * (start.translation - pivot) + pivot + s * travel};
}

RelativePose PaperScene::PoseAt(double s) const {
  const WorldPose of_a = PlacementOfA(s);
  const Matrix3d back = of_a.rotation.transpose();
  const auto pose = RelativePose::Make(back, -(back * of_a.translation));
  assert(pose.ok());
  return *pose;
}

double PaperScene::AtTurn(double degrees) const {
  return degrees * std::numbers::pi / 180.0 / turn;
}

std::span<const PaperScene> AllPaperScenes() {
  static const std::vector<PaperScene> kScenes = {Scaled(ConeAxes()), Scaled(SpoonCup()),
                                                  Scaled(FishTorus()), Scaled(TorusTorus())};
  return kScenes;
}

const PaperScene* FindPaperScene(const std::string& name) {
  for (const PaperScene& scene : AllPaperScenes()) {
    if (scene.name == name) return &scene;
  }
  return nullptr;
}

}  // namespace touchstone
