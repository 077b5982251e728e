// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "touchstone/exact/judge/nearest_on_triangle.h"
#include "touchstone/exact/judge/phong_field.h"
#include "touchstone/exact/judge_cpd.h"

namespace touchstone::exact {
namespace {

using Eigen::Vector3d;
using Doubles = Triple<double>;

constexpr int kQuarterings = 6;
constexpr int kSteps = 30;
constexpr double kDifference = 1e-7;  // in λ: the square root of roundings
constexpr double kSolved = 1e-13;     // a few roundings; differences gain five digits a step
constexpr double kInside = 1e-6;      // in λ: solutions on sides are as well a neighbour's

Doubles ToTriple(const Vector3d& v) { return {v[0], v[1], v[2]}; }

// All values of a formula, up to roundings.
struct Interval {
  double low = 0.0, high = 0.0;

  Interval() = default;
  explicit Interval(double x) : low(x), high(x) {}
  Interval(double least, double most) : low(least), high(most) {}
  bool Holds(double rounding) const { return !(low > rounding) && !(high < -rounding); }
};
Interval operator+(const Interval& a, const Interval& b) {
  return {a.low + b.low, a.high + b.high};
}
Interval operator*(const Interval& a, const Interval& b) {
  const double p = a.low * b.low, q = a.low * b.high, r = a.high * b.low, s = a.high * b.high;
  return {std::min({p, q, r, s}), std::max({p, q, r, s})};
}

class TriangleSearch {
 public:
  TriangleSearch(const std::array<Doubles, 3>& corners, const std::array<Doubles, 3>& normals)
      : corners_(corners), normals_(normals) {
    const auto sides = SideFrames(normals);
    for (int k = 0; k < 3; ++k) {
      for (int end = 0; end < 2; ++end) {
        for (int row = 0; row < 2; ++row) {
          for (int i = 0; i < 3; ++i) sides_[k][end][row][i] = Interval(sides[k][end][row][i]);
        }
      }
    }
  }

  // The length of a projection shorter than `distance`.
  std::optional<double> Nearer(double distance) {
    found_.reset();
    distance_ = distance;
    Look({0.0, 0.0}, 1.0, 0);
    return found_;
  }

 private:
  // The part of the triangle with right-angled corner (u, v) in λ_0, λ_1 and legs of this length,
  // upright or, if it is below zero, inverted: cut into quarters where what of x lies along the
  // tangent plane may vanish, and at the last solved from the middle.
  void Look(const std::array<double, 2>& corner, double leg, int level) {
    const auto& [u, v] = corner;
    if (!MayVanish(u, v, leg)) return;
    if (level == kQuarterings) {
      const auto solved = Solve(u + leg / 3.0, v + leg / 3.0);
      if (solved && *solved < distance_) found_ = distance_ = *solved;
      return;
    }
    const double half = 0.5 * leg;
    Look({u, v}, half, level + 1);
    Look({u + half, v}, half, level + 1);
    Look({u, v + half}, half, level + 1);
    Look({u + half, v + half}, -half, level + 1);
  }

  bool MayVanish(double u, double v, double leg) const {
    const auto range = [](double a, double b) { return Interval(std::min(a, b), std::max(a, b)); };
    const Triple<Interval> at = {range(u, u + leg), range(v, v + leg),
                                 range(1.0 - u - v, 1.0 - u - v - leg)};
    Triple<Interval> x;
    double size = 0.0;
    for (int i = 0; i < 3; ++i) {
      const double a = PointAt(u, v)[i], b = PointAt(u + leg, v)[i], c = PointAt(u, v + leg)[i];
      x[i] = Interval(std::min({a, b, c}), std::max({a, b, c}));
      size += std::abs(a) + std::abs(b) + std::abs(c);
    }
    const Frame<Interval> rows = BlendedRows(sides_, at);
    // Some 40 operations on numbers up to 1, and up to this: their roundings are below 1e-14 of it.
    const double rounding = 1e-14 * size;
    return Inner(rows[0], x).Holds(rounding) && Inner(rows[1], x).Holds(rounding);
  }

  Doubles PointAt(double u, double v) const {
    return Plus(Plus(Times(u, corners_[0]), Times(v, corners_[1])),
                Times(1.0 - u - v, corners_[2]));
  }
  // What of x lies across the normal, along two of the triangle's sides.
  std::array<double, 2> At(double u, double v, double* sine) const {
    const Doubles x = PointAt(u, v);
    const Doubles n = Unit(BlendedNormal<double>(normals_, {u, v, 1.0 - u - v}));
    const Doubles across = Minus(x, Times(Inner(n, x), n));
    *sine = Length(across) / Length(x);
    return {Inner(across, Minus(corners_[0], corners_[2])),
            Inner(across, Minus(corners_[1], corners_[2]))};
  }

  std::optional<double> Solve(double u, double v) const {
    for (int i = 0; i < kSteps; ++i) {
      double sine = 1.0, ignored;
      const auto f = At(u, v, &sine);
      if (!std::isfinite(sine)) return std::nullopt;
      if (sine < kSolved) {
        if (std::min({u, v, 1.0 - u - v}) < kInside) return std::nullopt;
        return Length(PointAt(u, v));
      }
      const auto fu = At(u + kDifference, v, &ignored), fv = At(u, v + kDifference, &ignored);
      const double a = (fu[0] - f[0]) / kDifference, b = (fv[0] - f[0]) / kDifference,
                   c = (fu[1] - f[1]) / kDifference, d = (fv[1] - f[1]) / kDifference;
      const double determinant = a * d - b * c;
      if (determinant == 0.0) return std::nullopt;
      double du = (b * f[1] - d * f[0]) / determinant, dv = (c * f[0] - a * f[1]) / determinant;
      const double length = std::hypot(du, dv);
      if (!(length < 1e6)) return std::nullopt;
      if (length > 0.25) du *= 0.25 / length, dv *= 0.25 / length;
      u += du, v += dv;
      // Beyond, the plane has solutions that are not the triangle's.
      if (std::min({u, v, 1.0 - u - v}) < -0.5) return std::nullopt;
    }
    return std::nullopt;
  }

  const std::array<Doubles, 3> corners_, normals_;
  std::array<std::array<Frame<Interval>, 2>, 3> sides_;
  std::optional<double> found_;
  double distance_ = 0.0;
};

}  // namespace

std::vector<std::string> FindNearerPhong(const std::vector<Vector3d>& vertices,
                                         const std::vector<std::array<int, 3>>& triangles,
                                         const std::vector<Vector3d>& triangle_normals,
                                         double distance) {
  std::vector<Doubles> normals(vertices.size(), Doubles{0.0, 0.0, 0.0});
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Vector3d &x = vertices[triangles[t][k]], &y = vertices[triangles[t][(k + 1) % 3]],
                     &z = vertices[triangles[t][(k + 2) % 3]];
      const Doubles u = ToTriple(y - x), v = ToTriple(z - x);
      const double angle = Atan2(Length(Outer(u, v)), Inner(u, v));
      Doubles& normal = normals[triangles[t][k]];
      normal = Plus(normal, Times(angle, ToTriple(triangle_normals[t])));
    }
  }
  for (Doubles& normal : normals) normal = Unit(normal);
  const double nearer = distance * (1.0 - 1e-6);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [i, j, k] = triangles[t];
    if (!(NearestOnTriangle(vertices[i], vertices[j], vertices[k]).norm() < nearer)) continue;
    const Vector3d area = (vertices[j] - vertices[i]).cross(vertices[k] - vertices[i]);
    if (!(area.dot(vertices[i]) > 0.0)) continue;  // it faces inward
    TriangleSearch search({ToTriple(vertices[i]), ToTriple(vertices[j]), ToTriple(vertices[k])},
                          {normals[i], normals[j], normals[k]});
    if (const auto found = search.Nearer(nearer)) {
      std::ostringstream out;
      out.precision(17);
      out << "phong: triangle " << t << " has a projection at " << *found << ", nearer than "
          << distance;
      return {out.str()};
    }
  }
  return {};
}

}  // namespace touchstone::exact
