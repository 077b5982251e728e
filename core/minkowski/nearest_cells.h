// SPDX-License-Identifier: MIT
//
// The lazy form of the boundary: its cells, nearest to a point first.
#ifndef TOUCHSTONE_CORE_MINKOWSKI_NEAREST_CELLS_H_
#define TOUCHSTONE_CORE_MINKOWSKI_NEAREST_CELLS_H_

#include <Eigen/Core>
#include <array>
#include <vector>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/base/status.h"
#include "touchstone/core/mesh/triangle_mesh.h"
#include "touchstone/core/minkowski/local_sum.h"

namespace touchstone {

// A cell of ∂M, in A's frame. Coordinates are rounded as in LocalSum.
struct BoundaryCell {
  SumFacet facet;
  std::vector<std::array<Eigen::Vector3d, 3>> triangles;  // counterclockwise from outside
  double distance = 0.0;                                  // from the point, in doubles
  bool is_sheet = false;  // M° lies on either side; one triangle each
};

// Yields the cells of ∂M in order of their distance from a point, each once. What has not been
// asked for has not been cut nor classified: facets are gathered in balls round the point, each
// half as large again as the one before, so a consumer that stops early has paid a small multiple
// of what the ball of the last cell costs by SphereHierarchy (see LocalMinkowskiSum).
//
// Cells whose distances tie within 2^-34 of the size of the pair may come in either order. Segments
// and points of ∂M with M° all around are not cells and do not come.
class NearestCells {
 public:
  NearestCells(TriangleMesh a, TriangleMesh b);

  // Begins anew. Returns kNonFinite or kOutOfRange for a bad point; then there are no cells.
  Status Start(const RelativePose& pose, const Eigen::Vector3d& point);

  // The next cell, or null when there are no more. It lives until the next call.
  const BoundaryCell* Next();

  // The radius within which cells have been cut so far.
  double radius() const { return radius_; }

 private:
  bool Grow();
  void TakeCells(const LocalSum& sum);

  LocalMinkowskiSum sums_;
  double size_;  // of the bodies
  RelativePose pose_;
  Eigen::Vector3d point_ = Eigen::Vector3d::Zero();
  double radius_ = 0.0;   // of the last ball
  double yielded_ = 0.0;  // cells up to this distance have come; none is near it
  double last_radius_ = 0.0;
  std::vector<BoundaryCell> cells_;
  std::size_t next_ = 0;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MINKOWSKI_NEAREST_CELLS_H_
