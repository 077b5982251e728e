// SPDX-License-Identifier: MIT
//
// Our own searches, asked for the verdict alone.
#include "touchstone/core/cd_dual/cd_dual.h"
#include "touchstone/core/proximity/distance.h"
#include "touchstone/core/proximity/penetration_depth.h"
#include "touchstone/tools/engines/own_copy.h"
#include "touchstone/tools/engines/registry.h"

namespace touchstone {
namespace {

struct Shape : EngineShape {
  explicit Shape(const ConvexPolyhedron& b) : body(OwnCopy(b)) {}
  ConvexPolyhedron body;
};

struct Cache : EngineCache {
  CollideCache cache;
};

class Pair : public EnginePair {
 public:
  Pair(const Shape& p, const Shape& q, const RelativePose& pose, const CollideOptions& options)
      : p_(p.body), q_(q.body), pose_(pose), options_(options) {}

  Verdict Ask(EngineCache* cache) const override {
    CollideCache* last = cache == nullptr ? nullptr : &static_cast<Cache*>(cache)->cache;
    return Collide(p_, q_, pose_, options_, last).verdict;
  }

  std::optional<EngineValue> Measure(Quantity quantity) const override {
    switch (quantity) {
      case Quantity::kExitTravel:
        return ExitTravel();
      case Quantity::kDistance:
        return MeasuredDistance();
      case Quantity::kDepth:
        return MeasuredDepth();
    }
    return std::nullopt;
  }

 private:
  std::optional<EngineValue> ExitTravel() const {
    CollideOptions options = options_;
    options.early_exit = false;
    const CollideResult result = Collide(p_, q_, pose_, options);
    if (!result.exit_travel) return std::nullopt;
    return EngineValue{result.exit_travel->value, result.interior_p, result.interior_q};
  }

  // Distance and depth are queries of their own, listed with the default search.
  std::optional<EngineValue> MeasuredDistance() const {
    if (options_.search != Search::kPortal) return std::nullopt;
    const DistanceResult result = Distance(p_, q_, pose_, {.certainty = options_.certainty});
    if (result.kind != DistanceKind::kSeparate) return std::nullopt;
    return EngineValue{result.distance.value};
  }

  std::optional<EngineValue> MeasuredDepth() const {
    if (options_.search != Search::kPortal) return std::nullopt;
    const PenetrationResult result =
        PenetrationDepth(p_, q_, pose_, {.certainty = options_.certainty});
    if (result.verdict != Verdict::kOverlap) return std::nullopt;
    return EngineValue{result.depth.value};
  }

  // Handles, as a user holds them; the bodies' data is the shapes'.
  ConvexPolyhedron p_, q_;
  RelativePose pose_;
  const CollideOptions& options_;
};

class TouchstoneEngine : public Engine {
 public:
  explicit TouchstoneEngine(const CollideOptions& options) : options_(options) {
    options_.early_exit = true;
  }

  std::unique_ptr<EngineShape> Prepare(const ConvexPolyhedron& body) const override {
    return std::make_unique<Shape>(body);
  }
  std::unique_ptr<EnginePair> Place(const EngineShape& p, const EngineShape& q,
                                    const RelativePose& pose) const override {
    return std::make_unique<Pair>(static_cast<const Shape&>(p), static_cast<const Shape&>(q), pose,
                                  options_);
  }
  std::unique_ptr<EngineCache> MakeCache() const override {
    // The paper's search and the phased one keep nothing.
    return options_.search == Search::kPortal ? std::make_unique<Cache>() : nullptr;
  }

 private:
  CollideOptions options_;
};

template <Search kSearch, Certainty kCertainty>
EngineDescription Describe(const char* name, const char* summary, bool proven) {
  EngineDescription engine;
  engine.name = name;
  engine.summary = summary;
  engine.proven = proven;
  engine.make = [](double) -> std::unique_ptr<Engine> {
    return std::make_unique<TouchstoneEngine>(
        CollideOptions{.search = kSearch, .certainty = kCertainty});
  };
  return engine;
}

}  // namespace

void DescribeTouchstone(std::vector<EngineDescription>& engines) {
  engines.push_back(Describe<Search::kPortal, Certainty::kExact>(
      "portal", "our default: portal search, always exact", true));
  engines.push_back(Describe<Search::kPortal, Certainty::kFloat>(
      "portal-float", "the same in doubles alone: proven or undecided", true));
  engines.push_back(Describe<Search::kPhased, Certainty::kExact>(
      "phased", "the paper's three phases, made correct", true));
  engines.push_back(Describe<Search::kPublished, Certainty::kExact>(
      "published", "CD-Dual to the letter; its verdict is not proven", false));
}

}  // namespace touchstone
