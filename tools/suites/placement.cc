// SPDX-License-Identifier: MIT
#include "touchstone/tools/suites/placement.h"

#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include "touchstone/core/base/dyadic.h"
#include "touchstone/core/cd_dual/result.h"
#include "touchstone/tools/suites/arithmetic.h"

namespace touchstone {
namespace {

constexpr int kMaxRounds = 1000;

// A vertex of M, relative to the start of the line.
struct MinkowskiVertex {
  VertexPair pair;
  Eigen::Vector3d point;
};

class PortalSearch {
 public:
  PortalSearch(std::span<const Eigen::Vector3d> p, std::vector<Eigen::Vector3d> q,
               const Eigen::Vector3d& start, const Eigen::Vector3d& direction)
      : p_(p), q_(std::move(q)), start_(start), direction_(direction) {}

  // Three vertices of the facet of M that the line leaves by, up to rounding.
  std::array<MinkowskiVertex, 3> Run() {
    Enclose();
    Refine();
    return {a_, b_, c_};
  }

 private:
  MinkowskiVertex Support(const Eigen::Vector3d& normal) const {
    VertexPair best{0, 0};
    double best_p = PlainDot(normal, p_[0]);
    for (int i = 1; i < static_cast<int>(p_.size()); ++i) {
      const double value = PlainDot(normal, p_[i]);
      if (value > best_p) best_p = value, best.p = i;
    }
    double best_q = PlainDot(normal, q_[0]);
    for (int j = 1; j < static_cast<int>(q_.size()); ++j) {
      const double value = PlainDot(normal, q_[j]);
      if (value < best_q) best_q = value, best.q = j;
    }
    return {best, (p_[best.p] - q_[best.q]) - start_};
  }

  // A triangle of M's vertices that the line crosses.
  void Enclose() {
    a_ = Support(direction_);
    Eigen::Vector3d normal = PlainCross(a_.point, direction_);
    if (PlainDot(normal, normal) == 0.0)
      normal = PlainCross(a_.point, Eigen::Vector3d(direction_[1], direction_[2], direction_[0]));
    b_ = Support(normal);
    normal = PlainCross(a_.point, b_.point);
    if (PlainDot(normal, direction_) < 0.0) {
      std::swap(a_, b_);
      normal = -normal;
    }
    for (int round = 0; round < kMaxRounds; ++round) {
      c_ = Support(normal);
      if (PlainDot(PlainCross(a_.point, c_.point), direction_) < 0.0) {
        b_ = c_;
        normal = PlainCross(a_.point, c_.point);
      } else if (PlainDot(PlainCross(c_.point, b_.point), direction_) < 0.0) {
        a_ = c_;
        normal = PlainCross(c_.point, b_.point);
      } else {
        return;
      }
    }
  }

  // Pushes the triangle outward until nothing lies beyond it.
  void Refine() {
    for (int round = 0; round < kMaxRounds; ++round) {
      Eigen::Vector3d normal = PlainCross(b_.point - a_.point, c_.point - a_.point);
      if (PlainDot(normal, direction_) < 0.0) normal = -normal;
      const MinkowskiVertex next = Support(normal);
      if (next.pair == a_.pair || next.pair == b_.pair || next.pair == c_.pair) return;
      if (!(PlainDot(normal, next.point) > PlainDot(normal, a_.point))) return;
      const Eigen::Vector3d side = PlainCross(next.point, direction_);
      if (PlainDot(a_.point, side) > 0.0) {
        (PlainDot(b_.point, side) > 0.0 ? a_ : c_) = next;
      } else {
        (PlainDot(c_.point, side) > 0.0 ? b_ : a_) = next;
      }
    }
  }

  std::span<const Eigen::Vector3d> p_;
  std::vector<Eigen::Vector3d> q_;  // rotated
  Eigen::Vector3d start_, direction_;
  MinkowskiVertex a_, b_, c_;
};

DyadicVector ExactPoint(const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                        const Eigen::Matrix3d& rotation, const VertexPair& pair) {
  DyadicVector point = ToDyadic(p.vertex(pair.p));
  const DyadicVector x = ToDyadic(q.vertex(pair.q));
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) point[i] = point[i] - Dyadic(rotation(i, j)) * x[j];
  }
  return point;
}

// (N . (a - start)) / (N . direction) for the plane of the facet, N its normal.
double ExactExit(const ConvexPolyhedron& p, const ConvexPolyhedron& q, const ContactLine& line,
                 const std::array<MinkowskiVertex, 3>& facet) {
  std::array<DyadicVector, 3> points;
  for (int k = 0; k < 3; ++k) points[k] = ExactPoint(p, q, line.rotation, facet[k].pair);
  const DyadicVector normal = Cross(points[1] - points[0], points[2] - points[0]);
  const Dyadic slope = Dot(normal, ToDyadic(line.direction));
  if (slope.sign() == 0) return PlainDot(facet[0].point, line.direction);
  return RatioToDouble(Dot(normal, points[0] - ToDyadic(line.start)), slope);
}

RelativePose MakePose(const ContactLine& line, const Eigen::Vector3d& translation) {
  StatusOr<RelativePose> pose = RelativePose::Make(line.rotation, translation);
  assert(pose.ok());
  return *pose;
}

}  // namespace

ContactLine FindContactLine(const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                            const Eigen::Matrix3d& rotation, const Eigen::Vector3d& direction) {
  std::vector<Eigen::Vector3d> rotated;
  rotated.reserve(q.vertices().size());
  for (const Eigen::Vector3d& x : q.vertices()) rotated.push_back(PlainRotate(rotation, x));
  ContactLine line;
  line.rotation = rotation;
  line.direction = direction;
  line.start = PlainMean(p.vertices()) - PlainMean(rotated);
  line.size = std::fmax(PlainMaxCoordinate(p.vertices()), PlainMaxCoordinate(q.vertices()));
  PortalSearch search(p.vertices(), std::move(rotated), line.start, direction);
  line.exit = ExactExit(p, q, line, search.Run());
  return line;
}

RelativePose PoseAtTravel(const ContactLine& line, double travel) {
  const double s = line.exit + travel;
  Eigen::Vector3d translation;
  for (int i = 0; i < 3; ++i) translation[i] = line.start[i] + s * line.direction[i];
  return MakePose(line, translation);
}

RelativePose PoseAtUlps(const ContactLine& line, int ulps) {
  Eigen::Vector3d translation = PoseAtTravel(line, 0.0).translation();
  if (ulps != 0) {
    const int axis = LongestAxis(line.direction);
    const bool up = (line.direction[axis] > 0.0) == (ulps > 0);
    translation[axis] = StepUlp(translation[axis], up, line.size);
  }
  return MakePose(line, translation);
}

RelativePose PoseOfPlacement(const ContactLine& line, int placement) {
  static constexpr std::array<double, kPlacementCount - 4> kTravels = {
      -50.0, -5.0, -1.0, -1e-2, -1e-6, -1e-9, -1e-12, 1e-12,
      1e-9,  1e-6, 1e-2, 1.0,   5.0,   20.0,  50.0,   200.0};
  switch (placement) {
    case 0:
      return PoseAtUlps(line, 0);
    case 1:
      return PoseAtUlps(line, 1);
    case 2:
      return PoseAtUlps(line, -1);
    // Within the first thousandth of the line: c near o.
    case kPlacementCount - 1:
      return PoseAtTravel(line, -line.exit * (1.0 - 0x1p-10));
    default:
      return PoseAtTravel(line, kTravels[placement - 3] * (line.size / 100.0));
  }
}

}  // namespace touchstone
