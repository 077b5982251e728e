// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_SUITES_LINE_SUITE_H_
#define TOUCHSTONE_TOOLS_SUITES_LINE_SUITE_H_

#include <cstdint>
#include <functional>
#include <utility>

#include "touchstone/tools/suites/random.h"
#include "touchstone/tools/suites/suite.h"

namespace touchstone {

// The common part of the suites of bodies in general position: a pair of bodies for 80 indices, in
// four orientations, each with all placements along one line (placement.h).
class LineSuite : public Suite {
 public:
  PlacedPair Generate(std::uint64_t seed, std::uint64_t index) const final;

 protected:
  using Pair = std::pair<ConvexPolyhedron, ConvexPolyhedron>;

  virtual Pair MakePair(Random& random) const = 0;
  virtual Eigen::Matrix3d MakeRotation(Random& random) const { return random.Rotation(); }
  // The last word on a placed pair. `block` is drawn anew for each pair of bodies, `index` for each
  // query.
  virtual PlacedPair Finish(PlacedPair pair, Random& /*block*/, Random& /*index*/) const {
    return pair;
  }
};

// The body with every vertex mapped, its faces as they are; the mapped body, or the status that
// says why it is none.
StatusOr<ConvexPolyhedron> MapBody(
    const ConvexPolyhedron& body,
    const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& map);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_SUITES_LINE_SUITE_H_
