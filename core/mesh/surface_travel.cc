// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/surface_travel.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "touchstone/core/base/dyadic.h"
#include "touchstone/core/mesh/tree_items.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;
using Candidate = SurfaceTravelCache::Candidate;
using Waiting = SurfaceTravelCache::Waiting;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kUnderflow = 0x1p-1000;
// The pair's coordinates are at most one and the largest of the way's is a half at least: beyond
// this nothing meets.
constexpr double kFarthest = 8.0;
// Bounds that differ by less need no big numbers for the sake of it.
constexpr double kTight = 0x1p-44;
constexpr int kMostTightened = 16;

double MaxAbs(const Vector3d& v) { return v.cwiseAbs().maxCoeff(); }

double Down(double x) { return x - 0x1p-50 * std::abs(x) - kUnderflow; }
double Up(double x) { return x + 0x1p-50 * std::abs(x) + kUnderflow; }

// A vector, each coordinate of which is off by at most `error`.
struct Rough {
  Vector3d v;
  double error;
};

// A coordinate is u_i v_j - u_j v_i: two roundings on each path, 2.01 units of the absolute terms,
// at most 2 |u||v|; errors of u and v add 2 (|u| e_v + |v| e_u + e_u e_v).
Rough Cross(const Rough& a, const Rough& b) {
  const double u = MaxAbs(a.v), v = MaxAbs(b.v);
  return {a.v.cross(b.v),
          1.01 * (4.1 * kUnit * u * v + 2.0 * (u * b.error + v * a.error + a.error * b.error)) +
              kUnderflow};
}

// The t in [first, last] that are left; empty where first > last.
struct Interval {
  double first = 0.0, last = kFarthest;

  bool is_empty() const { return !(first <= last); }
  // Keeps those with c + t m <= 0, and by a rounding more, or less.
  void Cut(double c, double m, bool outward) {
    const auto round = [&](double x, bool down) { return down == outward ? Down(x) : Up(x); };
    if (m < 0.0) {
      first = std::max(first, round(c / -m, true));
    } else if (m > 0.0) {
      last = std::min(last, round(-c / m, false));
    } else if (c > 0.0) {
      last = -kInfinity;
    }
  }
};

// Two faces where they are, and the axes that decide about them.
struct FacePair {
  std::array<Vector3d, 3> a, b;
  std::array<Rough, 17> axes;
};

// The interval of two faces by big numbers: fractions with positive denominators.
class ExactInterval {
 public:
  explicit ExactInterval(const Dyadic& reach) : last_(reach) {}

  // Keeps those with c + t m <= 0.
  void Cut(const Dyadic& c, const Dyadic& m) {
    if (m.sign() < 0) {
      const Dyadic denominator = -m;
      if ((c * first_denominator_ - first_ * denominator).sign() > 0) {
        first_ = c;
        first_denominator_ = denominator;
      }
    } else if (m.sign() > 0) {
      const Dyadic numerator = -c;
      if ((numerator * last_denominator_ - last_ * m).sign() < 0) {
        last_ = numerator;
        last_denominator_ = m;
      }
    } else if (c.sign() > 0) {
      is_empty_ = true;
    }
  }
  bool is_empty() const {
    return is_empty_ || (first_ * last_denominator_ - last_ * first_denominator_).sign() > 0;
  }
  double first() const { return RatioToDouble(first_, first_denominator_); }
  // Whether `value` is the first one, exactly.
  bool IsFirst(double value) const {
    return (Dyadic(value) * first_denominator_ - first_).sign() == 0;
  }

 private:
  Dyadic first_{0}, first_denominator_{1};
  Dyadic last_, last_denominator_{1};
  bool is_empty_ = false;
};

// Lengths are those of the placed pair; the way is s times a power of two, and the travel along it
// tau = t * to_tau.
class Sweep {
 public:
  Sweep(const MeshPair& pair, const Vector3d& s, double reach, SurfaceTravelCache* cache)
      : pair_(pair), s_(s), reach_(reach), cache_(*cache) {
    int exponent = 0;
    std::frexp(MaxAbs(s), &exponent);
    way_ = std::ldexp(1.0, -exponent) * s;
    to_tau_ = std::ldexp(pair.scale(), exponent);
    tau_reach_ = std::min(kFarthest, reach * to_tau_);
    best_ = tau_reach_ < kFarthest ? Up(tau_reach_) : kFarthest;
    point_error_ = pair.a().point_error + pair.b().point_error;
  }

  SurfaceTravelResult Run() {
    FindCandidates();
    Settle();
    Tighten();
    Finish();
    return result_;
  }

 private:
  static bool IsLater(const Waiting& x, const Waiting& y) {
    return std::tie(x.enter, x.a, x.b) > std::tie(y.enter, y.a, y.b);
  }

  void Push(const Waiting& waiting) {
    cache_.queue.push_back(waiting);
    std::push_heap(cache_.queue.begin(), cache_.queue.end(), IsLater);
  }

  void FindCandidates() {
    cache_.queue.clear();
    cache_.candidates.clear();
    Push({0.0, 0, 0});
    while (!cache_.queue.empty()) {
      std::pop_heap(cache_.queue.begin(), cache_.queue.end(), IsLater);
      const Waiting next = cache_.queue.back();
      cache_.queue.pop_back();
      if (next.enter > best_) break;
      Open(next.a, next.b);
    }
  }

  void Open(int code_a, int code_b) {
    const PlacedMesh &a = pair_.a(), &b = pair_.b();
    TreeItem items_a[kTreeWidth], items_b[kTreeWidth];
    const int count_a = ItemsOf(a.tree, a.points, a.mesh.faces(), code_a, items_a);
    const int count_b = ItemsOf(b.tree, b.points, b.mesh.faces(), code_b, items_b);
    result_.node_pairs += static_cast<long>(count_a) * count_b;
    for (int i = 0; i < count_a; ++i) {
      for (int j = 0; j < count_b; ++j) {
        const Interval interval = BoxesMeet(items_a[i], items_b[j]);
        if (interval.is_empty()) continue;
        if (items_a[i].child < 0 && items_b[j].child < 0) {
          Compare(~items_a[i].child, ~items_b[j].child);
        } else {
          Push({interval.first, items_a[i].child, items_b[j].child});
        }
      }
    }
  }

  // For which travels the boxes may meet: each side is off by its points' error, differences of two
  // at most are rounded twice, and the way is off by an underflow.
  Interval BoxesMeet(const TreeItem& a, const TreeItem& b) const {
    const double slack = point_error_ + 6.0 * kUnit + kUnderflow;
    Interval interval{0.0, best_};
    for (int axis = 0; axis < 3; ++axis) {
      interval.Cut(b.low[axis] - a.high[axis] - slack, way_[axis], true);
      interval.Cut(a.low[axis] - b.high[axis] - slack, -way_[axis], true);
    }
    return interval;
  }

  FacePair PairOf(int face_a, int face_b) const {
    FacePair f;
    std::array<Rough, 3> sides_a, sides_b;
    const auto fill = [](const PlacedMesh& placed, int face, std::array<Vector3d, 3>* corners,
                         std::array<Rough, 3>* sides) {
      const Triangle& triangle = placed.mesh.face(face);
      for (int k = 0; k < 3; ++k) (*corners)[k] = placed.points[triangle[k]];
      for (int k = 0; k < 3; ++k) {
        const Vector3d side = (*corners)[(k + 1) % 3] - (*corners)[k];
        (*sides)[k] = {side, 2.0 * placed.point_error + kUnit * MaxAbs(side) + kUnderflow};
      }
    };
    fill(pair_.a(), face_a, &f.a, &sides_a);
    fill(pair_.b(), face_b, &f.b, &sides_b);
    const FacePlane &plane_a = pair_.a().planes[face_a], &plane_b = pair_.b().planes[face_b];
    f.axes[0] = {plane_a.normal, plane_a.error};
    f.axes[1] = {plane_b.normal, plane_b.error};
    for (int i = 0; i < 3; ++i) {
      f.axes[2 + i] = Cross(f.axes[0], sides_a[i]);
      f.axes[5 + i] = Cross(f.axes[1], sides_b[i]);
      for (int j = 0; j < 3; ++j) f.axes[8 + 3 * i + j] = Cross(sides_a[i], sides_b[j]);
    }
    return f;
  }

  // Along an axis n B is at n.b + tau r and A at n.a; faces that meet have n.b_min + tau r <=
  // n.a_max and n.b_max + tau r >= n.a_min. Heights are over a corner of A.
  //
  // Any n parts the faces where it does, so for the interval that is surely large enough n is taken
  // at its word. With d the largest sum of a difference's coordinates, a height is off by 3.01
  // units of |n| d and by |n|_1 times the difference's error; c is made of two, of at most 2 |n| d,
  // by two subtractions: 10.1 units in all. The interval that is surely small enough is cut by the
  // exact axes, which n is off. As t >= 0, the rate's error is put on the side that keeps more, or
  // less.
  void CutByAxis(const FacePair& f, const Rough& axis, Interval* outer, Interval* inner,
                 Vector3d* normal) const {
    const Vector3d& n = axis.v;
    double low_a = 0.0, high_a = 0.0, low_b = kInfinity, high_b = -kInfinity, reach = 0.0;
    for (int k = 0; k < 3; ++k) {
      const Vector3d to_a = f.a[k] - f.a[0], to_b = f.b[k] - f.a[0];
      const double height_a = n.dot(to_a), height_b = n.dot(to_b);
      low_a = std::min(low_a, height_a);
      high_a = std::max(high_a, height_a);
      low_b = std::min(low_b, height_b);
      high_b = std::max(high_b, height_b);
      reach = std::max({reach, to_a.lpNorm<1>(), to_b.lpNorm<1>()});
    }
    const double rate = n.dot(way_), largest = MaxAbs(n), sum = n.lpNorm<1>();
    const double off = point_error_ + pair_.a().point_error + 2.0 * kUnit + kUnderflow;
    const double height_error = 2.02 * (sum * off + 5.2 * kUnit * largest * reach) + kUnderflow;
    const double rate_error = 4.2 * kUnit * largest * way_.lpNorm<1>() + kUnderflow;
    const double before = outer->first;
    outer->Cut(low_b - high_a - height_error, rate - rate_error, true);
    outer->Cut(low_a - high_b - height_error, -rate - rate_error, true);
    if (outer->first > before) *normal = rate < 0.0 ? n : Vector3d(-n);
    const double more = 2.02 * axis.error * (reach + 3.0 * off), faster = 3.1 * axis.error;
    inner->Cut(low_b - high_a + height_error + more, rate + rate_error + faster, false);
    inner->Cut(low_a - high_b + height_error + more, -rate + rate_error + faster, false);
  }

  void Compare(int face_a, int face_b) {
    ++result_.face_pairs;
    const FacePair f = PairOf(face_a, face_b);
    Interval outer{0.0, best_}, inner{0.0, kFarthest};
    Candidate candidate{
        0.0, kInfinity, 0.0, face_a, face_b, Vector3d::Zero(), Candidate::State::kOpen};
    for (const Rough& axis : f.axes) {
      CutByAxis(f, axis, &outer, &inner, &candidate.normal);
      if (outer.is_empty()) return;
    }
    candidate.enter = outer.first;
    if (inner.first <= std::min(inner.last, Down(tau_reach_))) {
      candidate.state = Candidate::State::kCertain;
      candidate.enter_at_most = inner.first;
      candidate.travel = 0.5 * (outer.first + inner.first);
      best_ = std::min(best_, inner.first);
    }
    cache_.candidates.push_back(candidate);
  }

  static bool IsFirst(const Candidate& x, const Candidate& y) {
    return std::tie(x.enter, x.face_a, x.face_b) < std::tie(y.enter, y.face_a, y.face_b);
  }

  // Decides all open candidates that might come first.
  void Settle() {
    std::sort(cache_.candidates.begin(), cache_.candidates.end(), IsFirst);
    for (Candidate& candidate : cache_.candidates) {
      if (candidate.enter > best_) break;
      if (candidate.state == Candidate::State::kOpen) DecideExactly(&candidate);
    }
  }

  Candidate* First() {
    Candidate* first = nullptr;
    for (Candidate& candidate : cache_.candidates) {
      if (candidate.state != Candidate::State::kCertain &&
          candidate.state != Candidate::State::kExact) {
        continue;
      }
      if (first == nullptr || IsFirst(candidate, *first)) first = &candidate;
    }
    return first;
  }

  // The first by big numbers, and others while the bounds are wide.
  void Tighten() {
    for (int i = 0; i < kMostTightened; ++i) {
      Candidate* first = First();
      if (first == nullptr || first->state == Candidate::State::kExact) return;
      if (i > 0 && best_ - first->enter <= kTight) return;
      DecideExactly(first);
    }
  }

  void DecideExactly(Candidate* candidate) {
    ++result_.exact_pairs;
    if (!exact_) exact_.emplace(pair_);
    std::array<DyadicVector, 3> a, b;
    for (int k = 0; k < 3; ++k) {
      a[k] = exact_->PointOfA(pair_.a().mesh.face(candidate->face_a)[k]);
      b[k] = exact_->PointOfB(pair_.b().mesh.face(candidate->face_b)[k]);
    }
    const DyadicVector way = exact_->pose().factor() * ToDyadic(s_);
    ExactInterval interval{Dyadic(reach_)};
    const DyadicVector normal_a = Cross(a[1] - a[0], a[2] - a[0]);
    const DyadicVector normal_b = Cross(b[1] - b[0], b[2] - b[0]);
    CutExactly(normal_a, a, b, way, &interval);
    CutExactly(normal_b, a, b, way, &interval);
    for (int i = 0; i < 3; ++i) {
      const DyadicVector side_a = a[(i + 1) % 3] - a[i];
      CutExactly(Cross(normal_a, side_a), a, b, way, &interval);
      CutExactly(Cross(normal_b, b[(i + 1) % 3] - b[i]), a, b, way, &interval);
      for (int j = 0; j < 3; ++j) {
        CutExactly(Cross(side_a, b[(j + 1) % 3] - b[j]), a, b, way, &interval);
      }
    }
    candidate->state = interval.is_empty() ? Candidate::State::kNever : Candidate::State::kExact;
    if (interval.is_empty()) return;
    const double t = interval.first();
    const bool is_double = interval.IsFirst(t);
    candidate->travel = t * to_tau_;
    candidate->enter = is_double ? candidate->travel : Down(candidate->travel);
    candidate->enter_at_most = is_double ? candidate->travel : Up(candidate->travel);
    best_ = std::min(best_, candidate->enter_at_most);
  }

  static void CutExactly(const DyadicVector& axis, const std::array<DyadicVector, 3>& a,
                         const std::array<DyadicVector, 3>& b, const DyadicVector& way,
                         ExactInterval* interval) {
    const auto less = [](const Dyadic& x, const Dyadic& y) { return (x - y).sign() < 0; };
    std::array<Dyadic, 3> on_a, on_b;
    for (int k = 0; k < 3; ++k) {
      on_a[k] = Dot(axis, a[k]);
      on_b[k] = Dot(axis, b[k]);
    }
    const auto [low_a, high_a] = std::minmax_element(on_a.begin(), on_a.end(), less);
    const auto [low_b, high_b] = std::minmax_element(on_b.begin(), on_b.end(), less);
    const Dyadic rate = Dot(axis, way);
    interval->Cut(*low_b - *high_a, rate);
    interval->Cut(*low_a - *high_b, -rate);
  }

  void Finish() {
    const Candidate* first = First();
    if (first == nullptr) return;
    result_.is_hit = true;
    result_.lower_bound = std::max(0.0, first->enter) / to_tau_;
    result_.upper_bound = best_ / to_tau_;
    result_.travel = std::clamp(first->travel / to_tau_, result_.lower_bound, result_.upper_bound);
    result_.face_a = first->face_a;
    result_.face_b = first->face_b;
    result_.normal = first->normal.stableNormalized();
  }

  const MeshPair& pair_;
  const Vector3d s_;
  const double reach_;
  SurfaceTravelCache& cache_;
  Vector3d way_;
  double to_tau_, tau_reach_, point_error_;
  double best_;  // the first travel is at most this; beyond it none counts
  std::optional<ExactMeshPair> exact_;
  SurfaceTravelResult result_;
};

}  // namespace

SurfaceTravelResult SurfaceTravel(const MeshPair& pair, const Vector3d& s, double reach,
                                  SurfaceTravelCache* cache) {
  assert(s.allFinite() && std::isfinite(reach) && reach >= 0.0);
  SurfaceTravelCache own;
  return Sweep(pair, s, reach, cache != nullptr ? cache : &own).Run();
}

}  // namespace touchstone
