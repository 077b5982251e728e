// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/kept_patch_internal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>

#include "touchstone/core/cpd/contact_name_internal.h"
#include "touchstone/core/minkowski/convolution.h"

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

// Scaled bodies are of size one. Points are placed to about 2^-44, where planes meet at no less
// than kLeastSine; what passes this far into a triangle cuts it.
constexpr double kPatchSlack = 0x1p-32;
constexpr double kLeastSine = 0x1p-10;
// A list has room for so many steps of the motion, within an angle beyond which it holds too much.
constexpr double kListSteps = 16.0, kListAngle = 0.1, kListRoom = 0.25;

bool Meet(const PlacedFacet& facet, const Vector3d& low, const Vector3d& high) {
  return (facet.low.array() <= high.array() + kPatchSlack).all() &&
         (facet.high.array() >= low.array() - kPatchSlack).all();
}

// Corners and box; the plane where it is asked for.
PlacedFacet PlaceCorners(const MeshPair& pair, const SumFacet& name) {
  PlacedFacet facet;
  const SumCorners corners = CornersOf(pair, name);
  facet.count = corners.count;
  for (int k = 0; k < corners.count; ++k) {
    facet.corners[k] = EstimateVertex(pair, corners.vertices[k]);
    facet.low = k == 0 ? facet.corners[k] : Vector3d(facet.low.cwiseMin(facet.corners[k]));
    facet.high = k == 0 ? facet.corners[k] : Vector3d(facet.high.cwiseMax(facet.corners[k]));
  }
  return facet;
}

void PlacePlane(const MeshPair& pair, const SumFacet& name, PlacedFacet* facet) {
  const PlaneEstimate plane = EstimatePlane(pair, name);
  facet->normal = plane.normal;
  facet->offset = plane.offset;
}

double Height(const PlacedFacet& facet, const Vector3d& x) {
  return facet.normal.dot(x) - facet.offset;
}

// Whether a point of the plane lies in the facet, up to the slack.
bool HoldsInPlane(const PlacedFacet& facet, const Vector3d& x) {
  for (int k = 0; k < facet.count; ++k) {
    const Vector3d side = facet.corners[k + 1 == facet.count ? 0 : k + 1] - facet.corners[k];
    if (facet.normal.cross(side).dot(x - facet.corners[k]) < -kPatchSlack * side.norm()) {
      return false;
    }
  }
  return true;
}

bool Holds(const PlacedFacet& facet, const Vector3d& x) {
  return std::abs(Height(facet, x)) <= kPatchSlack && HoldsInPlane(facet, x);
}

bool IsOnSegment(const Vector3d& from, const Vector3d& to, const Vector3d& x) {
  const Vector3d side = to - from;
  const double length = side.norm(), along = side.dot(x - from);
  return along >= -kPatchSlack * length && along <= (length + kPatchSlack) * length &&
         side.cross(x - from).norm() <= kPatchSlack * length;
}

bool IsOnEdge(const PlacedFacet& facet, const Vector3d& u, const Vector3d& v) {
  for (int k = 0; k < facet.count; ++k) {
    const Vector3d &from = facet.corners[k], &to = facet.corners[(k + 1) % facet.count];
    if (IsOnSegment(from, to, u) && IsOnSegment(from, to, v)) return true;
  }
  return false;
}

}  // namespace

bool CandidateList::Covers(const MeshPair& pair, const Vector3d& center, double radius) const {
  if (!is_made_ || scale_ != pair.scale()) return false;
  const MotionBound motion = MotionOfB(pair, pose_);
  return motion.distance <= distance_ && motion.angle <= angle_ &&
         (center - center_).norm() + radius <= radius_;
}

void CandidateList::Make(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
                         const Vector3d& center, double radius, double room, double distance,
                         double angle) {
  is_made_ = true;
  pose_ = pair.pose();
  scale_ = pair.scale();
  center_ = center;
  radius_ = radius + room;
  distance_ = distance;
  angle_ = angle;
  facets_.clear();
  // Sums are measured from the ball's centre.
  const Vector3d shift = -center / scale_;
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  const RelativePose& pose = pair.pose();
  const FeatureTree* of_a[] = {&a.faces(), &a.vertices(), &a.convex_edges()};
  const FeatureTree* of_b[] = {&b.vertices(), &b.faces(), &b.convex_edges()};
  for (int k = 0; k < 3; ++k) {
    trees_a_[k].Place(*of_a[k], identity, shift, scale_);
    trees_b_[k].Place(*of_b[k], pose.rotation(), pose.translation(), scale_, distance, angle);
    AddPairs(pair, a, b, static_cast<SumFacetKind>(k));
  }
}

void CandidateList::AddPairs(const MeshPair& pair, const ContactBody& body_a,
                             const ContactBody& body_b, SumFacetKind kind) {
  PlacedFeatureTree &tree_a = trees_a_[static_cast<int>(kind)],
                    &tree_b = trees_b_[static_cast<int>(kind)];
  if (tree_a.empty() || tree_b.empty()) return;
  const Vector3d reach = Vector3d::Constant(radius_ + distance_ + 4.0 * kPatchSlack);
  const Vector3d low = center_ - reach, high = center_ + reach;
  stack_.assign(1, {0, 0});
  while (!stack_.empty()) {
    const auto [code_a, code_b] = stack_.back();
    stack_.pop_back();
    FeatureNode alone_a, alone_b;
    const auto node_of = [](PlacedFeatureTree* tree, int code,
                            FeatureNode* alone) -> const FeatureNode& {
      if (code >= 0) return tree->node(code);
      *alone = LaneAlone(tree->node(~code / kFeatureTreeWidth), ~code % kFeatureTreeWidth);
      return *alone;
    };
    const FeatureNode& a = node_of(&tree_a, code_a, &alone_a);
    const FeatureNode& b = node_of(&tree_b, code_b, &alone_b);
    std::uint8_t masks[kFeatureTreeWidth];
    MeetingFeatures(a, b, radius_, false, masks);
    for (int j = 0; j < b.lane_count; ++j) {
      for (unsigned mask = masks[j]; mask != 0; mask &= mask - 1) {
        const int i = std::countr_zero(mask);
        const int child_a = a.children[i], child_b = b.children[j];
        if (child_a < 0 && child_b < 0) {
          const SumFacet facet = {kind, false, ~child_a, ~child_b};
          if (Meet(PlaceCorners(pair, facet), low, high) &&
              MaySupportEitherWay(pair, body_a, body_b, facet, angle_)) {
            facets_.push_back(facet);
          }
          continue;
        }
        const auto next = [](int child, int code, int lane) {
          return child >= 0 ? child : code < 0 ? code : ~(kFeatureTreeWidth * code + lane);
        };
        stack_.emplace_back(next(child_a, code_a, i), next(child_b, code_b, j));
      }
    }
  }
}

std::shared_ptr<const PatchShape> KeptPatch::Make(const MeshPair& pair, const ContactBody& a,
                                                  const ContactBody& b, const LocalSum& sum,
                                                  int t) {
  auto shape = std::make_shared<PatchShape>();
  shape->facets = sum.facets;
  std::vector<int> number(sum.vertices.size(), -1), taken;
  const auto add = [&](int triangle) {
    std::array<int, 3> corners = sum.triangles[triangle];
    for (int& v : corners) {
      if (number[v] < 0) {
        number[v] = static_cast<int>(shape->names.size());
        shape->names.push_back(sum.names[v]);
      }
      v = number[v];
    }
    shape->triangles.push_back(corners);
    shape->facet_of_triangle.push_back(sum.facet_of_triangle[triangle]);
    shape->sides.push_back({kEdgeSide, kEdgeSide, kEdgeSide});
    shape->is_above.push_back({false, false, false});
    taken.push_back(triangle);
  };
  add(t);
  const auto& own = sum.triangles[t];
  for (int s = 0; s < static_cast<int>(sum.triangles.size()); ++s) {
    const auto& corners = sum.triangles[s];
    if (s != t && std::find_first_of(corners.begin(), corners.end(), own.begin(), own.end()) !=
                      corners.end()) {
      add(s);
    }
  }
  for (const SumPointName& name : shape->names) {
    if (name.kind == SumPointKind::kEdgeEdge) return nullptr;
  }
  if (!PlaceFacets(pair, a, b, *shape) || !PlacePoints(pair, *shape)) return nullptr;
  Bound();
  CoverPatch(pair, a, b);
  if (!NameByOwnFacets(pair, a, b, shape.get())) return nullptr;
  for (std::size_t k = 0; k < taken.size(); ++k) {
    for (int side = 0; side < 3; ++side) {
      const int across = sum.neighbors[taken[k]][side];
      if (across >= 0 && sum.cell_of_triangle[across] == sum.cell_of_triangle[taken[k]]) {
        shape->sides[k][side] = kDiagonalSide;
      } else if (!FindWall(pair, a, b, static_cast<int>(k), side, shape.get())) {
        return nullptr;
      }
    }
  }
  MarkFlat(shape.get());
  if (!HasWalls(*shape) || !IsClear(pair, a, b, *shape)) return nullptr;
  return shape;
}

bool KeptPatch::FindWall(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
                         int triangle, int side, PatchShape* shape) {
  const auto& corners = shape->triangles[triangle];
  const Vector3d &u = points_[corners[side]], &v = points_[corners[(side + 1) % 3]],
                 &w = points_[corners[(side + 2) % 3]];
  const int own = shape->facet_of_triangle[triangle];
  if (IsOnEdge(facets_[own], u, v)) return true;
  const int wall = FindFacet(pair, a, b, shape, [&](const PlacedFacet& facet) {
    return &facet != &facets_[own] && Holds(facet, u) && Holds(facet, v);
  });
  if (wall < 0) return false;
  shape->sides[triangle][side] = wall;
  shape->is_above[triangle][side] = Height(facets_[wall], w) > 0.0;
  return true;
}

bool KeptPatch::Follow(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
                       const PatchShape& shape) {
  if (last_pose_) step_ = MotionOfB(pair, *last_pose_);
  last_pose_ = pair.pose();
  if (!PlaceFacets(pair, a, b, shape) || !PlacePoints(pair, shape) || !HasWalls(shape)) {
    return false;
  }
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

bool KeptPatch::IsOnNamed(const SumPointName& name, const Vector3d& x) const {
  return std::all_of(name.facets.begin(), name.facets.end(),
                     [&](int f) { return f < 0 || HoldsInPlane(facets_[f], x); });
}

// A name may give any facet of a plane: one of those that pass the point takes its place.
bool KeptPatch::NameByOwnFacets(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
                                PatchShape* shape) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    for (int& f : shape->names[i].facets) {
      if (f < 0 || HoldsInPlane(facets_[f], points_[i])) continue;
      const Vector3d normal = facets_[f].normal;
      f = FindFacet(pair, a, b, shape, [&](const PlacedFacet& facet) {
        return normal.cross(facet.normal).norm() <= kPatchSlack && Holds(facet, points_[i]);
      });
      if (f < 0) return false;
    }
  }
  return true;
}

// The number of a facet of the patch, or of one near it, that is then added; -1: none.
template <class Condition>
int KeptPatch::FindFacet(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
                         PatchShape* shape, const Condition& holds) {
  for (int f = 0; f < static_cast<int>(facets_.size()); ++f) {
    if (holds(facets_[f])) return f;
  }
  for (SumFacet name : list_.facets()) {
    PlacedFacet facet = PlaceCorners(pair, name);
    if (!Meet(facet, low_, high_)) continue;
    for (const bool sense : {false, true}) {
      name.is_along_cross = sense;
      if ((sense && name.kind != SumFacetKind::kEdgeEdge) || !MaySupport(pair, a, b, name)) {
        continue;
      }
      PlacePlane(pair, name, &facet);
      if (!holds(facet)) continue;
      shape->facets.push_back(name);
      facets_.push_back(facet);
      return static_cast<int>(facets_.size()) - 1;
    }
  }
  return -1;
}

bool KeptPatch::PlacePoints(const MeshPair& pair, const PatchShape& shape) {
  points_.resize(shape.names.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!PlacePoint(pair, shape.names[i], &points_[i])) return false;
  }
  return true;
}

void KeptPatch::MarkFlat(PatchShape* shape) const {
  for (const auto& [i, j, k] : shape->triangles) {
    const Vector3d u = points_[j] - points_[i], v = points_[k] - points_[i];
    const double longest = std::max({u.norm(), v.norm(), (v - u).norm()});
    shape->is_flat.push_back(u.cross(v).norm() <= 4.0 * kPatchSlack * longest);
  }
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
      if (name != shape.facets[shape.facet_of_triangle[t]] && Crosses(facet, shape, t))
        return false;
    }
  }
  return true;
}

// Whether the facet passes through the triangle deeper than the slack; for a facet in its plane,
// whether doubles leave that open.
bool KeptPatch::Crosses(const PlacedFacet& facet, const PatchShape& shape, int triangle) const {
  const auto& [i, j, k] = shape.triangles[triangle];
  const Vector3d* corners[3] = {&points_[i], &points_[j], &points_[k]};
  const auto parts = [](double least, double most) {
    return least >= -kPatchSlack || most <= kPatchSlack;
  };
  if (!Meet(facet, corners[0]->cwiseMin(*corners[1]).cwiseMin(*corners[2]),
            corners[0]->cwiseMax(*corners[1]).cwiseMax(*corners[2]))) {
    return false;
  }
  double least = 1e300, most = -1e300;
  for (const Vector3d* corner : corners) {
    const double height = Height(facet, *corner);
    least = std::min(least, height);
    most = std::max(most, height);
  }
  const bool is_coplanar = least >= -kPatchSlack && most <= kPatchSlack;
  if (!is_coplanar && parts(least, most)) return false;
  const PlacedFacet& own = facets_[shape.facet_of_triangle[triangle]];
  double heights[4];
  for (int c = 0; c < facet.count; ++c) heights[c] = Height(own, facet.corners[c]);
  // What the triangle's plane cuts from the facet.
  std::array<Vector3d, 8> cut;
  int count = 0;
  for (int c = 0; c < facet.count; ++c) {
    const int next = c + 1 == facet.count ? 0 : c + 1;
    if (std::abs(heights[c]) <= kPatchSlack) cut[count++] = facet.corners[c];
    if (std::min(heights[c], heights[next]) < -kPatchSlack &&
        std::max(heights[c], heights[next]) > kPatchSlack) {
      cut[count++] = facet.corners[c] + heights[c] / (heights[c] - heights[next]) *
                                            (facet.corners[next] - facet.corners[c]);
    }
  }
  if (count == 0) return false;
  // A line in the plane that parts them: along a side of the triangle, or of what was cut.
  for (int c = 0; c < 3; ++c) {
    const Vector3d &u = *corners[c], &v = *corners[(c + 1) % 3];
    const Vector3d inward = own.normal.cross(v - u);
    const double slack = kPatchSlack * inward.norm();
    bool is_outside = true;
    for (int n = 0; n < count; ++n) is_outside &= inward.dot(cut[n] - u) <= slack;
    if (is_outside) return false;
  }
  for (int n = 0; n < count && count > 1; ++n) {
    const Vector3d across = own.normal.cross(cut[(n + 1) % count] - cut[n]);
    const double slack = kPatchSlack * across.norm();
    double low = 1e300, high = -1e300, own_low = 0.0, own_high = 0.0;
    for (const Vector3d* corner : corners) {
      low = std::min(low, across.dot(*corner - cut[n]));
      high = std::max(high, across.dot(*corner - cut[n]));
    }
    for (int m = 0; m < count; ++m) {
      own_low = std::min(own_low, across.dot(cut[m] - cut[n]));
      own_high = std::max(own_high, across.dot(cut[m] - cut[n]));
    }
    if (low >= own_high - slack || high <= own_low + slack) return false;
  }
  return true;
}

PhongSurface KeptPatch::Surface(const MeshPair& pair, const PatchShape& shape,
                                NormalWeights weights) {
  vertices_.resize(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) vertices_[i] = points_[i] / pair.scale();
  if (weights != NormalWeights::kAngle) {
    normals_ = VertexNormals(vertices_, shape.triangles, weights);
  } else {
    // By the facets' normals, as in local sums.
    normals_.assign(points_.size(), Vector3d::Zero());
    for (std::size_t t = 0; t < shape.triangles.size(); ++t) {
      const auto& corners = shape.triangles[t];
      const Vector3d& normal = facets_[shape.facet_of_triangle[t]].normal;
      for (int k = 0; k < 3; ++k) {
        const Vector3d u = points_[corners[(k + 1) % 3]] - points_[corners[k]],
                       v = points_[corners[(k + 2) % 3]] - points_[corners[k]];
        normals_[corners[k]] += std::atan2(u.cross(v).norm(), u.dot(v)) * normal;
      }
    }
    for (Vector3d& normal : normals_) normal = normal.stableNormalized();
  }
  return {vertices_, shape.triangles, {}, normals_};
}

}  // namespace touchstone::internal
