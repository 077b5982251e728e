// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/half_edges_internal.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace touchstone::internal {
namespace {

class HalfEdgeBuilder {
 public:
  explicit HalfEdgeBuilder(TriangleMeshData* data) : data_(*data) {}

  Status Build() {
    if (Status status = PairHalfEdges(); !status.ok()) return status;
    NumberEdges();
    if (Status status = WalkRoundVertices(); !status.ok()) return status;
    FindComponents();
    return {};
  }

 private:
  Status PairHalfEdges() {
    // Half-edges in order of their smaller vertex, by counting, then of their larger one.
    const int half_edge_count = data_.half_edge_count();
    std::vector<int> begin(data_.vertex_count() + 1, 0);
    for (int h = 0; h < half_edge_count; ++h) ++begin[std::min(data_.tail(h), data_.head(h)) + 1];
    for (int v = 0; v < data_.vertex_count(); ++v) begin[v + 1] += begin[v];
    std::vector<std::pair<int, int>> sorted(half_edge_count);  // larger vertex, half-edge
    std::vector<int> place(begin.begin(), begin.end() - 1);
    for (int h = 0; h < half_edge_count; ++h) {
      const auto [small, large] = std::minmax({data_.tail(h), data_.head(h)});
      sorted[place[small]++] = {large, h};
    }
    data_.twins.assign(half_edge_count, -1);
    for (int v = 0; v < data_.vertex_count(); ++v) {
      std::sort(sorted.begin() + begin[v], sorted.begin() + begin[v + 1]);
      for (int i = begin[v]; i < begin[v + 1];) {
        int end = i + 1;
        while (end < begin[v + 1] && sorted[end].first == sorted[i].first) ++end;
        if (Status status = Pair(sorted[i].second, sorted[end - 1].second, end - i); !status.ok()) {
          return status;
        }
        i = end;
      }
    }
    return {};
  }

  // Joins the first and last of `count` half-edges on one pair of vertices.
  Status Pair(int h, int k, int count) {
    const int tail = data_.tail(h), head = data_.head(h);
    if (count == 2 && tail != data_.tail(k)) {
      data_.twins[h] = k;
      data_.twins[k] = h;
      return {};
    }
    const std::string name = "edge " + std::to_string(tail) + "-" + std::to_string(head);
    if (count == 1) {
      return {StatusCode::kOpen, ElementKind::kEdge, tail, head,
              name + " has face " + std::to_string(h / 3) + " only"};
    }
    if (count > 2) {
      return {StatusCode::kNonManifold, ElementKind::kEdge, tail, head,
              name + " has " + std::to_string(count) + " faces"};
    }
    return {StatusCode::kInconsistentOrientation, ElementKind::kEdge, tail, head,
            "faces " + std::to_string(h / 3) + " and " + std::to_string(k / 3) + " run " + name +
                " in the same sense"};
  }

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
