// SPDX-License-Identifier: MIT
//
//   here          meaning, in A's frame
//   s, t          B is moved by t s; t is a number, not a length
//   [enter, leave]  the t for which two faces share a point: a line against their Minkowski
//                 difference, a convex polytope with facets across the faces' normals, the cross
//                 products of a side of each, and where it is flat, those of a normal and a side
#ifndef TOUCHSTONE_CORE_MESH_SURFACE_TRAVEL_H_
#define TOUCHSTONE_CORE_MESH_SURFACE_TRAVEL_H_

#include <Eigen/Core>
#include <vector>

#include "touchstone/core/mesh/mesh_pair.h"

namespace touchstone {

struct SurfaceTravelResult {
  bool is_hit = false;  // exactly: two faces share a point for some t in [0, reach]
  // Of the first such t, where is_hit: proven bounds, and a double between them.
  double travel = 0.0, lower_bound = 0.0, upper_bound = 0.0;
  int face_a = -1, face_b = -1;  // that meet for some t within the bounds
  // What parts these two just before, from A to B, of unit length.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  long node_pairs = 0, face_pairs = 0;  // compared
  int exact_pairs = 0;                  // of faces, with big numbers
};

// Owned by the caller: storage, which answers do not depend on. One per thread; any pair.
struct SurfaceTravelCache {
  struct Waiting {
    double enter;
    int a, b;
  };
  // Two faces that may meet; lengths as the search has them.
  struct Candidate {
    double enter, enter_at_most, travel;
    int face_a, face_b;
    Eigen::Vector3d normal;
    enum class State { kOpen, kCertain, kExact, kNever } state;
  };
  std::vector<Waiting> queue;
  std::vector<Candidate> candidates;
};

// When do the surfaces of A and B + t s first meet, for t in [0, reach]? For bodies that share no
// point at t = 0 that is when the bodies first do, be it a graze.
//
// Requires a finite s of a length within [1e-100, 1e100] and a reach within [0, 1e100]. Boxes that
// the way does not cross are proven to be missed; pairs of faces are bounded in doubles from both
// sides; where these bounds leave open which pair is first, or whether there is one, big numbers
// decide. Where the first pair was decided so, `travel` is the double nearest to the truth.
//
// Complexity: O(k + log n) for k pairs of faces whose boxes the way crosses. No errors.
SurfaceTravelResult SurfaceTravel(const MeshPair& pair, const Eigen::Vector3d& s, double reach,
                                  SurfaceTravelCache* cache = nullptr);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MESH_SURFACE_TRAVEL_H_
