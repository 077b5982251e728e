// SPDX-License-Identifier: MIT
#include "touchstone/tools/engines/world.h"

#include <cassert>

#include "touchstone/core/scene/scene.h"

namespace touchstone {
namespace {

class SceneWorld : public World {
 public:
  explicit SceneWorld(const SceneOptions& options) : scene_(options) {}

  void AddShape(const ConvexPolyhedron& body) override {
    shapes_.push_back(SceneShape::Convex(body));
  }
  void AddBody(int shape, const WorldPose& pose) override {
    const auto added = scene_.Add(shapes_[shape], pose);
    assert(added.ok());
    bodies_.push_back(*added);
  }
  void Move(int body, const WorldPose& pose) override {
    [[maybe_unused]] const Status status = scene_.Move(bodies_[body], pose);
    assert(status.ok());
  }
  void Step() override { step_ = scene_.Step(); }
  // Slots are numbered as bodies are.
  std::vector<std::pair<int, int>> MeetingPairs() const override {
    std::vector<std::pair<int, int>> pairs;
    for (const SceneEvent& event : step_.events) {
      if (event.kind == EventKind::kEnd) continue;
      pairs.emplace_back(event.bodies.a.slot, event.bodies.b.slot);
    }
    return pairs;
  }

 private:
  Scene scene_;
  std::vector<SceneShape> shapes_;
  std::vector<BodyHandle> bodies_;
  SceneStep step_;
};

}  // namespace

std::unique_ptr<World> MakeSceneWorld(const SceneOptions& options) {
  return std::make_unique<SceneWorld>(options);
}

std::vector<WorldDescription> OtherWorlds() {
  [[maybe_unused]] const auto missing = [](const char* name, const char* package) {
    return WorldDescription{
        name, std::string(package) + " was not found when the project was configured", nullptr};
  };
  return {
#ifdef TOUCHSTONE_HAS_FCL
      {"fcl", "", MakeFclWorld},
#else
      missing("fcl", "libfcl-dev"),
#endif
#ifdef TOUCHSTONE_HAS_BULLET_F64
      {"bullet-f64", "", MakeBulletWorld},
#else
      missing("bullet-f64", "libbullet-dev"),
#endif
  };
}

}  // namespace touchstone
