// SPDX-License-Identifier: MIT
//
// Many placed bodies in each engine's own world: our scene, and what other libraries offer.
#ifndef TOUCHSTONE_TOOLS_ENGINES_WORLD_H_
#define TOUCHSTONE_TOOLS_ENGINES_WORLD_H_

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/convex/convex_polyhedron.h"
#include "touchstone/core/scene/options.h"

namespace touchstone {

// Bodies are numbered from 0 in the order in which they are added.
class World {
 public:
  virtual ~World() = default;

  // A shape that any number of bodies may have; numbered from 0.
  virtual void AddShape(const ConvexPolyhedron& body) = 0;
  virtual void AddBody(int shape, const WorldPose& pose) = 0;
  virtual void Move(int body, const WorldPose& pose) = 0;
  // Finds the pairs that meet.
  virtual void Step() = 0;
  // Them, the smaller number first, in order.
  virtual std::vector<std::pair<int, int>> MeetingPairs() const = 0;
};

struct WorldDescription {
  std::string name;
  // Why it cannot run (a package missing at configuration), or empty.
  std::string unavailable;
  std::unique_ptr<World> (*make)() = nullptr;
};

// Our scene under these options.
std::unique_ptr<World> MakeSceneWorld(const SceneOptions& options);
// Others' worlds, at the settings that their documentation recommends for many moving bodies.
std::vector<WorldDescription> OtherWorlds();

// One a file.
std::unique_ptr<World> MakeFclWorld();
std::unique_ptr<World> MakeBulletWorld();

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_ENGINES_WORLD_H_
