// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CPD_CONTACT_BODY_H_
#define TOUCHSTONE_CORE_CPD_CONTACT_BODY_H_

#include <memory>
#include <vector>

#include "touchstone/core/mesh/inner_balls.h"
#include "touchstone/core/mesh/triangle_mesh.h"
#include "touchstone/core/minkowski/feature_tree.h"
#include "touchstone/core/minkowski/gauss_map.h"

namespace touchstone {

// What a mesh contributes to depth queries, whatever its pose. Immutable; a copy is cheap.
//
// Complexity of making it: O(n sqrt n) on round bodies.
class ContactBody {
 public:
  explicit ContactBody(const TriangleMesh& mesh);

  struct Edge {
    int tail, head;   // vertices
    int left, right;  // faces
  };

  // Whether the other is a copy.
  bool IsSameAs(const ContactBody& other) const { return data_ == other.data_; }
  const TriangleMesh& mesh() const { return data_->mesh; }
  const GaussMap& gauss_map() const { return data_->gauss_map; }
  const Edge& edge(int e) const { return data_->edges[e]; }
  // A ball within the body that comes near the middle of face f; radius 0: none.
  const InnerBall& ball(int f) const { return data_->balls[f]; }

  const FeatureTree& faces() const { return data_->faces; }
  // Vertices that a face of another body can rest on.
  const FeatureTree& vertices() const { return data_->vertices; }
  const FeatureTree& convex_edges() const { return data_->convex_edges; }
  // Vertices that the solid cannot back out of, into itself, in any direction: a pair of these can
  // lock, each in the other's hollow, where no facet passes. Few bodies have any.
  const FeatureTree& locking_vertices() const { return data_->locking_vertices; }

 private:
  struct Data {
    TriangleMesh mesh;
    GaussMap gauss_map;
    std::vector<Edge> edges;
    std::vector<InnerBall> balls;
    FeatureTree faces, vertices, convex_edges, locking_vertices;
  };
  static Data MakeData(const TriangleMesh& mesh);

  std::shared_ptr<const Data> data_;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CPD_CONTACT_BODY_H_
