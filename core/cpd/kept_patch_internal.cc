// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/kept_patch_internal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "touchstone/core/cpd/contact_name_internal.h"

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

// Where planes meet at less, points are not placed.
constexpr double kLeastSine = 0x1p-10;
// A list has room for so many steps of the motion, within an angle beyond which it holds too much.
constexpr double kListSteps = 16.0, kListAngle = 0.1, kListRoom = 0.25;

}  // namespace

bool KeptPatch::Follow(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
                       const PatchShape& shape) {
  if (last_pose_) step_ = MotionOfB(pair, *last_pose_);
  last_pose_ = pair.pose();
  if (!Place(pair, a, b, shape) || !HasWalls(shape)) return false;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!IsOnNamed(shape.names[i], points_[i])) return false;
  }
  Bound();
  CoverPatch(pair, a, b);
  return IsClear(pair, a, b, shape);
}

bool KeptPatch::PlaceFacets(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
                            const PatchShape& shape) {
  facets_.clear();
  for (const SumFacet& name : shape.facets) {
    if (!MaySupport(pair, a, b, name)) return false;
    facets_.push_back(PlaceCorners(pair, name));
    PlacePlane(pair, name, &facets_.back());
  }
  return true;
}

bool KeptPatch::PlacePoint(const MeshPair& pair, const SumPointName& name, Vector3d* at) const {
  if (name.kind == SumPointKind::kVertex) {
    *at = EstimateVertex(pair, name.vertices[0]);
    return true;
  }
  const PlacedFacet& p = facets_[name.facets[0]];
  if (name.kind == SumPointKind::kEdgeFacet) {
    const Vector3d from = EstimateVertex(pair, name.vertices[0]),
                   to = EstimateVertex(pair, name.vertices[1]);
    const double s = Height(p, from), t = Height(p, to);
    if (!(s * t < 0.0) || std::min(std::abs(s), std::abs(t)) < kPatchSlack ||
        std::abs(s - t) < kLeastSine * (to - from).norm()) {
      return false;
    }
    *at = from + s / (s - t) * (to - from);
    return true;
  }
  const PlacedFacet &q = facets_[name.facets[1]], &r = facets_[name.facets[2]];
  const Vector3d qr = q.normal.cross(r.normal);
  const double determinant = p.normal.dot(qr);
  if (!(std::abs(determinant) > kLeastSine * kLeastSine)) return false;
  *at =
      (p.offset * qr + q.offset * r.normal.cross(p.normal) + r.offset * p.normal.cross(q.normal)) /
      determinant;
  return true;
}

bool KeptPatch::PlacePoints(const MeshPair& pair, const PatchShape& shape) {
  points_.resize(shape.names.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!PlacePoint(pair, shape.names[i], &points_[i])) return false;
  }
  return true;
}

bool KeptPatch::IsOnNamed(const SumPointName& name, const Vector3d& x) const {
  return std::all_of(name.facets.begin(), name.facets.end(),
                     [&](int f) { return f < 0 || HoldsInPlane(facets_[f], x); });
}

// Every triangle lies on its facet, the right way round, and every side on what bounds it.
bool KeptPatch::HasWalls(const PatchShape& shape) const {
  for (std::size_t t = 0; t < shape.triangles.size(); ++t) {
    const auto& [i, j, k] = shape.triangles[t];
    const Vector3d* corners[3] = {&points_[i], &points_[j], &points_[k]};
    const PlacedFacet& own = facets_[shape.facet_of_triangle[t]];
    double longest = 0.0;
    for (int c = 0; c < 3; ++c) {
      if (!Holds(own, *corners[c])) return false;
      longest = std::max(longest, (*corners[(c + 1) % 3] - *corners[c]).norm());
    }
    const double area =
        own.normal.dot((*corners[1] - *corners[0]).cross(*corners[2] - *corners[0]));
    // Slivers thinner than the slack, as between facets that are coplanar but for roundings, must
    // stay such.
    const double flat = 4.0 * kPatchSlack * longest;
    if (shape.is_flat[t] ? std::abs(area) > flat : area <= flat) return false;
    for (int c = 0; c < 3; ++c) {
      const int wall = shape.sides[t][c];
      if (wall == kDiagonalSide) continue;
      const Vector3d &u = *corners[c], &v = *corners[(c + 1) % 3], &w = *corners[(c + 2) % 3];
      if (wall == kEdgeSide) {
        if (!IsOnEdge(own, u, v)) return false;
        continue;
      }
      const PlacedFacet& facet = facets_[wall];
      if (!Holds(facet, u) || !Holds(facet, v)) return false;
      const double height = Height(facet, w);
      if (std::abs(height) > kPatchSlack && (height > 0.0) != shape.is_above[t][c]) return false;
    }
  }
  return true;
}

void KeptPatch::Bound() {
  low_ = high_ = points_[0];
  for (const Vector3d& point : points_) {
    low_ = low_.cwiseMin(point);
    high_ = high_.cwiseMax(point);
  }
  center_ = 0.5 * (low_ + high_);
  radius_ = 0.0;
  for (const Vector3d& point : points_) radius_ = std::max(radius_, (point - center_).norm());
}

void KeptPatch::CoverPatch(const MeshPair& pair, const ContactBody& a, const ContactBody& b) {
  if (list_.Covers(pair, center_, radius_)) return;
  MotionBound step = step_.value_or(MotionBound{0.0, 0.0});
  const double steps =
      step.angle > 0.0 ? std::min(kListSteps, kListAngle / step.angle) : kListSteps;
  step = {steps * step.distance + kPatchSlack, steps * step.angle + 1e-12};
  list_.Make(pair, a, b, center_, radius_, kListRoom * radius_ + step.distance, step.distance,
             step.angle);
}

bool KeptPatch::IsClear(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
                        const PatchShape& shape) {
  for (SumFacet name : list_.facets()) {
    PlacedFacet facet = PlaceCorners(pair, name);
    if (!Meet(facet, low_, high_)) continue;
    if (name.kind == SumFacetKind::kEdgeEdge) {
      const EdgeSenses senses = MayCross(pair, a, name.a, b, name.b);
      if (!senses.along && !senses.against) continue;
      name.is_along_cross = senses.along;
    } else if (!MaySupport(pair, a, b, name)) {
      continue;
    }
    PlacePlane(pair, name, &facet);
    for (int t = 0; t < static_cast<int>(shape.triangles.size()); ++t) {
      const auto& [i, j, k] = shape.triangles[t];
      const int own = shape.facet_of_triangle[t];
      if (name != shape.facets[own] &&
          PassesThrough(facet, facets_[own], {points_[i], points_[j], points_[k]})) {
        return false;
      }
    }
  }
  return true;
}

PhongSurface KeptPatch::Surface(const MeshPair& pair, const PatchShape& shape,
                                NormalWeights weights) {
  vertices_.resize(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) vertices_[i] = points_[i] / pair.scale();
  // By the facets' normals, as in local sums.
  triangle_normals_.resize(shape.triangles.size());
  for (std::size_t t = 0; t < shape.triangles.size(); ++t) {
    triangle_normals_[t] = facets_[shape.facet_of_triangle[t]].normal;
  }
  VertexNormals(vertices_, shape.triangles, weights, triangle_normals_, &normals_);
  return {vertices_, shape.triangles, {}, normals_};
}

}  // namespace touchstone::internal
