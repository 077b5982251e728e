// SPDX-License-Identifier: MIT
#include "touchstone/core/proximity/line.h"

#include <Eigen/Geometry>
#include <cassert>
#include <cmath>
#include <utility>

#include "touchstone/core/cd_dual/exact_support.h"
#include "touchstone/core/proximity/estimate_internal.h"

namespace touchstone {
namespace {

constexpr int kMaxRounds = 128;

// 2-D cross product of the shadows: positive when the line lies to the left of a -> b.
double Turn(const LinePoint& a, const LinePoint& b) { return a.x * b.y - a.y * b.x; }

class LineSearch {
 public:
  LineSearch(const MinkowskiDifference& m, const Eigen::Vector3d& s, PhaseCounts* counts)
      : up_(m, s), down_(m, -s), counts_(counts) {}

  LineProposal Run() {
    if (!Surround()) return proposal_;
    if (!Push(up_, start_, &proposal_.upper)) return proposal_;
    // Seen from the other end the triangle turns the other way.
    const std::array<VertexPair, 3> turned = {start_[1], start_[0], start_[2]};
    if (!Push(down_, turned, &proposal_.lower)) return proposal_;
    proposal_.kind = LineProposal::Kind::kCrossed;
    return proposal_;
  }

 private:
  // In the shadow: from c towards o, the edge between the supports on either side of the ray is
  // pushed outward until o is on its inner side, or nothing lies beyond it.
  bool Surround() {
    const LinePoint c = up_.Point(kInteriorDifference);
    const auto side = [&](const LinePoint& a) {  // of o as seen from c -> a
      return (a.x - c.x) * -c.y - (a.y - c.y) * -c.x;
    };
    double rx = -c.x, ry = -c.y;
    if (!(std::hypot(rx, ry) > 0.0)) rx = 1.0;
    LinePoint right = up_.Support(rx, ry, 0.0, counts_), left = right;
    // `right` has o to its left, `left` to its right.
    if (side(right) >= 0.0) {
      for (int round = 0; round < kMaxRounds; ++round) {
        left = up_.Support(-(right.y - c.y), right.x - c.x, 0.0, counts_);
        if (side(left) <= 0.0) break;
        right = left;
      }
    } else {
      for (int round = 0; round < kMaxRounds; ++round) {
        right = up_.Support(left.y - c.y, -(left.x - c.x), 0.0, counts_);
        if (side(right) >= 0.0) break;
        left = right;
      }
    }
    for (int round = 0; round < kMaxRounds; ++round) {
      if (Turn(right, left) >= 0.0) {
        start_ = {kInteriorDifference, right.pair, left.pair};
        return !(right.pair == left.pair);
      }
      const double nx = left.y - right.y, ny = -(left.x - right.x);
      const LinePoint beyond = up_.Support(nx, ny, 0.0, counts_);
      if (beyond.pair == right.pair || beyond.pair == left.pair ||
          !(nx * (beyond.x - right.x) + ny * (beyond.y - right.y) > 0.0)) {
        proposal_.kind = LineProposal::Kind::kMissed;
        proposal_.edge = {right.pair, left.pair};
        return false;
      }
      (side(beyond) >= 0.0 ? right : left) = beyond;
    }
    return false;
  }

  // Pushes a triangle around the line upward until nothing lies beyond its plane.
  bool Push(const LineFrame& frame, const std::array<VertexPair, 3>& start,
            std::array<VertexPair, 3>* triangle) {
    LinePoint x[3] = {frame.Point(start[0]), frame.Point(start[1]), frame.Point(start[2])};
    for (int round = 0; round < kMaxRounds; ++round) {
      ++counts_->faces_visited;
      *triangle = {x[0].pair, x[1].pair, x[2].pair};
      const double ux = x[1].x - x[0].x, uy = x[1].y - x[0].y, uz = x[1].z - x[0].z;
      const double vx = x[2].x - x[0].x, vy = x[2].y - x[0].y, vz = x[2].z - x[0].z;
      const double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
      const LinePoint beyond = frame.Support(nx, ny, nz, counts_);
      if (beyond.pair == x[0].pair || beyond.pair == x[1].pair || beyond.pair == x[2].pair ||
          !(nx * (beyond.x - x[0].x) + ny * (beyond.y - x[0].y) + nz * (beyond.z - x[0].z) > 0.0)) {
        return true;
      }
      const double t0 = Turn(beyond, x[0]), t1 = Turn(beyond, x[1]), t2 = Turn(beyond, x[2]);
      if (t0 >= 0.0) {
        x[t1 <= 0.0 ? 2 : 0] = beyond;
      } else {
        x[t2 >= 0.0 ? 1 : 0] = beyond;
      }
    }
    return true;
  }

  const LineFrame up_, down_;
  PhaseCounts* counts_;
  std::array<VertexPair, 3> start_;
  LineProposal proposal_;
};

DyadicVector Negated(const DyadicVector& v) { return {-v[0], -v[1], -v[2]}; }

struct ExactPoint {
  VertexPair pair;
  DyadicVector point;
};

class ExactLineSearch {
 public:
  ExactLineSearch(Signs* signs, const DyadicVector& s, bool outward, PhaseCounts* counts)
      : signs_(signs),
        big_(signs->exact()),
        s_(s),
        outward_(outward),
        c_(Make(kInteriorDifference)),
        counts_(counts) {}

  LineProposal Run() {
    LineProposal proposal;
    std::array<ExactPoint, 3> start;
    if (!Surround(&start, &proposal.edge)) {
      proposal.kind = LineProposal::Kind::kMissed;
      return proposal;
    }
    proposal.kind = LineProposal::Kind::kCrossed;
    proposal.upper = Push(start);
    s_ = Negated(s_);
    std::swap(start[0], start[1]);
    proposal.lower = Push(start);
    return proposal;
  }

 private:
  ExactPoint Make(VertexPair pair) const { return {pair, big_.Point(pair)}; }

  ExactPoint Support(const DyadicVector& n) const {
    signs_->CountExact();
    return Make(ExactSupport(big_, signs_->difference(), n, counts_));
  }

  // On which side of a -> b, seen against s, the moved line lies: 1 to the left. With the line
  // through l it is s.((a - l) x (b - l)) = s.(a x b) + l.(s x (b - a)). Zero only for points with
  // one shadow.
  int Side(const ExactPoint& a, const ExactPoint& b) const {
    if (const int sign = Dot(s_, Cross(a.point, b.point)).sign()) return sign;
    const DyadicVector across = Cross(s_, b.point - a.point);
    if (const int sign = Dot(c_.point, across).sign()) return outward_ ? -sign : sign;
    for (const Dyadic& x : across) {
      if (const int sign = x.sign()) return sign;
    }
    return 0;
  }

  // As LineSearch::Surround.
  bool Surround(std::array<ExactPoint, 3>* start, std::array<VertexPair, 2>* edge) const {
    // From c towards o, across s: c's part along s taken from -c, times s.s.
    const Dyadic along = Dot(c_.point, s_), squared = Dot(s_, s_);
    DyadicVector toward;
    bool on_line = true;
    for (int k = 0; k < 3; ++k) {
      toward[k] = along * s_[k] - squared * c_.point[k];
      on_line = on_line && toward[k].sign() == 0;
    }
    for (int k = 0; k < 3 && on_line; ++k) {  // any direction across s
      DyadicVector axis = {Dyadic(0), Dyadic(0), Dyadic(0)};
      axis[k] = Dyadic(1);
      toward = Cross(s_, axis);
      on_line = toward[0].sign() == 0 && toward[1].sign() == 0 && toward[2].sign() == 0;
    }
    ExactPoint right = Support(toward), left = right;
    if (Side(c_, right) > 0) {
      do {
        left = Support(Cross(s_, right.point - c_.point));
        if (Side(c_, left) < 0) break;
        right = left;
      } while (true);
    } else {
      do {
        right = Support(Cross(left.point - c_.point, s_));
        if (Side(c_, right) > 0) break;
        left = right;
      } while (true);
    }
    while (Side(right, left) <= 0) {
      const DyadicVector n = Cross(left.point - right.point, s_);
      const ExactPoint beyond = Support(n);
      if (Dot(n, beyond.point - right.point).sign() <= 0) {
        *edge = {right.pair, left.pair};
        return false;
      }
      (Side(c_, beyond) > 0 ? right : left) = beyond;
    }
    *start = {c_, right, left};
    return true;
  }

  std::array<VertexPair, 3> Push(std::array<ExactPoint, 3> x) const {
    for (;;) {
      ++counts_->faces_visited;
      const DyadicVector n = Cross(x[1].point - x[0].point, x[2].point - x[0].point);
      const ExactPoint beyond = Support(n);
      if (Dot(n, beyond.point - x[0].point).sign() <= 0) return {x[0].pair, x[1].pair, x[2].pair};
      const int s0 = Side(beyond, x[0]), s1 = Side(beyond, x[1]), s2 = Side(beyond, x[2]);
      if (s0 > 0 && s1 < 0) {
        x[2] = beyond;
      } else if (s1 > 0 && s2 < 0) {
        x[0] = beyond;
      } else {
        assert(s2 > 0 && s0 < 0);
        x[1] = beyond;
      }
    }
  }

  Signs* signs_;
  const ExactDifference& big_;
  DyadicVector s_;
  const bool outward_;
  const ExactPoint c_;
  PhaseCounts* counts_;
};

}  // namespace

LineFrame::LineFrame(const MinkowskiDifference& m, const Eigen::Vector3d& s) : m_(m) {
  // An orthonormal pair across the unit vector z (Duff et al. 2017).
  const Eigen::Vector3d z = s / s.norm();
  const double sign = std::copysign(1.0, z[2]);
  const double a = -1.0 / (sign + z[2]), b = z[0] * z[1] * a;
  axes_.col(0) << 1.0 + sign * z[0] * z[0] * a, sign * b, -sign * z[0];
  axes_.col(1) << b, sign + z[1] * z[1] * a, -z[1];
  axes_.col(2) = z;
}

LinePoint LineFrame::Support(double nx, double ny, double nz, PhaseCounts* counts) const {
  return Point(m_.Support(axes_ * Eigen::Vector3d(nx, ny, nz), {}, counts));
}

LinePoint LineFrame::Point(VertexPair pair) const {
  const Eigen::Vector3d w =
      axes_.transpose() * (pair == kInteriorDifference ? m_.c() : m_.Point(pair));
  return {pair, w[0], w[1], w[2]};
}

LineProposal SearchLine(const MinkowskiDifference& m, const Eigen::Vector3d& s,
                        PhaseCounts* counts) {
  return LineSearch(m, s, counts).Run();
}

LineDirection::LineDirection(const Eigen::Vector3d& s) : exact(ToDyadic(s)) {
  std::frexp(s.cwiseAbs().maxCoeff(), &exponent);
  for (int k = 0; k < 3; ++k) scaled[k] = std::ldexp(s[k], -exponent);
}

std::optional<int> LineSide(Signs* signs, const LineDirection& s, VertexPair a, VertexPair b) {
  const MinkowskiDifference& m = signs->difference();
  // s.(a x b) as s.(a x (b - a)); an entry of s that was rounded to zero was below 2^-1000.
  const internal::EstimateVector direction = internal::MakeEstimate(s.scaled, 0x1p-1000);
  const internal::Estimate side =
      Dot(direction, Cross(internal::PointOf(m, a), internal::DifferenceOf(m, b, a)));
  if (side.value > side.error) return 1;
  if (side.value < -side.error) return -1;
  if (!signs->exact_allowed()) return std::nullopt;
  signs->CountExact();
  const ExactDifference& big = signs->exact();
  return Dot(s.exact, Cross(big.Point(a), big.Point(b))).sign();
}

LineProposal FindExactLine(Signs* signs, const LineDirection& s, bool outward,
                           PhaseCounts* counts) {
  return ExactLineSearch(signs, s.exact, outward, counts).Run();
}

}  // namespace touchstone
