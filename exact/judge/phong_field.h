// SPDX-License-Identifier: GPL-3.0-or-later
//
//   paper     here                meaning
//   λ         at                  barycentric coordinates
//   T, Ψ      BlendedNormal       the normal of the interpolated tangent plane
//
// Normals of a triangulated surface, in a scalar that is double or Real: written apart from the
// core's, from the paper and from Panozzo et al. 2013.
#ifndef TOUCHSTONE_EXACT_JUDGE_PHONG_FIELD_H_
#define TOUCHSTONE_EXACT_JUDGE_PHONG_FIELD_H_

#include <array>
#include <cmath>

#include "touchstone/exact/real.h"

namespace touchstone::exact {

inline double Sqrt(double x) { return std::sqrt(x); }
inline double Atan2(double y, double x) { return std::atan2(y, x); }
// Angles are doubles, good to 2^-51 of themselves: the sides are divided first.
inline Real Atan2(const Real& y, const Real& x) {
  const Real length = Sqrt(x * x + y * y);
  if (length.sign() == 0) return Real(0.0);
  return Real(std::atan2((y / length).ToDouble(), (x / length).ToDouble()));
}

template <class T>
using Triple = std::array<T, 3>;

template <class T>
Triple<T> Plus(const Triple<T>& a, const Triple<T>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class T>
Triple<T> Minus(const Triple<T>& a, const Triple<T>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class T>
Triple<T> Times(const T& s, const Triple<T>& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
template <class T>
T Inner(const Triple<T>& a, const Triple<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class T>
Triple<T> Outer(const Triple<T>& a, const Triple<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class T>
T Length(const Triple<T>& a) {
  return Sqrt(Inner(a, a));
}
template <class T>
Triple<T> Unit(const Triple<T>& a) {
  return Times(T(1.0) / Length(a), a);
}

// The sine of the angle between two directions, 1 if they are more than a right angle apart.
template <class T>
T SineBetween(const Triple<T>& normal, const Triple<T>& x) {
  if (!(Inner(normal, x) > T(0.0))) return T(1.0);
  return Length(Outer(normal, x)) / (Length(normal) * Length(x));
}

// Two orthonormal rows.
template <class T>
using Frame = std::array<Triple<T>, 2>;

template <class T>
Frame<T> FrameAcross(const Triple<T>& normal) {
  int least = 0;
  for (int k = 1; k < 3; ++k) {
    if (normal[k] * normal[k] < normal[least] * normal[least]) least = k;
  }
  Triple<T> axis = {T(0.0), T(0.0), T(0.0)};
  axis[least] = T(1.0);
  const Triple<T> u = Unit(Outer(normal, axis));
  return {u, Outer(normal, u)};
}

// Turned in its plane, or mirrored, until the sum of the rows' inner products with the other's is
// largest: by an angle φ the sum is a cos φ + b sin φ, and as much mirrored first.
template <class T>
Frame<T> TurnedTo(const Frame<T>& frame, const Frame<T>& to) {
  const T xx = Inner(to[0], frame[0]), xy = Inner(to[0], frame[1]), yx = Inner(to[1], frame[0]),
          yy = Inner(to[1], frame[1]);
  T a = xx + yy, b = yx - xy, sign = T(1.0);
  if (a * a + b * b < (xx - yy) * (xx - yy) + (xy + yx) * (xy + yx)) {
    a = xx - yy, b = xy + yx, sign = T(-1.0);
  }
  const T length = Sqrt(a * a + b * b), c = a / length, s = b / length;
  // Rows of [c -s; s c] diag(1, sign) frame.
  const Triple<T> second = Times(sign, frame[1]);
  return {Minus(Times(c, frame[0]), Times(s, second)), Plus(Times(s, frame[0]), Times(c, second))};
}

// The frames of corners k and k + 1 on the side between them, turned to agree there.
template <class T>
std::array<std::array<Frame<T>, 2>, 3> SideFrames(const std::array<Triple<T>, 3>& normals) {
  const Frame<T> first = FrameAcross(normals[0]);
  const std::array<Frame<T>, 3> corners = {first, TurnedTo(FrameAcross(normals[1]), first),
                                           TurnedTo(FrameAcross(normals[2]), first)};
  std::array<std::array<Frame<T>, 2>, 3> sides;
  for (int k = 0; k < 3; ++k) sides[k] = {corners[k], TurnedTo(corners[(k + 1) % 3], corners[k])};
  return sides;
}

// Two rows that span the tangent plane blended at λ, but at corners, where they are zero.
template <class T>
Frame<T> BlendedRows(const std::array<std::array<Frame<T>, 2>, 3>& sides, const Triple<T>& at) {
  const Triple<T> zero = {T(0.0), T(0.0), T(0.0)};
  Frame<T> sum = {zero, zero};
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3;
    for (int row = 0; row < 2; ++row) {
      const Triple<T> side = Plus(Times(at[k], sides[k][0][row]), Times(at[l], sides[k][1][row]));
      sum[row] = Plus(sum[row], Times(at[k] * at[l], side));
    }
  }
  return sum;
}

// The normal, of any length and sign, of the tangent plane blended at λ from those at the corners.
template <class T>
Triple<T> BlendedNormal(const std::array<Triple<T>, 3>& normals, const Triple<T>& at) {
  if (!(at[0] * at[1] + at[1] * at[2] + at[2] * at[0] > T(0.0))) {  // at a corner
    for (int k = 0; k < 3; ++k) {
      if (at[k] > T(0.5)) return normals[k];
    }
  }
  const Frame<T> rows = BlendedRows(SideFrames(normals), at);
  return Outer(rows[0], rows[1]);
}

// ∫ (1 - |y - x|² / h²) n dy over what a ball round x holds of a triangle of unit normal n, by
// polar coordinates in its plane: Green's theorem, side by side.
template <class T>
Triple<T> MeanPart(const std::array<Triple<T>, 3>& corners, const Triple<T>& n, const Triple<T>& x,
                   const T& h) {
  const T height = Inner(n, Minus(x, corners[0]));
  const T rho = h * h - height * height;
  if (!(rho > T(0.0))) return {T(0.0), T(0.0), T(0.0)};
  const Triple<T> foot = Minus(x, Times(height, n));
  const auto sector = [&](const Triple<T>& p, const Triple<T>& q) {
    return rho * rho * Atan2(Inner(n, Outer(p, q)), Inner(p, q)) / T(4.0);
  };
  T sum = T(0.0);
  for (int k = 0; k < 3; ++k) {
    const Triple<T> p = Minus(corners[k], foot), q = Minus(corners[(k + 1) % 3], foot);
    const Triple<T> d = Minus(q, p);
    const T a = Inner(d, d), b = Inner(p, d), c = Inner(p, p) - rho, root2 = b * b - a * c;
    if (!(root2 > T(0.0)) || !(a > T(0.0))) {
      sum = sum + sector(p, q);
      continue;
    }
    const T root = Sqrt(root2);
    T from = (T(0.0) - b - root) / a, to = (root - b) / a;
    if (!(from > T(0.0))) from = T(0.0);
    if (to > T(1.0)) to = T(1.0);
    if (!(from < to)) {
      sum = sum + sector(p, q);
      continue;
    }
    const Triple<T> u = Plus(p, Times(from, d)), v = Plus(p, Times(to, d));
    sum = sum + sector(p, u) + sector(v, q);
    sum = sum + Inner(n, Outer(u, v)) / T(2.0) *
                    (rho - (Inner(u, u) + Inner(v, v) + Inner(u, v)) / T(6.0));
  }
  return Times(sum, n);
}

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_JUDGE_PHONG_FIELD_H_
