// SPDX-License-Identifier: MIT
//
// Bullet 3.24 in single precision, behind C functions: a module that bullet_f32.cc loads into a
// name space of its own, beside the double-precision flavour.
#include "touchstone/tools/engines/bullet_f32_module.h"

#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>

#ifdef BT_USE_DOUBLE_PRECISION
#error "this module is for the single-precision flavour of Bullet"
#endif

namespace {

using Results = btGjkEpaSolver2::sResults;

const btConvexHullShape& HullOf(const void* shape) {
  return *static_cast<const btConvexHullShape*>(shape);
}

btTransform ToBullet(const float* m) {
  return btTransform(btMatrix3x3(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]),
                     btVector3(m[3], m[7], m[11]));
}

void* MakeShape(const double* points, int count) {
  auto* hull = new btConvexHullShape();
  for (int i = 0; i < count; ++i) {
    hull->addPoint(
        btVector3(static_cast<float>(points[3 * i]), static_cast<float>(points[3 * i + 1]),
                  static_cast<float>(points[3 * i + 2])),
        false);
  }
  hull->setMargin(0.0f);
  hull->recalcLocalAabb();
  return hull;
}

void FreeShape(void* shape) { delete static_cast<btConvexHullShape*>(shape); }

TouchstoneBulletAnswer Ask(const void* p, const void* q, const float* pose, float* guess) {
  const btTransform q_pose = ToBullet(pose);
  btVector3 start(guess[0], guess[1], guess[2]);
  if (start.isZero()) start = q_pose.getOrigin();
  Results results;
  if (btGjkEpaSolver2::Distance(&HullOf(p), btTransform::getIdentity(), &HullOf(q), q_pose, start,
                                results)) {
    const btVector3 end = results.witnesses[0] - results.witnesses[1];
    for (int i = 0; i < 3; ++i) guess[i] = end[i];
    return kTouchstoneBulletSeparate;
  }
  return results.status == Results::Penetrating ? kTouchstoneBulletOverlap
                                                : kTouchstoneBulletUndecided;
}

bool Measure(const void* p, const void* q, const float* pose, bool want_depth, double* value) {
  const btTransform q_pose = ToBullet(pose);
  const btTransform identity = btTransform::getIdentity();
  Results results;
  const bool found = want_depth
                         ? btGjkEpaSolver2::Penetration(&HullOf(p), identity, &HullOf(q), q_pose,
                                                        q_pose.getOrigin(), results, false)
                         : btGjkEpaSolver2::Distance(&HullOf(p), identity, &HullOf(q), q_pose,
                                                     q_pose.getOrigin(), results);
  *value = want_depth ? -results.distance : results.distance;
  return found;
}

}  // namespace

extern "C" {
__attribute__((visibility("default"))) extern const TouchstoneBulletFunctions touchstone_bullet_f32;
const TouchstoneBulletFunctions touchstone_bullet_f32 = {MakeShape, FreeShape, Ask, Measure};
}
