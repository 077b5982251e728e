// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CPD_DEPTH_SEARCH_INTERNAL_H_
#define TOUCHSTONE_CORE_CPD_DEPTH_SEARCH_INTERNAL_H_

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "touchstone/core/cpd/burial_internal.h"
#include "touchstone/core/cpd/contact_name_internal.h"
#include "touchstone/core/cpd/facet_piece_internal.h"
#include "touchstone/core/cpd/mesh_penetration_depth.h"
#include "touchstone/core/mesh/membership.h"
#include "touchstone/core/minkowski/feature_tree.h"

namespace touchstone::internal {

// Which features' sums a pair of nodes stands for.
enum class SumKind : std::uint8_t { kFaceVertex, kVertexFace, kEdgeEdge, kVertexVertex };
inline constexpr SumKind kSumKinds[] = {SumKind::kFaceVertex, SumKind::kVertexFace,
                                        SumKind::kEdgeEdge, SumKind::kVertexVertex};

// By the codes of FeatureLanes.
struct NodePair {
  double near;
  SumKind kind;
  int a, b;
};

// A facet that was met, or a vertex of M in its place.
struct MetFacet {
  FacetFrame frame;
  bool is_vertex = false;
  SumVertex vertex;
};

// Pairs of features that can have a facet within `limit` of the origin at any pose near `middle`:
// one that moves B's points by no more than `distance` (scaled) and turns it by no more than
// `angle`. Made in two stages: pairs are collected, part by part, and then measured.
struct FeatureList {
  std::optional<ContactBody> a, b;  // of which it was made; none: no list
  RelativePose middle;
  double scale = 0.0, limit = 0.0, distance = 0.0, angle = 0.0;
  std::vector<NodePair> open;   // pairs of nodes that are yet to be looked through
  int node_pairs = 0;           // that have been
  std::vector<NodePair> items;  // by the features' own numbers; `near` once they are measured
  RelativePose measured_at;     // then in the order of `near`, at this pose
};

struct DepthScratch {
  // What the last answer was made of.
  std::optional<RelativePose> pose;
  FeatureList list, next_list;
  std::optional<ContactName> answer;
  std::vector<PrismName> prism_names;
  std::vector<std::pair<int, int>> ball_faces;

  // Storage.
  PlacedFeatureTree faces_a, vertices_a, edges_a, locks_a, faces_b, vertices_b, edges_b, locks_b;
  std::vector<NodePair> stack, later;
  std::vector<std::uint64_t> made;  // items kept in this query
  std::vector<MetFacet> facets;
  std::vector<FacetPiece> pieces;
  std::vector<int> free_pieces;
  std::vector<std::pair<double, int>> heap;
  std::vector<int> prism_uses;
  PrismList prisms;
  BallList balls;
  std::vector<std::pair<int, int>> met_balls;  // the faces that they touch
  MembershipCache membership;
};

// What the search found, in the pair's scaled frame.
struct DepthAnswer {
  MeshDepthStatus status = MeshDepthStatus::kSeparate;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  // not in M°: proven
  double at_error = 0.0;                         // off zero where `at` rounds an exact point
  double lower = 0.0, upper = std::numeric_limits<double>::infinity();
  bool is_exact = false, was_warm = false;
  std::optional<ContactName> name;
};

// Runs the search; counts go into `result`.
DepthAnswer SearchDepth(const MeshPair& pair, const ContactBody& a, const ContactBody& b,
                        const MeshDepthOptions& options, DepthScratch* scratch,
                        MeshDepthResult* result);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_CPD_DEPTH_SEARCH_INTERNAL_H_
