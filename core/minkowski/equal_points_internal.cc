// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/equal_points_internal.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

#include "touchstone/core/minkowski/flat_table_internal.h"

namespace touchstone::internal {
namespace {

// Points are looked up in cells of this size, in scaled lengths (the pair is of size one); errors
// are below half of it, so equal points lie in the same cell or in neighbouring ones. Few points
// are off by so much, and few that are not equal share a cell.
constexpr double kCell = 0x1p-28;
constexpr double kMaxError = 0.25 * kCell;

class Finder {
 public:
  explicit Finder(SumGeometry* geometry)
      : geometry_(*geometry), parent_(geometry->point_count()), is_added_(parent_.size(), 0) {
    std::iota(parent_.begin(), parent_.end(), 0);
    numbers_.Reserve(parent_.size());
    cells_.reserve(parent_.size());
  }

  void Add(int point) {
    if (is_added_[point]) return;
    is_added_[point] = 1;
    if (!(geometry_.point(point).error < kMaxError)) geometry_.Sharpen(point);
    const SumPoint& x = geometry_.point(point);
    // Every cell that the point's error reaches: eight at most. (Those at zero are twice as wide.)
    std::int64_t low[3], high[3];
    for (int i = 0; i < 3; ++i) {
      low[i] = static_cast<std::int64_t>((x.rounded[i] - x.error) / kCell);
      high[i] = static_cast<std::int64_t>((x.rounded[i] + x.error) / kCell);
    }
    for (std::int64_t i = low[0]; i <= high[0]; ++i) {
      for (std::int64_t j = low[1]; j <= high[1]; ++j) {
        for (std::int64_t k = low[2]; k <= high[2]; ++k) AddToCell(point, Hash(i, j, k));
      }
    }
  }

  std::vector<int> Representatives() {
    std::sort(others_.begin(), others_.end());
    std::vector<int> points;
    for (auto first = others_.begin(); first != others_.end();) {
      const int cell = first->first;
      points = {cells_[cell].point};
      for (; first != others_.end() && first->first == cell; ++first) {
        points.push_back(first->second);
      }
      JoinEqual(points);
    }
    for (std::size_t i = 0; i < parent_.size(); ++i) parent_[i] = Find(static_cast<int>(i));
    return std::move(parent_);
  }

 private:
  static std::uint64_t Hash(std::int64_t i, std::int64_t j, std::int64_t k) {
    std::uint64_t hash = static_cast<std::uint64_t>(i) * 0x9e3779b97f4a7c15u;
    hash = (hash ^ (hash >> 29) ^ static_cast<std::uint64_t>(j)) * 0xbf58476d1ce4e5b9u;
    hash = (hash ^ (hash >> 32) ^ static_cast<std::uint64_t>(k)) * 0x94d049bb133111ebu;
    return hash ^ (hash >> 31);
  }

  void AddToCell(int point, std::uint64_t hash) {
    const int count = static_cast<int>(cells_.size());
    const int number = numbers_.Insert(hash, count, [&](int i) { return cells_[i].hash == hash; });
    if (number == count) {
      cells_.push_back({hash, point});
    } else {
      others_.emplace_back(number, point);
    }
  }

  // Points of one cell in their exact order: equal ones are neighbours. Bodies that are symmetric
  // up to rounding have many points in one cell, no two of them equal.
  void JoinEqual(std::span<int> points) {
    std::sort(points.begin(), points.end(), [&](int x, int y) {
      for (int axis = 0; axis < 3; ++axis) {
        const int sign = geometry_.Compare(x, y, axis);
        if (sign != 0) return sign < 0;
      }
      return false;
    });
    for (std::size_t k = 1; k < points.size(); ++k) {
      if (!geometry_.AreEqual(points[k - 1], points[k])) continue;
      const auto [small, large] = std::minmax({Find(points[k - 1]), Find(points[k])});
      parent_[large] = small;
    }
  }

  int Find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  SumGeometry& geometry_;
  std::vector<int> parent_;
  std::vector<char> is_added_;
  NumberTable numbers_;
  struct Cell {
    std::uint64_t hash;
    int point;  // the first one
  };
  std::vector<Cell> cells_;
  std::vector<std::pair<int, int>> others_;  // cell, and a point after its first
};

}  // namespace

std::vector<int> FindEqualPoints(SumGeometry* geometry, std::span<const int> points) {
  Finder finder(geometry);
  for (const int point : points) finder.Add(point);
  return finder.Representatives();
}

}  // namespace touchstone::internal
