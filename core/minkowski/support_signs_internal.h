// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MINKOWSKI_SUPPORT_SIGNS_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_SUPPORT_SIGNS_INTERNAL_H_

#include <optional>

#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/minkowski/convolution.h"
#include "touchstone/core/minkowski/gauss_map.h"

namespace touchstone::internal {

// Which body of a pair.
enum class Side : std::uint8_t { kA, kB };
constexpr Side Other(Side side) { return side == Side::kA ? Side::kB : Side::kA; }

// Whether features of the two bodies support each other: filtered in doubles, then exact.
class SupportSigns {
 public:
  SupportSigns(const MeshPair& pair, const GaussMap& a, const GaussMap& b)
      : pair_(pair), maps_{&a, &b}, exact_(pair) {}

  // Whether vertex v of the other body, on face f of `side`'s body, has its solid on the outer
  // side of the face.
  bool FaceVertex(Side side, int face, int vertex);

  // The facet of two convex edges whose arcs meet, if they do and are not parallel.
  std::optional<SumFacet> EdgeEdge(int edge_a, int edge_b);

  long exact_count() const { return exact_count_; }

 private:
  const PlacedMesh& placed(Side side) const { return side == Side::kA ? pair_.a() : pair_.b(); }
  const GaussMap& map(Side side) const { return *maps_[side == Side::kA ? 0 : 1]; }

  // The sign of the exterior normal of a face of `side`'s body along (to - from) of the other's.
  int AlongNormal(Side side, int face, int to, int from);
  DyadicVector ExactDifference(Side side, int to, int from);
  bool SpecialVertexSupports(Side side, int face, int vertex);

  const MeshPair& pair_;
  const GaussMap* maps_[2];
  ExactMeshPair exact_;
  long exact_count_ = 0;
};

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_SUPPORT_SIGNS_INTERNAL_H_
