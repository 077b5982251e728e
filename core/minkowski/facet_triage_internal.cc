// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/facet_triage_internal.h"

#include <algorithm>
#include <limits>

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

// By the plane through an edge of x at its corner number `place`.
bool PartAtEdges(const SumGeometry& geometry, const ArrangedFacet& x, int place,
                 const ArrangedFacet& y) {
  int axis = 0;
  geometry.plane(x.plane).normal.cwiseAbs().maxCoeff(&axis);
  const int corner = x.corners[place];
  for (const int step : {1, x.count - 1}) {
    const int end = x.corners[(place + step) % x.count];
    // The side that all but the two lie on; 0: not one side, or doubles cannot tell.
    const auto side_of = [&](const ArrangedFacet& other) {
      int side = 0;
      for (int k = 0; k < other.count; ++k) {
        const int point = other.corners[k];
        if (point == corner || (&other == &x && point == end)) continue;
        const int turn = SumGeometry::TriageTurn(geometry.point(corner), geometry.point(end),
                                                 geometry.point(point), axis);
        if (turn == 0 || turn == -side) return 0;
        side = turn;
      }
      return side;
    };
    const int side = side_of(x);
    if (side != 0 && side_of(y) == -side) return true;
  }
  return false;
}

}  // namespace

// With n, o and x the roundings of a plane's normal and origin and of a corner, S the sum of n's
// coordinates and L the largest coordinate of any corner, in size: n.(x - o) is off by at most
// 3 e_n (2 L + 2 e) + 2 e S where no normal is off by more than e_n, nor a corner by more than e;
// and n.x - n.o is rounded along paths of three, three and one operations, by (3 + 3 + 2) S L
// units.
FacetTriage::FacetTriage(const SumGeometry& geometry, std::span<const ArrangedFacet> facets) {
  double largest = 0.0, error = 0.0;
  for (const ArrangedFacet& f : facets) {
    for (const int corner : f.corners) {
      const SumPoint& point = geometry.point(corner);
      largest = std::max(largest, point.rounded.cwiseAbs().maxCoeff());
      error = std::max(error, point.error);
    }
  }
  entries_.reserve(facets.size());
  for (const ArrangedFacet& f : facets) {
    const SumPlane& plane = geometry.plane(f.plane);
    const double sum = plane.normal.cwiseAbs().sum();
    Entry& entry = entries_.emplace_back();
    entry.normal = plane.normal;
    entry.offset = plane.normal.dot(plane.origin);
    entry.bound = 1.01 * (6.0 * plane.normal_error * (largest + error) + 2.0 * error * sum +
                          8.1 * kUnit * sum * largest) +
                  0x1p-1000;
    for (int k = 0; k < 4; ++k) {
      const Vector3d& x = geometry.point(f.corners[k]).rounded;
      for (int i = 0; i < 3; ++i) entry.corners[i][k] = x[i];
    }
  }
}

bool FacetTriage::IsClear(int f, int g) const {
  const Entry& plane = entries_[f];
  const auto& x = entries_[g].corners;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (int k = 0; k < 4; ++k) {
    const double height = plane.normal[0] * x[0][k] + plane.normal[1] * x[1][k] +
                          plane.normal[2] * x[2][k] - plane.offset;
    low = std::min(low, height);
    high = std::max(high, height);
  }
  return low > plane.bound || high < -plane.bound;
}

CornerSides FacetTriage::SidesOf(int f, int g) const {
  const Entry& plane = entries_[f];
  const auto& x = entries_[g].corners;
  CornerSides sides;
  for (int k = 0; k < 4; ++k) {
    const double height = plane.normal[0] * x[0][k] + plane.normal[1] * x[1][k] +
                          plane.normal[2] * x[2][k] - plane.offset;
    sides[k] = static_cast<signed char>((height > plane.bound) - (height < -plane.bound));
  }
  return sides;
}

bool FacetTriage::IsClearBut(int f, int g, int corner, std::span<const int> corners_of_g) const {
  const Entry& plane = entries_[f];
  const auto& x = entries_[g].corners;
  bool is_above = true, is_below = true;
  for (int k = 0; k < 4; ++k) {
    if (corners_of_g[k] == corner) continue;
    const double height = plane.normal[0] * x[0][k] + plane.normal[1] * x[1][k] +
                          plane.normal[2] * x[2][k] - plane.offset;
    is_above &= height > plane.bound;
    is_below &= height < -plane.bound;
  }
  return is_above || is_below;
}

SharedCorners FindSharedCorners(const ArrangedFacet& x, const ArrangedFacet& y) {
  SharedCorners shared;
  for (int k = 0; k < x.count; ++k) {
    for (int l = 0; l < y.count; ++l) {
      if (x.corners[k] != y.corners[l]) continue;
      ++shared.count;
      shared.place_x = k;
      shared.place_y = l;
    }
  }
  return shared;
}

bool PartAtCorner(const SumGeometry& geometry, const ArrangedFacet& x, const ArrangedFacet& y,
                  const SharedCorners& shared) {
  return PartAtEdges(geometry, x, shared.place_x, y) || PartAtEdges(geometry, y, shared.place_y, x);
}

bool LieAcrossAnEdge(const SumGeometry& geometry, const ArrangedFacet& x, const ArrangedFacet& y) {
  for (int k = 0; k < x.count; ++k) {
    for (int l = 0; l < y.count; ++l) {
      if (x.corners[k] != y.corners[(l + 1) % y.count] ||
          x.corners[(k + 1) % x.count] != y.corners[l]) {
        continue;
      }
      const SumPlane &p = geometry.plane(x.plane), &q = geometry.plane(y.plane);
      return TriageSign(HeightAlong(p.normal, p.normal_error, q.normal, q.normal_error)) > 0;
    }
  }
  return false;
}

}  // namespace touchstone::internal
