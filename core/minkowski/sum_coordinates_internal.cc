// SPDX-License-Identifier: MIT
//
// Where the points and planes of M are: roundings with bounds, and exactly.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "touchstone/core/minkowski/bounded_vector_internal.h"
#include "touchstone/core/minkowski/sum_geometry_internal.h"

namespace touchstone::internal {

using Eigen::Vector3d;

Estimate SumGeometry::Height(const SumPoint& x, const SumPlane& plane) {
  const Vector3d difference = x.rounded - plane.origin;
  return HeightAlong(plane.normal, plane.normal_error, difference,
                     1.01 * (x.error + plane.origin_error + kUnit * MaxAbs(difference)));
}

// Heights h, k of the edge's ends over the plane, off by e_h, e_k, cross it at s = h / (h - k), off
// by (e_h |k| + e_k |h|) / (|h - k| (|h - k| - e_h - e_k)); the division and its operands are
// rounded thrice.
void SumGeometry::RoundOnEdge(SumPoint* point) const {
  const SumPoint &u = points_[point->parts[0]], &v = points_[point->parts[1]];
  const SumPlane& plane = planes_[point->parts[2]];
  const Estimate h = Height(u, plane), k = Height(v, plane);
  const double span = std::abs(h.value - k.value);
  const double least = span * (1.0 - 2.0 * kUnit) - h.error - k.error;
  if (!(least > 0.0)) return;
  const double s = h.value / (h.value - k.value);
  const double s_error =
      1.01 * (h.error * std::abs(k.value) + k.error * std::abs(h.value)) / (span * least) +
      4.0 * kUnit * std::abs(s);
  const Vector3d edge = v.rounded - u.rounded;
  point->rounded = u.rounded + s * edge;
  // Vertices are off by their errors, weighted by 1 - s and s; the sum is rounded.
  point->error = 1.01 * ((1.0 + 2.0 * (std::abs(s) + s_error)) * std::max(u.error, v.error) +
                         s_error * MaxAbs(edge) +
                         3.0 * kUnit * (MaxAbs(u.rounded) + std::abs(s) * MaxAbs(edge)));
}

// With o the first plane's origin and d_i the heights of the others' origins over it, seen along
// their normals: x - o = (d_2 (n_3 x n_1) + d_3 (n_1 x n_2)) / det.
void SumGeometry::RoundOfPlanes(SumPoint* point) const {
  const SumPlane &p = planes_[point->parts[0]], &q = planes_[point->parts[1]],
                 &r = planes_[point->parts[2]];
  const BoundedVector qr = CrossOf(q.normal, q.normal_error, r.normal, r.normal_error);
  const BoundedVector rp = CrossOf(r.normal, r.normal_error, p.normal, p.normal_error);
  const BoundedVector pq = CrossOf(p.normal, p.normal_error, q.normal, q.normal_error);
  const Estimate det = HeightAlong(p.normal, p.normal_error, qr.value, qr.error);
  const double least = std::abs(det.value) - det.error;
  if (!(least > 0.0)) return;
  const auto offset = [&p](const SumPlane& plane) {
    const Vector3d difference = plane.origin - p.origin;
    return HeightAlong(plane.normal, plane.normal_error, difference,
                       1.01 * (plane.origin_error + p.origin_error + kUnit * MaxAbs(difference)));
  };
  const Estimate d_q = offset(q), d_r = offset(r);
  const Vector3d numerator = d_q.value * rp.value + d_r.value * pq.value;
  const double l_qr = MaxAbs(qr.value) + qr.error, l_rp = MaxAbs(rp.value) + rp.error,
               l_pq = MaxAbs(pq.value) + pq.error;
  // The origin of p is off its plane by its error times the normal: a third term.
  const double d_p_error = 3.0 * (MaxAbs(p.normal) + p.normal_error) * p.origin_error;
  const double numerator_error =
      1.01 * (d_q.error * l_rp + std::abs(d_q.value) * rp.error + d_r.error * l_pq +
              std::abs(d_r.value) * pq.error + d_p_error * l_qr +
              2.1 * kUnit * (std::abs(d_q.value) * l_rp + std::abs(d_r.value) * l_pq));
  const Vector3d step = numerator / det.value;
  point->rounded = p.origin + step;
  point->error = 1.01 * ((numerator_error + MaxAbs(step) * det.error) / least +
                         2.0 * kUnit * (MaxAbs(step) + MaxAbs(p.origin))) +
                 kUnderflow;
}

// An error of 2^-20 of the length moves the direction by as much, times √3.
Vector3d SumGeometry::UnitNormal(int plane) {
  const SumPlane& own = planes_[plane];
  const double size = MaxAbs(own.normal);
  if (size > 0x1p20 * own.normal_error) return (own.normal / size).normalized();
  Vector3d normal;
  std::array<int, 3> exponents;
  for (int i = 0; i < 3; ++i) {
    normal[i] = ExactPlaneOf(plane).normal[i].ToScaledDouble(&exponents[i]);
  }
  int largest = std::numeric_limits<int>::min();
  for (int i = 0; i < 3; ++i) {
    if (normal[i] != 0.0) largest = std::max(largest, exponents[i]);
  }
  for (int i = 0; i < 3; ++i) {
    normal[i] = normal[i] != 0.0 ? std::ldexp(normal[i], exponents[i] - largest) : 0.0;
  }
  return normal.normalized();
}

const SumGeometry::ExactPlane& SumGeometry::ExactPlaneOf(int plane) {
  if (const ExactPlane* known = exact_planes_.Find(plane)) return *known;
  const auto& corners = planes_[plane].points;
  const DyadicVector origin = Exact(corners[0]).coordinates;
  const DyadicVector u = Exact(corners[1]).coordinates - origin;
  DyadicVector v{Dyadic(0), Dyadic(0), Dyadic(0)};
  if (planes_[plane].axis < 0) {
    v = Exact(corners[2]).coordinates - origin;
  } else {
    v[planes_[plane].axis] = Dyadic(1);
  }
  const DyadicVector normal = Cross(u, v);
  return exact_planes_.Add(plane, {normal, Dot(normal, origin)});
}

ExactPoint SumGeometry::MakeExact(const SumPoint& point) {
  ExactPoint exact;
  if (point.form == SumPointForm::kVertex) {
    exact.coordinates =
        exact_pair().PointOfA(point.parts[0]) - exact_pair().PointOfB(point.parts[1]);
    return exact;
  }
  if (point.form == SumPointForm::kOnEdge) {
    const DyadicVector u = Exact(point.parts[0]).coordinates;
    const DyadicVector v = Exact(point.parts[1]).coordinates;
    const ExactPlane& plane = ExactPlaneOf(point.parts[2]);
    const Dyadic h = Dot(plane.normal, u) - plane.offset, k = Dot(plane.normal, v) - plane.offset;
    exact.denominator = h - k;
    exact.coordinates = h * v - k * u;
  } else {
    const ExactPlane &p = ExactPlaneOf(point.parts[0]), &q = ExactPlaneOf(point.parts[1]),
                     &r = ExactPlaneOf(point.parts[2]);
    const DyadicVector qr = Cross(q.normal, r.normal);
    exact.denominator = Dot(p.normal, qr);
    exact.coordinates =
        p.offset * qr + q.offset * Cross(r.normal, p.normal) + r.offset * Cross(p.normal, q.normal);
  }
  if (exact.denominator.sign() < 0) {
    exact.denominator = -exact.denominator;
    for (Dyadic& x : exact.coordinates) x = -x;
  }
  return exact;
}

const ExactPoint& SumGeometry::Exact(int point) {
  if (const ExactPoint* known = exact_points_.Find(point)) return *known;
  return exact_points_.Add(point, MakeExact(points_[point]));
}

void SumGeometry::Sharpen(int point) {
  const ExactPoint& exact = Exact(point);
  const Dyadic denominator = exact.denominator * factor();
  SumPoint& x = points_[point];
  // Scaled by a power of two: one rounding, and that of the quotient.
  for (int i = 0; i < 3; ++i) {
    x.rounded[i] = pair_.scale() * RatioToDouble(exact.coordinates[i], denominator);
  }
  x.error = kUnit * MaxAbs(x.rounded) + kUnderflow;
}

const SumPoint& SumGeometry::Sharp(int point) {
  if (!(points_[point].error <= 0x1p-38)) Sharpen(point);
  return points_[point];
}

}  // namespace touchstone::internal
