// SPDX-License-Identifier: MIT
//
// Bullet 3.24 in double precision: btGjkEpaSolver2 on hulls without margins. The verdict takes its
// GJK alone (Distance); depth takes EPA as well. Its tolerances are constants of the library.
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>

#include "touchstone/tools/engines/registry.h"

#ifndef BT_USE_DOUBLE_PRECISION
#error "this adapter is for the float64 flavour of Bullet"
#endif

namespace touchstone {
namespace {

using Results = btGjkEpaSolver2::sResults;

struct Shape : EngineShape {
  explicit Shape(const ConvexPolyhedron& body) {
    for (const Eigen::Vector3d& v : body.vertices()) {
      hull.addPoint(btVector3(v[0], v[1], v[2]), false);
    }
    hull.setMargin(0.0);
    hull.recalcLocalAabb();
  }
  btConvexHullShape hull;
};

// The last difference of closest points, from where the next search starts.
struct Cache : EngineCache {
  btVector3 guess = btVector3(0.0, 0.0, 0.0);
};

btTransform ToBullet(const RelativePose& pose) {
  const Eigen::Matrix3d& r = pose.rotation();
  const Eigen::Vector3d& t = pose.translation();
  const btMatrix3x3 rotation(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1),
                             r(2, 2));
  return btTransform(rotation, btVector3(t[0], t[1], t[2]));
}

class Pair : public EnginePair {
 public:
  Pair(const Shape& p, const Shape& q, const RelativePose& pose)
      : p_(p.hull), q_(q.hull), p_pose_(btTransform::getIdentity()), q_pose_(ToBullet(pose)) {}

  Verdict Ask(EngineCache* cache) const override {
    auto* last = static_cast<Cache*>(cache);
    Results results;
    // The first guess of Bullet's own callers.
    const btVector3 guess =
        last != nullptr && !last->guess.isZero() ? last->guess : q_pose_.getOrigin();
    const bool apart = btGjkEpaSolver2::Distance(&p_, p_pose_, &q_, q_pose_, guess, results);
    if (last != nullptr && apart) last->guess = results.witnesses[0] - results.witnesses[1];
    if (apart) return Verdict::kSeparate;
    return results.status == Results::Penetrating ? Verdict::kOverlap : Verdict::kUndecided;
  }

  std::optional<EngineValue> Measure(Quantity quantity) const override {
    Results results;
    const btVector3 guess = q_pose_.getOrigin();
    if (quantity == Quantity::kDistance) {
      if (!btGjkEpaSolver2::Distance(&p_, p_pose_, &q_, q_pose_, guess, results))
        return std::nullopt;
      return EngineValue{results.distance};
    }
    if (quantity == Quantity::kDepth) {
      if (!btGjkEpaSolver2::Penetration(&p_, p_pose_, &q_, q_pose_, guess, results, false))
        return std::nullopt;
      return EngineValue{-results.distance};
    }
    return std::nullopt;
  }

 private:
  const btConvexHullShape& p_;
  const btConvexHullShape& q_;
  btTransform p_pose_, q_pose_;
};

class BulletEngine : public Engine {
 public:
  std::unique_ptr<EngineShape> Prepare(const ConvexPolyhedron& body) const override {
    return std::make_unique<Shape>(body);
  }
  std::unique_ptr<EnginePair> Place(const EngineShape& p, const EngineShape& q,
                                    const RelativePose& pose) const override {
    return std::make_unique<Pair>(static_cast<const Shape&>(p), static_cast<const Shape&>(q), pose);
  }
  std::unique_ptr<EngineCache> MakeCache() const override { return std::make_unique<Cache>(); }
};

}  // namespace

void DescribeBulletF64(std::vector<EngineDescription>& engines) {
  EngineDescription engine;
  engine.name = "bullet-f64";
  engine.summary = "Bullet GJK-EPA (btGjkEpaSolver2), double precision, no margins";
  engine.touch = TouchConvention::kEither;
  engine.make = [](double) -> std::unique_ptr<Engine> { return std::make_unique<BulletEngine>(); };
  engines.push_back(engine);
}

}  // namespace touchstone
