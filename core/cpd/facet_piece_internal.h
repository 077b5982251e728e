// SPDX-License-Identifier: MIT
//
// Facets of the convolution and what is left of them, in doubles: convex polygons in planes.
#ifndef TOUCHSTONE_CORE_CPD_FACET_PIECE_INTERNAL_H_
#define TOUCHSTONE_CORE_CPD_FACET_PIECE_INTERNAL_H_

#include <Eigen/Core>
#include <array>

#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/minkowski/convolution.h"

namespace touchstone::internal {

// A facet in the pair's scaled frame: x = height * normal + at[0] * u + at[1] * v.
struct FacetFrame {
  SumFacet name;
  SumCorners corners;  // counterclockwise seen from outside
  Eigen::Vector3d normal, u, v;
  double height;
  bool is_oriented = true;  // whether the normal is the facet's own
  // Every point of the facet is within this of a point of the polygon in the frame.
  double slack;

  Eigen::Vector3d At(const Eigen::Vector2d& at) const {
    return height * normal + at[0] * u + at[1] * v;
  }
};

// What bounds a side of a piece: plane k of witness w is 5 w + k, side k of the facet -1 - k.
inline constexpr int kNoWall = -100;  // a cut that no feature makes

// A cut moves the corners that it makes by at most two units of coordinates below 4 off the sides
// that they are on.
inline constexpr double kCutSlack = 0x1p-49;
inline constexpr int kMaxCuts = 4000;
inline constexpr int kMaxPieceCorners = 12;

// The point of a piece nearest to the origin, and the walls it lies on.
struct NearestPoint {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  int wall_count = 0;
  std::array<int, 2> walls = {kNoWall, kNoWall};
};

struct FacetPiece {
  int facet = -1;  // number of its frame
  int count = 0;
  int cuts = 0;           // on the way to it
  double distance = 0.0;  // from the origin to the nearest point, in the frame
  NearestPoint nearest;
  std::array<Eigen::Vector2d, kMaxPieceCorners> at;
  std::array<int, kMaxPieceCorners> walls;  // of the side from corner i to the next
};

// The frame of a facet, and the whole of it as a piece.
void MakeFacet(const MeshPair& pair, const SumFacet& name, FacetFrame* frame, FacetPiece* piece);

// No more than the distance of a facet from the origin, whichever way it faces.
double DistanceToFacet(const MeshPair& pair, const SumFacet& name);

// Sets the piece's nearest point and distance.
void Measure(const FacetFrame& frame, FacetPiece* piece);

// The line a x + b y = c.
struct Line2 {
  double a, b, c;
  double Beyond(const Eigen::Vector2d& x) const { return a * x[0] + b * x[1] - c; }
};
// Whether no corner is beyond the line.
bool IsWithin(const FacetPiece& piece, const Line2& line);
// Parts a piece by a x + b y <= c, into two others. Either may be empty (count 0), and neither is
// measured. Requires room for one more corner.
void Part(const FacetPiece& piece, const Line2& line, int wall, FacetPiece* inside,
          FacetPiece* outside);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_CPD_FACET_PIECE_INTERNAL_H_
