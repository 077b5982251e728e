// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/nearest_cells.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "touchstone/core/minkowski/local_assembly_internal.h"

namespace touchstone {
namespace {

// The first ball's part of the bodies' size, and the growth of the next.
constexpr double kFirst = 0x1p-6, kGrowth = 1.5;
// Distances of one cell by two names of its corners differ by less than this part of the size.
constexpr double kTie = 0x1p-35;

}  // namespace

NearestCells::NearestCells(TriangleMesh a, TriangleMesh b)
    : sums_(a, b, {LocalBuilder::kSphereHierarchy}),
      size_(a.max_coordinate() + b.max_coordinate()) {}

Status NearestCells::Start(const RelativePose& pose, const Eigen::Vector3d& point) {
  pose_ = pose;
  point_ = point;
  cells_.clear();
  next_ = 0;
  radius_ = 0.0;
  yielded_ = -1.0;
  // |a - R b - t - x|: coordinates of a row of R add up to less than two.
  last_radius_ = 0.0;
  const Status status = sums_.Update(pose, {point, 0.0}).status;
  if (!status.ok()) return status;
  last_radius_ = 2.0 * (2.0 * size_ + pose.translation().norm() + point.norm());
  return status;
}

const BoundaryCell* NearestCells::Next() {
  while (next_ == cells_.size()) {
    if (!Grow()) return nullptr;
  }
  return &cells_[next_++];
}

// False if the last ball held all.
bool NearestCells::Grow() {
  if (radius_ >= last_radius_) return false;
  radius_ = radius_ > 0.0 ? kGrowth * radius_ : kFirst * size_;
  TakeCells(sums_.Update(pose_, {point_, radius_}));
  return true;
}

void NearestCells::TakeCells(const LocalSum& sum) {
  std::vector<BoundaryCell> found;
  const auto add = [&](const std::array<int, 3>& t, int facet, bool is_new) {
    if (is_new) found.emplace_back().facet = sum.facets[facet];
    BoundaryCell& cell = found.back();
    cell.triangles.push_back({sum.vertices[t[0]], sum.vertices[t[1]], sum.vertices[t[2]]});
    const double distance = internal::DistanceToPolygon(point_, cell.triangles.back().data(), 3);
    cell.distance = is_new ? distance : std::min(cell.distance, distance);
  };
  for (std::size_t t = 0; t < sum.triangles.size(); ++t) {
    const bool is_new = t == 0 || sum.cell_of_triangle[t] != sum.cell_of_triangle[t - 1];
    add(sum.triangles[t], sum.facet_of_triangle[t], is_new);
  }
  for (std::size_t t = 0; t < sum.sheets.size(); ++t) {
    add(sum.sheets[t], sum.facet_of_sheet[t], true);
    found.back().is_sheet = true;
  }
  std::sort(found.begin(), found.end(),
            [](const BoundaryCell& x, const BoundaryCell& y) { return x.distance < y.distance; });
  // The ball holds all cells up to its radius. The border of what comes now is put where no cell's
  // distance is near, so that it parts them alike the next time.
  const double tie = kTie * (size_ + pose_.translation().norm() + point_.norm() + radius_);
  double until = radius_;
  for (auto cell = found.rbegin(); cell != found.rend() && cell->distance > until - 2.0 * tie;
       ++cell) {
    if (cell->distance < until + 2.0 * tie) until = cell->distance - 4.0 * tie;
  }
  cells_.clear();
  next_ = 0;
  for (BoundaryCell& cell : found) {
    if (cell.distance > yielded_ && cell.distance <= until) cells_.push_back(std::move(cell));
  }
  yielded_ = std::max(yielded_, until);
}

}  // namespace touchstone
