// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/box_lanes_internal.h"

#include <bit>
#include <cstdint>
#include <limits>

#include "touchstone/core/base/vector_clones.h"

namespace touchstone::internal {

void BoxLanes::Clear() {
  lanes_.clear();
  count_ = 0;
}

void BoxLanes::Add(const Box3& box) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const int lane = count_++ % kTreeWidth;
  if (lane == 0) {
    Lanes& lanes = lanes_.emplace_back();
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < kTreeWidth; ++i) {
        lanes.low[axis][i] = kInfinity;
        lanes.high[axis][i] = -kInfinity;
      }
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    lanes_.back().low[axis][lane] = box.low[axis];
    lanes_.back().high[axis][lane] = box.high[axis];
  }
}

TOUCHSTONE_VECTOR_CLONES
unsigned BoxLanes::Mask(const Lanes& lanes, const Box3& box) {
  std::int64_t meets[kTreeWidth];
  for (int i = 0; i < kTreeWidth; ++i) meets[i] = std::int64_t{1} << i;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.low[axis], high = box.high[axis];
    for (int i = 0; i < kTreeWidth; ++i) {
      meets[i] = (lanes.low[axis][i] > high) | (lanes.high[axis][i] < low) ? 0 : meets[i];
    }
  }
  std::int64_t mask = 0;
  for (int i = 0; i < kTreeWidth; ++i) mask |= meets[i];
  return static_cast<unsigned>(mask);
}

void BoxLanes::Meeting(const Box3& box, std::vector<int>* hits) const {
  for (int first = 0; first < count_; first += kTreeWidth) {
    unsigned mask = Mask(lanes_[first / kTreeWidth], box);
    for (; mask != 0; mask &= mask - 1) {
      const int number = first + std::countr_zero(mask);
      if (number < count_) hits->push_back(number);
    }
  }
}

bool BoxLanes::MeetsAny(const Box3& box) const {
  for (int first = 0; first < count_; first += kTreeWidth) {
    const unsigned used = count_ - first < kTreeWidth ? (1u << (count_ - first)) - 1 : ~0u;
    if ((Mask(lanes_[first / kTreeWidth], box) & used) != 0) return true;
  }
  return false;
}

}  // namespace touchstone::internal
