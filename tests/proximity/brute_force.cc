// SPDX-License-Identifier: MIT
#include "touchstone/tests/proximity/brute_force.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include "touchstone/tests/testing/shapes.h"

namespace touchstone::testing {
namespace {

using Points = std::vector<Eigen::Vector3d>;

double PointSegment(const Eigen::Vector3d& x, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double t = std::clamp((x - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (x - a - t * along).norm();
}

double PointPolygon(const Eigen::Vector3d& x, const Points& polygon) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    normal += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  }
  normal.normalize();
  bool inside = true;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    inside = inside && normal.dot((b - a).cross(x - a)) >= 0.0;
    least = std::min(least, PointSegment(x, a, b));
  }
  return inside ? std::abs(normal.dot(x - polygon[0])) : least;
}

double SegmentSegment(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                      const Eigen::Vector3d& d) {
  double least = std::min(
      {PointSegment(a, c, d), PointSegment(b, c, d), PointSegment(c, a, b), PointSegment(d, a, b)});
  // The common perpendicular, where it meets both.
  const Eigen::Vector3d u = b - a, v = d - c, w = a - c;
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), uw = u.dot(w), vw = v.dot(w);
  const double det = uu * vv - uv * uv;
  if (det > 1e-12 * uu * vv) {
    const double s = (uv * vw - vv * uw) / det, t = (uu * vw - uv * uw) / det;
    if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0)
      least = std::min(least, (w + s * u - t * v).norm());
  }
  return least;
}

Points Polygon(const Points& vertices, std::span<const int> loop) {
  Points polygon;
  for (const int v : loop) polygon.push_back(vertices[v]);
  return polygon;
}

Points Placed(const ConvexPolyhedron& q, const RelativePose& pose) {
  Points placed;
  for (const Eigen::Vector3d& b : q.vertices())
    placed.push_back(pose.rotation() * b + pose.translation());
  return placed;
}

double Height(const Points& points, const Eigen::Vector3d& n) {
  double height = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& x : points) height = std::max(height, n.dot(x));
  return height;
}

// visit(n, height of M along n) for the normals of all faces and pairs of edges, either sense.
template <class Visit>
void ForEachPlane(const ConvexPolyhedron& p, const ConvexPolyhedron& q, const RelativePose& pose,
                  const Visit& visit) {
  const Points a(p.vertices().begin(), p.vertices().end()), b = Placed(q, pose);
  const auto consider = [&](const Eigen::Vector3d& n) { visit(n, Height(a, n) + Height(b, -n)); };
  for (int f = 0; f < p.face_count(); ++f) consider(p.face_normal(f));
  for (int f = 0; f < q.face_count(); ++f) consider(-(pose.rotation() * q.face_normal(f)));
  for (int e = 0; e < p.edge_count(); ++e) {
    for (int f = 0; f < q.edge_count(); ++f) {
      const Eigen::Vector3d u = (a[p.edge(e).head] - a[p.edge(e).tail]).normalized();
      const Eigen::Vector3d v = (b[q.edge(f).head] - b[q.edge(f).tail]).normalized();
      const Eigen::Vector3d n = u.cross(v);
      if (n.norm() < 1e-6) continue;
      consider(n);
      consider(-n);
    }
  }
}

ConvexPolyhedron ScaledBody(const ConvexPolyhedron& body, double factor) {
  Mesh mesh;
  for (const Eigen::Vector3d& v : body.vertices()) mesh.vertices.push_back(factor * v);
  for (int f = 0; f < body.face_count(); ++f)
    mesh.faces.emplace_back(body.face(f).begin(), body.face(f).end());
  return MustBuild(mesh);
}

}  // namespace

double DistanceByBruteForce(const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                            const RelativePose& pose) {
  const Points a(p.vertices().begin(), p.vertices().end()), b = Placed(q, pose);
  double least = std::numeric_limits<double>::infinity();
  for (int f = 0; f < q.face_count(); ++f) {
    for (const Eigen::Vector3d& x : a)
      least = std::min(least, PointPolygon(x, Polygon(b, q.face(f))));
  }
  for (int f = 0; f < p.face_count(); ++f) {
    for (const Eigen::Vector3d& x : b)
      least = std::min(least, PointPolygon(x, Polygon(a, p.face(f))));
  }
  for (int e = 0; e < p.edge_count(); ++e) {
    for (int f = 0; f < q.edge_count(); ++f) {
      least = std::min(least, SegmentSegment(a[p.edge(e).tail], a[p.edge(e).head],
                                             b[q.edge(f).tail], b[q.edge(f).head]));
    }
  }
  return least;
}

double DepthByBruteForce(const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                         const RelativePose& pose) {
  double least = std::numeric_limits<double>::infinity();
  ForEachPlane(p, q, pose, [&](const Eigen::Vector3d& n, double height) {
    least = std::min(least, height / n.norm());
  });
  return least;
}

TravelBounds TravelByBruteForce(const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                                const RelativePose& pose, const Eigen::Vector3d& s) {
  const double infinity = std::numeric_limits<double>::infinity();
  TravelBounds bounds{-infinity, infinity, infinity};
  ForEachPlane(p, q, pose, [&](const Eigen::Vector3d& n, double height) {
    const double along = n.dot(s);
    if (std::abs(along) < 1e-9 * n.norm() * s.norm()) return;
    if (along > 0.0) {
      bounds.leave = std::min(bounds.leave, height / along);
    } else {
      bounds.enter = std::max(bounds.enter, height / along);
    }
  });
  const Points a(p.vertices().begin(), p.vertices().end()), b = Placed(q, pose);
  const auto across = [&](const Eigen::Vector3d& edge) {
    const Eigen::Vector3d n = edge.normalized().cross(s.normalized());
    if (n.norm() < 1e-9) return;
    const Eigen::Vector3d unit = n.normalized();
    bounds.least_across = std::min({bounds.least_across, Height(a, unit) + Height(b, -unit),
                                    Height(a, -unit) + Height(b, unit)});
  };
  for (int e = 0; e < p.edge_count(); ++e) across(a[p.edge(e).head] - a[p.edge(e).tail]);
  for (int e = 0; e < q.edge_count(); ++e) across(b[q.edge(e).head] - b[q.edge(e).tail]);
  return bounds;
}

double SizeOf(const ConvexPolyhedron& p, const ConvexPolyhedron& q, const RelativePose& pose) {
  return p.max_coordinate() + q.max_coordinate() + pose.translation().cwiseAbs().maxCoeff();
}

RelativePose Inverse(const RelativePose& pose) {
  const Eigen::Matrix3d inverse = pose.rotation().transpose();
  return MustPose(inverse, -(inverse * pose.translation()));
}

Placement Scaled(const Placement& x, double power_of_two) {
  return {x.name, ScaledBody(x.p, power_of_two), ScaledBody(x.q, power_of_two),
          MustPose(x.pose.rotation(), power_of_two * x.pose.translation())};
}

std::vector<Placement> RoundPlacements(std::uint64_t seed, int count) {
  Random random(seed);
  std::vector<Placement> placements;
  for (int i = 0; i < count; ++i) {
    const auto body = [&] {
      const Eigen::Vector3d axes(random.Uniform(0.2, 2.0), random.Uniform(0.2, 2.0),
                                 random.Uniform(0.2, 2.0));
      return MustBuild(RoundBody(random.Int(20, 60), axes, random.Bits()));
    };
    ConvexPolyhedron p = body(), q = body();
    const double away = random.Uniform(0.0, 4.0);
    placements.push_back({"round " + std::to_string(seed) + "/" + std::to_string(i), std::move(p),
                          std::move(q), MustPose(random.Rotation(), away * random.Direction())});
  }
  return placements;
}

std::vector<Placement> ExtremePlacements(std::uint64_t seed, int low, int high) {
  const ConvexPolyhedron unit = MustBuild(Box({1, 1, 1}));
  const ConvexPolyhedron huge = MustBuild(Box({1e100, 1e100, 1e100}));
  const ConvexPolyhedron tiny = MustBuild(Box({1e-100, 1e-100, 1e-100}));
  const ConvexPolyhedron needle = MustBuild(Box({1e6, 1, 1e-6}));
  const ConvexPolyhedron blade = MustBuild(RoundBody(40, {1e6, 1, 1e-3}, 5));
  const std::pair<ConvexPolyhedron, ConvexPolyhedron> pairs[] = {
      {unit, huge}, {unit, tiny}, {huge, tiny}, {needle, needle}, {needle, blade}, {blade, blade}};
  Random random(seed);
  std::vector<Placement> placements;
  for (const auto& [p, q] : pairs) {
    for (int i = 0; i < 40; ++i) {
      const double reach = std::max(p.diameter_bound(), q.diameter_bound());
      const double away = reach * std::ldexp(1.0, -random.Int(low, high));
      placements.push_back(
          {"extreme " + std::to_string(i), p, q,
           MustPose(random.Rotation(), std::min(away, 1e99) * random.Direction())});
    }
  }
  return placements;
}

}  // namespace touchstone::testing
