// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/cd_dual.h"

namespace touchstone {

CollideResult Collide(const ConvexPolyhedron&, const ConvexPolyhedron&, const RelativePose&,
                      const CollideOptions&) {
  return {};
}

}  // namespace touchstone
