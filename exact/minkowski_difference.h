// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_MINKOWSKI_DIFFERENCE_H_
#define TOUCHSTONE_EXACT_MINKOWSKI_DIFFERENCE_H_

#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "touchstone/core/cd_dual/result.h"
#include "touchstone/exact/convert.h"
#include "touchstone/exact/integer.h"

namespace touchstone::exact {

// The plane normal . x = offset; outward, its four integers without a common factor.
struct ExactPlane {
  IntegerVector normal;
  Integer offset;
  friend bool operator<(const ExactPlane& a, const ExactPlane& b) {
    return std::tie(a.normal, a.offset) < std::tie(b.normal, b.offset);
  }
  friend bool operator==(const ExactPlane& a, const ExactPlane& b) {
    return a.normal == b.normal && a.offset == b.offset;
  }
};
ExactPlane MakePlane(const IntegerVector& normal, const Integer& offset);

struct MinkowskiFacet {
  ExactPlane plane;
  FaceClass face_class;
  Ratio ratio;  // 1 + d |c| = 1/s
};

// M built whole: its vertices (sorted) and its maximal facets (sorted by plane), in the integer
// coordinates of the PlacedPair it was made from. Equal bodies and poses give equal values, whoever
// built them.
struct MinkowskiDifference {
  std::vector<IntegerVector> vertices;
  std::vector<MinkowskiFacet> facets;

  // The largest ratio over all facets: of the exit face. Over the facets of a class as the paper
  // counts them: F_fv is all that a face of P takes part in, F_vf likewise for Q, F_ee is EdgeEdge.
  Ratio ExitRatio() const;
  std::optional<Ratio> FaceVertexMaximum() const;
  std::optional<Ratio> VertexFaceMaximum() const;
  std::optional<Ratio> EdgeEdgeMaximum() const;
  std::map<FaceClass, int> ClassCounts() const;
};

// Facets with their classes and ratios from planes that support the pair's M; planes may repeat.
std::vector<MinkowskiFacet> ClassifyFacets(const PlacedPair& pair, std::vector<ExactPlane> planes);
// Of `points`, those in at least three of the planes: sorted, each once.
std::vector<IntegerVector> Corners(std::vector<IntegerVector> points,
                                   const std::vector<MinkowskiFacet>& facets);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_MINKOWSKI_DIFFERENCE_H_
