// SPDX-License-Identifier: MIT
//
// FCL 0.7: its solver on libccd (MPR for a verdict) and its own GJK-EPA. The solvers are called
// directly: fcl::collide adds the dispatch by shape and bounding boxes, which are no part of the
// question.
#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/detail/gjk_solver_indep.h>
#include <fcl/narrowphase/detail/gjk_solver_libccd.h>

#include "touchstone/tools/engines/registry.h"

namespace touchstone {
namespace {

using Convex = fcl::Convex<double>;
using LibccdSolver = fcl::detail::GJKSolver_libccd<double>;
using OwnSolver = fcl::detail::GJKSolver_indep<double>;

struct Shape : EngineShape {
  explicit Shape(const ConvexPolyhedron& body) {
    auto vertices = std::make_shared<std::vector<fcl::Vector3d>>(body.vertices().begin(),
                                                                 body.vertices().end());
    auto faces = std::make_shared<std::vector<int>>();
    for (int f = 0; f < body.face_count(); ++f) {
      faces->push_back(static_cast<int>(body.face(f).size()));
      faces->insert(faces->end(), body.face(f).begin(), body.face(f).end());
    }
    convex = std::make_unique<Convex>(vertices, body.face_count(), faces);
  }
  std::unique_ptr<Convex> convex;
};

// The last direction of the solver's own GJK.
struct Cache : EngineCache {
  fcl::Vector3d guess = fcl::Vector3d(1.0, 0.0, 0.0);
};

template <class Solver>
class Pair : public EnginePair {
 public:
  Pair(const Shape& p, const Shape& q, const RelativePose& pose, const Solver& solver)
      : p_(*p.convex), q_(*q.convex), solver_(solver) {
    q_pose_.setIdentity();
    q_pose_.linear() = pose.rotation();
    q_pose_.translation() = pose.translation();
  }

  Verdict Ask(EngineCache* cache) const override {
    bool meets;
    if constexpr (std::is_same_v<Solver, OwnSolver>) {
      Solver solver = solver_;
      auto* last = static_cast<Cache*>(cache);
      if (last != nullptr) {
        solver.enableCachedGuess(true);
        solver.setCachedGuess(last->guess);
      }
      meets = solver.shapeIntersect(p_, fcl::Transform3d::Identity(), q_, q_pose_, nullptr);
      if (last != nullptr) last->guess = solver.getCachedGuess();
    } else {
      meets = solver_.shapeIntersect(p_, fcl::Transform3d::Identity(), q_, q_pose_, nullptr);
    }
    return meets ? Verdict::kOverlap : Verdict::kSeparate;
  }

  std::optional<EngineValue> Measure(Quantity quantity) const override {
    switch (quantity) {
      case Quantity::kDistance:
        return Distance();
      case Quantity::kDepth:
        return Depth();
      case Quantity::kExitTravel:
        return std::nullopt;
    }
    return std::nullopt;
  }

 private:
  std::optional<EngineValue> Distance() const {
    double distance = 0.0;
    if (!solver_.shapeDistance(p_, fcl::Transform3d::Identity(), q_, q_pose_, &distance, nullptr,
                               nullptr)) {
      return std::nullopt;
    }
    return EngineValue{distance};
  }

  std::optional<EngineValue> Depth() const {
    std::vector<fcl::ContactPointd> contacts;
    if (!solver_.shapeIntersect(p_, fcl::Transform3d::Identity(), q_, q_pose_, &contacts) ||
        contacts.empty()) {
      return std::nullopt;
    }
    // Its own solver reports the depth with the other sign.
    constexpr double kSign = std::is_same_v<Solver, OwnSolver> ? -1.0 : 1.0;
    return EngineValue{kSign * contacts.front().penetration_depth};
  }

  const Convex& p_;
  const Convex& q_;
  fcl::Transform3d q_pose_;
  const Solver& solver_;
};

// Bounds on iterations: the defaults (500 and 1000; 128 and 255) stop short of tight tolerances.
constexpr unsigned kMaxIterations = 5000;

template <class Solver>
class FclEngine : public Engine {
 public:
  explicit FclEngine(double tolerance) {
    if constexpr (std::is_same_v<Solver, OwnSolver>) {
      solver_.gjk_tolerance = tolerance;
      solver_.epa_tolerance = tolerance;
    } else {
      solver_.collision_tolerance = tolerance;
      solver_.distance_tolerance = tolerance;
      solver_.max_collision_iterations = kMaxIterations;
      solver_.max_distance_iterations = kMaxIterations;
    }
  }

  std::unique_ptr<EngineShape> Prepare(const ConvexPolyhedron& body) const override {
    return std::make_unique<Shape>(body);
  }
  std::unique_ptr<EnginePair> Place(const EngineShape& p, const EngineShape& q,
                                    const RelativePose& pose) const override {
    return std::make_unique<Pair<Solver>>(static_cast<const Shape&>(p),
                                          static_cast<const Shape&>(q), pose, solver_);
  }
  std::unique_ptr<EngineCache> MakeCache() const override {
    if constexpr (std::is_same_v<Solver, OwnSolver>) return std::make_unique<Cache>();
    return nullptr;
  }

 private:
  Solver solver_;
};

template <class Solver>
EngineDescription Describe(const char* name, const char* summary) {
  EngineDescription engine;
  engine.name = name;
  engine.summary = summary;
  engine.touch = TouchConvention::kEither;
  engine.default_tolerance = fcl::constants<double>::gjk_default_tolerance();  // 2e-14
  engine.tolerances = {1e-3, 1e-6, 1e-9, 1e-12, engine.default_tolerance};
  engine.best_tolerance = 1e-12;
  engine.make = [](double tolerance) -> std::unique_ptr<Engine> {
    return std::make_unique<FclEngine<Solver>>(tolerance);
  };
  return engine;
}

}  // namespace

void DescribeFcl(std::vector<EngineDescription>& engines) {
  engines.push_back(Describe<LibccdSolver>("fcl-libccd", "FCL, its solver on libccd (MPR)"));
  engines.push_back(Describe<OwnSolver>("fcl-own", "FCL, its own GJK-EPA"));
}

}  // namespace touchstone
