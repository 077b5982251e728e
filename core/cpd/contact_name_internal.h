// SPDX-License-Identifier: MIT
//
// Candidates for the nearest point of ∂M, named by features: what a name means is never rounded.
#ifndef TOUCHSTONE_CORE_CPD_CONTACT_NAME_INTERNAL_H_
#define TOUCHSTONE_CORE_CPD_CONTACT_NAME_INTERNAL_H_

#include <Eigen/Core>
#include <array>
#include <optional>

#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/mesh/translation.h"
#include "touchstone/core/minkowski/convolution.h"

namespace touchstone::internal {

// A line in a facet's plane: where the plane of another facet crosses it, or an edge of its own.
struct ContactWall {
  bool is_edge = false;
  SumFacet facet;
  SumVertex from, to;
};

// The point nearest to the origin of a facet's plane and of the walls' planes: the foot on the
// plane, on a line, or the point that three planes have in common. Without a facet: a vertex of M.
struct ContactName {
  bool is_vertex = false;
  SumVertex vertex;
  SumFacet facet;
  int wall_count = 0;
  std::array<ContactWall, 2> walls;
};

// A contact plane in doubles, in the pair's scaled frame: normal . x = offset. The normal is
// outward of M and of unit length; each coordinate is within `error` of the exact unit normal's.
struct PlaneEstimate {
  Eigen::Vector3d normal;
  double offset;
  double error;
};
PlaneEstimate EstimatePlane(const MeshPair& pair, const SumFacet& facet);

// Where A is touched, in the pair's scaled frame, when B is moved by a point `q` of the facet.
Eigen::Vector3d ContactPointOnA(const MeshPair& pair, const SumFacet& facet,
                                const Eigen::Vector3d& q);

// The vertex of M in doubles.
inline Eigen::Vector3d EstimateVertex(const MeshPair& pair, const SumVertex& v) {
  return pair.a().points[v.a] - pair.b().points[v.b];
}

// The point in doubles, and a direction along which all its planes recede at the same rate of one:
// a step that way leaves every contact that the name holds.
struct PointEstimate {
  Eigen::Vector3d at;
  Eigen::Vector3d out;
};
// Nothing if the planes are parallel to rounding.
std::optional<PointEstimate> EstimatePoint(const MeshPair& pair, const ContactName& name);

// The point with big numbers in A's frame and true lengths; nothing if the planes have no single
// nearest point in common.
std::optional<ExactPoint> ExactPointOf(const MeshPair& pair, const ContactName& name);

// An exact point in doubles: each coordinate is within `error` of it.
struct RoundedPoint {
  Eigen::Vector3d at;
  double error;
};
RoundedPoint Rounded(const ExactPoint& point);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_CPD_CONTACT_NAME_INTERNAL_H_
