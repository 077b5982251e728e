// SPDX-License-Identifier: GPL-3.0-or-later
//
// The faces of M in doubles, for scans over all of them.
#ifndef TOUCHSTONE_EXACT_FACES_H_
#define TOUCHSTONE_EXACT_FACES_H_

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "touchstone/exact/convert.h"

namespace touchstone::exact {

// max of n.x over the vertices, in doubles.
double Largest(const ExactBodyData& body, const Eigen::Vector3d& n);

inline Eigen::Vector3d Vertex(const ExactBodyData& body, int i) {
  return {body.x[i], body.y[i], body.z[i]};
}

// Normals of Q's faces in P's frame, halved so that no component exceeds 1: cof(R) n. Entries of
// the cofactors are off by less than 32u, components of the result by 3 (32 + 8)u < 2^-46; so
// values n.x that follow are off by less than 4 PlacedPair::error (2^-43 of the size).
std::vector<Eigen::Vector3d> NormalsOfQ(const PlacedPair& pair);

// The arcs of all edge pairs in doubles, exact signs where they fail.
class ArcTest {
 public:
  explicit ArcTest(const PlacedPair& pair);

  // Calls found(e_p, e_q) for every properly crossing pair.
  void ForEachCrossing(const std::function<void(int, int)>& found) const;

  const Eigen::Vector3d& direction_q(int e_q) const { return directions_q_[e_q]; }

 private:
  bool Crosses(int e_p, int e_q, double c, double d) const;

  const PlacedPair& pair_;
  const std::vector<ExactEdge>& edges_p_;
  const std::vector<ExactEdge>& edges_q_;
  std::vector<Eigen::Vector3d> normals_q_, directions_q_;
};

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_FACES_H_
