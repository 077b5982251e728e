// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/gather_internal.h"

#include <algorithm>

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

bool Meet(const Box3& a, const Box3& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

}  // namespace

FacetCorners RoundedCorners(const MeshPair& pair, const SumFacet& facet) {
  const SumCorners corners = CornersOf(pair, facet);
  FacetCorners rounded;
  rounded.count = corners.count;
  for (int k = 0; k < corners.count; ++k) {
    const SumVertex& x = corners.vertices[k];
    rounded.points[k] = pair.a().points[x.a] - pair.b().points[x.b];
  }
  return rounded;
}

Box3 BoxOf(const MeshPair& pair, const FacetCorners& corners) {
  Box3 box{corners.points[0], corners.points[0]};
  for (int k = 1; k < corners.count; ++k) {
    box.low = box.low.cwiseMin(corners.points[k]);
    box.high = box.high.cwiseMax(corners.points[k]);
  }
  // A point's error, as SumGeometry::AddVertex has it, and the rounding of these sums.
  const double error = 1.1 * (pair.a().point_error + pair.b().point_error + 4.0 * kUnit);
  box.low -= Vector3d::Constant(error);
  box.high += Vector3d::Constant(error);
  return box;
}

bool MeetsBall(const FacetCorners& corners, const ScaledBall& ball) {
  // First whether all corners lie beyond it along an axis.
  for (int axis = 0; axis < 3; ++axis) {
    double low = corners.points[0][axis], high = low;
    for (int k = 1; k < corners.count; ++k) {
      low = std::min(low, corners.points[k][axis]);
      high = std::max(high, corners.points[k][axis]);
    }
    const double at = ball.center()[axis], reach = ball.gathering_reach();
    if (low - at > reach || at - high > reach) return false;
  }
  return DistanceToPolygon(ball.center(), corners.points.data(), corners.count) <=
         ball.gathering_reach();
}

void NearBoxes::Add(const Box3& box) {
  if (boxes_.empty()) {
    all_ = box;
  } else {
    all_.low = all_.low.cwiseMin(box.low);
    all_.high = all_.high.cwiseMax(box.high);
  }
  boxes_.Add(box);
}

bool NearBoxes::MayMeetAny(const Box3& box) const { return !boxes_.empty() && Meet(all_, box); }

bool NearBoxes::MeetsAny(const Box3& box) const { return MayMeetAny(box) && boxes_.MeetsAny(box); }

void NearBoxes::Meeting(const Box3& box, std::vector<int>* hits) const {
  if (MayMeetAny(box)) boxes_.Meeting(box, hits);
}

void FacetGathering::Clear() {
  found_.clear();
  near_.clear();
}

int FacetGathering::Add(const SumFacet& facet, bool is_active) {
  found_.push_back({facet, static_cast<int>(found_.size()), is_active});
  return found_.back().number;
}

void FacetGathering::MoveTo(GatheredFacets* gathered) {
  std::sort(found_.begin(), found_.end(),
            [](const Found& x, const Found& y) { return x.facet < y.facet; });
  gathered->facets.clear();
  gathered->is_active.clear();
  gathered->near.clear();
  place_of_number_.resize(found_.size());
  for (const Found& found : found_) {
    place_of_number_[found.number] = static_cast<int>(gathered->facets.size());
    gathered->facets.push_back(found.facet);
    gathered->is_active.push_back(found.is_active);
  }
  for (const auto& [f, g] : near_) {
    gathered->near.push_back(std::minmax(place_of_number_[f], place_of_number_[g]));
  }
}

std::optional<SumFacet> SupportedFacet(SupportSigns* signs, const TriangleMesh& a,
                                       const TriangleMesh& b, const SumFacet& candidate) {
  switch (candidate.kind) {
    case SumFacetKind::kFaceVertex:
      if (!signs->FaceVertex(Side::kA, candidate.a, candidate.b)) return std::nullopt;
      return candidate;
    case SumFacetKind::kVertexFace:
      if (!signs->FaceVertex(Side::kB, candidate.b, candidate.a)) return std::nullopt;
      return candidate;
    case SumFacetKind::kEdgeEdge:
      break;
  }
  if (a.edge_kind(candidate.a) != EdgeKind::kConvex ||
      b.edge_kind(candidate.b) != EdgeKind::kConvex) {
    return std::nullopt;
  }
  return signs->EdgeEdge(candidate.a, candidate.b);
}

void SelectFacets(const MeshPair& pair, std::span<const SumFacet> facets, const ScaledBall& ball,
                  NearBoxes* near, FacetGathering* gathering) {
  near->Clear();
  gathering->Clear();
  std::vector<Box3> boxes(facets.size());
  std::vector<int> hits;
  std::vector<char> is_active(facets.size(), 0);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const FacetCorners corners = RoundedCorners(pair, facets[f]);
    boxes[f] = BoxOf(pair, corners);
    is_active[f] = MeetsBall(corners, ball);
    if (!is_active[f]) continue;
    const int number = gathering->Add(facets[f], true);
    hits.clear();
    near->Meeting(boxes[f], &hits);
    for (const int g : hits) gathering->AddNear(g, number);
    near->Add(boxes[f]);
  }
  for (std::size_t f = 0; f < facets.size(); ++f) {
    if (is_active[f]) continue;
    hits.clear();
    near->Meeting(boxes[f], &hits);
    if (hits.empty()) continue;
    const int number = gathering->Add(facets[f], false);
    for (const int g : hits) gathering->AddNear(g, number);
  }
}

}  // namespace touchstone::internal
