// SPDX-License-Identifier: MIT
//
// Features in the way of the origin, by trees.
#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>

#include "touchstone/core/cpd/contact_signs_internal.h"
#include "touchstone/core/cpd/depth_searcher_internal.h"

namespace touchstone::internal {
namespace {

constexpr double kInner = -0x1p-46;  // facets that have the origin on their inner side
constexpr double kReach = 4.0;       // times the radius: what is further off is not even noted

std::uint64_t ItemKey(SumKind kind, int a, int b) {
  return static_cast<std::uint64_t>(kind) << 62 | static_cast<std::uint64_t>(a) << 31 |
         static_cast<std::uint64_t>(b);
}

}  // namespace

using Eigen::Vector2d;
using Eigen::Vector3d;

void DepthSearcher::PlaceTrees(const RelativePose& pose, double distance, double angle) {
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  const Vector3d zero = Vector3d::Zero();
  const double scale = pair_.scale();
  s_.faces_a.Place(a_.faces(), identity, zero, scale);
  s_.vertices_a.Place(a_.vertices(), identity, zero, scale);
  s_.edges_a.Place(a_.convex_edges(), identity, zero, scale);
  s_.locks_a.Place(a_.locking_vertices(), identity, zero, scale);
  const Eigen::Matrix3d& rotation = pose.rotation();
  const Vector3d& translation = pose.translation();
  s_.faces_b.Place(b_.faces(), rotation, translation, scale, distance, angle);
  s_.vertices_b.Place(b_.vertices(), rotation, translation, scale, distance, angle);
  s_.edges_b.Place(b_.convex_edges(), rotation, translation, scale, distance, angle);
  s_.locks_b.Place(b_.locking_vertices(), rotation, translation, scale, distance, angle);
}

void DepthSearcher::BeginAtRoots(double reach) {
  reach_ = reach;
  made_before_ = s_.made.size();
  std::sort(s_.made.begin(), s_.made.end());
  s_.later.clear();
  for (const SumKind kind : kSumKinds) {
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
    if (s_.later[i].near >= answer_.upper) continue;
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

void DepthSearcher::AddLanes(const NodePair& pair, const PlacedFeatureNode& a, int i,
                             const PlacedFeatureNode& b, int j) {
  // Lanes have room for facets at any pose of a list, and a ball moves by no more than the motion
  // from here to there.
  const double margin = listed_ ? listed_motion_ : 0.0;
  const double radius = margin + a.radius[i] + b.radius[j];
  if (s_.balls.MayHold(radius)) {
    Vector3d centre;
    for (int k = 0; k < 3; ++k) centre[k] = static_cast<double>(a.centre[k][i]) - b.centre[k][j];
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
  } else if (listed_) {
    listed_->items.push_back({0.0, pair.kind, ~child_a, ~child_b});
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
