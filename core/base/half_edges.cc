// SPDX-License-Identifier: MIT
#include "touchstone/core/base/half_edges.h"

#include <algorithm>
#include <string>
#include <utility>

namespace touchstone {
namespace {

// What is wrong with an edge of `count` half-edges, of which two are given.
Status DefectOf(const HalfEdge& first, const HalfEdge& last, int count) {
  const auto status = [&](StatusCode code, std::string message) {
    return Status{code, ElementKind::kEdge, first.tail, first.head, std::move(message)};
  };
  const std::string name = "edge " + std::to_string(first.tail) + "-" + std::to_string(first.head);
  if (count == 1) {
    return status(StatusCode::kOpen, name + " has face " + std::to_string(first.face) + " only");
  }
  if (count > 2) {
    return status(StatusCode::kNonManifold, name + " has " + std::to_string(count) + " faces");
  }
  return status(StatusCode::kInconsistentOrientation, "faces " + std::to_string(first.face) +
                                                          " and " + std::to_string(last.face) +
                                                          " run " + name + " in the same sense");
}

}  // namespace

Status PairHalfEdges(std::span<const HalfEdge> half_edges, int vertex_count,
                     std::vector<int>* twins) {
  // In order of their smaller vertex, by counting, then of their larger one.
  std::vector<int> begin(static_cast<std::size_t>(vertex_count) + 1, 0);
  for (const HalfEdge& h : half_edges) ++begin[std::min(h.tail, h.head) + 1];
  for (int v = 0; v < vertex_count; ++v) begin[v + 1] += begin[v];
  std::vector<std::pair<int, int>> sorted(half_edges.size());  // larger vertex, half-edge
  std::vector<int> place(begin.begin(), begin.end() - 1);
  for (int h = 0; h < static_cast<int>(half_edges.size()); ++h) {
    const auto [small, large] = std::minmax({half_edges[h].tail, half_edges[h].head});
    sorted[place[small]++] = {large, h};
  }
  twins->assign(half_edges.size(), -1);
  for (int v = 0; v < vertex_count; ++v) {
    std::sort(sorted.begin() + begin[v], sorted.begin() + begin[v + 1]);
    for (int i = begin[v], end = i; i < begin[v + 1]; i = end) {
      while (end < begin[v + 1] && sorted[end].first == sorted[i].first) ++end;
      const int h = sorted[i].second, k = sorted[end - 1].second;
      if (end - i != 2 || half_edges[h].tail == half_edges[k].tail) {
        return DefectOf(half_edges[h], half_edges[k], end - i);
      }
      (*twins)[h] = k;
      (*twins)[k] = h;
    }
  }
  return {};
}

}  // namespace touchstone
