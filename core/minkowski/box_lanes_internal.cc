// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/box_lanes_internal.h"

#include <bit>
#include <cstdint>
#include <limits>

#include "touchstone/core/base/vector_clones.h"

namespace touchstone::internal {

void BoxLanes::Clear() {
  lanes_.clear();
  blocks_.clear();
  count_ = 0;
}

// A new entry for lane 0, of lanes that nothing meets; else the last one.
BoxLanes::Lanes& BoxLanes::LanesAt(int lane, std::vector<Lanes>* lanes) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (lane == 0) {
    Lanes& added = lanes->emplace_back();
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < kTreeWidth; ++i) {
        added.low[axis][i] = kInfinity;
        added.high[axis][i] = -kInfinity;
      }
    }
  }
  return lanes->back();
}

void BoxLanes::Add(const Box3& box) {
  const int lane = count_ % kTreeWidth, block = count_ / kTreeWidth % kTreeWidth;
  ++count_;
  Lanes& own = LanesAt(lane, &lanes_);
  Lanes& round = LanesAt(lane > 0 ? 1 : block, &blocks_);
  for (int axis = 0; axis < 3; ++axis) {
    own.low[axis][lane] = box.low[axis];
    own.high[axis][lane] = box.high[axis];
    // NaN stays, and meets all.
    const double low = round.low[axis][block], high = round.high[axis][block];
    round.low[axis][block] = !(low < box.low[axis]) && low == low ? box.low[axis] : low;
    round.high[axis][block] = !(high > box.high[axis]) && high == high ? box.high[axis] : high;
  }
}

TOUCHSTONE_VECTOR_CLONES
unsigned BoxLanes::Mask(const Lanes& lanes, const Box3& box) {
  std::int64_t meets[kTreeWidth];
  for (int i = 0; i < kTreeWidth; ++i) meets[i] = std::int64_t{1} << i;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.low[axis], high = box.high[axis];
    for (int i = 0; i < kTreeWidth; ++i) {
      meets[i] = ((lanes.low[axis][i] > high) | (lanes.high[axis][i] < low)) ? 0 : meets[i];
    }
  }
  std::int64_t mask = 0;
  for (int i = 0; i < kTreeWidth; ++i) mask |= meets[i];
  return static_cast<unsigned>(mask);
}

void BoxLanes::Meeting(const Box3& box, std::vector<int>* hits) const {
  const int entries = static_cast<int>(lanes_.size());
  for (int first = 0; first < entries; first += kTreeWidth) {
    unsigned near = Mask(blocks_[first / kTreeWidth], entries - first, box);
    for (; near != 0; near &= near - 1) {
      const int entry = first + std::countr_zero(near), base = kTreeWidth * entry;
      unsigned mask = Mask(lanes_[entry], count_ - base, box);
      for (; mask != 0; mask &= mask - 1) hits->push_back(base + std::countr_zero(mask));
    }
  }
}

bool BoxLanes::MeetsAny(const Box3& box) const {
  const int entries = static_cast<int>(lanes_.size());
  for (int first = 0; first < entries; first += kTreeWidth) {
    unsigned near = Mask(blocks_[first / kTreeWidth], entries - first, box);
    for (; near != 0; near &= near - 1) {
      const int entry = first + std::countr_zero(near);
      if (Mask(lanes_[entry], count_ - kTreeWidth * entry, box) != 0) return true;
    }
  }
  return false;
}

}  // namespace touchstone::internal
