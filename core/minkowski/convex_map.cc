// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/convex_map.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "touchstone/core/minkowski/cone_tree.h"
#include "touchstone/core/minkowski/conform_internal.h"
#include "touchstone/core/minkowski/gauss_arrangement_internal.h"
#include "touchstone/core/minkowski/half_spaces_internal.h"
#include "touchstone/core/minkowski/tangent_planes_internal.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;
using internal::ArcPiece;
using internal::Direction;
using internal::GaussArrangement;
using internal::HalfSpace;
using internal::HalfSpaceIntersection;

// Near directions get near numbers, for the cache's sake: the bits of the three coordinates take
// turns.
std::uint32_t CurvePosition(const Vector3d& direction) {
  std::uint32_t position = 0;
  for (int bit = 9; bit >= 0; --bit) {
    for (int i = 0; i < 3; ++i) {
      const auto cell =
          static_cast<std::uint32_t>(511.5 * (1.0 + std::clamp(direction[i], -1.0, 1.0)));
      position = position << 1 | (cell >> bit & 1);
    }
  }
  return position;
}

}  // namespace

// Makes the lists of a map from a polyhedron whose corners are triangles of planes.
class ConvexMap::Assembler {
 public:
  Assembler(const TriangleMesh& mesh, const GaussMap& map, const GaussArrangement& arrangement,
            const HalfSpaceIntersection& polyhedron, const std::vector<int>& plane_of_vertex)
      : mesh_(mesh),
        map_(map),
        arrangement_(arrangement),
        polyhedron_(polyhedron),
        plane_of_vertex_(plane_of_vertex) {}

  // `chains`: for each piece of the arrangement the planes along it.
  Data Assemble(const std::vector<std::vector<int>>& chains) {
    MergeCorners();
    NumberFaces();
    std::vector<bool> is_done(polyhedron_.corner_count());
    for (const int t : CornersInOrder()) {
      if (is_done[Root(t)]) continue;
      for (int k = 0; k < 3 && !is_done[Root(t)]; ++k) {
        if (is_flat_[t][k]) continue;
        is_done[Root(t)] = true;
        AddVertex(t, k);
      }
    }
    AddPoles();
    AddFacesAt();
    AddEdgesAlong(chains);
    AddVerticesOver();
    data_.counts.arcs = arrangement_.arc_count;
    data_.counts.pieces = static_cast<int>(arrangement_.pieces.size());
    data_.counts.directions = arrangement_.vertices.size();
    data_.counts.added_directions = polyhedron_.plane_count() -
                                    HalfSpaceIntersection::kSimplexPlanes -
                                    arrangement_.vertices.size();
    return std::move(data_);
  }

 private:
  // A plane has a face where three or more edges that are not flat come from it; with fewer, it
  // touches the surface in an edge or a corner.
  void NumberFaces() {
    std::vector<int> edge_counts(polyhedron_.plane_count(), 0);
    for (int t = 0; t < polyhedron_.corner_count(); ++t) {
      for (int k = 0; k < 3 && polyhedron_.is_alive(t); ++k) {
        edge_counts[polyhedron_.corner(t)[k]] += !is_flat_[t][k];
      }
    }
    std::vector<std::pair<std::uint32_t, int>> planes;
    for (int i = 0; i < polyhedron_.plane_count(); ++i) {
      if (edge_counts[i] >= 3) planes.emplace_back(CurvePosition(polyhedron_.direction(i).unit), i);
    }
    face_of_plane_.assign(polyhedron_.plane_count(), -1);
    for (const int i : Second(&planes)) {
      face_of_plane_[i] = static_cast<int>(data_.planes.size());
      data_.directions.push_back(polyhedron_.direction(i).unit);
      data_.planes.push_back({polyhedron_.plane(i).normal, polyhedron_.plane(i).offset});
    }
  }

  std::vector<int> CornersInOrder() const {
    std::vector<std::pair<std::uint32_t, int>> corners;
    for (int t = 0; t < polyhedron_.corner_count(); ++t) {
      if (!polyhedron_.is_alive(t)) continue;
      Vector3d sum = Vector3d::Zero();
      for (const int plane : polyhedron_.corner(t)) sum += polyhedron_.direction(plane).unit;
      corners.emplace_back(CurvePosition(sum.normalized()), t);
    }
    return Second(&corners);
  }

  static std::vector<int> Second(std::vector<std::pair<std::uint32_t, int>>* pairs) {
    std::sort(pairs->begin(), pairs->end());
    std::vector<int> second;
    for (const auto& [position, item] : *pairs) second.push_back(item);
    return second;
  }

  int Root(int t) {
    while (parent_[t] != t) t = parent_[t] = parent_[parent_[t]];
    return t;
  }

  // Corners with a flat edge between them are one vertex.
  void MergeCorners() {
    parent_.resize(polyhedron_.corner_count());
    std::iota(parent_.begin(), parent_.end(), 0);
    is_flat_.resize(polyhedron_.corner_count());
    for (int t = 0; t < polyhedron_.corner_count(); ++t) {
      if (!polyhedron_.is_alive(t)) continue;
      for (int k = 0; k < 3; ++k) {
        is_flat_[t][k] = polyhedron_.IsFlat(t, k);
        if (is_flat_[t][k]) parent_[Root(t)] = Root(polyhedron_.neighbor(t, k));
      }
    }
  }

  // From an edge of corner t that is not flat, round the region.
  void AddVertex(int t, int k) {
    const int vertex = static_cast<int>(data_.middles.size());
    data_.vertex_begin.push_back(static_cast<int>(data_.vertex_faces.size()));
    std::vector<int> loop;
    const int first = t, first_k = k;
    do {
      const int head_plane = polyhedron_.corner(t)[(k + 1) % 3];
      const int face = face_of_plane_[polyhedron_.corner(t)[k]];
      if (face >= 0) loop.push_back(face);
      k = (k + 1) % 3;
      while (is_flat_[t][k]) {
        t = polyhedron_.neighbor(t, k);
        k = polyhedron_.IndexOf(t, head_plane);
      }
    } while (t != first || k != first_k);
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < loop.size(); ++i) {
      data_.vertex_faces.push_back(loop[i]);
      data_.vertex_edges.push_back(EdgeBetween(loop[i], loop[(i + 1) % loop.size()], vertex));
      sum += data_.directions[loop[i]];
    }
    data_.middles.push_back(sum.normalized());
  }

  // The edge with `vertex` on the left on the way from tail to head.
  int EdgeBetween(int tail, int head, int vertex) {
    const auto key = std::minmax(tail, head);
    const auto [place, added] = edge_numbers_.try_emplace(
        static_cast<std::uint64_t>(key.first) << 32 | static_cast<std::uint32_t>(key.second),
        static_cast<int>(data_.edges.size()));
    if (added) {
      data_.edges.push_back({tail, head, vertex, -1});
    } else {
      data_.edges[place->second].right = vertex;
    }
    return place->second;
  }

  void AddPoles() {
    data_.vertex_begin.push_back(static_cast<int>(data_.vertex_faces.size()));
    for (const MapEdge& edge : data_.edges) {
      data_.poles.push_back(
          UnitOf(Cross(data_.planes[edge.tail].normal, data_.planes[edge.head].normal)));
    }
  }

  static void Flatten(std::vector<std::vector<int>>* lists, std::vector<int>* begin,
                      std::vector<int>* items) {
    for (std::vector<int>& list : *lists) {
      begin->push_back(static_cast<int>(items->size()));
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
      items->insert(items->end(), list.begin(), list.end());
    }
    begin->push_back(static_cast<int>(items->size()));
  }

  void AddFacesAt() {
    std::vector<std::vector<int>> faces(data_.planes.size());
    for (int f = 0; f < mesh_.face_count(); ++f) {
      const int face = face_of_plane_[plane_of_vertex_[arrangement_.vertex_of_face[f]]];
      data_.face_of_mesh_face.push_back(face);
      if (face >= 0) faces[face].push_back(f);
    }
    Flatten(&faces, &data_.faces_at_begin, &data_.faces_at);
  }

  void AddEdgesAlong(const std::vector<std::vector<int>>& chains) {
    std::vector<std::vector<int>> edges(data_.edges.size());
    for (std::size_t i = 0; i < chains.size(); ++i) {
      bool is_missing = false;
      for (std::size_t k = 0; k + 1 < chains[i].size(); ++k) {
        const auto key =
            std::minmax(face_of_plane_[chains[i][k]], face_of_plane_[chains[i][k + 1]]);
        const auto place = edge_numbers_.find(static_cast<std::uint64_t>(key.first) << 32 |
                                              static_cast<std::uint32_t>(key.second));
        if (place == edge_numbers_.end()) {
          is_missing = true;
          continue;
        }
        std::vector<int>& along = edges[place->second];
        const std::vector<int>& piece = arrangement_.pieces[i].edges;
        along.insert(along.end(), piece.begin(), piece.end());
      }
      data_.counts.missing_pieces += is_missing;
    }
    Flatten(&edges, &data_.edges_along_begin, &data_.edges_along);
  }

  // A region lies in a cone or outside it, so one direction within the region tells.
  void AddVerticesOver() {
    std::vector<NormalCone> cones;
    std::vector<int> corners;
    for (int v = 0; v < mesh_.vertex_count(); ++v) {
      cones.push_back(map_.vertex_cone(v));
      if (map_.vertex_kind(v) == VertexKind::kCorner) corners.push_back(v);
    }
    const ConeTree tree(cones, std::move(corners));
    std::vector<Direction> edges;
    for (int e = 0; e < mesh_.edge_count(); ++e) {
      edges.push_back(internal::DirectionOfEdge(mesh_, e));
    }
    std::vector<std::vector<int>> over(data_.middles.size());
    std::vector<int> candidates;
    for (std::size_t i = 0; i < over.size(); ++i) {
      const Direction inside = Inside(static_cast<int>(i));
      candidates.clear();
      tree.Along(inside.unit, &candidates);
      for (const int v : candidates) {
        if (IsInCone(v, inside, edges)) over[i].push_back(v);
      }
    }
    Flatten(&over, &data_.vertices_over_begin, &data_.vertices_over);
  }

  // A direction strictly within the region: the sum of its corners, each about as long.
  Direction Inside(int vertex) const {
    IntegerVector sum = {Integer(0), Integer(0), Integer(0)};
    int digits = 0;
    const auto faces = Range(data_.vertex_begin, data_.vertex_faces, vertex);
    for (const int face : faces) digits = std::max(digits, DigitsOf(data_.planes[face].normal));
    for (const int face : faces) {
      const IntegerVector& normal = data_.planes[face].normal;
      sum = sum + Shifted(normal, digits - DigitsOf(normal));
    }
    return {sum, UnitOf(sum)};
  }

  bool IsInCone(int v, const Direction& x, const std::vector<Direction>& edges) const {
    for (const int w : map_.essential_neighbors(v)) {
      for (const int h : mesh_.vertex_half_edges(v)) {
        if (mesh_.head(h) != w) continue;
        const int e = mesh_.edge_of(h);
        const int side = SideOf(edges[e], x);
        if ((mesh_.half_edge_of(e) == h ? side : -side) > 0) return false;
      }
    }
    return true;
  }

  const TriangleMesh& mesh_;
  const GaussMap& map_;
  const GaussArrangement& arrangement_;
  const HalfSpaceIntersection& polyhedron_;
  const std::vector<int>& plane_of_vertex_;
  std::vector<int> face_of_plane_, parent_;
  std::vector<std::array<bool, 3>> is_flat_;
  std::unordered_map<std::uint64_t, int> edge_numbers_;
  Data data_;
};

ConvexMap ConvexMap::AsPublished(const TriangleMesh& mesh, const GaussMap& map, MapArcs arcs) {
  const GaussArrangement arrangement = internal::ArrangeGaussMap(mesh, map, arcs == MapArcs::kAll);
  std::vector<Direction> directions;
  std::vector<HalfSpace> planes;
  for (int i = 0; i < arrangement.vertices.size(); ++i) {
    planes.push_back(internal::RoundedTangentPlane(arrangement.vertices[i]));
    directions.push_back(internal::MakeDirection(planes.back().normal));
  }
  std::vector<int> plane_of_vertex;
  const HalfSpaceIntersection polyhedron =
      internal::IntersectionOf(directions, planes, false, &plane_of_vertex);
  std::vector<std::vector<int>> chains;
  for (const ArcPiece& piece : arrangement.pieces) {
    chains.push_back({plane_of_vertex[piece.tail], plane_of_vertex[piece.head]});
  }
  ConvexMap result;
  result.data_ = std::make_shared<const Data>(
      Assembler(mesh, map, arrangement, polyhedron, plane_of_vertex).Assemble(chains));
  return result;
}

ConvexMap ConvexMap::Conforming(const TriangleMesh& mesh, const GaussMap& map, MapArcs arcs) {
  const GaussArrangement arrangement = internal::ArrangeGaussMap(mesh, map, arcs == MapArcs::kAll);
  std::vector<Direction> directions;
  std::vector<HalfSpace> planes;
  if (internal::IsConvexBody(mesh)) planes = internal::OwnPlanes(mesh, arrangement);
  const bool is_own = !planes.empty() && std::all_of(planes.begin(), planes.end(), [](auto& plane) {
    return plane.offset.sign() > 0;
  });
  if (!is_own) planes.clear();
  for (int i = 0; i < arrangement.vertices.size(); ++i) {
    directions.push_back(arrangement.vertices[i]);
    if (!is_own) planes.push_back(internal::NearlyTangentPlane(directions.back(), i));
  }
  std::vector<int> plane_of_vertex;
  HalfSpaceIntersection polyhedron =
      internal::IntersectionOf(directions, planes, true, &plane_of_vertex);
  const std::vector<std::vector<int>> chains =
      internal::MakeConforming(arrangement.pieces, arrangement.poles, plane_of_vertex, &polyhedron);
  ConvexMap result;
  result.data_ = std::make_shared<const Data>(
      Assembler(mesh, map, arrangement, polyhedron, plane_of_vertex).Assemble(chains));
  return result;
}

int ConvexMap::Walk(const Vector3d& direction, int start, double margin) const {
  int vertex = start;
  while (true) {
    double least = -margin;
    int next = vertex;
    for (const int e : vertex_edges(vertex)) {
      const MapEdge& edge = data_->edges[e];
      const bool is_left = edge.left == vertex;
      const double side =
          is_left ? data_->poles[e].dot(direction) : -data_->poles[e].dot(direction);
      if (side < least) {
        least = side;
        next = is_left ? edge.right : edge.left;
      }
    }
    if (next == vertex) return vertex;
    vertex = next;
  }
}

}  // namespace touchstone
