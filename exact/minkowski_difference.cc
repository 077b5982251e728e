// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/minkowski_difference.h"

#include <algorithm>

#include "touchstone/exact/support.h"

namespace touchstone::exact {
namespace {

template <class Keep>
std::optional<Ratio> Maximum(const std::vector<MinkowskiFacet>& facets, const Keep& keep) {
  std::optional<Ratio> best;
  for (const MinkowskiFacet& facet : facets) {
    if (keep(facet.face_class) && (!best.has_value() || Compare(facet.ratio, *best) > 0)) {
      best = facet.ratio;
    }
  }
  return best;
}

}  // namespace

ExactPlane MakePlane(const IntegerVector& normal, const Integer& offset) {
  const Integer divisor = gcd(gcd(gcd(normal[0], normal[1]), normal[2]), offset);
  return {
      {Integer(normal[0] / divisor), Integer(normal[1] / divisor), Integer(normal[2] / divisor)},
      Integer(offset / divisor)};
}

Ratio MinkowskiDifference::ExitRatio() const {
  return *Maximum(facets, [](FaceClass) { return true; });
}

std::optional<Ratio> MinkowskiDifference::FaceVertexMaximum() const {
  return Maximum(facets, [](FaceClass c) {
    return c == FaceClass::kFaceVertex || c == FaceClass::kFaceEdge || c == FaceClass::kFaceFace;
  });
}

std::optional<Ratio> MinkowskiDifference::VertexFaceMaximum() const {
  return Maximum(facets, [](FaceClass c) {
    return c == FaceClass::kVertexFace || c == FaceClass::kEdgeFace || c == FaceClass::kFaceFace;
  });
}

std::optional<Ratio> MinkowskiDifference::EdgeEdgeMaximum() const {
  return Maximum(facets, [](FaceClass c) { return c == FaceClass::kEdgeEdge; });
}

std::map<FaceClass, int> MinkowskiDifference::ClassCounts() const {
  std::map<FaceClass, int> counts;
  for (const MinkowskiFacet& facet : facets) ++counts[facet.face_class];
  return counts;
}

std::vector<MinkowskiFacet> ClassifyFacets(const PlacedPair& pair, std::vector<ExactPlane> planes) {
  std::sort(planes.begin(), planes.end());
  planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
  std::vector<MinkowskiFacet> facets;
  for (ExactPlane& plane : planes) {
    const SupportingFeatures supporting = Supporting(pair, plane.normal);
    const FaceClass face_class = ClassOf(pair, supporting).value();
    Ratio ratio = RatioOf(pair, plane.normal, {supporting.p[0], supporting.q[0]});
    facets.push_back({std::move(plane), face_class, std::move(ratio)});
  }
  return facets;
}

std::vector<IntegerVector> Corners(std::vector<IntegerVector> points,
                                   const std::vector<MinkowskiFacet>& facets) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::erase_if(points, [&](const IntegerVector& point) {
    return std::count_if(facets.begin(), facets.end(), [&](const MinkowskiFacet& facet) {
             return Dot(facet.plane.normal, point) == facet.plane.offset;
           }) < 3;
  });
  return points;
}

}  // namespace touchstone::exact
