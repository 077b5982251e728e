// SPDX-License-Identifier: MIT
//
// FCL 0.7: its dynamic AABB tree manager, and fcl::collide without contacts for the pairs that it
// reports, by its default solver (libccd).
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <cstdint>

#include "touchstone/tools/engines/world.h"

namespace touchstone {
namespace {

using Convex = fcl::Convex<double>;
using Object = fcl::CollisionObject<double>;

fcl::Transform3d ToFcl(const WorldPose& pose) {
  fcl::Transform3d transform = fcl::Transform3d::Identity();
  transform.linear() = pose.rotation;
  transform.translation() = pose.translation;
  return transform;
}

class FclWorld : public World {
 public:
  void AddShape(const ConvexPolyhedron& body) override {
    auto vertices = std::make_shared<std::vector<fcl::Vector3d>>(body.vertices().begin(),
                                                                 body.vertices().end());
    auto faces = std::make_shared<std::vector<int>>();
    for (int f = 0; f < body.face_count(); ++f) {
      faces->push_back(static_cast<int>(body.face(f).size()));
      faces->insert(faces->end(), body.face(f).begin(), body.face(f).end());
    }
    shapes_.push_back(std::make_shared<Convex>(vertices, body.face_count(), faces));
  }

  void AddBody(int shape, const WorldPose& pose) override {
    objects_.push_back(std::make_unique<Object>(shapes_[shape], ToFcl(pose)));
    objects_.back()->setUserData(reinterpret_cast<void*>(objects_.size() - 1));
    objects_.back()->computeAABB();
    added_.push_back(objects_.back().get());
  }

  void Move(int body, const WorldPose& pose) override {
    objects_[body]->setTransform(ToFcl(pose));
    objects_[body]->computeAABB();
    moved_.push_back(objects_[body].get());
  }

  void Step() override {
    if (!added_.empty()) {
      manager_.registerObjects(added_);
      manager_.setup();
      added_.clear();
    } else if (2 * moved_.size() > objects_.size()) {
      manager_.update();
    } else if (!moved_.empty()) {
      manager_.update(moved_);
    }
    moved_.clear();
    meeting_.clear();
    manager_.collide(this, &Meet);
  }

  std::vector<std::pair<int, int>> MeetingPairs() const override {
    auto pairs = meeting_;
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

 private:
  static int IndexOf(const Object* object) {
    return static_cast<int>(reinterpret_cast<std::uintptr_t>(object->getUserData()));
  }

  // Called for each pair whose boxes meet; false: go on.
  static bool Meet(Object* a, Object* b, void* world) {
    static const fcl::CollisionRequestd kVerdictOnly(1, false);
    fcl::CollisionResultd result;
    fcl::collide(a, b, kVerdictOnly, result);
    if (result.isCollision()) {
      static_cast<FclWorld*>(world)->meeting_.push_back(std::minmax(IndexOf(a), IndexOf(b)));
    }
    return false;
  }

  std::vector<std::shared_ptr<Convex>> shapes_;
  std::vector<std::unique_ptr<Object>> objects_;
  std::vector<Object*> added_, moved_;
  fcl::DynamicAABBTreeCollisionManagerd manager_;
  std::vector<std::pair<int, int>> meeting_;
};

}  // namespace

std::unique_ptr<World> MakeFclWorld() { return std::make_unique<FclWorld>(); }

}  // namespace touchstone
