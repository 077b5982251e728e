// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface is closed, and its components are what they are said to be.
#include <algorithm>
#include <numeric>
#include <set>

#include "touchstone/exact/judge/sum_checks.h"

namespace touchstone::exact {
namespace {

class SurfaceCheck {
 public:
  explicit SurfaceCheck(const SumContext& context)
      : context_(context), boundary_(context.boundary), parent_(boundary_.triangles.size()) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  void Run() {
    RunEdges();
    CheckComponents();
    if (boundary_.border_edges != 0) {
      context_.Add(SumFindingKind::kNotClosed, "says itself that it has border edges");
    }
    if (boundary_.detached_patches != 0) {
      context_.Add(SumFindingKind::kWrongSide, "says itself that it has detached patches");
    }
  }

 private:
  struct Edge {
    int balance = 0;  // runs up less runs down
    int triangle = -1;
  };

  int Find(int t) {
    while (parent_[t] != t) t = parent_[t] = parent_[parent_[t]];
    return t;
  }

  void RunEdges() {
    for (int t = 0; t < std::ssize(boundary_.triangles); ++t) {
      for (int k = 0; k < 3; ++k) {
        const int u = boundary_.triangles[t][k], v = boundary_.triangles[t][(k + 1) % 3];
        Edge& edge = edges_[std::minmax(u, v)];
        edge.balance += u < v ? 1 : -1;
        if (edge.triangle >= 0) parent_[Find(t)] = Find(edge.triangle);
        edge.triangle = t;
      }
    }
    for (const auto& [ends, edge] : edges_) {
      if (edge.balance == 0) continue;
      context_.Add(SumFindingKind::kNotClosed, "edge " + std::to_string(ends.first) + '-' +
                                                   std::to_string(ends.second) +
                                                   " is not run both ways equally often");
    }
  }

  void CheckComponents() {
    std::map<int, int> component_of_root;
    std::vector<SumComponent> counted(boundary_.components.size());
    std::vector<std::set<int>> vertices(boundary_.components.size());
    std::set<int> roots;
    for (int t = 0; t < std::ssize(boundary_.triangles); ++t) {
      const int component = boundary_.component_of_triangle[t];
      roots.insert(Find(t));
      if (component_of_root.try_emplace(Find(t), component).first->second != component) {
        context_.Add(SumFindingKind::kWrongCounts,
                     "triangle " + std::to_string(t) + " hangs together with another component");
      }
      ++counted[component].triangle_count;
      vertices[component].insert(boundary_.triangles[t].begin(), boundary_.triangles[t].end());
    }
    if (roots.size() != boundary_.components.size()) {
      context_.Add(SumFindingKind::kWrongCounts, "has " + std::to_string(roots.size()) +
                                                     " components, says " +
                                                     std::to_string(boundary_.components.size()));
    }
    for (const auto& [ends, edge] : edges_) {
      ++counted[boundary_.component_of_triangle[edge.triangle]].edge_count;
    }
    for (std::size_t c = 0; c < counted.size(); ++c) {
      const SumComponent& said = boundary_.components[c];
      if (said.vertex_count != std::ssize(vertices[c]) ||
          said.edge_count != counted[c].edge_count ||
          said.triangle_count != counted[c].triangle_count) {
        context_.Add(SumFindingKind::kWrongCounts,
                     "component " + std::to_string(c) + " has other counts than it says");
      }
    }
  }

  const SumContext& context_;
  const SumBoundary& boundary_;
  std::map<std::pair<int, int>, Edge> edges_;
  std::vector<int> parent_;
};

}  // namespace

void CheckSurface(const SumContext& context) { SurfaceCheck(context).Run(); }

}  // namespace touchstone::exact
