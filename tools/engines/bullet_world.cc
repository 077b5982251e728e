// SPDX-License-Identifier: MIT
//
// Bullet 3.24 in double precision: btCollisionWorld on its dynamic tree (btDbvtBroadphase), hulls
// without margins, performDiscreteCollisionDetection. It knows no question but contacts, which it
// keeps from step to step; a pair meets where a contact is not apart.
#include <btBulletCollisionCommon.h>

#include <algorithm>

#include "touchstone/tools/engines/world.h"

#ifndef BT_USE_DOUBLE_PRECISION
#error "this adapter is for the float64 flavour of Bullet"
#endif

namespace touchstone {
namespace {

btTransform ToBullet(const WorldPose& pose) {
  const Eigen::Matrix3d& r = pose.rotation;
  const Eigen::Vector3d& t = pose.translation;
  return btTransform(
      btMatrix3x3(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2)),
      btVector3(t[0], t[1], t[2]));
}

class BulletWorld : public World {
 public:
  BulletWorld()
      : dispatcher_(&configuration_), world_(&dispatcher_, &broad_phase_, &configuration_) {
    // Boxes of bodies that did not move need no update.
    world_.setForceUpdateAllAabbs(false);
  }
  ~BulletWorld() override {
    for (const auto& object : objects_) world_.removeCollisionObject(object.get());
  }

  void AddShape(const ConvexPolyhedron& body) override {
    shapes_.push_back(std::make_unique<btConvexHullShape>());
    for (const Eigen::Vector3d& v : body.vertices()) {
      shapes_.back()->addPoint(btVector3(v[0], v[1], v[2]), false);
    }
    shapes_.back()->setMargin(0.0);
    shapes_.back()->recalcLocalAabb();
  }

  void AddBody(int shape, const WorldPose& pose) override {
    objects_.push_back(std::make_unique<btCollisionObject>());
    btCollisionObject& object = *objects_.back();
    object.setCollisionShape(shapes_[shape].get());
    object.setWorldTransform(ToBullet(pose));
    object.setUserIndex(static_cast<int>(objects_.size()) - 1);
    world_.addCollisionObject(&object);
  }

  void Move(int body, const WorldPose& pose) override {
    objects_[body]->setWorldTransform(ToBullet(pose));
    world_.updateSingleAabb(objects_[body].get());
  }

  void Step() override {
    // updateAabbs would visit every active body again; what moved is up to date.
    world_.computeOverlappingPairs();
    dispatcher_.dispatchAllCollisionPairs(broad_phase_.getOverlappingPairCache(),
                                          world_.getDispatchInfo(), &dispatcher_);
  }

  std::vector<std::pair<int, int>> MeetingPairs() const override {
    std::vector<std::pair<int, int>> pairs;
    for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
      const btPersistentManifold* manifold = dispatcher_.getManifoldByIndexInternal(i);
      bool meets = false;
      for (int k = 0; k < manifold->getNumContacts(); ++k) {
        meets |= manifold->getContactPoint(k).getDistance() <= 0.0;
      }
      if (meets) {
        pairs.push_back(std::minmax(manifold->getBody0()->getUserIndex(),
                                    manifold->getBody1()->getUserIndex()));
      }
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

 private:
  btDefaultCollisionConfiguration configuration_;
  mutable btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broad_phase_;
  btCollisionWorld world_;
  std::vector<std::unique_ptr<btConvexHullShape>> shapes_;
  std::vector<std::unique_ptr<btCollisionObject>> objects_;
};

}  // namespace

std::unique_ptr<World> MakeBulletWorld() { return std::make_unique<BulletWorld>(); }

}  // namespace touchstone
