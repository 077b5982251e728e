// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/mean_normals.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "touchstone/core/mesh/nearest_on_triangle.h"

namespace touchstone {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Axes = Eigen::Matrix<double, 2, 3>;

// Sines are good to the roundings of some hundred integrals, 1e-14 each; Newton with differences
// gains some five digits a step, so one that comes below this is one of rounding.
constexpr double kConverged = 1e-11;
// For differences, over h: the square root of roundings would be 1e-7; fields bend little over h.
constexpr double kDifference = 1e-6;
constexpr double kLongestStep = 0.25;  // over h
// |det J| over its trace squared, below which a solution is about to vanish, or has: near a fold at
// distance δ it is √δ, so that what is left of one that is gone by more than 1e-12 is none.
constexpr double kFolding = 1e-6;
// A step that is put back to this much of its length does not leave where it is.
constexpr double kNoMove = 1e-3;

double Cross(const Vector2d& p, const Vector2d& q) { return p[0] * q[1] - p[1] * q[0]; }

// ∫ (ρ² - |s|²) ds over what lies within ρ of the origin in the triangle of the origin, p and q;
// below zero where that is clockwise.
double SectorPart(const Vector2d& p, const Vector2d& q, double squared_radius) {
  return 0.25 * squared_radius * squared_radius * std::atan2(Cross(p, q), p.dot(q));
}
double InnerPart(const Vector2d& p, const Vector2d& q, double squared_radius) {
  return 0.5 * Cross(p, q) *
         (squared_radius - (p.squaredNorm() + q.squaredNorm() + p.dot(q)) / 6.0);
}
double SidePart(const Vector2d& p, const Vector2d& q, double squared_radius) {
  const Vector2d side = q - p;
  const double a = side.squaredNorm(), b = p.dot(side), c = p.squaredNorm() - squared_radius;
  const double discriminant = b * b - a * c;
  if (!(discriminant > 0.0)) return SectorPart(p, q, squared_radius);
  const double root = std::sqrt(discriminant);
  const double from = std::max(0.0, (-b - root) / a), to = std::min(1.0, (-b + root) / a);
  if (!(from < to)) return SectorPart(p, q, squared_radius);
  const Vector2d u = p + from * side, v = p + to * side;
  double sum = InnerPart(u, v, squared_radius);
  if (from > 0.0) sum += SectorPart(p, u, squared_radius);
  if (to < 1.0) sum += SectorPart(v, q, squared_radius);
  return sum;
}

// A walk on the surface.
class MeanWalk {
 public:
  MeanWalk(const PhongSurface& surface, const MeanNormals& normals,
           const MeanProjectionOptions& options)
      : surface_(surface), normals_(normals), options_(options) {}

  MeanProjection Run(const Vector3d& from) {
    MeanProjection best;
    if (!PutBack(from)) return best;
    best.point = PointHere(1.0);
    double limit = kLongestStep;
    bool was_sent_back = false;
    Vector3d before = Vector3d::Zero();
    for (int i = 0; i < options_.step_limit; ++i) {
      Normal here;
      if (!NormalAt(at_, &here)) return Left(at_);
      const double residual = Sine(at_, here.n);
      const bool faces_out = NormalOf(triangle_).dot(at_) > 0.0;
      if (faces_out && residual < best.point.residual) best.point = PointHere(residual);
      const Axes axes = AxesOf(triangle_);
      Matrix2d jacobian;
      if (!Jacobian(axes, here, &jacobian)) return Left(at_);
      const double trace = jacobian.trace();
      const bool is_stable = trace > 0.0 && jacobian.determinant() > kFolding * trace * trace;
      if (residual < kConverged && is_stable && !faces_out) {
        if (was_sent_back || !SendBack()) return best;
        was_sent_back = true;
        continue;
      }
      if (residual < kConverged && is_stable) {
        best.status = MeanProjectionStatus::kFound;
        best.point = PointHere(residual);
        best.point.rate = RateHere(axes, here, jacobian);
        return best;
      }
      const Vector2d g = axes * Tangent(at_, here.n);
      const Vector2d planar = is_stable ? Vector2d(jacobian.inverse() * g) : g;
      Vector3d step = -(axes.transpose() * planar);
      if (!step.allFinite()) return best;
      if (step.dot(before) < 0.0) limit *= 0.5;
      before = step;
      const double longest = limit * here.radius;
      if (step.norm() > longest) step *= longest / step.norm();
      const Vector3d last = at_;
      PutBack(at_ + step);
      if ((at_ - last).norm() > kNoMove * step.norm()) continue;
      // Off a sharp edge: across the mean normal instead.
      Vector3d slide = -Tangent(last, here.n);
      if (slide.norm() > longest) slide *= longest / slide.norm();
      PutBack(last + slide);
    }
    return best;
  }

 private:
  struct Normal {
    Vector3d n;  // of unit length
    double radius;
  };

  static double Sine(const Vector3d& x, const Vector3d& n) {
    const double length = x.norm();
    return length > 0.0 && n.dot(x) > 0.0 ? n.cross(x).norm() / length : 1.0;
  }
  static Vector3d Tangent(const Vector3d& x, const Vector3d& n) { return x - n.dot(x) * n; }

  double RadiusAt(const Vector3d& x) const {
    return std::max(options_.radius_ratio * x.norm(), options_.least_radius);
  }

  // Whether the surface is known as far as that takes.
  bool NormalAt(const Vector3d& x, Normal* normal) const {
    normal->radius = RadiusAt(x);
    if ((x - options_.center).norm() + normal->radius > options_.reach) return false;
    normal->n = normals_.At(x, normal->radius).stableNormalized();
    return true;
  }

  Vector3d NormalOf(int triangle) const {
    const auto& [a, b, c] = surface_.triangles[triangle];
    return (surface_.vertices[b] - surface_.vertices[a])
        .cross(surface_.vertices[c] - surface_.vertices[a])
        .stableNormalized();
  }

  // On a triangle that faces inward the way out has left the solid before: on to where it last
  // does.
  bool SendBack() {
    const Vector3d way = at_;
    double last = 0.0;
    for (int t = 0; t < static_cast<int>(surface_.triangles.size()); ++t) {
      const auto& [a, b, c] = surface_.triangles[t];
      const Vector3d &p = surface_.vertices[a], &q = surface_.vertices[b],
                     &r = surface_.vertices[c];
      const Vector3d normal = NormalOf(t);
      // Outward where the way passes the sides counterclockwise.
      if (!(normal.dot(way) > 0.0) || way.dot(p.cross(q)) < 0.0 || way.dot(q.cross(r)) < 0.0 ||
          way.dot(r.cross(p)) < 0.0) {
        continue;
      }
      const double part = normal.dot(p) / normal.dot(way);
      if (!(part > last && part < 1.0)) continue;
      last = part;
      triangle_ = t;
    }
    at_ = last * way;
    return last > 0.0;
  }

  Axes AxesOf(int triangle) const {
    const auto& [a, b, c] = surface_.triangles[triangle];
    const Vector3d u = (surface_.vertices[b] - surface_.vertices[a]).stableNormalized(),
                   v = surface_.vertices[c] - surface_.vertices[a];
    Axes axes;
    axes.row(0) = u;
    axes.row(1) = (v - u.dot(v) * u).stableNormalized();
    return axes;
  }

  bool Jacobian(const Axes& axes, const Normal& here, Matrix2d* jacobian) const {
    const Vector2d g = axes * Tangent(at_, here.n);
    const double step = kDifference * here.radius;
    for (int k = 0; k < 2; ++k) {
      const Vector3d x = at_ + step * axes.row(k).transpose();
      Normal there;
      if (!NormalAt(x, &there)) return false;
      jacobian->col(k) = (axes * Tangent(x, there.n) - g) / step;
    }
    return true;
  }

  // With a motion of o: dq = -J^-1 dg, where g also depends on o through h.
  std::optional<Matrix3d> RateHere(const Axes& axes, const Normal& here,
                                   const Matrix2d& jacobian) const {
    Matrix3d rate = here.n * here.n.transpose() - Matrix3d::Identity();
    if (here.radius > options_.least_radius) {
      const double step = kDifference * here.radius;
      const Vector3d other = normals_.At(at_, here.radius - step).stableNormalized();
      const Vector3d by_radius = (Tangent(at_, here.n) - Tangent(at_, other)) / step;
      rate -= options_.radius_ratio * by_radius * at_.stableNormalized().transpose();
    }
    return Matrix3d(-axes.transpose() * (jacobian.inverse() * (axes * rate)));
  }

  PhongPoint PointHere(double residual) const {
    PhongPoint point;
    point.triangle = triangle_;
    point.index = 1;  // n points the way back
    point.position = at_;
    point.residual = residual;
    const auto& [a, b, c] = surface_.triangles[triangle_];
    const Vector3d &p = surface_.vertices[a], &q = surface_.vertices[b], &r = surface_.vertices[c];
    const Vector3d area = (q - p).cross(r - p).stableNormalized();
    point.at = Vector3d(area.dot((q - at_).cross(r - at_)), area.dot((r - at_).cross(p - at_)),
                        area.dot((p - at_).cross(q - at_)))
                   .cwiseMax(0.0);
    const double sum = point.at.sum();
    point.at = sum > 0.0 ? Vector3d(point.at / sum) : Vector3d::Constant(1.0 / 3.0);
    return point;
  }

  MeanProjection Left(const Vector3d& x) const {
    MeanProjection projection;
    projection.status = MeanProjectionStatus::kLeft;
    projection.point = PointHere(1.0);
    projection.point.position = x;
    return projection;
  }

  // To the nearest point of the surface, of triangles that are none of slivers.
  bool PutBack(const Vector3d& x) {
    double least = std::numeric_limits<double>::infinity();
    int nearest = -1;
    Vector3d at = x;
    for (int t = 0; t < static_cast<int>(surface_.triangles.size()); ++t) {
      const auto& [a, b, c] = surface_.triangles[t];
      const Vector3d &p = surface_.vertices[a], &q = surface_.vertices[b],
                     &r = surface_.vertices[c];
      const Vector3d y = NearestOnTriangle(x, p, q, r);
      const double distance = (y - x).squaredNorm();
      if (!(distance < least)) continue;
      least = distance;
      nearest = t;
      at = y;
    }
    if (nearest < 0) return false;
    triangle_ = nearest;
    at_ = at;
    return true;
  }

  const PhongSurface& surface_;
  const MeanNormals& normals_;
  const MeanProjectionOptions& options_;
  int triangle_ = -1;
  Vector3d at_ = Vector3d::Zero();
};

}  // namespace

MeanProjection ProjectByMeanNormals(const PhongSurface& surface, const MeanNormals& normals,
                                    const Vector3d& from, const MeanProjectionOptions& options) {
  return MeanWalk(surface, normals, options).Run(from);
}

void MeanNormals::Set(const PhongSurface& surface) {
  triangles_.clear();
  for (const auto& [a, b, c] : surface.triangles) {
    const Vector3d &p = surface.vertices[a], &q = surface.vertices[b], &r = surface.vertices[c];
    Placed placed;
    placed.normal = (q - p).cross(r - p).stableNormalized();
    const Vector3d u = (q - p).stableNormalized();
    placed.axes.row(0) = u;
    placed.axes.row(1) = placed.normal.cross(u);
    placed.center = (p + q + r) / 3.0;
    placed.reach =
        std::sqrt(std::max({(p - placed.center).squaredNorm(), (q - placed.center).squaredNorm(),
                            (r - placed.center).squaredNorm()}));
    placed.corners = {Vector2d(placed.axes * (p - placed.center)),
                      Vector2d(placed.axes * (q - placed.center)),
                      Vector2d(placed.axes * (r - placed.center))};
    triangles_.push_back(placed);
  }
}

Vector3d MeanNormals::At(const Vector3d& x, double radius) const {
  Vector3d sum = Vector3d::Zero();
  if (!(radius > 0.0)) return sum;
  // In units of the radius, so that fourth powers stay in range.
  const double unit = 1.0 / radius;
  for (const Placed& placed : triangles_) {
    const Vector3d to = unit * (x - placed.center);
    const double within = 1.0 + unit * placed.reach;
    if (to.squaredNorm() >= within * within) continue;
    const double height = placed.normal.dot(to);
    const double squared = 1.0 - height * height;
    if (!(squared > 0.0)) continue;
    const Vector2d foot = placed.axes * to;
    const Vector2d p = unit * placed.corners[0] - foot, q = unit * placed.corners[1] - foot,
                   r = unit * placed.corners[2] - foot;
    sum += (SidePart(p, q, squared) + SidePart(q, r, squared) + SidePart(r, p, squared)) *
           placed.normal;
  }
  return sum;
}

}  // namespace touchstone
