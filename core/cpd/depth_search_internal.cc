// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/depth_search_internal.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "touchstone/core/cpd/depth_searcher_internal.h"

namespace touchstone::internal {
namespace {

constexpr double kClosed = 4.0 * kStep;  // bounds that differ by steps alone
constexpr int kCrumbLimit = 32;          // then too much is left open to go on
constexpr double kGrowth = 1.2;          // of the radius within which facets are made
constexpr std::size_t kRememberedPrisms = 256;
constexpr std::size_t kRememberedBalls = 16;

// Of two pieces in the queue, whether the first is the further one.
constexpr auto kIsFurther = [](const auto& p, const auto& q) { return p.first > q.first; };

}  // namespace

using Eigen::Vector3d;

DepthAnswer DepthSearcher::Run() {
  Reset();
  RecallWitnesses();
  if (!IsOverlapRecalled() && IsSeparate()) {
    answer_.status = MeshDepthStatus::kSeparate;
    answer_.upper = 0.0;
    return answer_;
  }
  PartBoxes();
  TryRemembered();
  Explore();
  PrepareNextList();
  Remember();
  return answer_;
}

void DepthSearcher::Reset() {
  s_.stack.clear();
  s_.later.clear();
  s_.made.clear();
  s_.facets.clear();
  s_.pieces.clear();
  s_.free_pieces.clear();
  s_.heap.clear();
  s_.prism_uses.clear();
  s_.prisms.Clear();
  s_.balls.Clear();
  s_.met_balls.clear();
  answer_.status = MeshDepthStatus::kCertain;
}

bool DepthSearcher::IsOverlapRecalled() const {
  const Vector3d origin = Vector3d::Zero();
  return s_.prisms.FindDeepest(origin).margin > 0.0 || s_.balls.Holds(origin, 0.0);
}

bool DepthSearcher::IsSeparate() {
  const Vector3d origin = Vector3d::Zero();
  const MembershipResult result = Membership(pair_, origin, {options_.certainty}, &s_.membership);
  if (result.verdict == Verdict::kOverlap) AddWitness(origin, result.face_a, result.face_b);
  return result.verdict == Verdict::kSeparate || result.verdict == Verdict::kTouch;
}

void DepthSearcher::PartBoxes() {
  const Vector3d low_a = pair_.a().tree.low(), high_a = pair_.a().tree.high(),
                 low_b = pair_.b().tree.low(), high_b = pair_.b().tree.high();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double way : {1.0, -1.0}) {
      const double step = way > 0.0 ? high_a[axis] - low_b[axis] : high_b[axis] - low_a[axis];
      // Boxes of bodies that barely overlap may be apart by their rounding.
      const double length = std::max(0.0, step) + 0x1p-46;
      if (length * kRoundUp < answer_.upper)
        Take(way * length * Vector3d::Unit(axis), std::nullopt);
    }
  }
}

void DepthSearcher::Take(const Vector3d& at, const std::optional<ContactName>& name) {
  answer_.at = at;
  answer_.at_error = 0.0;
  answer_.upper = at.norm() * kRoundUp;
  answer_.name = name;
  answer_.is_exact = false;
}

bool DepthSearcher::IsBuried(const FacetFrame& frame, const FacetPiece& piece) const {
  const double slack = SlackOf(piece);
  if (!s_.balls.MayHold(slack)) return false;
  std::uint64_t holding = ~std::uint64_t{0};
  for (int i = 0; i < piece.count && holding != 0; ++i) {
    holding &= s_.balls.Holding(frame.At(piece.at[i]), slack);
  }
  return holding != 0;
}

bool DepthSearcher::Push(const FacetPiece& piece) {
  const double near = Near(piece);
  if (near >= answer_.upper) return false;
  int slot;
  if (s_.free_pieces.empty()) {
    slot = static_cast<int>(s_.pieces.size());
    s_.pieces.push_back(piece);
  } else {
    slot = s_.free_pieces.back();
    s_.free_pieces.pop_back();
    s_.pieces[slot] = piece;
  }
  s_.heap.emplace_back(near, slot);
  std::push_heap(s_.heap.begin(), s_.heap.end(), kIsFurther);
  return true;
}

void DepthSearcher::Explore() {
  if (!UseList()) {
    radius_ = answer_.was_warm ? answer_.upper : 0.0625 * answer_.upper;
    PlaceTrees(pair_.pose(), 0.0, 0.0);
    ExpandWithinRadius();
  }
  while (true) {
    const double near = s_.heap.empty() ? radius_ : s_.heap.front().first;
    if (near >= radius_ || s_.heap.empty()) {
      if (radius_ >= answer_.upper) break;
      radius_ = std::min(answer_.upper, std::max(kGrowth * radius_, 1.01 * near));
      ExpandWithinRadius();
      continue;
    }
    if (near >= answer_.upper - kClosed) break;
    if (crumbs_ >= kCrumbLimit) break;
    if (result_.pieces >= options_.piece_limit) {
      answer_.status = MeshDepthStatus::kLimit;
      answer_.lower = std::min(open_, near);
      return;
    }
    ++result_.pieces;
    std::pop_heap(s_.heap.begin(), s_.heap.end(), kIsFurther);
    const int slot = s_.heap.back().second;
    s_.heap.pop_back();
    const FacetPiece piece = s_.pieces[slot];
    s_.free_pieces.push_back(slot);
    if (LookAt(piece)) {
      answer_.lower = std::min(near, answer_.upper);
      break;
    }
    answer_.lower = near;
  }
  const double next = s_.heap.empty() ? answer_.upper : s_.heap.front().first;
  if (!found_) answer_.lower = std::min(answer_.upper, next);
  if (open_ < answer_.lower) {
    answer_.lower = open_;
    answer_.status = MeshDepthStatus::kOpen;
  }
}

void DepthSearcher::Remember() {
  s_.answer = answer_.name;
  s_.pose = pair_.pose();
  s_.prism_names.clear();
  for (int i = s_.prisms.size() - 1; i >= 0 && s_.prism_names.size() < kRememberedPrisms; --i) {
    if (s_.prism_uses[i] > 0) s_.prism_names.push_back(s_.prisms.prism(i).name);
  }
  s_.ball_faces.clear();
  for (auto it = s_.met_balls.rbegin();
       it != s_.met_balls.rend() && s_.ball_faces.size() < kRememberedBalls; ++it) {
    s_.ball_faces.push_back(*it);
  }
}

DepthAnswer SearchDepth(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
                        const MeshDepthOptions& options, DepthScratch* scratch,
                        MeshDepthResult* result) {
  return DepthSearcher(pair, a, b, options, scratch, result).Run();
}

}  // namespace touchstone::internal
