// SPDX-License-Identifier: MIT
//
// Scenes as JSON: shapes by file or generator, bodies with poses and motions, subscriptions
// (tools/README.md has the format).
#ifndef TOUCHSTONE_TOOLS_SCENE_SCENE_FILE_H_
#define TOUCHSTONE_TOOLS_SCENE_SCENE_FILE_H_

#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "touchstone/core/scene/scene.h"
#include "touchstone/tools/result_json.h"

namespace touchstone {

// Where a body is after so many steps: a closed formula, so that nothing drifts.
struct BodyMotion {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // a step
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();      // axis times radians a step
  // Half extents of a box around the origin that the body's origin is reflected in.
  std::optional<Eigen::Vector3d> within;
  // To and fro about an axis through a point: amplitude * sin(2 pi step / period).
  struct Hinge {
    Eigen::Vector3d point, axis;
    double amplitude = 0.0, period = 1.0;
  };
  std::optional<Hinge> hinge;
  // The pose and the motion are in the frame of this earlier body.
  std::optional<int> parent;
};

struct SceneBodySpec {
  std::string name;
  SceneShape shape;
  WorldPose pose;
  BodyMotion motion;
  Subscriptions subscriptions;
  Filter filter;
};

struct SceneSpec {
  std::vector<SceneBodySpec> bodies;
  std::vector<std::tuple<int, int, Subscriptions>> pairs;
  std::vector<std::pair<int, int>> ignored;
  int steps = 100;
  // A record of an earlier run, if the file is one: poses by step and body, and what was told.
  std::vector<std::vector<WorldPose>> recorded_poses;
  std::vector<std::vector<std::string>> recorded_events;
};

// Both throw BadInput, naming the source and the element: "FILE: bodies[3].shape: ...".
Json ReadSceneJson(const std::string& path);
SceneSpec ParseScene(const Json& json, const std::string& source);

// The poses of all bodies after `step` steps; step 0: as given.
std::vector<WorldPose> PosesAt(const SceneSpec& spec, int step);

// A demo by its name, as the JSON of a scene file. Null for an unknown name.
Json MakeDemo(const std::string& name);
std::span<const std::string> DemoNames();

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_SCENE_SCENE_FILE_H_
