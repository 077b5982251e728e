// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CONVEX_SUPPORT_TABLE_H_
#define TOUCHSTONE_CORE_CONVEX_SUPPORT_TABLE_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

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
// Coordinates are kept relative to an interior point and over a power of two, so that the rounding
// of a height refers to the body's own extent, and no product overflows.
class SupportTable {
 public:
  SupportTable() = default;
  // Requires topology, facets and the first interior point. Complexity: O(n).
  explicit SupportTable(const ConvexPolyhedronData& data);

  // The vertex found from `start` (-1: from the table); adds the moves to *steps.
  int Find(const Eigen::Vector3d& direction, int start, long* steps) const;

 private:
  static constexpr int kLanes = 8;

  // Some of a corner's neighbours: spare lanes repeat the corner itself, which is never higher. A
  // corner with more than eight has several blocks in a row, its place being that of the first.
  struct alignas(64) Block {
    double x[kLanes], y[kLanes], z[kLanes];  // of the neighbours
    std::int32_t link[kLanes];               // their places
    double own_x, own_y, own_z;
    std::int32_t vertex;
    std::int32_t block_count;
  };
  static_assert(sizeof(Block) == 256);  // four cache lines

  void AddCorners(const ConvexPolyhedronData& data);
  void FillCells();
  std::size_t Cell(double x, double y, double z, double sum) const;

  int Scan(double x, double y, double z) const;
  // Climbs from the corner at `place`. `budget` bounds the blocks looked at: it is reduced by their
  // number, and a climb that used it up stops where it is.
  int Climb(int place, double x, double y, double z, long* budget, long* steps) const;

  std::vector<int> corner_of_vertex_;  // by vertex: the place of its corner, or of one near
  std::vector<Block> blocks_;
  std::vector<std::int32_t> cells_;  // places; 2 resolution_^2 of them
  int resolution_ = 0;               // 0 for bodies so small that a scan is faster
  std::vector<double> scan_;         // for those: x of all corners, then y, then z
  std::vector<std::int32_t> scan_vertices_;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CONVEX_SUPPORT_TABLE_H_
