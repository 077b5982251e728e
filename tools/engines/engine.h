// SPDX-License-Identifier: MIT
//
// One small interface for every collision engine that is timed or judged: our searches and others'.
#ifndef TOUCHSTONE_TOOLS_ENGINES_ENGINE_H_
#define TOUCHSTONE_TOOLS_ENGINES_ENGINE_H_

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/cd_dual/result.h"
#include "touchstone/core/convex/convex_polyhedron.h"

namespace touchstone {

// What an engine's documentation says of bodies that share points of their boundaries only.
enum class TouchConvention {
  kThreeWay,  // answers kTouch
  kOverlap,   // answers kOverlap
  kEither,    // says nothing: either answer is right
};

// Whether `answer` contradicts the exact verdict under the engine's own convention. kUndecided is
// never wrong: it is counted apart.
bool IsWrong(TouchConvention convention, Verdict answer, Verdict truth);

// What an engine may say of a pair besides the verdict.
enum class Quantity {
  kDistance,    // Euclidean, of a separate pair
  kDepth,       // the least translation that separates an overlapping pair
  kExitTravel,  // g of core/cd_dual/result.h
};
inline constexpr std::array kAllQuantities = {Quantity::kExitTravel, Quantity::kDistance,
                                              Quantity::kDepth};
std::string_view ToString(Quantity quantity);

struct EngineValue {
  double value = 0.0;  // as the engine gave it: it may be NaN
  // kExitTravel: the interior points between which the line runs.
  int interior_p = 0, interior_q = 0;
};

// A body as an engine stores it. Immutable; any number of pairs may use one.
class EngineShape {
 public:
  virtual ~EngineShape() = default;
};

// What an engine carries from one frame of a pair to the next.
class EngineCache {
 public:
  virtual ~EngineCache() = default;
};

// P and Q, placed. Holds the pose in the engine's own form and references to the shapes, so that a
// question converts nothing.
class EnginePair {
 public:
  virtual ~EnginePair() = default;

  // Do the bodies meet? `cache`, when given, was made by the same engine (MakeCache) and last used
  // with the same two shapes. kUndecided where the engine says so itself, or where it was stopped
  // at its bound on iterations.
  virtual Verdict Ask(EngineCache* cache) const = 0;
  // Nothing where the engine has no such query, or not for a pair with this verdict.
  virtual std::optional<EngineValue> Measure(Quantity /*quantity*/) const { return std::nullopt; }
};

class Engine {
 public:
  virtual ~Engine() = default;

  virtual std::unique_ptr<EngineShape> Prepare(const ConvexPolyhedron& body) const = 0;
  // The shapes were prepared by the same engine and outlive the pair.
  virtual std::unique_ptr<EnginePair> Place(const EngineShape& p, const EngineShape& q,
                                            const RelativePose& pose) const = 0;
  // Null where the engine offers no coherence between frames.
  virtual std::unique_ptr<EngineCache> MakeCache() const { return nullptr; }
};

// An engine as the registry lists it.
struct EngineDescription {
  std::string name;
  std::string summary;  // one line
  TouchConvention touch = TouchConvention::kThreeWay;
  // The tolerances worth trying, in the engine's own meaning of the word, the loosest first; empty
  // where it has none. `default_tolerance` is what a user gets who sets nothing, `best_tolerance`
  // the most accurate that the documentation or its users recommend.
  std::vector<double> tolerances;
  double default_tolerance = 0.0;
  double best_tolerance = 0.0;
  // Whether a wrong verdict is a bug of this project.
  bool proven = false;
  // Inputs are rounded to float: what it is asked is the question only where floats hold it.
  bool single_precision = false;
  // Looks at all pairs of features: the benchmarks time it only when it is named.
  bool quadratic = false;
  // Why the engine cannot run (a package missing at configuration), or empty.
  std::string unavailable;
  std::unique_ptr<Engine> (*make)(double tolerance) = nullptr;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_ENGINES_ENGINE_H_
