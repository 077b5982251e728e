// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/surface_graph.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace touchstone::exact {
namespace {

class Maker {
 public:
  Maker(std::span<const RationalPoint> points, std::span<const std::array<int, 3>> triangles)
      : points_(points), triangles_(triangles) {
    for (int t = 0; t < std::ssize(triangles_); ++t) {
      planes_.push_back(PlaneOf(triangles_[t]));
      for (int k = 0; k < 3; ++k) {
        edges_[std::minmax(int{triangles_[t][k]}, int{triangles_[t][(k + 1) % 3]})].push_back(t);
      }
    }
  }

  SurfaceGraph Run() {
    facet_.resize(triangles_.size());
    piece_.resize(triangles_.size());
    std::iota(facet_.begin(), facet_.end(), 0);
    std::iota(piece_.begin(), piece_.end(), 0);
    for (const auto& [ends, around] : edges_) {
      for (const int t : around) piece_[Find(&piece_, t)] = Find(&piece_, around[0]);
      if (around.size() == 2 && planes_[around[0]] == planes_[around[1]]) {
        facet_[Find(&facet_, around[0])] = Find(&facet_, around[1]);
      }
    }
    AddFacets();
    AddCharacteristics();
    return std::move(graph_);
  }

 private:
  static int Find(std::vector<int>* parent, int t) {
    while ((*parent)[t] != t) t = (*parent)[t] = (*parent)[(*parent)[t]];
    return t;
  }

  SurfaceGraph::Plane PlaneOf(const std::array<int, 3>& t) const {
    const RationalPoint& o = points_[t[0]];
    const RationalPoint normal = Cross(points_[t[1]] - o, points_[t[2]] - o);
    const auto first =
        std::find_if(normal.begin(), normal.end(), [](const mpq_class& x) { return sgn(x) != 0; });
    const mpq_class size = abs(*first);
    return {normal[0] / size, normal[1] / size, normal[2] / size, Dot(normal, o) / size};
  }

  // Whether the edge is one of the surface, not only of its triangles.
  bool IsBorder(const std::vector<int>& around) {
    return around.size() != 2 || Find(&facet_, around[0]) != Find(&facet_, around[1]);
  }

  bool IsStraight(int u, int v, int w) const {
    const RationalPoint cross = Cross(points_[u] - points_[v], points_[w] - points_[v]);
    return std::all_of(cross.begin(), cross.end(), [](const mpq_class& x) { return sgn(x) == 0; });
  }

  void AddFacets() {
    std::map<int, std::vector<int>> ways;     // from a vertex along borders
    std::map<int, std::set<int>> vertices;    // of a facet's border
    std::set<std::pair<int, int>> neighbors;  // by roots
    for (const auto& [ends, around] : edges_) {
      if (!IsBorder(around)) continue;
      ways[ends.first].push_back(ends.second);
      ways[ends.second].push_back(ends.first);
      for (const int t : around) {
        vertices[Find(&facet_, t)].insert({ends.first, ends.second});
        for (const int u : around) {
          if (Find(&facet_, t) < Find(&facet_, u)) {
            neighbors.emplace(Find(&facet_, t), Find(&facet_, u));
          }
        }
      }
    }
    std::vector<std::pair<SurfaceGraph::Facet, int>> facets;
    for (const auto& [root, border] : vertices) {
      SurfaceGraph::Facet facet{planes_[root], {}};
      for (const int v : border) {
        const std::vector<int>& from = ways[v];
        if (from.size() != 2 || !IsStraight(from[0], v, from[1])) {
          facet.corners.push_back(points_[v]);
        }
      }
      std::sort(facet.corners.begin(), facet.corners.end());
      facets.emplace_back(std::move(facet), root);
    }
    std::sort(facets.begin(), facets.end());
    std::map<int, int> number;
    for (auto& [facet, root] : facets) {
      number[root] = static_cast<int>(graph_.facets.size());
      graph_.facets.push_back(std::move(facet));
    }
    for (const auto& [f, g] : neighbors) {
      graph_.neighbors.push_back(std::minmax(int{number[f]}, int{number[g]}));
    }
    std::sort(graph_.neighbors.begin(), graph_.neighbors.end());
  }

  void AddCharacteristics() {
    std::map<int, int> count;
    std::set<std::pair<int, int>> vertices;  // piece, vertex
    for (int t = 0; t < std::ssize(triangles_); ++t) {
      const int piece = Find(&piece_, t);
      ++count[piece];
      for (const int v : triangles_[t]) vertices.emplace(piece, v);
    }
    for (const auto& [piece, v] : vertices) ++count[piece];
    for (const auto& [ends, around] : edges_) --count[Find(&piece_, around[0])];
    for (const auto& [piece, characteristic] : count) {
      graph_.euler_characteristics.push_back(characteristic);
    }
    std::sort(graph_.euler_characteristics.begin(), graph_.euler_characteristics.end());
  }

  const std::span<const RationalPoint> points_;
  const std::span<const std::array<int, 3>> triangles_;
  std::vector<SurfaceGraph::Plane> planes_;
  std::map<std::pair<int, int>, std::vector<int>> edges_;  // the triangles round each
  std::vector<int> facet_, piece_;                         // by union and find
  SurfaceGraph graph_;
};

}  // namespace

SurfaceGraph MakeSurfaceGraph(std::span<const RationalPoint> points,
                              std::span<const std::array<int, 3>> triangles) {
  return Maker(points, triangles).Run();
}

}  // namespace touchstone::exact
