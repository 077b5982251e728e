// SPDX-License-Identifier: MIT
#include "touchstone/core/proximity/inner_polytope.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "touchstone/core/proximity/signs_of_points.h"

namespace touchstone {

double InnerPolytope::DistanceError(const MinkowskiDifference& m) {
  // n.w / |n| with w off by E in each coordinate and three roundings of the dot product, |n|_1 <=
  // 1.74 |n|; the quotient and |n| add 4 u of a distance of at most 2 size.
  return 1.01 * (1.74 * (m.coordinate_error() + 3.1 * kRoundingUnit * 2.0 * m.size()) +
                 8.0 * kRoundingUnit * m.size());
}

void InnerPolytope::Clear() {
  corners_.clear();
  triangles_.clear();
  free_.clear();
  queue_.clear();
  alive_ = 0;
}

std::array<VertexPair, 3> InnerPolytope::Corners(int triangle) const {
  const auto& corners = triangles_[triangle].corners;
  return {corners_[corners[0]].pair, corners_[corners[1]].pair, corners_[corners[2]].pair};
}

bool InnerPolytope::HasCorner(int triangle, VertexPair pair) const {
  const auto& corners = triangles_[triangle].corners;
  return corners_[corners[0]].pair == pair || corners_[corners[1]].pair == pair ||
         corners_[corners[2]].pair == pair;
}

int InnerPolytope::AddTriangle(int a, int b, int c) {
  int slot = 0;
  if (free_.empty()) {
    slot = static_cast<int>(triangles_.size());
    triangles_.emplace_back();
  } else {
    slot = free_.back();
    free_.pop_back();
  }
  Triangle& triangle = triangles_[slot];
  triangle.corners = {a, b, c};
  triangle.alive = true;
  ++triangle.stamp;
  ++alive_;
  return slot;
}

void InnerPolytope::Kill(int triangle) {
  triangles_[triangle].alive = false;
  ++triangles_[triangle].stamp;
  free_.push_back(triangle);
  --alive_;
}

void InnerPolytope::Push(int triangle) {
  const Triangle& t = triangles_[triangle];
  queue_.push_back({t.distance, triangle, t.stamp});
  std::push_heap(queue_.begin(), queue_.end(),
                 [](const Queued& x, const Queued& y) { return x.distance > y.distance; });
}

int InnerPolytope::TakeNearest(double limit) {
  while (!queue_.empty() && queue_.front().distance < limit) {
    const Queued top = queue_.front();
    std::pop_heap(queue_.begin(), queue_.end(),
                  [](const Queued& x, const Queued& y) { return x.distance > y.distance; });
    queue_.pop_back();
    const Triangle& t = triangles_[top.triangle];
    if (t.alive && t.stamp == top.stamp) return top.triangle;
  }
  return -1;
}

// The triangle's plane in doubles. True if o is on its inner side, or in it where that is exact.
bool InnerPolytope::Evaluate(Signs* signs, int triangle) {
  const MinkowskiDifference& m = signs->difference();
  Triangle& t = triangles_[triangle];
  const Eigen::Vector3d& a = corners_[t.corners[0]].point;
  const Eigen::Vector3d& b = corners_[t.corners[1]].point;
  const Eigen::Vector3d& c = corners_[t.corners[2]].point;
  const Eigen::Vector3d u = b - a, v = c - a;
  t.normal = u.cross(v);
  t.length = t.normal.norm();
  // Sides: both ends off by E, one rounding more. A coordinate u_i v_j - u_j v_i: 2.01 u of
  // absolute terms of at most 2 |u||v| (in maximum norm), and 2 (|u| e_v + |v| e_u + e_u e_v) for
  // the data.
  const double lu = u.cwiseAbs().maxCoeff(), lv = v.cwiseAbs().maxCoeff();
  const double e = 2.0 * m.coordinate_error() + kRoundingUnit * std::max(lu, lv);
  t.normal_error = 1.01 * (4.1 * kRoundingUnit * lu * lv + 2.0 * e * (lu + lv + e)) + 0x1p-1000;
  const double lowest = std::min({t.normal.dot(a), t.normal.dot(b), t.normal.dot(c)});
  t.distance = t.length > 0.0 ? std::max(0.0, lowest / t.length) : 0.0;
  // det[a b c] = N.a with N off by dn, a by E: as in Signs::AlongNormal.
  const double n1 = t.normal.lpNorm<1>(), largest = 2.0 * m.size();
  const double error = 1.01 * ((n1 + 3.0 * t.normal_error) * m.coordinate_error() +
                               3.1 * kRoundingUnit * n1 * largest + 3.0 * t.normal_error * largest);
  if (lowest > error) return true;
  const auto corners = Corners(triangle);
  const auto side = signs->Determinant(corners[0], corners[1], corners[2]);
  return side && (*side > 0 || (*side == 0 && signs->exact_allowed()));
}

bool InnerPolytope::Start(Signs* signs, const std::array<VertexPair, 3>& triangle) {
  Clear();
  const MinkowskiDifference& m = signs->difference();
  corners_.push_back({kInteriorDifference, m.c()});
  for (const VertexPair& pair : triangle) corners_.push_back({pair, m.Point(pair)});
  AddTriangle(1, 2, 3);
  AddTriangle(0, 2, 1);
  AddTriangle(0, 3, 2);
  AddTriangle(0, 1, 3);
  triangles_[0].across = {1, 2, 3};
  triangles_[1].across = {2, 0, 3};
  triangles_[2].across = {3, 0, 1};
  triangles_[3].across = {1, 0, 2};
  // Not flat: o lies strictly on the inner side of the front.
  const auto front = signs->Determinant(triangle[0], triangle[1], triangle[2]);
  if (!front || *front <= 0) return false;
  for (int i = 0; i < 4; ++i) {
    if (!Evaluate(signs, i)) return false;
    Push(i);
  }
  return true;
}

bool InnerPolytope::Refresh(Signs* signs) {
  const MinkowskiDifference& m = signs->difference();
  for (Corner& corner : corners_) {
    if (corner.pair.p >= m.p().vertex_count() || corner.pair.q >= m.q().vertex_count())
      return false;
    corner.point = m.Point(corner.pair);
  }
  queue_.clear();
  for (int i = 0; i < static_cast<int>(triangles_.size()); ++i) {
    const Triangle& t = triangles_[i];
    if (!t.alive) continue;
    if (!Evaluate(signs, i) || !(t.distance > 0.0)) return false;
    queue_.push_back({t.distance, i, t.stamp});
  }
  std::make_heap(queue_.begin(), queue_.end(),
                 [](const Queued& x, const Queued& y) { return x.distance > y.distance; });
  return true;
}

std::optional<int> InnerPolytope::IsBeyond(Signs* signs, int triangle, VertexPair w) const {
  const MinkowskiDifference& m = signs->difference();
  const Triangle& t = triangles_[triangle];
  const Eigen::Vector3d from = m.Point(w) - corners_[t.corners[0]].point;
  // N.(w - a) with N off by dn, each end by E, the difference rounded once: |w - a| <= 4 size in
  // every coordinate.
  const double value = t.normal.dot(from), n1 = t.normal.lpNorm<1>();
  const double largest = from.cwiseAbs().maxCoeff();
  const double error =
      1.01 * ((n1 + 3.0 * t.normal_error) * 2.0 * m.coordinate_error() +
              4.1 * kRoundingUnit * n1 * largest + 3.0 * t.normal_error * largest) +
      0x1p-1000;
  if (value > error) return 1;
  if (value < -error) return -1;
  return Beyond(signs, Corners(triangle), w);
}

// Walks over the triangles that w lies beyond, from `first`, and leaves them in dead_, and the
// sides between them and the rest in horizon_, in order. False where a sign cannot be told.
bool InnerPolytope::CollectHorizon(Signs* signs, int first, VertexPair w) {
  ++round_;
  horizon_.clear();
  stack_.clear();
  dead_.clear();
  const auto take = [&](int triangle, int entered) {
    triangles_[triangle].seen = round_;
    triangles_[triangle].is_beyond = true;
    dead_.push_back(triangle);
    // The last pushed is the next looked at: the side after the one we came by.
    for (int k = entered < 0 ? 3 : 2; k >= 1; --k)
      stack_.push_back({triangle, ((entered < 0 ? -1 : entered) + k) % 3});
  };
  take(first, -1);
  while (!stack_.empty()) {
    const Step step = stack_.back();
    stack_.pop_back();
    const Triangle& t = triangles_[step.triangle];
    const int next = t.across[step.side];
    Triangle& beyond = triangles_[next];
    const int from = t.corners[step.side], to = t.corners[(step.side + 1) % 3];
    int side = 0;  // the same one as `next` has it, from `to` to `from`
    while (beyond.corners[side] != to) ++side;
    if (beyond.seen != round_) {
      const auto sign = IsBeyond(signs, next, w);
      if (!sign && signs->exact_allowed()) return false;
      beyond.seen = round_;
      beyond.is_beyond = sign && *sign > 0;
      if (beyond.is_beyond) {
        take(next, side);
        continue;
      }
    }
    if (!beyond.is_beyond) horizon_.push_back({next, side, from, to});
  }
  return true;
}

bool InnerPolytope::Expand(Signs* signs, int triangle, VertexPair w) {
  if (!CollectHorizon(signs, triangle, w)) return false;
  const std::size_t count = horizon_.size();
  if (count < 3) return false;
  for (std::size_t i = 0; i < count; ++i) {
    if (horizon_[i].to != horizon_[(i + 1) % count].from) return false;
  }
  const int apex = static_cast<int>(corners_.size());
  corners_.push_back({w, signs->difference().Point(w)});
  fan_.clear();
  for (const Side& side : horizon_) {
    fan_.push_back(AddTriangle(side.from, side.to, apex));
    if (Evaluate(signs, fan_.back())) continue;
    for (const int t : fan_) Kill(t);
    corners_.pop_back();
    return false;
  }
  for (const int t : dead_) Kill(t);
  for (std::size_t i = 0; i < count; ++i) {
    triangles_[fan_[i]].across = {horizon_[i].outside, fan_[(i + 1) % count],
                                  fan_[(i + count - 1) % count]};
    triangles_[horizon_[i].outside].across[horizon_[i].side] = fan_[i];
    Push(fan_[i]);
  }
  return true;
}

double InnerPolytope::LeastDistance() const {
  double least = HUGE_VAL;
  ForEach([&](int i) { least = std::min(least, triangles_[i].distance); });
  return least;
}

}  // namespace touchstone
