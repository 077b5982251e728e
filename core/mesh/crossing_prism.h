// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MESH_CROSSING_PRISM_H_
#define TOUCHSTONE_CORE_MESH_CROSSING_PRISM_H_

#include <Eigen/Core>

#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/mesh/translation.h"

namespace touchstone {

// An edge of one body and a face of the other.
struct Crossing {
  bool edge_is_of_a = false;
  int half_edge = -1;  // of the body whose edge it is
  int face = -1;       // of the other

  friend bool operator==(const Crossing&, const Crossing&) = default;
};

// The translations at which an edge of one body passes strictly through a face of the other, so
// that the solids overlap: edge ⊕ -face, or face ⊕ -edge, an open prism in M°. Its planes depend on
// five points and how far off these are; it is asked of a pair only if they are its own, to the
// last bit, so a prism that was made for other bodies or another pose never answers.
//
//   here      meaning, scaled as the pair
//   y         x where the edge is A's, -x where it is B's
//   n, c      n_k . y > c_k for all five k: two ends of the edge, three sides of the face
//
// What a prism says, the comparison of its two triangles in doubles says too (see Holds).
class CrossingPrism {
 public:
  // Whether the edge and the face can be told to cross at some translations. If not, this is no
  // prism of anything. Requires numbers of the pair's own.
  bool Make(const MeshPair& pair, const Crossing& crossing);

  // Whether it was made, and from points that the pair has where it has that edge and that face.
  bool IsOf(const MeshPair& pair) const;

  // Whether x is certain to lie within. Requires IsOf(pair).
  bool Holds(const MeshPair& pair, const Translation& x) const;

  const Crossing& crossing() const { return crossing_; }

 private:
  static constexpr int kPlanes = 5;

  bool Set(int k, const Eigen::Vector3d& normal, double error, double side,
           const Eigen::Vector3d& at);

  Crossing crossing_;
  Eigen::Vector3d points_[5];  // the edge's ends, the face's corners
  int side_ = 0;               // the edge's, in its face
  double error_a_ = 0.0, error_b_ = 0.0, difference_error_ = 0.0;
  Eigen::Vector3d normals_[kPlanes];  // the largest coordinate from 1/2 to 1
  double heights_[kPlanes];           // c
  double normal_error_ = 0.0;         // of each coordinate
  double turns_move_ = 0.0;           // how that grows with the error of x, at most
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MESH_CROSSING_PRISM_H_
