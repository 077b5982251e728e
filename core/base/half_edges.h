// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_BASE_HALF_EDGES_H_
#define TOUCHSTONE_CORE_BASE_HALF_EDGES_H_

#include <span>
#include <vector>

#include "touchstone/core/base/status.h"

namespace touchstone {

// Runs from one vertex to another, with a face on its left.
struct HalfEdge {
  int tail, head, face;
};

// Sets `twins` to the half-edge that runs the other way for each, where the faces make a closed
// oriented surface; otherwise names the first edge, by its smaller vertex and then its larger one,
// that has one face, more than two, or two that run it in the same sense.
//
// Complexity: O(n log d) for n half-edges and vertices of at most d.
Status PairHalfEdges(std::span<const HalfEdge> half_edges, int vertex_count,
                     std::vector<int>* twins);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_BASE_HALF_EDGES_H_
