// SPDX-License-Identifier: MIT
//
// Bullet 3.24 in single precision, as most of its users have it. Its library and the
// double-precision one define the same names, so it lives in a module that is loaded into a name
// space of its own (dlmopen), with its own copy of the standard library; the heap meter does not
// see what it takes. Inputs are rounded to float: judged on inputs that floats do not hold, it
// answers another question.
#include <dlfcn.h>

#include <array>
#include <vector>

#include "touchstone/tools/engines/bullet_f32_module.h"
#include "touchstone/tools/engines/registry.h"

namespace touchstone {
namespace {

// Loaded once and kept; null where it cannot be.
const TouchstoneBulletFunctions* Functions() {
  static const TouchstoneBulletFunctions* functions = [] {
    void* module = dlmopen(LM_ID_NEWLM, TOUCHSTONE_BULLET_F32_MODULE, RTLD_NOW | RTLD_LOCAL);
    return module == nullptr ? nullptr
                             : static_cast<const TouchstoneBulletFunctions*>(
                                   dlsym(module, "touchstone_bullet_f32"));
  }();
  return functions;
}

struct Shape : EngineShape {
  explicit Shape(const ConvexPolyhedron& body) {
    std::vector<double> points;
    for (const Eigen::Vector3d& v : body.vertices())
      points.insert(points.end(), v.begin(), v.end());
    hull = Functions()->make_shape(points.data(), body.vertex_count());
  }
  ~Shape() override { Functions()->free_shape(hull); }
  Shape(const Shape&) = delete;
  Shape& operator=(const Shape&) = delete;
  void* hull;
};

struct Cache : EngineCache {
  std::array<float, 3> guess = {};
};

class Pair : public EnginePair {
 public:
  Pair(const Shape& p, const Shape& q, const RelativePose& pose)
      : p_(p.hull), q_(q.hull), functions_(*Functions()) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) pose_[4 * i + j] = static_cast<float>(pose.rotation()(i, j));
      pose_[4 * i + 3] = static_cast<float>(pose.translation()[i]);
    }
  }

  Verdict Ask(EngineCache* cache) const override {
    Cache none;
    Cache& last = cache == nullptr ? none : *static_cast<Cache*>(cache);
    switch (functions_.ask(p_, q_, pose_.data(), last.guess.data())) {
      case kTouchstoneBulletSeparate:
        return Verdict::kSeparate;
      case kTouchstoneBulletOverlap:
        return Verdict::kOverlap;
      case kTouchstoneBulletUndecided:
        return Verdict::kUndecided;
    }
    return Verdict::kUndecided;
  }

  std::optional<EngineValue> Measure(Quantity quantity) const override {
    if (quantity == Quantity::kExitTravel) return std::nullopt;
    EngineValue value;
    if (!functions_.measure(p_, q_, pose_.data(), quantity == Quantity::kDepth, &value.value))
      return std::nullopt;
    return value;
  }

 private:
  const void* p_;
  const void* q_;
  const TouchstoneBulletFunctions& functions_;
  std::array<float, 12> pose_;
};

class BulletF32Engine : public Engine {
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

void DescribeBulletF32(std::vector<EngineDescription>& engines) {
  EngineDescription engine;
  engine.name = "bullet-f32";
  engine.summary = "the same in single precision; inputs are rounded to float";
  engine.touch = TouchConvention::kEither;
  engine.single_precision = true;
  if (Functions() == nullptr) {
    engine.unavailable = std::string("its module " TOUCHSTONE_BULLET_F32_MODULE " is not there");
  }
  engine.make = [](double) -> std::unique_ptr<Engine> {
    return std::make_unique<BulletF32Engine>();
  };
  engines.push_back(engine);
}

}  // namespace touchstone
