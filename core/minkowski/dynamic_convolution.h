// SPDX-License-Identifier: MIT
//
//   paper              here                   meaning
//   C(A), C(B)         MappedMesh             a mesh with its Gauss map and its convex map
//   C(A) ⊗ C(-B)       DynamicConvolution     where each direction of one map lies in the other,
//   and
//                                             which arcs of the one meet which of the other
//   vf-error                                  a direction has left its region
//   ee-error                                  an arc meets other arcs than before
//   F̄_P x (V̄2 - V̄1)    SumChanges::added      appendix A.1 calls V̄2 - V̄1 faces; they are vertices
#ifndef TOUCHSTONE_CORE_MINKOWSKI_DYNAMIC_CONVOLUTION_H_
#define TOUCHSTONE_CORE_MINKOWSKI_DYNAMIC_CONVOLUTION_H_

#include <memory>
#include <span>
#include <vector>

#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/minkowski/convolution.h"
#include "touchstone/core/minkowski/mapped_mesh.h"

namespace touchstone {

// What an update did. Whatever was there before and is not dropped is kept. Sorted.
struct SumChanges {
  std::vector<SumFacet> dropped, added;
};

// The reduced convolution of two meshes, kept up to date while one turns: at every pose the facets
// are those of ReducedConvolution, ties included.
//
// A feature is a direction of A's map in the map of B, one of B's in the map of A, or an edge of
// the body with more convex edges in the map of the other. It is found by walking; its candidates
// are the correspondence sets of all that lies within reach, and with each of them is known by how
// much the rotation may change (as a matrix, in the 2-norm) before the two can begin or cease to
// support each other. Until the first of these, or until motion has used up the reach, the feature
// is not looked at again. Where doubles cannot tell a sign apart from zero, exact signs decide, and
// the feature is looked at in every update.
//
// It is complete since regions of a conforming map lie wholly within a cone or outside it, and each
// arc is a chain of edges: whatever a feature comes to meet, the map has within reach (README).
//
// Complexity: an update looks at the features whose bound is used up, each in O(1) on round bodies
// plus what is within reach; O(log n) to find each. Memory is used again. Not for several threads
// at once.
class DynamicConvolution {
 public:
  DynamicConvolution(MappedMesh a, MappedMesh b);
  DynamicConvolution(DynamicConvolution&&) noexcept;
  DynamicConvolution& operator=(DynamicConvolution&&) noexcept;
  ~DynamicConvolution();

  // Goes to the pose of `pair`, a pair of the meshes given, and brings every feature up to date.
  // Returns what changed since the last update (or, the first time, everything); valid until the
  // next.
  const SumChanges& Update(const MeshPair& pair);
  // All facets as of the last update, sorted. Complexity: O(k log k).
  std::vector<SumFacet> Facets() const;

  // Goes to the pose of `pair` and looks at nothing: features come up to date as they are asked
  // for, so that a part of the convolution costs no more than that part. `pair` must stay as it is
  // while questions are asked. The next Update tells all changes since the last.
  void Place(const MeshPair& pair);
  // The vertices of B that support a face of A, and of A that support a face of B: sorted.
  std::span<const int> VerticesOnFaceOfA(int face);
  std::span<const int> VerticesOnFaceOfB(int face);
  // The facets of an edge of one body with edges of the other; of A if `traces_a`, else of B.
  bool traces_a() const;
  std::span<const SumFacet> FacetsOfEdge(int edge);

  struct Counts {
    int features = 0;      // in all
    int looked_at = 0;     // since the last Update or Place began
    int undecided = 0;     // of these, by exact signs
    long regions = 0;      // that they visited
    long exact_signs = 0;  // that took big numbers
  };
  const Counts& counts() const;

 private:
  class State;

  std::unique_ptr<State> state_;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MINKOWSKI_DYNAMIC_CONVOLUTION_H_
