// SPDX-License-Identifier: MIT
//
// Eight single-precision numbers side by side: the one place where vector code is written. Two
// types with one interface: VectorLanes is the compiler's own vector type, which becomes AVX-512,
// AVX2 or baseline instructions by the clone it is compiled in (vector_clones.h); ScalarLanes is
// its twin of plain loops. The same operations in the same order, so the same results to the bit.
#ifndef TOUCHSTONE_CORE_BASE_LANES_H_
#define TOUCHSTONE_CORE_BASE_LANES_H_

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>

#include "touchstone/core/base/vector_clones.h"

namespace touchstone {

inline constexpr int kLaneCount = 8;

class VectorLanes {
 public:
  static TOUCHSTONE_INLINE VectorLanes Load(const float* from) {
    VectorLanes lanes;
    std::memcpy(&lanes.values_, from, sizeof lanes.values_);
    return lanes;
  }
  TOUCHSTONE_INLINE void Store(float* to) const { std::memcpy(to, &values_, sizeof values_); }

  friend TOUCHSTONE_INLINE VectorLanes operator+(const VectorLanes& a, const VectorLanes& b) {
    return VectorLanes(a.values_ + b.values_);
  }
  friend TOUCHSTONE_INLINE VectorLanes operator*(float a, const VectorLanes& b) {
    return VectorLanes(a * b.values_);
  }
  static TOUCHSTONE_INLINE VectorLanes Larger(const VectorLanes& a, const VectorLanes& b) {
    return VectorLanes(a.values_ > b.values_ ? a.values_ : b.values_);
  }
  // Each number with a tag in its last bits, those of kMask: first, first + 1, ... by lane. Heights
  // keep their order up to that, and the largest brings its tag along.
  template <std::int32_t kMask>
  TOUCHSTONE_INLINE VectorLanes Tagged(std::int32_t first) const {
    Integers bits;
    std::memcpy(&bits, &values_, sizeof bits);
    bits = (bits & ~kMask) | (kNumbers + first);
    VectorLanes lanes;
    std::memcpy(&lanes.values_, &bits, sizeof bits);
    return lanes;
  }
  // The tag of the largest number.
  template <std::int32_t kMask>
  TOUCHSTONE_INLINE std::int32_t TagOfLargest() const {
    return std::bit_cast<std::int32_t>(Largest()) & kMask;
  }
  TOUCHSTONE_INLINE float Largest() const {
    Four low, high;
    std::memcpy(&low, &values_, sizeof low);
    std::memcpy(&high, reinterpret_cast<const char*>(&values_) + sizeof low, sizeof high);
    low = low > high ? low : high;
    const Four turned = __builtin_shufflevector(low, low, 2, 3, 0, 1);
    low = low > turned ? low : turned;
    const float a = low[0], b = low[1];
    return a > b ? a : b;
  }
  // All numbers but that of one lane, if it is one of the eight.
  TOUCHSTONE_INLINE VectorLanes Except(std::int32_t lane) const {
    return VectorLanes(kNumbers == lane ? Values{} - std::numeric_limits<float>::max() : values_);
  }

 private:
  using Values = float __attribute__((vector_size(32)));
  using Integers = std::int32_t __attribute__((vector_size(32)));
  using Four = float __attribute__((vector_size(16)));
  static constexpr Integers kNumbers = {0, 1, 2, 3, 4, 5, 6, 7};

  VectorLanes() = default;
  TOUCHSTONE_INLINE explicit VectorLanes(const Values& values) : values_(values) {}

  Values values_;
};

class ScalarLanes {
 public:
  static ScalarLanes Load(const float* from) {
    ScalarLanes lanes;
    std::memcpy(lanes.values_.data(), from, sizeof lanes.values_);
    return lanes;
  }
  void Store(float* to) const { std::memcpy(to, values_.data(), sizeof values_); }

  friend ScalarLanes operator+(const ScalarLanes& a, const ScalarLanes& b) {
    return Map([&](int i) { return a.values_[i] + b.values_[i]; });
  }
  friend ScalarLanes operator*(float a, const ScalarLanes& b) {
    return Map([&](int i) { return a * b.values_[i]; });
  }
  static ScalarLanes Larger(const ScalarLanes& a, const ScalarLanes& b) {
    return Map([&](int i) { return a.values_[i] > b.values_[i] ? a.values_[i] : b.values_[i]; });
  }
  template <std::int32_t kMask>
  ScalarLanes Tagged(std::int32_t first) const {
    return Map([&](int i) {
      return std::bit_cast<float>((std::bit_cast<std::int32_t>(values_[i]) & ~kMask) | (first + i));
    });
  }
  template <std::int32_t kMask>
  std::int32_t TagOfLargest() const {
    return std::bit_cast<std::int32_t>(Largest()) & kMask;
  }
  float Largest() const {
    float largest = values_[0];
    for (const float value : values_) largest = value > largest ? value : largest;
    return largest;
  }
  ScalarLanes Except(std::int32_t lane) const {
    return Map([&](int i) { return i == lane ? -std::numeric_limits<float>::max() : values_[i]; });
  }

 private:
  template <class Function>
  static ScalarLanes Map(Function function) {
    ScalarLanes lanes;
    for (int i = 0; i < kLaneCount; ++i) lanes.values_[i] = function(i);
    return lanes;
  }

  std::array<float, kLaneCount> values_;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_BASE_LANES_H_
