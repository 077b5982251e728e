// SPDX-License-Identifier: MIT
//
// Section 6 as printed.
#include <algorithm>
#include <cmath>
#include <vector>

#include "touchstone/core/cd_dual/certify.h"
#include "touchstone/core/cd_dual/published.h"
#include "touchstone/core/proximity/directional_distance.h"
#include "touchstone/core/proximity/line.h"
#include "touchstone/core/proximity/validate_internal.h"

namespace touchstone {
namespace {

// A silhouette vertex: its shadow, and whose it is.
struct Shadow {
  int vertex;
  double x, y;
};

double Cross(const Shadow& a, const Shadow& b, const Shadow& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// CH of the shadows, counterclockwise, without collinear points, from the one of least y (then x).
// (The paper finds the boundary in O(n) as the silhouette; the hull is the same.)
std::vector<Shadow> Silhouette(std::vector<Shadow> points) {
  std::sort(points.begin(), points.end(), [](const Shadow& a, const Shadow& b) {
    return a.y < b.y || (a.y == b.y && a.x < b.x);
  });
  std::vector<Shadow> hull;
  const auto add = [&](const Shadow& point, std::size_t base) {
    while (hull.size() >= base + 2 && Cross(hull[hull.size() - 2], hull.back(), point) <= 0.0)
      hull.pop_back();
    hull.push_back(point);
  };
  for (const Shadow& point : points) add(point, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto point = points.rbegin() + 1; point != points.rend(); ++point) add(*point, lower);
  hull.pop_back();
  return hull;
}

struct Corner {
  VertexPair pair;
  double x, y;
};

// The Minkowski sum of two convex polygons by merging their sides in order of direction, O(m + n).
std::vector<Corner> Sum(const std::vector<Shadow>& p, const std::vector<Shadow>& q) {
  std::vector<Corner> sum;
  const std::size_t m = p.size(), n = q.size();
  for (std::size_t i = 0, j = 0; i < m || j < n;) {
    const Shadow &a = p[i % m], &b = q[j % n];
    sum.push_back({{a.vertex, b.vertex}, a.x + b.x, a.y + b.y});
    const Shadow &a1 = p[(i + 1) % m], &b1 = q[(j + 1) % n];
    const double turn = (a1.x - a.x) * (b1.y - b.y) - (a1.y - a.y) * (b1.x - b.x);
    if (j == n || (i < m && turn > 0.0)) {
      ++i;
    } else if (i == m || turn < 0.0) {
      ++j;
    } else {
      ++i;
      ++j;
    }
  }
  return sum;
}

class PublishedQuery {
 public:
  PublishedQuery(const ConvexPolyhedron& p, const ConvexPolyhedron& q, const RelativePose& pose,
                 const Eigen::Vector3d& s)
      : m_(p, q, pose), s_(s), frame_(m_, s_.scaled) {}

  PublishedTravel Run() {
    std::vector<Shadow> in_p, in_q;
    for (int v = 0; v < m_.p().vertex_count(); ++v) {
      const Eigen::Vector3d w = frame_.Along(m_.scale() * m_.p().vertex(v));
      in_p.push_back({v, w[0], w[1]});
    }
    const RelativePose& pose = m_.pose();
    for (int v = 0; v < m_.q().vertex_count(); ++v) {
      const Eigen::Vector3d w =
          frame_.Along(-m_.scale() * (pose.rotation() * m_.q().vertex(v) + pose.translation()));
      in_q.push_back({v, w[0], w[1]});
    }
    if (!FindTriangle(Sum(Silhouette(std::move(in_p)), Silhouette(std::move(in_q))))) {
      result_.kind = PublishedTravelKind::kNever;
      return result_;
    }
    SearchFromC();
    return result_;
  }

 private:
  // The triangle r0, rj, rj+1 of the fan that holds o.
  bool FindTriangle(const std::vector<Corner>& r) {
    for (std::size_t j = 1; j + 1 < r.size(); ++j) {
      const Corner &a = r[0], &b = r[j], &c = r[j + 1];
      const double u = b.x * c.y - b.y * c.x, v = c.x * a.y - c.y * a.x, w = a.x * b.y - a.y * b.x;
      const double whole = u + v + w;
      if (u < 0.0 || v < 0.0 || w < 0.0 || !(whole > 0.0)) continue;
      result_.corners = {a.pair, b.pair, c.pair};
      result_.weights = {u / whole, v / whole, w / whole};
      return true;
    }
    return false;
  }

  void SearchFromC() {
    Eigen::Vector3d c = Eigen::Vector3d::Zero();
    for (int i = 0; i < 3; ++i) c += result_.weights[i] * m_.Point(result_.corners[i]);
    // c = k s; what is left across s is rounding.
    const double k = c.dot(s_.scaled) / s_.scaled.squaredNorm();
    const double unit = std::ldexp(1.0 / m_.scale(), -s_.exponent);
    result_.c_travel = k * unit;
    const double noise = 4.0 * m_.coordinate_error();
    if (std::abs(k) * s_.scaled.norm() <= noise) {
      result_.kind = PublishedTravelKind::kCoincident;
      return;
    }
    if (OnBoundary()) {
      result_.kind = PublishedTravelKind::kOnBoundary;
      return;
    }
    m_.PlaceInterior(k * s_.scaled);
    std::array<PhaseCounts, kPhaseCount> counts{};
    SearchLog log{&counts, nullptr};
    const FaceOfM face = SearchPublished(m_, false, &log).face;
    const double d = face.signed_distance, length = m_.c_norm();
    const double g = d * length * length / (d * length + 1.0);
    result_.face_class = face.face_class;
    result_.feature_p = face.feature_p;
    result_.feature_q = face.feature_q;
    // From o by g towards c.
    result_.travel = g / length * result_.c_travel;
    // d is infinite, or g undefined, where a plane runs through c or parallel to the ray.
    result_.kind = std::isfinite(result_.travel) ? PublishedTravelKind::kTravel
                                                 : PublishedTravelKind::kOnBoundary;
  }

  // c is strictly inside the triangle of three vertices of M, or on a side of it: on M's boundary
  // if the triangle's plane supports M, whichever way it faces.
  bool OnBoundary() const {
    Signs signs(m_, Certainty::kExact);
    for (const bool turned : {false, true}) {
      std::array<VertexPair, 3> corners = result_.corners;
      if (turned) std::swap(corners[1], corners[2]);
      FacetPlane plane = signs.Plane(corners);
      if (SupportingFeature(&signs, &plane, Body::kP, corners[0].p) &&
          SupportingFeature(&signs, &plane, Body::kQ, corners[0].q)) {
        return true;
      }
    }
    return false;
  }

  MinkowskiDifference m_;
  const LineDirection s_;
  const LineFrame frame_;
  PublishedTravel result_;
};

}  // namespace

StatusOr<PublishedTravel> DirectionalDistanceAsPublished(const ConvexPolyhedron& p,
                                                         const ConvexPolyhedron& q,
                                                         const RelativePose& pose,
                                                         const Eigen::Vector3d& s) {
  Status status = internal::CheckDirection(s);
  if (!status.ok()) return status;
  return PublishedQuery(p, q, pose, s).Run();
}

}  // namespace touchstone
