// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/half_edges_internal.h"

#include <string>
#include <vector>

#include "touchstone/core/base/half_edges.h"

namespace touchstone::internal {
namespace {

class HalfEdgeBuilder {
 public:
  explicit HalfEdgeBuilder(TriangleMeshData* data) : data_(*data) {}

  Status Build() {
    std::vector<HalfEdge> half_edges(data_.half_edge_count());
    for (int h = 0; h < data_.half_edge_count(); ++h) {
      half_edges[h] = {data_.tail(h), data_.head(h), h / 3};
    }
    const Status paired = PairHalfEdges(half_edges, data_.vertex_count(), &data_.twins);
    if (!paired.ok()) return paired;
    NumberEdges();
    if (Status status = WalkRoundVertices(); !status.ok()) return status;
    FindComponents();
    return {};
  }

 private:
  void NumberEdges() {
    data_.edge_of_half_edge.resize(data_.half_edge_count());
    data_.half_edge_of_edge.reserve(data_.half_edge_count() / 2);
    for (int h = 0; h < data_.half_edge_count(); ++h) {
      if (h < data_.twins[h]) {
        data_.edge_of_half_edge[h] = data_.edge_count();
        data_.half_edge_of_edge.push_back(h);
      } else {
        data_.edge_of_half_edge[h] = data_.edge_of_half_edge[data_.twins[h]];
      }
    }
  }

  Status WalkRoundVertices() {
    const int n = data_.vertex_count();
    std::vector<int> first_out(n, -1);
    data_.vertex_begin.assign(n + 1, 0);
    for (int h = data_.half_edge_count() - 1; h >= 0; --h) {
      first_out[data_.tail(h)] = h;
      ++data_.vertex_begin[data_.tail(h) + 1];
    }
    for (int v = 0; v < n; ++v) data_.vertex_begin[v + 1] += data_.vertex_begin[v];
    data_.vertex_half_edges.resize(data_.half_edge_count());
    for (int v = 0; v < n; ++v) {
      int place = data_.vertex_begin[v];
      int h = first_out[v];
      do {
        data_.vertex_half_edges[place++] = h;
        // Counterclockwise past the face on the left: the half-edge that leaves v along its other
        // side.
        h = data_.twins[h % 3 == 0 ? h + 2 : h - 1];
      } while (h != first_out[v]);
      if (place != data_.vertex_begin[v + 1]) {
        return {StatusCode::kNonManifold, ElementKind::kVertex, v, -1,
                "the faces at vertex " + std::to_string(v) + " make more than one cycle"};
      }
    }
    return {};
  }

  void FindComponents() {
    data_.component_of_face.assign(data_.face_count(), -1);
    std::vector<int> stack;
    for (int first = 0; first < data_.face_count(); ++first) {
      if (data_.component_of_face[first] >= 0) continue;
      const int component = static_cast<int>(data_.components.size());
      MeshComponent& piece = data_.components.emplace_back(MeshComponent{first, 0, 0, 0, 0});
      stack = {first};
      data_.component_of_face[first] = component;
      while (!stack.empty()) {
        const int f = stack.back();
        stack.pop_back();
        ++piece.face_count;
        for (int h = 3 * f; h < 3 * f + 3; ++h) {
          const int g = data_.twins[h] / 3;
          if (data_.component_of_face[g] >= 0) continue;
          data_.component_of_face[g] = component;
          stack.push_back(g);
        }
      }
      piece.edge_count = piece.face_count / 2 * 3;
    }
    for (int v = 0; v < data_.vertex_count(); ++v) {
      const int face = data_.vertex_half_edges[data_.vertex_begin[v]] / 3;
      ++data_.components[data_.component_of_face[face]].vertex_count;
    }
  }

  TriangleMeshData& data_;
};

}  // namespace

Status BuildHalfEdges(TriangleMeshData* data) { return HalfEdgeBuilder(data).Build(); }

}  // namespace touchstone::internal
