// SPDX-License-Identifier: MIT
#include "touchstone/core/convex/support_table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "touchstone/core/base/vector_clones.h"
#include "touchstone/core/convex/convex_polyhedron_data.h"

namespace touchstone {
namespace {

// Chosen by measurement: README.md.
constexpr int kScanLimit = 12;  // corners: a scan is faster up to here
constexpr double kCellsPerCorner = 8;
constexpr int kMaxResolution = 1024;
// Eight doubles in the compiler's own vector type: a loop over lanes is unrolled before it is
// vectorised.
using Lanes = double __attribute__((vector_size(64)));
using HalfLanes = double __attribute__((vector_size(32)));
constexpr long kFillBudget = 8;  // blocks per cell
constexpr int kScanLanes = 4;
static_assert(kScanLimit % kScanLanes == 0 && kScanLimit <= 32);

// How the faces meet at a vertex: the number of its edges between facets of different planes. Three
// or more at a corner, two inside an edge of the body, none inside a facet.
class CornerGraph {
 public:
  explicit CornerGraph(const ConvexPolyhedronData& data) : data_(data) {
    bends_.resize(data.vertex_count());
    for (int v = 0; v < data.vertex_count(); ++v) {
      for (int i = data.vertex_begin[v]; i < data.vertex_begin[v + 1]; ++i) bends_[v] += IsBend(i);
    }
  }

  int bends(int v) const { return bends_[v]; }
  bool IsCorner(int v) const { return bends_[v] >= 3; }

  // Whether the edge at place i of the vertex lists joins facets of different planes.
  bool IsBend(int i) const {
    const Edge& edge = data_.edges[data_.vertex_edges[i]];
    return data_.facet_of_face[edge.left] != data_.facet_of_face[edge.right];
  }

  // Follows the body's edge that begins at place i of a corner's lists to the corner at its other
  // end; `visit` sees the vertices between.
  template <class Visit>
  int FollowEdge(int i, Visit visit) const {
    int edge = data_.vertex_edges[i];
    int v = data_.vertex_neighbors[i];
    while (!IsCorner(v)) {
      visit(v);
      int next = data_.vertex_begin[v];
      while (!IsBend(next) || data_.vertex_edges[next] == edge) ++next;
      edge = data_.vertex_edges[next];
      v = data_.vertex_neighbors[next];
    }
    return v;
  }

 private:
  const ConvexPolyhedronData& data_;
  std::vector<int> bends_;
};

}  // namespace

SupportTable::SupportTable(const ConvexPolyhedronData& data) {
  AddCorners(data);
  if (static_cast<int>(scan_vertices_.size()) > kScanLimit) {
    FillCells();
    scan_vertices_.clear();
    return;
  }
  // Spare lanes repeat the first corner, and the smallest index wins.
  while (scan_vertices_.size() % kScanLanes != 0) scan_vertices_.push_back(scan_vertices_[0]);
  for (int axis = 0; axis < 3; ++axis) {
    for (int v : scan_vertices_) {
      const Block& block = blocks_[corner_of_vertex_[v]];
      scan_.push_back(axis == 0 ? block.own_x : axis == 1 ? block.own_y : block.own_z);
    }
  }
}

void SupportTable::AddCorners(const ConvexPolyhedronData& data) {
  const CornerGraph graph(data);
  const int n = data.vertex_count();
  int exponent = 0;
  std::frexp(data.max_coordinate, &exponent);
  const double scale = std::ldexp(1.0, -exponent);
  const Eigen::Vector3d center = scale * data.interior[0];
  const auto position = [&](int v) -> Eigen::Vector3d { return scale * data.vertices[v] - center; };

  corner_of_vertex_.assign(n, -1);
  int place = 0;
  for (int v = 0; v < n; ++v) {
    if (!graph.IsCorner(v)) continue;
    corner_of_vertex_[v] = place;
    scan_vertices_.push_back(v);
    place += (graph.bends(v) + kLanes - 1) / kLanes;
  }
  blocks_.resize(place);
  for (const int v : scan_vertices_) {
    const int first = corner_of_vertex_[v];
    const int block_count = (graph.bends(v) + kLanes - 1) / kLanes;
    const Eigen::Vector3d own = position(v);
    for (int i = 0; i < block_count; ++i) {
      Block& block = blocks_[first + i];
      std::fill_n(block.x, kLanes, own[0]);
      std::fill_n(block.y, kLanes, own[1]);
      std::fill_n(block.z, kLanes, own[2]);
      std::fill_n(block.link, kLanes, first);
      block.own_x = own[0];
      block.own_y = own[1];
      block.own_z = own[2];
      block.vertex = v;
      block.block_count = block_count;
    }
    int count = 0;
    for (int i = data.vertex_begin[v]; i < data.vertex_begin[v + 1]; ++i) {
      if (!graph.IsBend(i)) continue;
      const int w = graph.FollowEdge(i, [&](int between) { corner_of_vertex_[between] = first; });
      const Eigen::Vector3d p = position(w);
      Block& block = blocks_[first + count / kLanes];
      const int lane = count % kLanes;
      block.x[lane] = p[0];
      block.y[lane] = p[1];
      block.z[lane] = p[2];
      block.link[lane] = corner_of_vertex_[w];
      ++count;
    }
  }
  // Vertices inside a facet stand for some corner of it.
  std::vector<int> corner_of_facet(data.face_count(), -1);
  for (int f = 0; f < data.face_count(); ++f) {
    for (int i = data.face_begin[f]; i < data.face_begin[f + 1]; ++i) {
      const int v = data.face_vertices[i];
      if (graph.IsCorner(v)) corner_of_facet[data.facet_of_face[f]] = corner_of_vertex_[v];
    }
  }
  for (int v = 0; v < n; ++v) {
    if (corner_of_vertex_[v] >= 0) continue;
    const int face = data.vertex_faces[data.vertex_begin[v]];
    corner_of_vertex_[v] = corner_of_facet[data.facet_of_face[face]];
  }
}

// Directions with z >= 0, and those with z < 0, as the square [-1, 1]^2 each: the octahedron
// |x| + |y| + |z| = sum seen along z is a square with its corners on the axes, and x + y, x - y
// turn it upright. No branch, no folding. `sum` is positive; rounding may carry x +- y past it by a
// few units of 2^-52, which the factor below 1 keeps within the last cell.
std::size_t SupportTable::Cell(double x, double y, double z, double sum) const {
  const double half = 0.5 * (1.0 - 0x1p-40) * resolution_;
  const double scale = half / sum;
  const auto i = static_cast<std::size_t>(std::max(0.0, half + scale * (x + y)));
  const auto j = static_cast<std::size_t>(std::max(0.0, half + scale * (x - y)));
  const auto lower = static_cast<std::size_t>(std::bit_cast<std::uint64_t>(z) >> 63);
  const auto resolution = static_cast<std::size_t>(resolution_);
  return (lower * resolution + j) * resolution + i;
}

void SupportTable::FillCells() {
  const auto corner_count = static_cast<double>(scan_vertices_.size());
  resolution_ = static_cast<int>(std::sqrt(0.5 * kCellsPerCorner * corner_count)) + 1;
  resolution_ = std::min(resolution_, kMaxResolution);
  cells_.resize(2 * static_cast<std::size_t>(resolution_) * resolution_);
  // A cell is only where climbs begin, so its corner need not be extreme. What one cell leaves of
  // its share of looks others may use; together they are linear, however many edges a corner has.
  long budget = static_cast<long>(blocks_.size()), steps = 0;
  int place = 0;
  std::size_t cell = 0;
  for (int lower = 0; lower < 2; ++lower) {
    for (int j = 0; j < resolution_; ++j) {
      for (int i = 0; i < resolution_; ++i, ++cell) {
        const double sum = (2 * i + 1.0) / resolution_ - 1.0;         // x + y
        const double difference = (2 * j + 1.0) / resolution_ - 1.0;  // x - y
        const double x = 0.5 * (sum + difference), y = 0.5 * (sum - difference);
        const double z = 1.0 - std::abs(x) - std::abs(y);
        // The row before is a better neighbour than the other end of this one.
        if (i == 0 && j > 0) place = cells_[cell - resolution_];
        if (budget > 0) place = Climb(place, x, y, lower == 0 ? z : -z, &budget, &steps);
        cells_[cell] = place;
        budget += kFillBudget;
      }
    }
  }
}

TOUCHSTONE_VECTOR_CLONES
int SupportTable::Scan(double x, double y, double z) const {
  // Which corner is the highest is as good as random: a branch on it costs more than all heights.
  const auto n = static_cast<int>(scan_vertices_.size());
  const double* xs = scan_.data();
  const double* ys = xs + n;
  const double* zs = ys + n;
  std::array<double, kScanLimit> heights;
  int filled = 0;
  do {
    for (int k = 0; k < kScanLanes; ++k, ++filled) {
      heights[filled] = x * xs[filled] + y * ys[filled] + z * zs[filled];
    }
  } while (filled < n);
  std::array<double, kScanLanes> top = {heights[0], heights[1], heights[2], heights[3]};
  for (int i = kScanLanes; i < n; i += kScanLanes) {
    for (int k = 0; k < kScanLanes; ++k) top[k] = std::max(top[k], heights[i + k]);
  }
  const double highest = std::max(std::max(top[0], top[1]), std::max(top[2], top[3]));
  unsigned is_highest = 0;
  for (int i = 0; i < n; ++i) is_highest |= static_cast<unsigned>(heights[i] == highest) << i;
  return scan_vertices_[std::countr_zero(is_highest)];
}

// Ends, because each move strictly raises the height, and the height of a corner is one number: the
// same doubles in the same order of operations, wherever its coordinates are stored.
TOUCHSTONE_VECTOR_CLONES
int SupportTable::Climb(int place, double x, double y, double z, long* budget, long* steps) const {
  const Block* block = &blocks_[place];
  double height = x * block->own_x + y * block->own_y + z * block->own_z;
  while (*budget > 0) {
    std::int32_t next = place;
    const int block_count = block->block_count;
    *budget -= block_count;
    for (int i = 0; i < block_count; ++i, ++block) {
      Lanes xs, ys, zs;
      std::memcpy(&xs, block->x, sizeof xs);
      std::memcpy(&ys, block->y, sizeof ys);
      std::memcpy(&zs, block->z, sizeof zs);
      const Lanes h = x * xs + y * ys + z * zs;
      HalfLanes low, high;
      std::memcpy(&low, &h, sizeof low);
      std::memcpy(&high, reinterpret_cast<const char*>(&h) + sizeof low, sizeof high);
      const HalfLanes top = low > high ? low : high;
      const double highest = std::max(std::max(top[0], top[1]), std::max(top[2], top[3]));
      if (highest > height) {
        height = highest;
        unsigned is_highest = 0;
        for (int k = 0; k < 8; ++k) is_highest |= static_cast<unsigned>(h[k] == highest) << k;
        next = block->link[std::countr_zero(is_highest)];
      }
    }
    if (next == place) break;
    place = next;
    block = &blocks_[place];
    ++*steps;
  }
  return place;
}

int SupportTable::Find(const Eigen::Vector3d& direction, int start, long* steps) const {
  double x = direction[0], y = direction[1], z = direction[2];
  double sum = std::abs(x) + std::abs(y) + std::abs(z);
  if (!(sum > 0x1p-400 && sum < 0x1p400)) {
    // Very long or short: scale it. Zero, infinite, NaN: any vertex is as good.
    const double largest = std::max({std::abs(x), std::abs(y), std::abs(z)});
    if (!direction.allFinite() || largest == 0.0) return blocks_[0].vertex;
    int exponent = 0;
    std::frexp(largest, &exponent);
    x = std::ldexp(x, -exponent);
    y = std::ldexp(y, -exponent);
    z = std::ldexp(z, -exponent);
    sum = std::abs(x) + std::abs(y) + std::abs(z);
  }
  if (resolution_ == 0) return Scan(x, y, z);
  long unbounded = std::numeric_limits<long>::max();
  const int place = start >= 0 ? corner_of_vertex_[start] : cells_[Cell(x, y, z, sum)];
  return blocks_[Climb(place, x, y, z, &unbounded, steps)].vertex;
}

}  // namespace touchstone
