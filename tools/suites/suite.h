// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_SUITES_SUITE_H_
#define TOUCHSTONE_TOOLS_SUITES_SUITE_H_

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/cd_dual/result.h"
#include "touchstone/core/convex/convex_polyhedron.h"

namespace touchstone {

// One question to ask: do P and Q, placed by `pose`, meet?
struct PlacedPair {
  ConvexPolyhedron p, q;
  RelativePose pose;
  // What the construction makes certain, when it does: the judge must agree.
  std::optional<Verdict> expected = std::nullopt;
};

// A named, seeded generator of placed pairs.
//
// `Generate` is a pure function: (name, seed, index) gives the same doubles in every run, thread
// and machine. Suites keep to random.h and arithmetic.h for that, and never read anything from the
// core but what they gave it (its interior points may change from version to version).
class Suite {
 public:
  virtual ~Suite() = default;

  virtual std::string_view name() const = 0;
  virtual std::string_view summary() const = 0;  // one line
  virtual std::string_view attacks() const = 0;  // what a wrong program gets wrong here, one line
  // Why the suite cannot run (files missing), or empty.
  virtual std::string unavailable() const { return {}; }

  virtual PlacedPair Generate(std::uint64_t seed, std::uint64_t index) const = 0;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_SUITES_SUITE_H_
