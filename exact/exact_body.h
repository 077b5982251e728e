// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_EXACT_BODY_H_
#define TOUCHSTONE_EXACT_EXACT_BODY_H_

#include <Eigen/Core>
#include <memory>

#include "touchstone/core/convex/convex_polyhedron.h"

namespace touchstone::exact {

struct ExactBodyData;

// A body as the exact half sees it: its vertices and interior points as integers over a common
// power of two, its faces as they were given, and what follows from those alone (edges, neighbours,
// normals, the proof that its interior points are interior), each computed once, when first needed.
//
// Nothing else of the core's preprocessing is read. A copy shares the data; any number of threads
// may use one. Keep it beside a body that many queries use: what was computed stays computed.
//
// Edges are numbered in the order in which a walk over the faces 0, 1, ... and their loops first
// meets them: step k of face f runs from face(f)[k] (the tail) to the next vertex (the head).
class ExactBody {
 public:
  // Implicit, so that every function here also takes a plain ConvexPolyhedron.
  ExactBody(const ConvexPolyhedron& body);  // NOLINT(google-explicit-constructor)
  // The same body with two other interior points: what is judged is then the query with those.
  ExactBody(const ConvexPolyhedron& body, const Eigen::Vector3d& interior_0,
            const Eigen::Vector3d& interior_1);

  const ConvexPolyhedron& body() const;

  int edge_count() const;
  // The two vertices of an edge, tail first.
  std::pair<int, int> edge(int e) const;

  // Whether interior point i is strictly inside every face's plane, by exact signs.
  bool InteriorPointIsInterior(int i) const;

  const ExactBodyData& data() const { return *data_; }

 private:
  std::shared_ptr<const ExactBodyData> data_;
};

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_EXACT_BODY_H_
