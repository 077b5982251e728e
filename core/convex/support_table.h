// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CONVEX_SUPPORT_TABLE_H_
#define TOUCHSTONE_CORE_CONVEX_SUPPORT_TABLE_H_

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "touchstone/core/base/lanes.h"

namespace touchstone {

struct ConvexPolyhedronData;

// What a body keeps to answer support queries: its corners, each with its neighbouring corners
// beside it, and a table from direction to a corner near the extreme one.
//
// Only the true corners of the body take part: vertices inside an edge or a facet are never needed
// as answers, and the edges that join corners (chains of collinear edges between facets of
// different planes, followed to their ends) generate the body's cone at each corner. So a corner
// that no neighbour beats is extreme, and there is no plateau to be stuck on.
//
// Two ways to ask. `Look` is what searches do: one cell, one block of eight single-precision lanes,
// no loop, no branch that depends on the answer; nearly always right, never relied upon. `Climb`
// goes on to a corner that no neighbour beats in doubles, and says whether the lanes prove it.
//
// Memory is laid out for pairs that come from memory: a small body is one run of cache lines; a
// large one costs a look the lines of one cell and one block, the corner's doubles among them.
class SupportTable {
 public:
  // A corner of the body, as doubles.
  struct Corner {
    double x, y, z;
  };

  SupportTable() = default;
  SupportTable(const SupportTable&) = delete;
  SupportTable& operator=(const SupportTable&) = delete;
  // Fills an empty table. Requires topology, facets and the first interior point. Complexity: O(n).
  void Build(const ConvexPolyhedronData& data);

  int corner_count() const { return corner_count_; }
  TOUCHSTONE_INLINE const Corner& corner(int i) const {
    return scan_count_ > 0 ? scan_corners_[i] : blocks_[i].corner;
  }
  // The vertex of the body that it is.
  TOUCHSTONE_INLINE int vertex(int i) const {
    return scan_count_ > 0 ? scan_vertices_[i] : blocks_[i].vertex;
  }
  // The corner that is vertex v, or one near it.
  int CornerOfVertex(int v) const { return corner_of_vertex_[v]; }

  // A corner that is extreme along (x, y, z), or nearly. Any direction is safe: one that is zero or
  // not finite gives some corner.
  TOUCHSTONE_INLINE int Look(double x, double y, double z) const {
    return LookWith<VectorLanes>(x, y, z);
  }
  // The same by plain loops: its twin, equal to the bit.
  int LookByScalars(double x, double y, double z) const { return LookWith<ScalarLanes>(x, y, z); }

  struct Peak {
    int corner;
    // No neighbour of the corner lies level with it or further along, for the direction given and
    // for every one whose coordinates differ by at most 2^-30 of its 1-norm: then no point of the
    // body does.
    bool certain;
  };
  // From `start` to a corner that no neighbour beats in doubles; adds the moves to *steps.
  Peak Climb(int start, const Eigen::Vector3d& direction, int* steps) const;

  // How much further along `direction` than this corner any point of the body is, at most: in the
  // body's lengths times that of the direction, whose coordinates are each off by `error` at most.
  // Zero where every neighbour is certainly lower, infinity where nothing can be proven. Looks only
  // at corners that the lanes cannot rank, so near a peak it is a few of them.
  double Rise(int corner, const Eigen::Vector3d& direction, double error) const;

  // The vertex found from the vertex `start` (-1: from the table); adds the moves to *steps.
  int Find(const Eigen::Vector3d& direction, int start, int* steps) const;

  // Asks for the memory that any query will touch.
  TOUCHSTONE_INLINE void Prefetch() const {
    if (scan_count_ == 0) return;
    Fetch(scan_lanes_.data(), scan_count_);
    Fetch(scan_corners_.data(), corner_count_);
    Fetch(scan_vertices_.data(), corner_count_);
  }

  // What it holds beyond its own size, in bytes.
  std::size_t heap_bytes() const;

 private:
  // Eight corners, relative to the body's middle and over a power of two, so that all lie within
  // [-1, 1].
  struct Lanes {
    float x[kLaneCount], y[kLaneCount], z[kLaneCount];
  };
  // A corner in lane 0 and up to seven of its neighbours; spare lanes repeat a neighbour. The
  // further blocks of a corner with more neighbours follow each other; there link[0] is how many
  // are left, itself included.
  struct alignas(64) Block {
    Lanes lanes;
    std::int32_t link[kLaneCount];  // which corners they are
    Corner corner;
    std::int32_t vertex;       // of the body
    std::int32_t more_blocks;  // -1, or the first of its further blocks
    // No point of the body is higher than the corner by more than this times the steepest slope of
    // its edges: the diameter over ConvexPolyhedron::corner_margin.
    double rise_per_slope;
  };
  static_assert(sizeof(Block) == 192);  // three cache lines
  static constexpr int kOwnNeighbors = kLaneCount - 1;

  // Bodies of up to so many corners keep all of them in lanes and need no blocks and no cells.
  static constexpr int kScanLimit = 32;
  static constexpr std::int32_t kScanTags = kScanLimit - 1, kBlockTags = kLaneCount - 1;

  // How far single precision may be off when two lanes are compared, for a direction of 1-norm 1
  // and coordinates within [-1, 1]. With u = 2^-23 (any rounding mode): a coordinate and a
  // component of the direction are each rounded to single precision, products and sums round three
  // times more, so a height is off by at most 5.1 u; two heights and the subtraction of the
  // slack, 11.3 u. A direction whose coordinates are off by 2^-30 changes the difference of two
  // heights, over an edge of at most 2 along each axis, by 6 * 2^-30 < 0.1 u. Rounding of the
  // direction in doubles and underflow disappear in the rest.
  static constexpr float kSlack = 0x1p-19F;  // 16 u

  template <class LaneType>
  static TOUCHSTONE_INLINE LaneType Heights(const Lanes& lanes, float x, float y, float z) {
    return x * LaneType::Load(lanes.x) + y * LaneType::Load(lanes.y) + z * LaneType::Load(lanes.z);
  }

  template <class LaneType>
  TOUCHSTONE_INLINE int LookWith(double x, double y, double z) const {
    auto fx = static_cast<float>(x), fy = static_cast<float>(y), fz = static_cast<float>(z);
    float sum = std::abs(fx) + std::abs(fy) + std::abs(fz);
    if (!(sum > 0x1p-80F && sum < 0x1p80F)) [[unlikely]] {
      if (!Rescale(&x, &y, &z)) return 0;
      fx = static_cast<float>(x), fy = static_cast<float>(y), fz = static_cast<float>(z);
      sum = std::abs(fx) + std::abs(fy) + std::abs(fz);
    }
    if (scan_count_ > 0) {
      const auto heights = [&](int i) {
        return Heights<LaneType>(scan_lanes_[i], fx, fy, fz)
            .template Tagged<kScanTags>(i * kLaneCount);
      };
      LaneType top = heights(0);
      for (int i = 1; i < scan_count_; ++i) top = LaneType::Larger(top, heights(i));
      return std::min(top.template TagOfLargest<kScanTags>(), corner_count_ - 1);
    }
    const std::size_t cell = Cell(fx, fy, fz, sum);
    const Block& block = blocks_[is_wide() ? wide_cells_[cell] : cells_[cell]];
    return block.link[Heights<LaneType>(block.lanes, fx, fy, fz)
                          .template Tagged<kBlockTags>(0)
                          .template TagOfLargest<kBlockTags>()];
  }

  // Directions with z >= 0, and those with z < 0, as the square [-1, 1]^2 each: the octahedron
  // |x| + |y| + |z| = sum seen along z is a square with its corners on the axes, and x + y, x - y
  // turn it upright. No branch, no folding. Rounding may carry x +- y past the sum by a few units
  // of 2^-23, which the factor below 1 keeps within the last cell.
  TOUCHSTONE_INLINE std::size_t Cell(float x, float y, float z, float sum) const {
    const float half = half_resolution_, scale = half / sum;
    const auto i = static_cast<std::uint32_t>(std::max(0.0F, half + scale * (x + y)));
    const auto j = static_cast<std::uint32_t>(std::max(0.0F, half + scale * (x - y)));
    const std::uint32_t lower = std::bit_cast<std::uint32_t>(z) >> 31;
    return (static_cast<std::size_t>(lower) * resolution_ + j) * resolution_ + i;
  }

  // A very long or very short direction brought near 1; false for zero, infinite or NaN.
  static bool Rescale(double* x, double* y, double* z);

  void AddCorners(const ConvexPolyhedronData& data);
  void PutLane(Lanes* lanes, int lane, const Corner& corner) const;
  void PutLink(Block* block, int lane, int corner) const;
  void FillBlocks(int corner, std::span<const int> neighbors);
  void FillCells();
  void FillScan(std::span<const Corner> corners, std::span<const std::int32_t> vertices);

  double Height(const Corner& corner, double x, double y, double z) const;
  // Calls visit(corner) for every corner that may be as far along as `corner` or further: in a
  // small body of all others, else of its neighbours. Returns how many blocks it looked at.
  template <class Visit>
  TOUCHSTONE_INLINE int VisitRivals(int corner, float x, float y, float z, Visit visit) const;
  // Climbs from a corner; (x, y, z) has a 1-norm of about 1. `budget` bounds the blocks looked at:
  // it is reduced by their number, and a climb that used it up stops where it is.
  Peak ClimbScaled(int start, double x, double y, double z, long* budget, int* steps) const;

  template <class T>
  static TOUCHSTONE_INLINE void Fetch(const T* first, int count) {
    const auto* bytes = reinterpret_cast<const char*>(first);
    for (int i = 0; i < count * static_cast<int>(sizeof(T)); i += 64) __builtin_prefetch(bytes + i);
  }

  bool is_wide() const { return corner_count_ > 0x10000; }

  std::int32_t corner_count_ = 0;
  std::int32_t scan_count_ = 0;  // lanes in use; 0 where the table serves
  std::int32_t resolution_ = 0;
  float half_resolution_ = 0.0F;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  std::vector<Block> blocks_;             // of the corners, then the further blocks
  std::vector<std::uint16_t> cells_;      // corners; 2 resolution_^2 of them
  std::vector<std::int32_t> wide_cells_;  // instead, for bodies of more than 2^16 corners
  alignas(64) std::array<Lanes, kScanLimit / kLaneCount> scan_lanes_{};
  std::array<Corner, kScanLimit> scan_corners_{};
  std::array<std::int32_t, kScanLimit> scan_vertices_{};

  std::vector<std::int32_t> corner_of_vertex_;
  double lane_scale_ = 1.0;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CONVEX_SUPPORT_TABLE_H_
