// SPDX-License-Identifier: MIT
//
// Features in the way of the origin: facets by trees, and by lists along slow motions.
#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>

#include "touchstone/core/cpd/contact_signs_internal.h"
#include "touchstone/core/cpd/depth_searcher_internal.h"

namespace touchstone::internal {
namespace {

constexpr double kListFrames = 8.0;  // steps of a motion that a list has room for
constexpr double kInner = -0x1p-46;  // facets that have the origin on their inner side
constexpr double kListAngle = 0.06;  // beyond, lists would hold too much
constexpr double kReach = 4.0;       // times the radius: what is further off is not even noted

std::uint64_t ItemKey(SumKind kind, int a, int b) {
  return static_cast<std::uint64_t>(kind) << 62 | static_cast<std::uint64_t>(a) << 31 |
         static_cast<std::uint64_t>(b);
}

}  // namespace

using Eigen::Vector2d;
using Eigen::Vector3d;

bool DepthSearcher::UseList() {
  FeatureList& list = s_.list;
  const bool is_of_these = list.a && list.b && list.a->IsSameAs(a_) && list.b->IsSameAs(b_) &&
                           list.scale == pair_.scale();
  if (is_of_these && answer_.upper <= list.limit) {
    const MotionBound motion = MotionOfB(pair_, list.pose);
    if (motion.distance <= list.distance && motion.angle <= list.angle) {
      AddItems(motion.distance);
      return true;
    }
  }
  if (!answer_.was_warm || !s_.pose) return false;
  const MotionBound step = MotionOfB(pair_, *s_.pose);
  if (!(kListFrames * step.angle < kListAngle)) return false;
  list.a = a_;
  list.b = b_;
  list.pose = pair_.pose();
  list.scale = pair_.scale();
  list.distance = kListFrames * step.distance + 0x1p-40;
  list.angle = kListFrames * step.angle + 0x1p-40;
  list.limit = 1.02 * answer_.upper + list.distance;
  list.items.clear();
  PlaceTrees(list.distance, list.angle);
  is_listing_ = true;
  radius_ = list.limit;
  ExpandWithinRadius();
  is_listing_ = false;
  s_.later.clear();
  std::sort(list.items.begin(), list.items.end(),
            [](const NodePair& x, const NodePair& y) { return x.near < y.near; });
  AddItems(0.0);
  return true;
}

void DepthSearcher::AddItems(double motion) {
  radius_ = answer_.upper;
  for (const NodePair& item : s_.list.items) {
    if (item.near - motion >= answer_.upper) break;
    AddItem(item.kind, item.a, item.b);
  }
}

void DepthSearcher::ListItem(SumKind kind, int a, int b) {
  double near = 0.0;
  if (kind == SumKind::kVertexVertex) {
    near = EstimateVertex(pair_, {a, b}).norm() - 0x1p-44;
  } else {
    constexpr SumFacetKind kKinds[] = {SumFacetKind::kFaceVertex, SumFacetKind::kVertexFace,
                                       SumFacetKind::kEdgeEdge};
    const SumFacet facet = {kKinds[static_cast<int>(kind)], false, a, b};
    if (!MaySupportEitherWay(pair_, a_, b_, facet, s_.list.angle)) return;
    near = DistanceToFacet(pair_, facet);
  }
  if (near - s_.list.distance < s_.list.limit) s_.list.items.push_back({near, kind, a, b});
}

void DepthSearcher::PlaceTrees(double distance, double angle) {
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  const Vector3d zero = Vector3d::Zero();
  const double scale = pair_.scale();
  s_.faces_a.Place(a_.faces(), identity, zero, scale);
  s_.vertices_a.Place(a_.vertices(), identity, zero, scale);
  s_.edges_a.Place(a_.convex_edges(), identity, zero, scale);
  s_.locks_a.Place(a_.locking_vertices(), identity, zero, scale);
  const Eigen::Matrix3d& rotation = pair_.pose().rotation();
  const Vector3d& translation = pair_.pose().translation();
  s_.faces_b.Place(b_.faces(), rotation, translation, scale, distance, angle);
  s_.vertices_b.Place(b_.vertices(), rotation, translation, scale, distance, angle);
  s_.edges_b.Place(b_.convex_edges(), rotation, translation, scale, distance, angle);
  s_.locks_b.Place(b_.locking_vertices(), rotation, translation, scale, distance, angle);
  s_.made.clear();
  BeginAtRoots(is_listing_ ? s_.list.limit : kReach * radius_);
}

void DepthSearcher::BeginAtRoots(double reach) {
  reach_ = reach;
  made_before_ = s_.made.size();
  std::sort(s_.made.begin(), s_.made.end());
  s_.later.clear();
  for (const SumKind kind :
       {SumKind::kFaceVertex, SumKind::kVertexFace, SumKind::kEdgeEdge, SumKind::kVertexVertex}) {
    if (!TreeA(kind).empty() && !TreeB(kind).empty()) s_.later.push_back({0.0, kind, 0, 0});
  }
}

PlacedFeatureTree& DepthSearcher::TreeA(SumKind kind) {
  switch (kind) {
    case SumKind::kFaceVertex:
      return s_.faces_a;
    case SumKind::kVertexFace:
      return s_.vertices_a;
    case SumKind::kEdgeEdge:
      return s_.edges_a;
    case SumKind::kVertexVertex:
      break;
  }
  return s_.locks_a;
}

PlacedFeatureTree& DepthSearcher::TreeB(SumKind kind) {
  switch (kind) {
    case SumKind::kFaceVertex:
      return s_.vertices_b;
    case SumKind::kVertexFace:
      return s_.faces_b;
    case SumKind::kEdgeEdge:
      return s_.edges_b;
    case SumKind::kVertexVertex:
      break;
  }
  return s_.locks_b;
}

void DepthSearcher::ExpandWithinRadius() {
  if (radius_ > reach_) BeginAtRoots(kReach * radius_);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < s_.later.size(); ++i) {
    if (!is_listing_ && s_.later[i].near >= answer_.upper) continue;
    if (s_.later[i].near < radius_) {
      s_.stack.push_back(s_.later[i]);
    } else {
      s_.later[kept++] = s_.later[i];
    }
  }
  s_.later.resize(kept);
  while (!s_.stack.empty()) {
    const NodePair pair = s_.stack.back();
    s_.stack.pop_back();
    Expand(pair);
  }
}

bool DepthSearcher::WasMade(SumKind kind, int a, int b) const {
  const auto end = s_.made.begin() + static_cast<std::ptrdiff_t>(made_before_);
  return std::binary_search(s_.made.begin(), end, ItemKey(kind, a, b));
}

void DepthSearcher::Expand(const NodePair& pair) {
  ++result_.node_pairs;
  const FeatureLanes a = TreeA(pair.kind).lanes(pair.a), b = TreeB(pair.kind).lanes(pair.b);
  std::uint8_t masks[kFeatureTreeWidth];
  MeetingFeatures(a, b, {Limit(), kInner}, masks);
  for (int j = 0; j < b.node->lane_count; ++j) {
    for (unsigned mask = masks[j]; mask != 0; mask &= mask - 1) {
      AddLanes(pair, *a.node, std::countr_zero(mask), *b.node, j);
    }
  }
}

void DepthSearcher::AddLanes(const NodePair& pair, const FeatureNode& a, int i,
                             const FeatureNode& b, int j) {
  // Whatever the motion does, a ball and a facet move by no more than the distance each.
  const double margin = is_listing_ ? s_.list.distance : 0.0;
  const double radius = a.radius[i] + b.radius[j] + margin;
  if (s_.balls.MayHold(radius)) {
    const Vector3d centre(a.centre[0][i] - b.centre[0][j], a.centre[1][i] - b.centre[1][j],
                          a.centre[2][i] - b.centre[2][j]);
    if (s_.balls.Holds(centre, radius)) return;
  }
  const int child_a = a.children[i], child_b = b.children[j];
  // Where all that meets is wanted now, how near it is does not matter.
  const bool is_order_needed = radius_ < Limit();
  const double near = is_order_needed ? std::max(pair.near, NearestSum(a, i, b, j)) : pair.near;
  if (child_a >= 0 || child_b >= 0 || !(near < radius_)) {
    (near < radius_ ? s_.stack : s_.later)
        .push_back({near, pair.kind, FeatureLanes::Next(child_a, pair.a, i),
                    FeatureLanes::Next(child_b, pair.b, j)});
  } else if (is_listing_) {
    ListItem(pair.kind, ~child_a, ~child_b);
  } else if (!WasMade(pair.kind, ~child_a, ~child_b)) {
    AddItem(pair.kind, ~child_a, ~child_b);
  }
}

void DepthSearcher::AddItem(SumKind kind, int a, int b) {
  switch (kind) {
    case SumKind::kFaceVertex:
      if (MayRest(pair_.a(), a, pair_.b(), b_.gauss_map(), b)) {
        AddFacet({SumFacetKind::kFaceVertex, false, a, b});
      }
      return;
    case SumKind::kVertexFace:
      if (MayRest(pair_.b(), b, pair_.a(), a_.gauss_map(), a)) {
        AddFacet({SumFacetKind::kVertexFace, false, a, b});
      }
      return;
    case SumKind::kEdgeEdge:
      AddEdgeEdge(a, b);
      return;
    case SumKind::kVertexVertex:
      AddVertex({a, b});
      return;
  }
}

void DepthSearcher::AddEdgeEdge(int a, int b) {
  const EdgeSenses senses = MayCross(pair_, a_, a, b_, b);
  if (senses.along) AddFacet({SumFacetKind::kEdgeEdge, true, a, b});
  if (senses.against) AddFacet({SumFacetKind::kEdgeEdge, false, a, b});
}

void DepthSearcher::AddFacet(const SumFacet& name) {
  s_.facets.emplace_back();
  MetFacet& facet = s_.facets.back();
  FacetPiece piece;
  MakeFacet(pair_, name, &facet.frame, &piece);
  piece.facet = static_cast<int>(s_.facets.size()) - 1;
  ++result_.facets;
  const bool faces_away = facet.frame.is_oriented && facet.frame.height < -facet.frame.slack;
  if (faces_away || IsBuried(facet.frame, piece) || !Push(piece)) {
    s_.facets.pop_back();
    return;
  }
  // A facet's kinds are those of sums.
  s_.made.push_back(ItemKey(static_cast<SumKind>(name.kind), name.a, name.b));
}

void DepthSearcher::AddVertex(const SumVertex& vertex) {
  const Vector3d x = EstimateVertex(pair_, vertex);
  s_.facets.emplace_back();
  MetFacet& facet = s_.facets.back();
  facet.is_vertex = true;
  facet.vertex = vertex;
  FacetFrame& frame = facet.frame;
  frame.normal = x.norm() > 0.0 ? Vector3d(x.normalized()) : Vector3d::UnitZ();
  frame.u = frame.normal.unitOrthogonal();
  frame.v = frame.normal.cross(frame.u);
  frame.height = x.norm();
  frame.slack = 0x1p-45 + 2.0 * (pair_.a().point_error + pair_.b().point_error);
  FacetPiece piece;
  piece.facet = static_cast<int>(s_.facets.size()) - 1;
  piece.count = 1;
  piece.at[0] = Vector2d::Zero();
  piece.walls[0] = kNoWall;
  piece.distance = frame.height;
  ++result_.facets;
  if (IsBuried(frame, piece) || !Push(piece)) {
    s_.facets.pop_back();
    return;
  }
  s_.made.push_back(ItemKey(SumKind::kVertexVertex, vertex.a, vertex.b));
}

}  // namespace touchstone::internal
