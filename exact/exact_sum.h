// SPDX-License-Identifier: GPL-3.0-or-later
//
//   here            meaning
//   M               A ⊕ -B, in the integers of the pair: see exact/mesh_pair.h
//   N, k            a facet's outward normal, and N.x = k its plane
#ifndef TOUCHSTONE_EXACT_EXACT_SUM_H_
#define TOUCHSTONE_EXACT_EXACT_SUM_H_

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "touchstone/core/minkowski/sum_boundary.h"
#include "touchstone/exact/mesh_pair.h"
#include "touchstone/exact/triangle_cells.h"

namespace touchstone::exact {

// An edge of a mesh: from its tail to its head with one face on the left and one on the right.
struct MeshEdge {
  int tail, head;
  int left_apex, right_apex;  // the faces' third vertices
};

// What follows from a mesh's faces alone. Edges are numbered in the order in which a walk over the
// faces 0, 1, ... and their sides first meets them; the first face is on the left.
struct MeshFeatures {
  explicit MeshFeatures(const TriangleMesh& mesh);

  std::vector<MeshEdge> edges;
  std::vector<std::vector<int>> neighbors;  // of a vertex
};

struct SumPlane {
  IntegerVector normal;  // outward
  Integer offset;        // normal . x of its points
};

// Vertices, facets and points of M by name. Keeps a reference to the pair.
class ExactSum {
 public:
  explicit ExactSum(const PlacedMeshPair& pair);

  const PlacedMeshPair& pair() const { return pair_; }
  const MeshFeatures& a() const { return a_; }
  const MeshFeatures& b() const { return b_; }

  // Whether a name names something; all else here requires it.
  bool IsValid(const SumVertex& vertex) const;
  bool IsValid(const SumFacet& facet) const;

  IntegerVector Point(const SumVertex& vertex) const {
    return pair_.point_a(vertex.a) - pair_.point_b(vertex.b);
  }
  // Counterclockwise seen from outside.
  std::vector<SumVertex> Corners(const SumFacet& facet) const;
  SumPlane Plane(const SumFacet& facet) const;
  // One triangle, or the two halves of a parallelogram. Requires a facet of positive area.
  std::vector<RationalTriangle> Triangles(const SumFacet& facet) const;

  // The one point that a name stands for; nothing if it is none, or not one. `facets` are those
  // that the name counts through.
  std::optional<RationalPoint> Point(const SumPointName& name,
                                     std::span<const SumFacet> facets) const;

  // Whether the two features can be in contact at inner points of theirs, as far as their edges
  // tell. (f, v): no edge at v leads strictly into the solid behind f, or some of the other body
  // lies in it. (e, e): both edges are convex, flat at most, and their wedges lie on either side of
  // the plane. A wedge of more than a half-turn holds one half of any line through an inner point
  // of its edge in its inside, but for the edge's own line. So a facet of which this is false has
  // no point of ∂M in its inside. Facets of no area are no contacts.
  bool CanTouch(const SumFacet& facet) const;

  // All facets of M: every pair of a face and a vertex, and of two edges, both ways round. If
  // `contacts_only`, those that can touch, without vertices within flat facets or straight edges
  // and without flat edges. What these touch others cover: sliding along the plane that they share,
  // each against the other, two features end where one of them is a corner or both are borders.
  // Complexity: O(m n).
  std::vector<SumFacet> AllFacets(bool contacts_only) const;

  // As a translation in true units, and back.
  ExactTranslation ToTranslation(const RationalPoint& x) const;
  RationalPoint FromDoubles(const Eigen::Vector3d& x) const;
  // A point in true units.
  RationalPoint ToTrue(const RationalPoint& x) const;

  // A positive s such that moving x by s N for any N of a facet crosses the plane of no facet of M
  // that x does not lie on. For the plane N', k' and x = X / d, |N'.x - k'| is 0 or at least 1 / d;
  // no coordinate of a normal exceeds n = 8 c^2 for vertices of at most c, so that |s N'.N| <= 3 s
  // n^2, and s = 1 / (4 d n^2) will do.
  mpq_class StepBelowAnyOther(const RationalPoint& x) const;

 private:
  bool IsNeedless(const SumFacet& facet) const;

  const PlacedMeshPair& pair_;
  const MeshFeatures a_, b_;
  // Edges that are flat, and vertices within flat facets or straight edges.
  std::vector<char> flat_edges_a_, flat_edges_b_, inner_vertices_a_, inner_vertices_b_;
  mpq_class unit_;          // true length of 1
  Integer largest_normal_;  // n
};

// x + s direction.
RationalPoint Along(const RationalPoint& x, const mpq_class& s, const IntegerVector& direction);
// The sign of N.x - k.
int Side(const SumPlane& plane, const RationalPoint& x);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_EXACT_SUM_H_
