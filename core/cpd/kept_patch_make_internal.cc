// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "touchstone/core/cpd/kept_patch_internal.h"

namespace touchstone::internal {

using Eigen::Vector3d;

std::shared_ptr<const PatchShape> KeptPatch::Make(const MeshPair& pair, const ContactBody& a,
                                                  const ContactBody& b, const LocalSum& sum,
                                                  int t) {
  auto shape = std::make_shared<PatchShape>();
  shape->facets = sum.facets;
  std::vector<int> number(sum.vertices.size(), -1), taken;
  const auto add = [&](int triangle) {
    std::array<int, 3> corners = sum.triangles[triangle];
    for (int& v : corners) {
      if (number[v] < 0) {
        number[v] = static_cast<int>(shape->names.size());
        shape->names.push_back(sum.names[v]);
      }
      v = number[v];
    }
    shape->triangles.push_back(corners);
    shape->facet_of_triangle.push_back(sum.facet_of_triangle[triangle]);
    shape->sides.push_back({kEdgeSide, kEdgeSide, kEdgeSide});
    shape->is_above.push_back({false, false, false});
    taken.push_back(triangle);
  };
  add(t);
  const auto& own = sum.triangles[t];
  for (int s = 0; s < static_cast<int>(sum.triangles.size()); ++s) {
    const auto& corners = sum.triangles[s];
    if (s != t && std::find_first_of(corners.begin(), corners.end(), own.begin(), own.end()) !=
                      corners.end()) {
      add(s);
    }
  }
  for (const SumPointName& name : shape->names) {
    if (name.kind == SumPointKind::kEdgeEdge) return nullptr;
  }
  if (!PlaceFacets(pair, a, b, *shape) || !PlacePoints(pair, *shape)) return nullptr;
  Bound();
  CoverPatch(pair, a, b);
  if (!NameByOwnFacets(pair, a, b, shape.get())) return nullptr;
  for (std::size_t k = 0; k < taken.size(); ++k) {
    for (int side = 0; side < 3; ++side) {
      const int across = sum.neighbors[taken[k]][side];
      if (across >= 0 && sum.cell_of_triangle[across] == sum.cell_of_triangle[taken[k]]) {
        shape->sides[k][side] = kDiagonalSide;
      } else if (!FindWall(pair, a, b, static_cast<int>(k), side, shape.get())) {
        return nullptr;
      }
    }
  }
  MarkFlat(shape.get());
  if (!HasWalls(*shape) || !IsClear(pair, a, b, *shape)) return nullptr;
  return shape;
}

bool KeptPatch::FindWall(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
                         int triangle, int side, PatchShape* shape) {
  const auto& corners = shape->triangles[triangle];
  const Vector3d &u = points_[corners[side]], &v = points_[corners[(side + 1) % 3]],
                 &w = points_[corners[(side + 2) % 3]];
  const int own = shape->facet_of_triangle[triangle];
  if (IsOnEdge(facets_[own], u, v)) return true;
  const int wall = FindFacet(pair, a, b, shape, [&](const PlacedFacet& facet) {
    return &facet != &facets_[own] && Holds(facet, u) && Holds(facet, v);
  });
  if (wall < 0) return false;
  shape->sides[triangle][side] = wall;
  shape->is_above[triangle][side] = Height(facets_[wall], w) > 0.0;
  return true;
}

// The number of a facet of the patch, or of one near it, that is then added; -1: none.
template <class Condition>
int KeptPatch::FindFacet(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
                         PatchShape* shape, const Condition& holds) {
  for (int f = 0; f < static_cast<int>(facets_.size()); ++f) {
    if (holds(facets_[f])) return f;
  }
  for (SumFacet name : list_.facets()) {
    PlacedFacet facet = PlaceCorners(pair, name);
    if (!Meet(facet, low_, high_)) continue;
    for (const bool sense : {false, true}) {
      name.is_along_cross = sense;
      if ((sense && name.kind != SumFacetKind::kEdgeEdge) || !MaySupport(pair, a, b, name)) {
        continue;
      }
      PlacePlane(pair, name, &facet);
      if (!holds(facet)) continue;
      shape->facets.push_back(name);
      facets_.push_back(facet);
      return static_cast<int>(facets_.size()) - 1;
    }
  }
  return -1;
}

// A name may give any facet of a plane: one of those that pass the point takes its place.
bool KeptPatch::NameByOwnFacets(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
                                PatchShape* shape) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    for (int& f : shape->names[i].facets) {
      if (f < 0 || HoldsInPlane(facets_[f], points_[i])) continue;
      const Vector3d normal = facets_[f].normal;
      f = FindFacet(pair, a, b, shape, [&](const PlacedFacet& facet) {
        return normal.cross(facet.normal).norm() <= kPatchSlack && Holds(facet, points_[i]);
      });
      if (f < 0) return false;
    }
  }
  return true;
}

void KeptPatch::MarkFlat(PatchShape* shape) const {
  for (const auto& [i, j, k] : shape->triangles) {
    const Vector3d u = points_[j] - points_[i], v = points_[k] - points_[i];
    const double longest = std::max({u.norm(), v.norm(), (v - u).norm()});
    shape->is_flat.push_back(u.cross(v).norm() <= 4.0 * kPatchSlack * longest);
  }
}

}  // namespace touchstone::internal
