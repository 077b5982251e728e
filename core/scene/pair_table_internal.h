// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_SCENE_PAIR_TABLE_INTERNAL_H_
#define TOUCHSTONE_CORE_SCENE_PAIR_TABLE_INTERNAL_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "touchstone/core/base/verdict.h"
#include "touchstone/core/cd_dual/minkowski_difference.h"

namespace touchstone::internal {

// What is read of a pair when it is looked at: 88 bytes. The guesses prove nothing by themselves.
struct PairState {
  // The direction that separated last, from P to Q in the world's frame, with the corners that
  // reach furthest.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  CornerPair support;
  // The triangle that enclosed o last, together with c.
  CornerPair triangle[3];
  std::int32_t mesh = -1;     // place of its MeshPairState
  std::int32_t numbers = -1;  // place of its caches for numbers
  Verdict verdict = Verdict::kSeparate;
  Verdict told = Verdict::kSeparate;  // while in_contact
  std::uint8_t interior_p = 0, interior_q = 0;
  bool has_direction = false;
  bool has_triangle = false;
  bool is_pinned = false;     // kept whatever the boxes say
  bool wants_verdict = true;  // by events, or by numbers
  bool is_told = true;        // events tell of it
  bool in_contact = false;    // they have told that it began, and not that it ended
  std::uint8_t patience = 0;  // looks to wait before a better direction is tried again
};

static_assert(sizeof(PairState) == 88);

// The pairs of parts that are candidates, in arrays, found by their two parts. The order of the
// arrays depends on history, nothing that leaves the scene does. Steady state: no allocation.
class PairTable {
 public:
  static constexpr int kNone = -1;

  int size() const { return static_cast<int>(p_.size()); }
  int p(int i) const { return p_[i]; }
  int q(int i) const { return q_[i]; }
  // The pair keeps its verdict while the travels of its parts add up to less than this.
  double& limit(int i) { return limit_[i]; }
  double limit(int i) const { return limit_[i]; }
  PairState& state(int i) { return states_[i]; }
  const PairState& state(int i) const { return states_[i]; }

  int Find(int p, int q) const;
  // Requires that the pair is not there. Returns its place: the last.
  int Add(int p, int q);
  // The last pair takes the place.
  void RemoveAt(int i);
  void Reserve(std::size_t pairs);

  std::size_t bytes() const;
  static constexpr std::size_t kBytesPerPair =
      2 * sizeof(std::int32_t) + sizeof(double) + sizeof(PairState);

 private:
  static std::size_t Hash(int p, int q);
  std::size_t SlotOf(int i) const;
  void Grow();

  std::vector<std::int32_t> p_, q_;
  std::vector<double> limit_;
  std::vector<PairState> states_;
  std::vector<std::int32_t> slots_;  // open addressing: places, or kNone
};

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_SCENE_PAIR_TABLE_INTERNAL_H_
