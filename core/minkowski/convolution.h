// SPDX-License-Identifier: MIT
//
//   paper         here             meaning
//   A, B          a, b             the meshes; B placed in A's frame by the pair's pose
//   M             A ⊕ -B           its points a - b are named by pairs of vertices
//   A ⊗ -B        Convolution      the reduced convolution: the facets of two features that support
//                                  each other locally, a superset of the boundary of M°
#ifndef TOUCHSTONE_CORE_MINKOWSKI_CONVOLUTION_H_
#define TOUCHSTONE_CORE_MINKOWSKI_CONVOLUTION_H_

#include <array>
#include <vector>

#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/minkowski/gauss_map.h"
#include "touchstone/core/minkowski/sum_facet.h"

namespace touchstone {

// The facet's corners, counterclockwise seen from outside M; a triangle repeats no corner and has
// three, a parallelogram four.
struct SumCorners {
  std::array<SumVertex, 4> vertices;
  int count;
};
SumCorners CornersOf(const MeshPair& pair, const SumFacet& facet);

// All facets whose features support each other: (f, v) if the neighbours of v lie on the outer side
// of f's plane through it, or in it, and the solid with them; the same for (v, f); (e, e) if both
// edges are convex and their arcs G(e_A) and -G(e_B) meet. Ties are included: with parallel faces
// or edges several facets lie in one plane and overlap. Facets of no area are not.
//
// Vertices within a flat facet or a straight edge and flat edges take no part: the corners and
// edges round them say it all. Every point of the boundary of M° that has an open piece of the
// boundary round it lies on a facet. The list is sorted. Signs are exact where doubles cannot tell.
//
// Complexity: by brute force O(m n); else O((m + n + k) log) on round bodies, k the facets.
struct Convolution {
  std::vector<SumFacet> facets;
  long exact_count = 0;  // signs that took big numbers
};
Convolution ConvolutionByBruteForce(const MeshPair& pair, const GaussMap& a, const GaussMap& b);
Convolution ReducedConvolution(const MeshPair& pair, const GaussMap& a, const GaussMap& b);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MINKOWSKI_CONVOLUTION_H_
