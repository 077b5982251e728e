// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/facet_crossing_internal.h"

#include <algorithm>
#include <utility>

#include "touchstone/core/mesh/box_tree.h"

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

class PairFinder {
 public:
  PairFinder(SumGeometry* geometry, std::span<const ArrangedFacet> facets)
      : geometry_(*geometry), facets_(facets), triage_(*geometry, facets) {}

  FacetPairs Run(std::optional<std::span<const std::pair<int, int>>> near) {
    FacetPairs result;
    if (near) {
      near_.assign(near->begin(), near->end());
    } else {
      FindNear();
    }
    result.box_pairs = static_cast<long>(near_.size());
    std::erase_if(near_, [&](const auto& pair) {
      return triage_.IsClear(pair.first, pair.second) || triage_.IsClear(pair.second, pair.first);
    });
    // In a fixed order, however they were found: facets come sorted.
    std::sort(near_.begin(), near_.end());
    for (const auto& [f, g] : near_) {
      FacetPair pair{f, g, {}, {}};
      if (MayCross(&pair)) result.pairs.push_back(pair);
    }
    return result;
  }

 private:
  // Pairs whose boxes meet.
  void FindNear() {
    std::vector<Box3> boxes;
    boxes.reserve(facets_.size());
    for (const ArrangedFacet& f : facets_) {
      Box3 box{geometry_.point(f.corners[0]).rounded, geometry_.point(f.corners[0]).rounded};
      for (const int corner : f.corners) {
        const SumPoint& point = geometry_.point(corner);
        box.low = box.low.cwiseMin(point.rounded - Vector3d::Constant(point.error));
        box.high = box.high.cwiseMax(point.rounded + Vector3d::Constant(point.error));
      }
      boxes.push_back(box);
    }
    BoxTree(boxes).MeetingItems(&near_);
  }

  bool MayCross(FacetPair* pair) {
    const ArrangedFacet &x = facets_[pair->f], &y = facets_[pair->g];
    const SharedCorners shared = FindSharedCorners(x, y);
    if (shared.count == 1 && MeetInACorner(*pair, shared)) return false;
    const bool share_an_edge = shared.count >= 2;
    if (share_an_edge && (AreOfOneVertex(x.name, y.name) || LieAcrossAnEdge(geometry_, x, y))) {
      return false;
    }
    if (!FindSides(pair->f, pair->g, &pair->of_g)) return false;
    if (std::all_of(pair->of_g.begin(), pair->of_g.end(), [](int side) { return side == 0; })) {
      geometry_.Unite(x.plane, y.plane);
      return false;
    }
    return !share_an_edge && FindSides(pair->g, pair->f, &pair->of_f);
  }

  // The sides of f's plane that g's corners lie on; false if all lie strictly on one side.
  bool FindSides(int f, int g, CornerSides* sides) {
    const ArrangedFacet& own = facets_[g];
    *sides = triage_.SidesOf(f, g);
    int least = 1, greatest = -1;
    for (int k = 0; k < own.count; ++k) {
      int side = (*sides)[k];
      if (side == 0) side = geometry_.Side(own.corners[k], facets_[f].plane);
      (*sides)[k] = static_cast<signed char>(side);
      least = std::min(least, side);
      greatest = std::max(greatest, side);
    }
    return least <= 0 && greatest >= 0;
  }

  // Whether facets that share one corner certainly share nothing else: neither cuts the other then,
  // and a plane may have two names. Round a vertex of M many facets do.
  bool MeetInACorner(const FacetPair& pair, const SharedCorners& shared) const {
    const ArrangedFacet &x = facets_[pair.f], &y = facets_[pair.g];
    const int corner = x.corners[shared.place_x];
    return triage_.IsClearBut(pair.f, pair.g, corner, y.corners) ||
           triage_.IsClearBut(pair.g, pair.f, corner, x.corners) ||
           PartAtCorner(geometry_, x, y, shared);
  }

  SumGeometry& geometry_;
  const std::span<const ArrangedFacet> facets_;
  const FacetTriage triage_;
  std::vector<std::pair<int, int>> near_;
};

// What a plane cuts from a convex facet.
struct Trace {
  int from, to;     // points
  bool is_on_edge;  // along an edge of the facet, rather than through its inside
};

// Nothing where the plane only touches a corner.
std::optional<Trace> TraceOf(SumGeometry* geometry, const ArrangedFacet& facet,
                             const CornerSides& sides, int plane) {
  int points[4], count = 0;
  bool is_on_edge = false;
  for (int k = 0; k < facet.count; ++k) {
    const int next = (k + 1) % facet.count;
    if (sides[k] == 0) {
      points[count++] = facet.corners[k];
      is_on_edge |= sides[next] == 0;
    } else if (sides[k] * sides[next] < 0) {
      points[count++] = geometry->AddOnEdge(facet.corners[k], facet.corners[next], plane);
    }
  }
  if (count < 2) return std::nullopt;
  return Trace{points[0], points[1], is_on_edge};
}

}  // namespace

FacetPairs FindCrossingFacets(SumGeometry* geometry, std::span<const ArrangedFacet> facets,
                              std::optional<std::span<const std::pair<int, int>>> near) {
  return PairFinder(geometry, facets).Run(near);
}

std::optional<FacetCrossing> CrossingOf(SumGeometry* geometry,
                                        std::span<const ArrangedFacet> facets,
                                        const FacetPair& pair) {
  const ArrangedFacet &f = facets[pair.f], &g = facets[pair.g];
  const int plane_f = geometry->Root(f.plane), plane_g = geometry->Root(g.plane);
  std::optional<Trace> of_f = TraceOf(geometry, f, pair.of_f, plane_g);
  if (!of_f) return std::nullopt;
  std::optional<Trace> of_g = TraceOf(geometry, g, pair.of_g, plane_f);
  if (!of_g) return std::nullopt;
  const int axis = geometry->LineAxis(plane_f, plane_g);
  for (Trace* trace : {&*of_f, &*of_g}) {
    if (geometry->Compare(trace->from, trace->to, axis) > 0) std::swap(trace->from, trace->to);
  }
  const int from = geometry->Compare(of_f->from, of_g->from, axis) >= 0 ? of_f->from : of_g->from;
  const int to = geometry->Compare(of_f->to, of_g->to, axis) <= 0 ? of_f->to : of_g->to;
  if (geometry->Compare(from, to, axis) >= 0) return std::nullopt;
  return FacetCrossing{axis, {from, to}, !of_f->is_on_edge, !of_g->is_on_edge};
}

}  // namespace touchstone::internal
