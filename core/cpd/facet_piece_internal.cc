// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/facet_piece_internal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "touchstone/core/cpd/contact_name_internal.h"

namespace touchstone::internal {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double Cross2(const Vector2d& u, const Vector2d& v) { return u[0] * v[1] - u[1] * v[0]; }

// Beyond this a facet is a needle, whose own normal is no better than any across it.
constexpr double kUnsureNormal = 0x1p-12;

Vector3d AcrossLongestSide(const MeshPair& pair, const SumCorners& corners) {
  Vector3d longest = Vector3d::Zero();
  for (int k = 0; k < corners.count; ++k) {
    const Vector3d side = EstimateVertex(pair, corners.vertices[(k + 1) % corners.count]) -
                          EstimateVertex(pair, corners.vertices[k]);
    if (side.squaredNorm() > longest.squaredNorm()) longest = side;
  }
  return longest.norm() > 0.0 ? Vector3d(longest.unitOrthogonal()) : Vector3d::UnitZ();
}

NearestPoint NearestOf(const FacetPiece& piece) {
  NearestPoint nearest;
  bool is_inside = true;
  double least = 1e300;
  for (int i = 0; i < piece.count; ++i) {
    const int next = i + 1 == piece.count ? 0 : i + 1;
    const Vector2d &a = piece.at[i], &b = piece.at[next];
    const Vector2d side = b - a;
    is_inside &= Cross2(side, -a) >= 0.0;
    const double squared = side.squaredNorm(), along = -a.dot(side);
    Vector2d foot = a;
    int walls[2] = {piece.walls[i == 0 ? piece.count - 1 : i - 1], piece.walls[i]};
    int count = 2;
    if (along > 0.0 && along < squared) {
      foot = a + (along / squared) * side;
      walls[0] = piece.walls[i];
      count = 1;
    } else if (along > 0.0) {
      continue;  // the next corner, whose turn comes
    }
    const double distance = foot.squaredNorm();
    if (distance < least) {
      least = distance;
      nearest = {foot, count, {walls[0], walls[1]}};
    }
  }
  if (is_inside && piece.count >= 3) return {};
  return nearest;
}

}  // namespace

void MakeFacet(const MeshPair& pair, const SumFacet& name, FacetFrame* frame, FacetPiece* piece) {
  frame->name = name;
  frame->corners = CornersOf(pair, name);
  const PlaneEstimate plane = EstimatePlane(pair, name);
  frame->normal = plane.normal;
  frame->is_oriented = plane.error < kUnsureNormal;
  if (!frame->is_oriented) frame->normal = AcrossLongestSide(pair, frame->corners);
  frame->u = frame->normal.unitOrthogonal();
  frame->v = frame->normal.cross(frame->u);
  piece->count = frame->corners.count;
  piece->cuts = 0;
  double low = 1e300, high = -1e300;
  for (int k = 0; k < piece->count; ++k) {
    const Vector3d x = EstimateVertex(pair, frame->corners.vertices[k]);
    const double height = frame->normal.dot(x);
    low = std::min(low, height);
    high = std::max(high, height);
    piece->at[k] = {frame->u.dot(x), frame->v.dot(x)};
    piece->walls[k] = -1 - k;
  }
  frame->height = 0.5 * (low + high);
  // Corners are off by the bodies' points and 2^-50 for their difference, the dot products and the
  // frame's own orthonormality by 2^-49 each. A normal that is not the facet's shows in the
  // corners' heights.
  frame->slack = 0.5 * (high - low) + 0x1p-46 + 2.0 * (pair.a().point_error + pair.b().point_error);
  // Seen from outside the corners run counterclockwise, but for facets thinner than their rounding.
  double area = 0.0;
  for (int k = 2; k < piece->count; ++k) {
    area += Cross2(piece->at[k - 1] - piece->at[0], piece->at[k] - piece->at[0]);
  }
  if (area < 0.0) {
    std::reverse(piece->at.begin(), piece->at.begin() + piece->count);
    // Side k ran from corner k to the next.
    std::reverse(piece->walls.begin(), piece->walls.begin() + piece->count - 1);
  }
  Measure(*frame, piece);
}

double DistanceToFacet(const MeshPair& pair, const SumFacet& name) {
  FacetFrame frame;
  FacetPiece piece;
  MakeFacet(pair, name, &frame, &piece);
  return std::max(0.0, piece.distance - frame.slack);
}

void Measure(const FacetFrame& frame, FacetPiece* piece) {
  piece->nearest = NearestOf(*piece);
  piece->distance = std::sqrt(frame.height * frame.height + piece->nearest.at.squaredNorm());
}

bool IsWithin(const FacetPiece& piece, const Line2& line) {
  return std::all_of(piece.at.begin(), piece.at.begin() + piece.count,
                     [&](const Vector2d& x) { return line.Beyond(x) <= 0.0; });
}

void Part(const FacetPiece& piece, const Line2& line, int wall, FacetPiece* inside,
          FacetPiece* outside) {
  std::array<double, kMaxPieceCorners> sides;
  double low = 1e300, high = -1e300;
  for (int i = 0; i < piece.count; ++i) {
    sides[i] = line.Beyond(piece.at[i]);
    low = std::min(low, sides[i]);
    high = std::max(high, sides[i]);
  }
  if (high <= 0.0 || low >= 0.0) {
    *(high <= 0.0 ? inside : outside) = piece;
    (high <= 0.0 ? outside : inside)->count = 0;
    return;
  }
  FacetPiece &in = *inside, &out = *outside;
  in.facet = out.facet = piece.facet;
  in.cuts = out.cuts = piece.cuts + 1;
  in.count = out.count = 0;
  for (int i = 0; i < piece.count; ++i) {
    const int next = i + 1 == piece.count ? 0 : i + 1;
    const double s = sides[i], t = sides[next];
    if (s <= 0.0) {
      in.at[in.count] = piece.at[i];
      in.walls[in.count++] = s == 0.0 && t > 0.0 ? wall : piece.walls[i];
    }
    if (s >= 0.0) {
      out.at[out.count] = piece.at[i];
      out.walls[out.count++] = s == 0.0 && t < 0.0 ? wall : piece.walls[i];
    }
    if ((s < 0.0 && t > 0.0) || (s > 0.0 && t < 0.0)) {
      const Vector2d x = piece.at[i] + (s / (s - t)) * (piece.at[next] - piece.at[i]);
      in.at[in.count] = out.at[out.count] = x;
      in.walls[in.count++] = s < 0.0 ? wall : piece.walls[i];
      out.walls[out.count++] = s > 0.0 ? wall : piece.walls[i];
    }
  }
}

}  // namespace touchstone::internal
