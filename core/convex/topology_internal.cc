// SPDX-License-Identifier: MIT
#include "touchstone/core/convex/topology_internal.h"

#include <algorithm>
#include <string>
#include <vector>

#include "touchstone/core/base/half_edges.h"

namespace touchstone::internal {
namespace {

// A half-edge is a place h in face_vertices: it runs from the vertex there to the loop's next one,
// with its face on its left.
class TopologyBuilder {
 public:
  explicit TopologyBuilder(ConvexPolyhedronData* data)
      : data_(*data), half_edge_count_(static_cast<int>(data->face_vertices.size())) {}

  Status Build() {
    ListFaces();
    std::vector<HalfEdge> half_edges(half_edge_count_);
    for (int h = 0; h < half_edge_count_; ++h) half_edges[h] = {Tail(h), Head(h), face_of_[h]};
    const Status paired = PairHalfEdges(half_edges, data_.vertex_count(), &twin_);
    if (!paired.ok()) return paired;
    NumberEdges();
    if (Status status = WalkRoundVertices(); !status.ok()) return status;
    return CheckOneSphere();
  }

 private:
  int Tail(int h) const { return data_.face_vertices[h]; }
  int Head(int h) const { return data_.face_vertices[Next(h)]; }
  int Next(int h) const {
    const int f = face_of_[h];
    return h + 1 < data_.face_begin[f + 1] ? h + 1 : data_.face_begin[f];
  }
  int Previous(int h) const {
    const int f = face_of_[h];
    return h > data_.face_begin[f] ? h - 1 : data_.face_begin[f + 1] - 1;
  }

  void ListFaces() {
    face_of_.resize(half_edge_count_);
    for (int f = 0; f < data_.face_count(); ++f) {
      std::fill(face_of_.begin() + data_.face_begin[f], face_of_.begin() + data_.face_begin[f + 1],
                f);
    }
  }

  void NumberEdges() {
    data_.face_edges.resize(half_edge_count_);
    data_.edges.reserve(half_edge_count_ / 2);
    for (int h = 0; h < half_edge_count_; ++h) {
      if (h < twin_[h]) {
        data_.face_edges[h] = data_.edge_count();
        data_.edges.push_back({Tail(h), Head(h), face_of_[h], face_of_[twin_[h]]});
      } else {
        data_.face_edges[h] = data_.face_edges[twin_[h]];
      }
    }
  }

  Status WalkRoundVertices() {
    const int n = data_.vertex_count();
    std::vector<int> first_out(n, -1);
    data_.vertex_begin.assign(n + 1, 0);
    for (int h = half_edge_count_ - 1; h >= 0; --h) {
      first_out[Tail(h)] = h;
      ++data_.vertex_begin[Tail(h) + 1];
    }
    for (int v = 0; v < n; ++v) data_.vertex_begin[v + 1] += data_.vertex_begin[v];
    data_.vertex_neighbors.resize(half_edge_count_);
    data_.vertex_edges.resize(half_edge_count_);
    data_.vertex_faces.resize(half_edge_count_);
    for (int v = 0; v < n; ++v) {
      int place = data_.vertex_begin[v];
      int h = first_out[v];
      do {
        data_.vertex_neighbors[place] = Head(h);
        data_.vertex_edges[place] = data_.face_edges[h];
        data_.vertex_faces[place] = face_of_[h];
        ++place;
        // Counterclockwise past the face on the left: the half-edge that leaves v along its other
        // side.
        h = twin_[Previous(h)];
      } while (h != first_out[v]);
      if (place != data_.vertex_begin[v + 1]) {
        return {StatusCode::kNonManifold, ElementKind::kVertex, v, -1,
                "the faces at vertex " + std::to_string(v) + " make more than one cycle"};
      }
    }
    return {};
  }

  Status CheckOneSphere() const {
    const int n = data_.vertex_count();
    std::vector<char> seen(n, 0);
    std::vector<int> stack = {0};
    seen[0] = 1;
    while (!stack.empty()) {
      const int v = stack.back();
      stack.pop_back();
      for (int i = data_.vertex_begin[v]; i < data_.vertex_begin[v + 1]; ++i) {
        const int w = data_.vertex_neighbors[i];
        if (!seen[w]) {
          seen[w] = 1;
          stack.push_back(w);
        }
      }
    }
    for (int v = 0; v < n; ++v) {
      if (!seen[v]) {
        return {StatusCode::kNonManifold, ElementKind::kVertex, v, -1,
                "vertex " + std::to_string(v) + " is in a second component"};
      }
    }
    const int euler = n - data_.edge_count() + data_.face_count();
    if (euler != 2) {
      return {StatusCode::kNonManifold, ElementKind::kNone, -1, -1,
              "not a sphere: V - E + F = " + std::to_string(euler)};
    }
    return {};
  }

  ConvexPolyhedronData& data_;
  const int half_edge_count_;
  std::vector<int> face_of_, twin_;
};

}  // namespace

Status BuildTopology(ConvexPolyhedronData* data) { return TopologyBuilder(data).Build(); }

}  // namespace touchstone::internal
