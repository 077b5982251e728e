// SPDX-License-Identifier: MIT
//
//   paper     here             meaning, in A's frame
//   A, B      pair             the bodies; B placed in A's frame by the pair's pose
//   o         the origin       B where it is: no translation
//   q         translation      B moved by q, or A by -q, and the bodies just touch: q is on ∂M,
//                              M° = int A ⊕ -int B and ∂M = closure(M°) minus M°
//   PD(A, B)  depth            |q| for the q nearest to o
#ifndef TOUCHSTONE_CORE_CPD_MESH_PENETRATION_DEPTH_H_
#define TOUCHSTONE_CORE_CPD_MESH_PENETRATION_DEPTH_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "touchstone/core/base/verdict.h"
#include "touchstone/core/cpd/contact_body.h"
#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/minkowski/convolution.h"

namespace touchstone {

struct MeshDepthOptions {
  // kExact goes on to big numbers where doubles cannot tell whether a candidate lies in M°, and to
  // the arrangement of all facets in the way where single points do not tell: a line of points that
  // no crossing of an edge and a face buries, in placements on a grid. With kFloat these are left
  // open, and count for the lower bound.
  Certainty certainty = Certainty::kExact;
  // Whether to confirm the answer's point itself, by its exact name: then the bounds are its
  // distance, rounded down and up.
  bool confirm_exactly = false;
  // Pieces of facets looked at, at most.
  int piece_limit = 200000;
};

enum class MeshDepthStatus : std::uint8_t {
  kSeparate,  // the interiors do not meet: depth 0
  kCertain,   // every point nearer than the lower bound was proven to lie in M°, and some point
              // no further than the upper bound not to: the bounds differ by roundings alone
  kOpen,      // the same, but doubles left some point below the translation's length open: under
              // Certainty::kFloat only
  kLimit,     // stopped at the limit; the bounds hold
};
std::string_view ToString(MeshDepthStatus status);

// What the nearest point of ∂M is.
enum class NearestKind : std::uint8_t {
  kNone,
  kPlaneFoot,       // on one facet
  kCrossingFoot,    // on the line where two facets cross
  kReflexEdgeFoot,  // on an edge of a facet: where two meet along a natural reflex edge
  kTriplePoint,     // of three facets, or a facet's edge and a facet
  kNaturalVertex,   // a vertex of A against one of B
  kBoxes,           // no candidate was nearer than what parts the bodies' boxes
  kBoundary,        // a point of the exact arrangement of facets, which decided
};
std::string_view ToString(NearestKind kind);

// One of the contacts that hold B off A at the answer.
struct DepthContact {
  SumFacet features;       // for kNaturalVertex and kReflexEdgeFoot: a facet that has it
  Eigen::Vector3d normal;  // of unit length, from A to B
  // Where it is: on A where A is, and on B where B is before it is moved.
  Eigen::Vector3d point_on_a, point_on_b;
  double weight;  // the direction of q is the sum of weight * normal; not negative
};

struct MeshDepthResult {
  MeshDepthStatus status = MeshDepthStatus::kSeparate;
  // Proven: B moved by it does not overlap A; where `is_exact` or `by_boundary`, moved by a point
  // that this is the rounding of. Zero where they do not overlap to begin with.
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  double lower_bound = 0.0, upper_bound = 0.0;  // of the depth; the upper one is |translation|
  bool by_boundary = false;                     // the arrangement decided
  bool is_exact = false;                        // the answer's own point was confirmed exactly
  NearestKind kind = NearestKind::kNone;
  std::array<DepthContact, 3> contacts;
  int contact_count = 0;

  // The rates of the depth with B's motion, where the contacts stay what they are: with B's
  // translation, and with a turn of B about the origin of its own frame (axis times angle, in A's
  // frame). A penalty force on B is along minus these.
  std::optional<Eigen::Vector3d> rate_of_translation, rate_of_rotation;

  // Work done.
  int node_pairs = 0, facets = 0, pieces = 0, memberships = 0, exact_memberships = 0, prisms = 0,
      balls = 0;
  bool was_warm = false;  // the cached answer's features gave the upper bound
};

namespace internal {
struct DepthScratch;
}

// Owned by the caller; one per thread; any pair. Keeps what the last answer was made of, and
// storage. The bounds of answers hold whatever it keeps.
class MeshDepthCache {
 public:
  MeshDepthCache();
  ~MeshDepthCache();
  MeshDepthCache(MeshDepthCache&&) noexcept;
  MeshDepthCache& operator=(MeshDepthCache&&) noexcept;

  // Forgets the last answer, not the storage.
  void Clear();
  internal::DepthScratch& scratch() { return *scratch_; }

 private:
  std::unique_ptr<internal::DepthScratch> scratch_;
};

// The least translation that ends the overlap of two closed meshes: global, Euclidean, with bounds
// that are proven.
//
// Every point of ∂M lies on a facet of the convolution that has the origin on its inner side, or is
// a vertex of A against one of B. Pieces of facets are taken in the order of their distance. The
// nearest point of a piece is looked for in convex sets known to lie in M° (burial_internal.h);
// what such a set covers is cut off, and what is left waits for its turn. The first nearest point
// that is not in M° is the answer. Cuts run along planes of contacts, so the answer is found by its
// name: the foot on a plane or on a line, a triple point, a vertex; where doubles cannot place it,
// it is placed exactly.
//
// Requires `a` and `b` made from the pair's meshes. |q| is symmetric under a swap of the bodies,
// unchanged by a rigid motion of both, and changes no faster than B moves by translation.
//
// Complexity: O(k log k) for k pieces below the depth, each with O(w) for w sets at hand. No
// errors. Source: Lee, Behar, Lien, Kim 2016, equation 3.
MeshDepthResult MeshPenetrationDepth(const MeshPair& pair, const ContactBody& a,
                                     const ContactBody& b, const MeshDepthOptions& options = {},
                                     MeshDepthCache* cache = nullptr);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CPD_MESH_PENETRATION_DEPTH_H_
