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
constexpr double kCellsPerCorner = 8;
constexpr int kMaxResolution = 2048;
constexpr long kFillBudget = 8;  // blocks per cell

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

void SupportTable::Build(const ConvexPolyhedronData& data) {
  AddCorners(data);
  if (scan_count_ == 0) FillCells();
}

void SupportTable::AddCorners(const ConvexPolyhedronData& data) {
  const CornerGraph graph(data);
  const int n = data.vertex_count();
  center_ = data.interior[0];
  corner_of_vertex_.assign(n, -1);
  std::vector<Corner> corners;
  std::vector<std::int32_t> vertices;
  double extent = 0.0;
  for (int v = 0; v < n; ++v) {
    if (!graph.IsCorner(v)) continue;
    const Eigen::Vector3d& x = data.vertices[v];
    extent = std::max(extent, (x - center_).cwiseAbs().maxCoeff());
    corner_of_vertex_[v] = static_cast<std::int32_t>(corners.size());
    corners.push_back({x[0], x[1], x[2]});
    vertices.push_back(v);
  }
  corner_count_ = static_cast<std::int32_t>(corners.size());
  // Extents lie within 1e-117 and 1e101.
  int exponent = 0;
  std::frexp(extent, &exponent);
  lane_scale_ = std::ldexp(1.0, -exponent);

  if (corner_count_ <= kScanLimit) {
    FillScan(corners, vertices);
  } else {
    const auto further_blocks = [&](int i) {
      const int spare = std::max(graph.bends(vertices[i]) - kOwnNeighbors, 0);
      return (spare + kOwnNeighbors - 1) / kOwnNeighbors;
    };
    int block_count = corner_count_;
    for (int i = 0; i < corner_count_; ++i) block_count += further_blocks(i);
    blocks_.resize(block_count);
    int next = corner_count_;
    for (int i = 0; i < corner_count_; ++i) {
      const int count = further_blocks(i);
      const double margin = data.corner_margins[vertices[i]];
      blocks_[i].corner = corners[i];
      blocks_[i].vertex = vertices[i];
      blocks_[i].more_blocks = count > 0 ? next : -1;
      blocks_[i].rise_per_slope = margin > 0.0 ? 1.01 * data.diameter_bound / margin : HUGE_VAL;
      next += count;
    }
  }
  std::vector<int> neighbors;
  for (int i = 0; i < corner_count_; ++i) {
    const int v = vertices[i];
    neighbors.clear();
    for (int k = data.vertex_begin[v]; k < data.vertex_begin[v + 1]; ++k) {
      if (!graph.IsBend(k)) continue;
      const int w = graph.FollowEdge(k, [&](int between) { corner_of_vertex_[between] = i; });
      neighbors.push_back(corner_of_vertex_[w]);
    }
    if (scan_count_ == 0) FillBlocks(i, neighbors);
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

void SupportTable::PutLane(Lanes* lanes, int lane, const Corner& corner) const {
  lanes->x[lane] = static_cast<float>(lane_scale_ * (corner.x - center_[0]));
  lanes->y[lane] = static_cast<float>(lane_scale_ * (corner.y - center_[1]));
  lanes->z[lane] = static_cast<float>(lane_scale_ * (corner.z - center_[2]));
}

void SupportTable::PutLink(Block* block, int lane, int i) const {
  PutLane(&block->lanes, lane, corner(i));
  block->link[lane] = i;
}

void SupportTable::FillBlocks(int corner, std::span<const int> neighbors) {
  const int count = static_cast<int>(neighbors.size());
  for (int first = 0; first < count; first += kOwnNeighbors) {
    const int further = first / kOwnNeighbors;
    Block* block = &blocks_[further == 0 ? corner : blocks_[corner].more_blocks + further - 1];
    PutLink(block, 0, corner);
    for (int lane = 1; lane < kLaneCount; ++lane) {
      const int neighbor = first + lane - 1;
      PutLink(block, lane, neighbors[neighbor < count ? neighbor : first]);
    }
    if (further > 0) block->link[0] = (count - first + kOwnNeighbors - 1) / kOwnNeighbors;
  }
}

void SupportTable::FillScan(std::span<const Corner> corners,
                            std::span<const std::int32_t> vertices) {
  scan_count_ = (corner_count_ + kLaneCount - 1) / kLaneCount;
  std::copy(corners.begin(), corners.end(), scan_corners_.begin());
  std::copy(vertices.begin(), vertices.end(), scan_vertices_.begin());
  for (int i = 0; i < scan_count_ * kLaneCount; ++i) {
    PutLane(&scan_lanes_[i / kLaneCount], i % kLaneCount, corners[std::min(i, corner_count_ - 1)]);
  }
}

void SupportTable::FillCells() {
  resolution_ = static_cast<int>(std::sqrt(0.5 * kCellsPerCorner * corner_count_)) + 1;
  resolution_ = std::min(resolution_, kMaxResolution);
  half_resolution_ = 0.5F * (1.0F - 0x1p-18F) * static_cast<float>(resolution_);
  const std::size_t cell_count = 2 * static_cast<std::size_t>(resolution_) * resolution_;
  is_wide() ? wide_cells_.resize(cell_count) : cells_.resize(cell_count);
  const auto get = [&](std::size_t cell) -> int {
    return is_wide() ? wide_cells_[cell] : cells_[cell];
  };
  // A cell is only where climbs begin, so its corner need not be extreme. What one cell leaves of
  // its share of looks others may use; together they are linear, however many edges a corner has.
  long budget = static_cast<long>(blocks_.size());
  int corner = 0, steps = 0;
  std::size_t cell = 0;
  for (int lower = 0; lower < 2; ++lower) {
    for (int j = 0; j < resolution_; ++j) {
      for (int i = 0; i < resolution_; ++i, ++cell) {
        const double sum = (2 * i + 1.0) / resolution_ - 1.0;         // x + y
        const double difference = (2 * j + 1.0) / resolution_ - 1.0;  // x - y
        const double x = 0.5 * (sum + difference), y = 0.5 * (sum - difference);
        const double z = 1.0 - std::abs(x) - std::abs(y);
        // The row before is a better neighbour than the other end of this one.
        if (i == 0 && j > 0) corner = get(cell - resolution_);
        if (budget > 0) {
          corner = ClimbScaled(corner, x, y, lower == 0 ? z : -z, &budget, &steps).corner;
        }
        if (is_wide()) {
          wide_cells_[cell] = corner;
        } else {
          cells_[cell] = static_cast<std::uint16_t>(corner);
        }
        budget += kFillBudget;
      }
    }
  }
}

bool SupportTable::Rescale(double* x, double* y, double* z) {
  const double largest = std::max({std::abs(*x), std::abs(*y), std::abs(*z)});
  const bool finite = std::isfinite(*x) && std::isfinite(*y) && std::isfinite(*z);
  if (!finite || largest == 0.0) return false;
  int exponent = 0;
  std::frexp(largest, &exponent);
  *x = std::ldexp(*x, -exponent);
  *y = std::ldexp(*y, -exponent);
  *z = std::ldexp(*z, -exponent);
  return true;
}

// Over the middle of the body: its rounding refers to the body's extent, not to its distance from
// the frame's origin.
double SupportTable::Height(const Corner& c, double x, double y, double z) const {
  return x * (c.x - center_[0]) + y * (c.y - center_[1]) + z * (c.z - center_[2]);
}

template <class Visit>
int SupportTable::VisitRivals(int corner, float x, float y, float z, Visit visit) const {
  using L = VectorLanes;
  float heights[kLaneCount];
  // Calls visit_lane for every lane from `first` on that is at least as high as `low`.
  const auto visit_lanes = [&](const Lanes& lanes, float low, int first, auto visit_lane) {
    Heights<L>(lanes, x, y, z).Store(heights);
    for (int k = first; k < kLaneCount; ++k) {
      if (heights[k] >= low) visit_lane(k);
    }
  };
  if (scan_count_ > 0) {
    const Lanes& own = scan_lanes_[corner / kLaneCount];
    const int lane = corner % kLaneCount;
    const float low = x * own.x[lane] + y * own.y[lane] + z * own.z[lane] - kSlack;
    L top = Heights<L>(scan_lanes_[0], x, y, z).Except(corner);
    for (int i = 1; i < scan_count_; ++i) {
      top = L::Larger(top, Heights<L>(scan_lanes_[i], x, y, z).Except(corner - i * kLaneCount));
    }
    if (top.Largest() < low) return scan_count_;
    for (int i = 0; i < scan_count_; ++i) {
      visit_lanes(scan_lanes_[i], low, 0, [&](int k) {
        const int rival = std::min(i * kLaneCount + k, corner_count_ - 1);
        if (rival != corner) visit(rival);
      });
    }
    return scan_count_;
  }
  const Block& block = blocks_[corner];
  const Lanes& own = block.lanes;
  const float low = x * own.x[0] + y * own.y[0] + z * own.z[0] - kSlack;
  const auto visit_block = [&](const Block& from) {
    if (Heights<L>(from.lanes, x, y, z).Except(0).Largest() < low) return;
    visit_lanes(from.lanes, low, 1, [&](int k) { visit(from.link[k]); });
  };
  visit_block(block);
  if (block.more_blocks < 0) return 1;
  const Block* more = &blocks_[block.more_blocks];
  const int count = more->link[0];
  for (int i = 0; i < count; ++i) visit_block(more[i]);
  return 1 + count;
}

// Ends, because each move strictly raises the height, and the height of a corner is one number.
TOUCHSTONE_VECTOR_CLONES
SupportTable::Peak SupportTable::ClimbScaled(int start, double x, double y, double z, long* budget,
                                             int* steps) const {
  const auto fx = static_cast<float>(x), fy = static_cast<float>(y), fz = static_cast<float>(z);
  Peak peak{start, false};
  double height = Height(corner(start), x, y, z);
  while (*budget > 0) {
    int next = peak.corner;
    peak.certain = true;
    *budget -= VisitRivals(peak.corner, fx, fy, fz, [&](int rival) {
      peak.certain = false;
      const double rival_height = Height(corner(rival), x, y, z);
      if (rival_height > height) {
        next = rival;
        height = rival_height;
      }
    });
    if (next == peak.corner) return peak;
    peak.corner = next;
    ++*steps;
  }
  peak.certain = false;
  return peak;
}

SupportTable::Peak SupportTable::Climb(int start, const Eigen::Vector3d& direction,
                                       int* steps) const {
  double x = direction[0], y = direction[1], z = direction[2];
  double sum = std::abs(x) + std::abs(y) + std::abs(z);
  if (!(sum > 0x1p-1000 && sum < 0x1p1000)) {
    if (!Rescale(&x, &y, &z)) return {start, false};
    sum = std::abs(x) + std::abs(y) + std::abs(z);
  }
  const double scale = 1.0 / sum;
  long unbounded = std::numeric_limits<long>::max();
  return ClimbScaled(start, x * scale, y * scale, z * scale, &unbounded, steps);
}

TOUCHSTONE_VECTOR_CLONES
double SupportTable::Rise(int corner, const Eigen::Vector3d& direction, double error) const {
  const double sum = direction.lpNorm<1>();
  // The lanes' claim holds for directions off by 2^-30 of their 1-norm.
  if (!(sum > 0x1p-1000 && sum < 0x1p1000 && error <= 0x1p-31 * sum)) return HUGE_VAL;
  const double scale = 1.0 / sum;
  const Eigen::Vector3d n = scale * direction;
  // n.e with e = fl(w - v): a rounding of each coordinate of n and of e, three of each term: below
  // 5.01 u sum |n_i e_i|, plus the error of n.
  const double per_length = 1.01 * (5.1 * 0x1p-52 * n.cwiseAbs().maxCoeff() + scale * error);
  const Corner& v = this->corner(corner);
  double highest = 0.0, steepest = 0.0;
  VisitRivals(corner, static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2]),
              [&](int rival) {
                const Corner& w = this->corner(rival);
                const Eigen::Vector3d edge(w.x - v.x, w.y - v.y, w.z - v.z);
                const double length = edge.lpNorm<1>();  // at least |e|, at most sqrt(3) |e|
                const double gain = n.dot(edge) + per_length * length;
                highest = std::max(highest, gain);
                if (gain > 0.0) steepest = std::max(steepest, 1.8 * gain / length);
              });
  if (highest <= 0.0) return 0.0;
  // All corners were seen, or those that bound the cone of this one.
  const double rise =
      1.01 * sum * (scan_count_ > 0 ? highest : steepest * blocks_[corner].rise_per_slope);
  return rise >= 0x1p-1000 ? rise : HUGE_VAL;  // or what underflow made of it
}

TOUCHSTONE_VECTOR_CLONES
int SupportTable::Find(const Eigen::Vector3d& direction, int start, int* steps) const {
  const int from =
      start >= 0 ? corner_of_vertex_[start] : Look(direction[0], direction[1], direction[2]);
  return vertex(Climb(from, direction, steps).corner);
}

std::size_t SupportTable::heap_bytes() const {
  return blocks_.capacity() * sizeof(Block) + cells_.capacity() * sizeof cells_[0] +
         wide_cells_.capacity() * sizeof wide_cells_[0] +
         corner_of_vertex_.capacity() * sizeof corner_of_vertex_[0];
}

}  // namespace touchstone
