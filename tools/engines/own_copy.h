// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_ENGINES_OWN_COPY_H_
#define TOUCHSTONE_TOOLS_ENGINES_OWN_COPY_H_

#include "touchstone/core/convex/convex_polyhedron.h"

namespace touchstone {

// The body built anew from its vertices and faces. Copies of a body share its data; engines that
// are timed side by side may not, or one would find in the cache what another has just read.
ConvexPolyhedron OwnCopy(const ConvexPolyhedron& body);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_ENGINES_OWN_COPY_H_
