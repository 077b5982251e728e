// SPDX-License-Identifier: MIT
//
//   paper       here               meaning, in A's frame
//   M°, ∂M      boundary.h         int A ⊕ -int B, open; closure(M°) minus M°
//   S, ε-ball   Ball               a closed ball; its centre is a translation x of B
//   ∂M(S)       LocalSum           the cells of ∂M that meet S
//   BSH         kSphereHierarchy   section 5.1, with Theorem 2 mended
//   Gap Fill.   kGapFilling        section 5.2, made complete
#ifndef TOUCHSTONE_CORE_MINKOWSKI_LOCAL_SUM_H_
#define TOUCHSTONE_CORE_MINKOWSKI_LOCAL_SUM_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/base/status.h"
#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/mesh/triangle_mesh.h"
#include "touchstone/core/minkowski/convolution.h"
#include "touchstone/core/minkowski/sum_point_name.h"

namespace touchstone {

// A closed ball of translations of B, in A's frame and the caller's units. Radius 0 is a point,
// which meets what it lies on.
struct Ball {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0.0;
};

// How the facets that matter are found. What comes out is the same.
enum class LocalBuilder : std::uint8_t {
  kFull,             // the whole boundary, of which the ball's part is kept
  kBruteForce,       // all facets of the convolution, then the ball
  kSphereHierarchy,  // both bodies' bounding spheres and normal cones, against the ball
  kGapFilling,       // what the last update knew, mended
};
std::string_view ToString(LocalBuilder builder);
std::optional<LocalBuilder> LocalBuilderFromString(std::string_view word);

// Of a facet, against the last update.
enum class FacetChange : std::uint8_t { kNew, kKept, kDropped };

// The part of ∂M in a ball.
//
// A facet's part of ∂M is cut into cells: its open connected pieces after every facet that meets it
// has cut it, wherever that is. The local sum is made of all cells whose closure meets the ball,
// each of them whole, also where it reaches beyond; so a cell has the same corners whatever the
// ball, and consumers may enlarge the ball without seeing what they have seen change. That
// defines it; the builder and what was asked before have no say. (Distances from the ball's centre
// are doubles: a cell that misses the ball by less than 2^-36 of the size of the pair, which is
// max |a| + max |R b| + |t|, may count as meeting it.)
//
// Order: cells by facet, facets by name. Two builders list the same triangles of the same corners;
// where several names fit a point (in degenerate positions) they may choose different ones, and the
// rounding with it.
struct LocalSum {
  // kNonFinite or kOutOfRange: the ball is NaN, infinite or of negative radius; all else is empty.
  Status status;

  // Points by name, and their roundings, each within `rounding` of the exact one; what is built on
  // them is exact. Facet numbers in names are those of `facets`.
  std::vector<SumPointName> names;
  std::vector<Eigen::Vector3d> vertices;
  double rounding = 0.0;

  // By name: those that cells lie on, and those that names of points mention.
  std::vector<SumFacet> facets;
  // kNew: this update's `facets` has it and the last one's had not. kKept: both.
  std::vector<FacetChange> changes;
  std::vector<SumFacet> dropped;  // the last update's had it and this one's has not

  // The boundary of the closure of M°, counterclockwise seen from outside. Numbers of cells rise.
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> facet_of_triangle;
  std::vector<int> cell_of_triangle;
  // The triangle across the side from corner k to corner k + 1; -1 where the surface goes on in
  // cells that do not meet the ball, and where it touches itself: more than two triangles come
  // together there.
  std::vector<std::array<int, 3>> neighbors;

  // Outward, of unit length: of the facet, not of the rounded corners.
  std::vector<Eigen::Vector3d> triangle_normals;

  // The mean of the normals of the triangles listed, by their angles at the vertex: of unit length.
  // At a vertex that lies in the ball all of ∂M's triangles are listed, so it is that of ∂M.
  std::vector<Eigen::Vector3d> vertex_normals;
  // Whether a side without a neighbour ends there: then triangles may be missing.
  std::vector<std::uint8_t> is_border_vertex;

  // What of ∂M has M° all around it and meets the ball: triangles with M° on either side, segments,
  // and points.
  std::vector<std::array<int, 3>> sheets;
  std::vector<int> facet_of_sheet;
  std::vector<std::array<int, 2>> segments;
  std::vector<int> points;

  // Counts of the work done. Facets tried for support; facets found in the ball; pairs of facets
  // compared; segments in which they cross; cells; patches and tests of membership.
  long candidates = 0, gathered = 0, facet_pairs = 0, crossings = 0, cells = 0, patches = 0,
       memberships = 0, exact_signs = 0;
  // Whether gap filling went by what an earlier update had gathered.
  bool reused = false;
  // Patches that membership calls separate: 0, or the bodies' surfaces are no embedded ones.
  int detached_patches = 0;

  int cell_count() const { return cell_of_triangle.empty() ? 0 : cell_of_triangle.back() + 1; }
};

struct LocalSumOptions {
  LocalBuilder builder = LocalBuilder::kSphereHierarchy;
};

// Local sums of one pair of meshes, for a ball and a pose at a time, in storage that is used again.
// One per thread. No errors but the ball's; any pose and any ball may follow any other.
//
// Complexity: of making it O(n log n). Of an update O(n) to place B, and what the builder takes:
//   kFull             as BuildSumBoundary
//   kBruteForce       as ReducedConvolution, and k log k for k facets that meet the ball or cross
//                     such
//   kSphereHierarchy  O(log n) for each of the k, on round bodies; k log k
//   kGapFilling       O(1) for each of the k while the motion stays small; k log k
class LocalMinkowskiSum {
 public:
  LocalMinkowskiSum(TriangleMesh a, TriangleMesh b, const LocalSumOptions& options = {});
  ~LocalMinkowskiSum();
  LocalMinkowskiSum(LocalMinkowskiSum&&) noexcept;
  LocalMinkowskiSum& operator=(LocalMinkowskiSum&&) noexcept;

  // The local sum at this pose and ball. It lives until the next update.
  const LocalSum& Update(const RelativePose& pose, const Ball& ball);
  const LocalSum& sum() const;

  // The pair as the last update placed it.
  const MeshPair& pair() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MINKOWSKI_LOCAL_SUM_H_
