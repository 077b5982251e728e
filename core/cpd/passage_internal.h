// SPDX-License-Identifier: MIT
//
// Where a segment of one body passes through a face of the other, by roundings: to choose among
// prisms before any is made.
#ifndef TOUCHSTONE_CORE_CPD_PASSAGE_INTERNAL_H_
#define TOUCHSTONE_CORE_CPD_PASSAGE_INTERNAL_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "touchstone/core/mesh/mesh_pair.h"

namespace touchstone::internal {

// A face of a body that is moved by `shift`.
struct MovedFace {
  const Eigen::Vector3d& normal;  // of any length
  Eigen::Vector3d corners[3];     // counterclockwise round it

  MovedFace(const PlacedMesh& body, int face, const Eigen::Vector3d& shift)
      : normal(body.planes[face].normal) {
    const Triangle& vertices = body.mesh.face(face);
    for (int k = 0; k < 3; ++k) corners[k] = body.points[vertices[k]] + shift;
  }

  // The normal's length times that of the point over the plane.
  double Over(const Eigen::Vector3d& point) const { return normal.dot(point - corners[0]); }
};

// A segment, and its ends over a face.
struct Segment {
  const Eigen::Vector3d &tail, &head;
  double tail_over, head_over;
};

inline constexpr double kNoPassage = -std::numeric_limits<double>::infinity();

// The least distance of the origin from the five planes of the prism of a segment and a face:
// positive where the segment passes through the face, negative where it passes by, and kNoPassage
// where that is by more than `outside`.
inline double PassageMargin(const Segment& segment, const MovedFace& face, double outside) {
  const auto is_far = [&](double height, double squared_length) {
    return outside == 0.0 || height * height > outside * outside * squared_length;
  };
  const bool is_across = segment.tail_over * segment.head_over < 0.0;
  const double nearer = std::min(std::abs(segment.tail_over), std::abs(segment.head_over));
  if (!is_across && is_far(nearer, face.normal.squaredNorm())) return kNoPassage;
  const bool is_upward = segment.tail_over < segment.head_over;
  const Eigen::Vector3d along = is_upward ? Eigen::Vector3d(segment.head - segment.tail)
                                          : Eigen::Vector3d(segment.tail - segment.head);
  double inward[3], squared[3];
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d across = along.cross(face.corners[(k + 1) % 3] - face.corners[k]);
    inward[k] = across.dot(segment.tail - face.corners[k]);
    squared[k] = across.squaredNorm();
    if (!(inward[k] > 0.0) && is_far(inward[k], squared[k])) return kNoPassage;
  }
  double margin = (is_across ? nearer : -nearer) / face.normal.norm();
  for (int k = 0; k < 3; ++k) margin = std::min(margin, inward[k] / std::sqrt(squared[k]));
  return margin;
}

// Calls visit(k, margin) for side k of the first face and the second, for sides in the order
// `first`, `first` + 1, ... of their number round the face.
template <class Visit>
void VisitPassages(const MovedFace& of_sides, int first, int count, const MovedFace& face,
                   double outside, const Visit& visit) {
  double over[3];
  for (int k = 0; k < 3; ++k) over[k] = face.Over(of_sides.corners[k]);
  for (int i = first; i < first + count; ++i) {
    const int k = i % 3, next = (k + 1) % 3;
    if (outside == 0.0 && !(over[k] * over[next] < 0.0)) continue;
    const Segment side = {of_sides.corners[k], of_sides.corners[next], over[k], over[next]};
    const double margin = PassageMargin(side, face, outside);
    if (margin > kNoPassage) visit(k, margin);
  }
}

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_CPD_PASSAGE_INTERNAL_H_
