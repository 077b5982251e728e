// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/dynamic_convolution.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "touchstone/core/minkowski/gauss_arrangement_internal.h"
#include "touchstone/core/minkowski/map_search_internal.h"
#include "touchstone/core/minkowski/rotation_travel_internal.h"
#include "touchstone/core/minkowski/sum_changes_internal.h"
#include "touchstone/core/minkowski/support_signs_internal.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;
using internal::ForEachMissing;
using internal::MapSearch;
using internal::RotationTravel;
using internal::Side;
using internal::SupportSigns;

constexpr double kNever = -1.0;  // before any travel

}  // namespace

class DynamicConvolution::State {
 public:
  State(MappedMesh a, MappedMesh b)
      : bodies_{std::move(a), std::move(b)},
        searches_{MapSearch(bodies_[1].convex_map), MapSearch(bodies_[0].convex_map)} {
    for (const int side : {0, 1}) AddDirections(side);
    std::array<int, 2> convex_edges = {0, 0};
    for (const int side : {0, 1}) {
      const TriangleMesh& mesh = bodies_[side].mesh;
      for (int e = 0; e < mesh.edge_count(); ++e) {
        convex_edges[side] += mesh.edge_kind(e) == EdgeKind::kConvex;
      }
    }
    // Short arcs meet few others.
    traced_ = convex_edges[0] >= convex_edges[1] ? 0 : 1;
    AddEdges();
    counts_.features =
        static_cast<int>(directions_[0].size() + directions_[1].size() + edges_.size());
  }

  void Place(const MeshPair& pair) {
    pair_ = &pair;
    ++pose_;
    signs_.reset();
    counts_.looked_at = counts_.undecided = 0;
    counts_.regions = counts_.exact_signs = 0;
    if (!motion_.GoTo(pair.pose())) StartAnew();
  }

  const SumChanges& Update(const MeshPair& pair) {
    Place(pair);
    changes_.dropped.swap(noted_.dropped);
    changes_.added.swap(noted_.added);
    noted_.dropped.clear();
    noted_.added.clear();
    due_.clear();
    while (!queue_.empty() && queue_.front().until <= motion_.travel()) {
      std::pop_heap(queue_.begin(), queue_.end());
      const Entry entry = queue_.back();
      queue_.pop_back();
      if (entry.until == UntilOf(entry.feature)) due_.push_back(entry.feature);
    }
    // Neighbours follow each other, and walks are short.
    std::sort(due_.begin(), due_.end());
    due_.erase(std::unique(due_.begin(), due_.end()), due_.end());
    for (const int feature : due_) Refresh(feature);
    changes_.dropped.insert(changes_.dropped.end(), noted_.dropped.begin(), noted_.dropped.end());
    changes_.added.insert(changes_.added.end(), noted_.added.begin(), noted_.added.end());
    noted_.dropped.clear();
    noted_.added.clear();
    internal::CancelChanges(&changes_, &net_);
    return changes_;
  }

  std::span<const int> VerticesOnFace(int side, int face) {
    const int i = feature_of_face_[side][face];
    const DirectionFeature& feature = directions_[side][i];
    if (feature.until <= motion_.travel() && feature.pose != pose_)
      Refresh(side == 0 ? i : FirstOfB() + i);
    return feature.vertices;
  }

  bool traces_a() const { return traced_ == 0; }
  std::span<const SumFacet> FacetsOfEdge(int edge) {
    const int i = feature_of_edge_[edge];
    if (i < 0) return {};
    if (edges_[i].until <= motion_.travel() && edges_[i].pose != pose_) Refresh(FirstEdge() + i);
    return edges_[i].facets;
  }

  std::vector<SumFacet> Facets() const {
    std::vector<SumFacet> facets;
    for (const int side : {0, 1}) {
      for (const DirectionFeature& feature : directions_[side]) {
        for (const int f : FacesOf(side, feature)) {
          for (const int v : feature.vertices) facets.push_back(FaceVertexFacet(side, f, v));
        }
      }
    }
    for (const EdgeFeature& feature : edges_) {
      facets.insert(facets.end(), feature.facets.begin(), feature.facets.end());
    }
    std::sort(facets.begin(), facets.end());
    return facets;
  }

  const Counts& counts() const { return counts_; }

 private:
  // A direction of one body's map in the map of the other, or an edge of one mesh in the map of the
  // other. The candidates are all that it can meet before the travel is `listed_until`.
  struct Feature {
    int region = 0;                                // of the other's map, where the last walk ended
    int pose = 0;                                  // the last at which it was looked at
    double until = kNever, listed_until = kNever;  // what was found holds until then
    std::vector<int> candidates;
  };
  struct DirectionFeature : Feature {
    int face = 0;               // of its own map
    std::vector<int> vertices;  // that support it, sorted
  };
  struct EdgeFeature : Feature {
    int edge = 0;
    std::vector<SumFacet> facets;  // sorted
  };
  // In a heap by `until`; void where that is not the feature's any more.
  struct Entry {
    double until;
    int feature;  // directions of A, directions of B, edges
    friend bool operator<(const Entry& a, const Entry& b) { return a.until > b.until; }
  };

  int FirstOfB() const { return static_cast<int>(directions_[0].size()); }
  int FirstEdge() const { return FirstOfB() + static_cast<int>(directions_[1].size()); }
  double UntilOf(int feature) const {
    if (feature < FirstOfB()) return directions_[0][feature].until;
    if (feature < FirstEdge()) return directions_[1][feature - FirstOfB()].until;
    return edges_[feature - FirstEdge()].until;
  }
  std::span<const int> FacesOf(int side, const DirectionFeature& feature) const {
    return bodies_[side].convex_map.faces_at(feature.face);
  }
  static SumFacet FaceVertexFacet(int side, int face, int vertex) {
    if (side == 0) return {SumFacetKind::kFaceVertex, false, face, vertex};
    return {SumFacetKind::kVertexFace, false, vertex, face};
  }
  static Side SideOf(int side) { return side == 0 ? Side::kA : Side::kB; }

  void AddDirections(int side) {
    const ConvexMap& map = bodies_[side].convex_map;
    std::vector<int> feature_of_direction(map.face_count(), -1);
    for (int f = 0; f < bodies_[side].mesh.face_count(); ++f) {
      const int face = map.face_of_mesh_face(f);
      if (feature_of_direction[face] < 0) {
        feature_of_direction[face] = static_cast<int>(directions_[side].size());
        directions_[side].emplace_back().face = face;
      }
      feature_of_face_[side].push_back(feature_of_direction[face]);
    }
  }

  void AddEdges() {
    const TriangleMesh& mesh = bodies_[traced_].mesh;
    feature_of_edge_.assign(mesh.edge_count(), -1);
    for (int e = 0; e < mesh.edge_count(); ++e) {
      if (mesh.edge_kind(e) != EdgeKind::kConvex) continue;
      feature_of_edge_[e] = static_cast<int>(edges_.size());
      edges_.emplace_back().edge = e;
    }
  }

  void StartAnew() {
    queue_.clear();
    for (auto& directions : directions_) {
      for (Feature& feature : directions) feature.until = feature.listed_until = kNever;
    }
    for (Feature& feature : edges_) feature.until = feature.listed_until = kNever;
    for (int i = 0; i < counts_.features; ++i) queue_.push_back({kNever, i});
  }

  // The exact signs of the pair, made when first needed at a pose.
  SupportSigns& signs() {
    if (!signs_) signs_.emplace(*pair_, bodies_[0].gauss_map, bodies_[1].gauss_map);
    return *signs_;
  }

  void Refresh(int feature) {
    ++counts_.looked_at;
    const long exact_before = signs_ ? signs_->exact_count() : 0;
    if (feature < FirstOfB()) {
      RefreshDirection(0, &directions_[0][feature]);
    } else if (feature < FirstEdge()) {
      RefreshDirection(1, &directions_[1][feature - FirstOfB()]);
    } else {
      RefreshEdge(&edges_[feature - FirstEdge()]);
    }
    if (signs_) counts_.exact_signs += signs_->exact_count() - exact_before;
    queue_.push_back({UntilOf(feature), feature});
    std::push_heap(queue_.begin(), queue_.end());
  }

  // The greatest height of a neighbour that bounds the cone: negative where x is within.
  static double HeightOverCone(const MappedMesh& body, int v, const Vector3d& x) {
    double height = -std::numeric_limits<double>::infinity();
    for (int i = body.cone_begin[v]; i < body.cone_begin[v + 1]; ++i) {
      height = std::max(height, body.cone_sides[i].dot(x));
    }
    return height;
  }

  // The vertices over the regions near x; special ones by their own neighbours.
  void ListVertices(int side, const Vector3d& x, DirectionFeature* feature) {
    const MappedMesh& other = bodies_[1 - side];
    // From where it was, or where the last one was found, whichever is nearer.
    const int last = last_regions_[side];
    const auto nearness = [&](int region) { return other.convex_map.middle(region).dot(x); };
    const int start = nearness(feature->region) >= nearness(last) ? feature->region : last;
    MapSearch& search = searches_[side];
    const double radius = std::max(motion_.reach(), 2.0 * motion_.margin());
    search.FindPoint(x, start, 2.0 * motion_.margin(), radius);
    counts_.regions += std::ssize(search.regions());
    last_regions_[side] = feature->region = search.regions().front();
    std::vector<int>& candidates = feature->candidates;
    candidates.clear();
    for (const int r : search.regions()) {
      const auto over = other.convex_map.vertices_over(r);
      candidates.insert(candidates.end(), over.begin(), over.end());
    }
    for (const int v : other.special_vertices) {
      if (HeightOverCone(other, v, x) <= radius) candidates.push_back(v);
    }
    std::sort(candidates.begin(), candidates.end());
    candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
    feature->listed_until = motion_.UntilReached();
  }

  void RefreshDirection(int side, DirectionFeature* feature) {
    feature->pose = pose_;
    const Vector3d x = motion_.directions(side) * bodies_[side].convex_map.direction(feature->face);
    if (feature->listed_until <= motion_.travel()) ListVertices(side, x, feature);
    feature->until = feature->listed_until;
    found_vertices_.clear();
    bool is_decided = true;
    for (const int v : feature->candidates) {
      const double height = HeightOverCone(bodies_[1 - side], v, x);
      bool supports = height < 0.0;
      if (std::abs(height) <= 2.0 * motion_.margin()) {
        is_decided = false;
        supports = signs().FaceVertex(SideOf(side), FacesOf(side, *feature).front(), v);
      }
      feature->until = std::min(feature->until, motion_.Until(std::abs(height)));
      if (supports) found_vertices_.push_back(v);
    }
    counts_.undecided += !is_decided;
    if (feature->vertices == found_vertices_) return;
    NoteVertices(side, *feature);
    feature->vertices.swap(found_vertices_);
  }

  void NoteVertices(int side, const DirectionFeature& feature) {
    for (const int f : FacesOf(side, feature)) {
      ForEachMissing(feature.vertices, found_vertices_,
                     [&](int v) { noted_.dropped.push_back(FaceVertexFacet(side, f, v)); });
      ForEachMissing(found_vertices_, feature.vertices,
                     [&](int v) { noted_.added.push_back(FaceVertexFacet(side, f, v)); });
    }
  }

  // The convex edges of the other mesh along the edges of its map near the arc.
  void ListEdges(const Vector3d& p, const Vector3d& q, const Vector3d& pole, EdgeFeature* feature) {
    const ConvexMap& other = bodies_[1 - traced_].convex_map;
    const int last = last_regions_[traced_];
    const auto nearness = [&](int region) { return other.middle(region).dot(p); };
    const int start = nearness(feature->region) >= nearness(last) ? feature->region : last;
    MapSearch& search = searches_[traced_];
    search.FindArc(p, q, pole, start, 2.0 * motion_.margin(),
                   std::max(motion_.reach(), 2.0 * motion_.margin()));
    counts_.regions += std::ssize(search.regions());
    last_regions_[traced_] = feature->region = search.regions().front();
    std::vector<int>& candidates = feature->candidates;
    candidates.clear();
    for (const int e : search.edges()) {
      const auto along = other.edges_along(e);
      candidates.insert(candidates.end(), along.begin(), along.end());
    }
    std::sort(candidates.begin(), candidates.end());
    candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
    feature->listed_until = motion_.UntilReached();
  }

  void RefreshEdge(EdgeFeature* feature) {
    feature->pose = pose_;
    const MappedMesh &body = bodies_[traced_], &other = bodies_[1 - traced_];
    // The arc of a convex edge runs counterclockwise round the half-edge, from the left face.
    const auto normal = [](const MappedMesh& of, int h) -> const Vector3d& {
      return of.convex_map.direction(of.convex_map.face_of_mesh_face(h / 3));
    };
    const int h = body.mesh.half_edge_of(feature->edge);
    const Vector3d p = motion_.directions(traced_) * normal(body, h);
    const Vector3d q = motion_.directions(traced_) * normal(body, body.mesh.twin(h));
    const Vector3d pole = motion_.along(traced_) * body.along[feature->edge];
    if (feature->listed_until <= motion_.travel()) ListEdges(p, q, pole, feature);
    feature->until = feature->listed_until;
    found_facets_.clear();
    bool is_decided = true;
    for (const int e : feature->candidates) {
      const int g = other.mesh.half_edge_of(e);
      const internal::ArcCrossing crossing = internal::CrossingOf(
          p, q, pole, normal(other, g), normal(other, other.mesh.twin(g)), other.along[e]);
      feature->until = std::min(feature->until, motion_.Until(crossing.slack()));
      const int edge_a = traced_ == 0 ? feature->edge : e,
                edge_b = traced_ == 0 ? e : feature->edge;
      if (crossing.slack() <= 2.0 * motion_.margin()) {
        is_decided = false;
        if (const auto facet = signs().EdgeEdge(edge_a, edge_b)) found_facets_.push_back(*facet);
      } else if (crossing.to_left > 0.0 || crossing.to_right > 0.0) {
        // The facet's normal is along d_A x d_B where d_B.l_A > 0 (EdgeEdge): with p = -l_A, or
        // r = l_A, where the other's arc passes to the right.
        found_facets_.push_back({SumFacetKind::kEdgeEdge, crossing.to_right > 0.0, edge_a, edge_b});
      }
    }
    counts_.undecided += !is_decided;
    std::sort(found_facets_.begin(), found_facets_.end());
    ForEachMissing(feature->facets, found_facets_,
                   [&](const SumFacet& facet) { noted_.dropped.push_back(facet); });
    ForEachMissing(found_facets_, feature->facets,
                   [&](const SumFacet& facet) { noted_.added.push_back(facet); });
    feature->facets.swap(found_facets_);
  }

  std::array<MappedMesh, 2> bodies_;
  std::array<MapSearch, 2> searches_;  // of A's features in B's map, of B's in A's
  std::array<std::vector<DirectionFeature>, 2> directions_;
  std::array<std::vector<int>, 2> feature_of_face_;  // by face of the mesh
  std::array<int, 2> last_regions_ = {0, 0};
  int traced_ = 0;  // whose edges are features
  std::vector<EdgeFeature> edges_;
  std::vector<int> feature_of_edge_;  // by edge of that mesh; -1: not convex

  std::vector<Entry> queue_;
  std::vector<int> due_;
  int pose_ = 0;
  RotationTravel motion_;
  const MeshPair* pair_ = nullptr;
  std::optional<SupportSigns> signs_;

  std::vector<int> found_vertices_;
  std::vector<SumFacet> found_facets_;
  SumChanges noted_, changes_, net_;
  Counts counts_;
};

DynamicConvolution::DynamicConvolution(MappedMesh a, MappedMesh b)
    : state_(std::make_unique<State>(std::move(a), std::move(b))) {}
DynamicConvolution::DynamicConvolution(DynamicConvolution&&) noexcept = default;
DynamicConvolution& DynamicConvolution::operator=(DynamicConvolution&&) noexcept = default;
DynamicConvolution::~DynamicConvolution() = default;

const SumChanges& DynamicConvolution::Update(const MeshPair& pair) { return state_->Update(pair); }
std::vector<SumFacet> DynamicConvolution::Facets() const { return state_->Facets(); }
void DynamicConvolution::Place(const MeshPair& pair) { state_->Place(pair); }
std::span<const int> DynamicConvolution::VerticesOnFaceOfA(int face) {
  return state_->VerticesOnFace(0, face);
}
std::span<const int> DynamicConvolution::VerticesOnFaceOfB(int face) {
  return state_->VerticesOnFace(1, face);
}
bool DynamicConvolution::traces_a() const { return state_->traces_a(); }
std::span<const SumFacet> DynamicConvolution::FacetsOfEdge(int edge) {
  return state_->FacetsOfEdge(edge);
}
const DynamicConvolution::Counts& DynamicConvolution::counts() const { return state_->counts(); }

}  // namespace touchstone
