// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_SUITES_LATTICE_CONTACT_H_
#define TOUCHSTONE_TOOLS_SUITES_LATTICE_CONTACT_H_

#include <cstdint>
#include <string_view>

#include "touchstone/tools/suites/contact.h"
#include "touchstone/tools/suites/suite.h"

namespace touchstone {

// The common part of the suites of exact contact: a pair of lattice bodies for 60 indices, in three
// contacts (axis rotation and features drawn anew), each at all offsets of contact.h.
class LatticeContactSuite : public Suite {
 public:
  PlacedPair Generate(std::uint64_t seed, std::uint64_t index) const final;

 protected:
  // A body with integer coordinates below 2^12.
  virtual ConvexPolyhedron MakeBody(Random& random) const = 0;
  // The pair of features to bring in contact.
  virtual bool Wants(int dimension_p, int dimension_q) const = 0;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_SUITES_LATTICE_CONTACT_H_
