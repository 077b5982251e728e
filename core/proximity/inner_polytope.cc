// SPDX-License-Identifier: MIT
#include "touchstone/core/proximity/inner_polytope.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "touchstone/core/cd_dual/exact_support.h"
#include "touchstone/core/proximity/signs_of_points.h"

namespace touchstone {
namespace {

// Of the size: how much of its distance a triangle may lose by a normal of rounded corners before a
// finer one is worth its time. The bound is coarse, and what is lost in truth a small part of it;
// `Sharpen` mends where it matters.
constexpr double kWorstTilt = 1e-11;

}  // namespace

double InnerPolytope::DistanceError(const MinkowskiDifference& m) {
  // n.w / |n| with w off by E in each coordinate and three roundings of the dot product, |n|_1 <=
  // 1.74 |n|; the quotient and |n| add 4 u of a distance of at most 2 size.
  return 1.01 * (1.74 * (m.coordinate_error() + 3.1 * kRoundingUnit * 2.0 * m.size()) +
                 8.0 * kRoundingUnit * m.size());
}

void InnerPolytope::Clear() {
  corners_.clear();
  exact_points_.clear();
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

// How far the corners of a triangle may seem to be off its plane because its normal is: that is
// lost from its distance.
double InnerPolytope::Tilt(const Triangle& t, double extent) {
  const double largest = t.normal.cwiseAbs().maxCoeff();
  if (!(largest > 0.0)) return HUGE_VAL;
  return 3.0 * t.normal_error / largest * extent;
}

// The normal from the corners' differences, feature by feature, and where that is not enough, for
// slivers, by big numbers; over a power of two.
void InnerPolytope::Straighten(Signs* signs, double extent, Triangle* t) {
  const std::array<VertexPair, 3> corners = {
      corners_[t->corners[0]].pair, corners_[t->corners[1]].pair, corners_[t->corners[2]].pair};
  const FacetPlane plane = signs->Plane(corners);
  int exponent = 0;
  std::frexp(plane.normal.cwiseAbs().maxCoeff(), &exponent);
  for (int k = 0; k < 3; ++k) t->normal[k] = std::ldexp(plane.normal[k], -exponent);
  t->normal_error = std::ldexp(plane.normal_error, -exponent) + 0x1p-1000;
  if (signs->exact_allowed() && !(Tilt(*t, extent) <= kWorstTilt)) SetExactNormal(signs, t);
  t->length = t->normal.norm();
}

void InnerPolytope::MakeExact(Signs* signs, int corner) {
  if (corners_[corner].exact >= 0) return;
  corners_[corner].exact = static_cast<int>(exact_points_.size());
  exact_points_.push_back(signs->exact().Point(corners_[corner].pair));
}

DyadicVector InnerPolytope::ExactNormal(Signs* signs, const Triangle& t) {
  for (const int corner : t.corners) MakeExact(signs, corner);
  const DyadicVector& origin = Exact(t.corners[0]);
  return Cross(Exact(t.corners[1]) - origin, Exact(t.corners[2]) - origin);
}

void InnerPolytope::SetExactNormal(Signs* signs, Triangle* t) {
  signs->CountExact();
  t->normal = ToDirection(ExactNormal(signs, *t));
  t->normal_error = kRoundingUnit;
  t->length = t->normal.norm();
}

// At most the distance of o from the three corners along the normal.
void InnerPolytope::SetDistance(Triangle* t) const {
  const double lowest = std::min({t->normal.dot(corners_[t->corners[0]].point),
                                  t->normal.dot(corners_[t->corners[1]].point),
                                  t->normal.dot(corners_[t->corners[2]].point)});
  t->distance = t->length > 0.0 ? std::max(0.0, lowest / t->length) : 0.0;
}

void InnerPolytope::Sharpen(Signs* signs, double least) {
  if (!signs->exact_allowed()) return;
  for (Triangle& t : triangles_) {
    if (!t.alive || t.distance >= least) continue;
    SetExactNormal(signs, &t);
    SetDistance(&t);
  }
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
  const double extent = std::max(lu, lv);
  const double e = 2.0 * m.coordinate_error() + kRoundingUnit * extent;
  t.normal_error = 1.01 * (4.1 * kRoundingUnit * lu * lv + 2.0 * e * (lu + lv + e)) + 0x1p-1000;
  if (!(Tilt(t, extent) <= kWorstTilt)) Straighten(signs, extent, &t);
  SetDistance(&t);
  // det[a b c] = N.a with N off by dn, a by E: as in Signs::AlongNormal.
  const double n1 = t.normal.lpNorm<1>(), largest = 2.0 * m.size();
  const double error = 1.01 * ((n1 + 3.0 * t.normal_error) * m.coordinate_error() +
                               3.1 * kRoundingUnit * n1 * largest + 3.0 * t.normal_error * largest);
  if (t.distance * t.length > 1.01 * error) return true;
  const auto corners = Corners(triangle);
  Signs in_doubles(m, Certainty::kFloat);
  if (const auto side = in_doubles.Determinant(corners[0], corners[1], corners[2]))
    return *side > 0;
  if (!signs->exact_allowed()) return false;
  signs->CountExact();
  for (const int corner : t.corners) MakeExact(signs, corner);
  return Determinant(Exact(t.corners[0]), Exact(t.corners[1]), Exact(t.corners[2])).sign() >= 0;
}

bool InnerPolytope::Start(Signs* signs, const std::array<VertexPair, 3>& triangle) {
  // Not flat: o lies strictly on the inner side of the front.
  const auto front = signs->Determinant(triangle[0], triangle[1], triangle[2]);
  if (!front || *front <= 0) return false;
  const std::array<VertexPair, 4> corners = {kInteriorDifference, triangle[0], triangle[1],
                                             triangle[2]};
  static constexpr std::array<int, 3> kSides[] = {{1, 2, 3}, {0, 2, 1}, {0, 3, 2}, {0, 1, 3}};
  return Make(signs, corners, kSides);
}

bool InnerPolytope::StartFromSupports(Signs* signs, const Eigen::Matrix3d& axes,
                                      PhaseCounts* counts) {
  std::array<VertexPair, 6> corners;
  for (int k = 0; k < 3; ++k) {
    corners[2 * k] = signs->difference().Support(axes.col(k), {}, counts);
    corners[2 * k + 1] = signs->difference().Support(-axes.col(k), {}, counts);
  }
  static constexpr std::array<int, 3> kSides[] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                                  {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return Make(signs, corners, kSides);
}

// The closed surface of these triangles, o on the inner side of each.
bool InnerPolytope::Make(Signs* signs, std::span<const VertexPair> corners,
                         std::span<const std::array<int, 3>> sides) {
  Clear();
  for (const VertexPair& pair : corners) {
    corners_.push_back({pair, pair == kInteriorDifference ? signs->difference().c()
                                                          : signs->difference().Point(pair)});
  }
  for (const auto& [a, b, c] : sides) AddTriangle(a, b, c);
  for (Triangle& t : triangles_) {
    for (int k = 0; k < 3; ++k) {
      for (int other = 0; other < static_cast<int>(sides.size()); ++other) {
        for (int i = 0; i < 3; ++i) {
          if (sides[other][i] == t.corners[(k + 1) % 3] &&
              sides[other][(i + 1) % 3] == t.corners[k])
            t.across[k] = other;
        }
      }
    }
  }
  for (int i = 0; i < static_cast<int>(triangles_.size()); ++i) {
    if (!Evaluate(signs, i)) {
      Clear();
      return false;
    }
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
    corner.exact = -1;
  }
  exact_points_.clear();
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

std::optional<int> InnerPolytope::IsBeyond(Signs* signs, int triangle, int corner) {
  const MinkowskiDifference& m = signs->difference();
  const Triangle& t = triangles_[triangle];
  const Eigen::Vector3d from = corners_[corner].point - corners_[t.corners[0]].point;
  // N.(w - a) with N off by dn, each end by E, the difference rounded once.
  const double value = t.normal.dot(from), n1 = t.normal.lpNorm<1>();
  const double largest = from.cwiseAbs().maxCoeff();
  const double error =
      1.01 * ((n1 + 3.0 * t.normal_error) * 2.0 * m.coordinate_error() +
              4.1 * kRoundingUnit * n1 * largest + 3.0 * t.normal_error * largest) +
      0x1p-1000;
  if (value > error) return 1;
  if (value < -error) return -1;
  Signs in_doubles(m, Certainty::kFloat);
  if (const auto sign = Beyond(&in_doubles, Corners(triangle), corners_[corner].pair)) return sign;
  if (!signs->exact_allowed()) return std::nullopt;
  signs->CountExact();
  MakeExact(signs, corner);
  const DyadicVector normal = ExactNormal(signs, t);
  return Dot(normal, Exact(corner) - Exact(t.corners[0])).sign();
}

// Walks over the triangles that w lies beyond, from `first`, and leaves them in dead_, and the
// sides between them and the rest in horizon_, in order. False where a sign cannot be told.
bool InnerPolytope::CollectHorizon(Signs* signs, int first, int apex) {
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
      const auto sign = IsBeyond(signs, next, apex);
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

InnerPolytope::Growth InnerPolytope::Expand(Signs* signs, int triangle, VertexPair w) {
  const int apex = static_cast<int>(corners_.size());
  corners_.push_back({w, signs->difference().Point(w)});
  const auto sign = IsBeyond(signs, triangle, apex);
  if (!sign || *sign <= 0) {
    corners_.pop_back();
    return Growth::kNotBeyond;
  }
  if (!CollectHorizon(signs, triangle, apex) || !AddFan(signs, apex)) {
    corners_.pop_back();
    return Growth::kImpossible;
  }
  return Growth::kGrown;
}

// Replaces the triangles of dead_ by a fan from the horizon. False, with nothing changed, if it is
// no loop or a triangle of the fan has o on its outer side.
bool InnerPolytope::AddFan(Signs* signs, int apex) {
  const std::size_t count = horizon_.size();
  if (count < 3) return false;
  for (std::size_t i = 0; i < count; ++i) {
    if (horizon_[i].to != horizon_[(i + 1) % count].from) return false;
  }
  fan_.clear();
  for (const Side& side : horizon_) {
    fan_.push_back(AddTriangle(side.from, side.to, apex));
    if (Evaluate(signs, fan_.back())) continue;
    for (const int t : fan_) Kill(t);
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
