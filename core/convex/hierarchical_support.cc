// SPDX-License-Identifier: MIT
#include "touchstone/core/convex/hierarchical_support.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <utility>

#include "touchstone/core/convex/support.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;
using Ring = std::vector<std::int32_t>;

constexpr int kCoarsest = 12;  // vertices: looked at one by one
constexpr int kMaxDegree = 9;  // a planar graph has enough independent vertices up to here

// A triangulated hull as rings: the neighbours of each vertex, counterclockwise from outside.
class Rings {
 public:
  explicit Rings(const ConvexPolyhedron& body) : body_(body), rings_(body.vertex_count()) {
    for (int v = 0; v < body.vertex_count(); ++v) {
      const auto neighbors = body.vertex_neighbors(v);
      rings_[v].assign(neighbors.begin(), neighbors.end());
    }
    for (int f = 0; f < body.face_count(); ++f) Fan(body.face(f));
  }

  const Ring& of(int v) const { return rings_[v]; }

  // Takes v out and closes the hole with the lower hull of its neighbours.
  void Remove(int v) {
    Ring hole = std::exchange(rings_[v], {});
    for (const int w : hole) std::erase(rings_[w], v);
    while (hole.size() > 3) {
      const std::size_t ear = FlattestEar(hole);
      const std::size_t before = (ear + hole.size() - 1) % hole.size(),
                        after = (ear + 1) % hole.size();
      Join(hole[before], hole[ear], hole[after]);
      hole.erase(hole.begin() + static_cast<std::ptrdiff_t>(ear));
    }
  }

 private:
  // Diagonals from a polygon's first vertex.
  void Fan(std::span<const int> loop) {
    for (std::size_t k = 2; k + 1 < loop.size(); ++k) Join(loop[0], loop[k - 1], loop[k]);
  }

  // Adds the edge a - c across the corner a, b, c of a face, next to the edges to b.
  void Join(int a, int b, int c) {
    const auto insert = [this](int at, int beside, bool after, int value) {
      Ring& ring = rings_[at];
      auto place = std::find(ring.begin(), ring.end(), beside);
      if (place != ring.end() && after) ++place;
      ring.insert(place, value);
    };
    insert(a, b, true, c);
    insert(c, b, false, a);
  }

  // The ear (its middle) whose plane has the least of the other vertices above it: none, but for
  // rounding, since the hole's lower hull has ears.
  std::size_t FlattestEar(const Ring& hole) const {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    const std::size_t count = hole.size();
    for (std::size_t i = 0; i < count; ++i) {
      const Vector3d& a = body_.vertex(hole[(i + count - 1) % count]);
      const Vector3d normal =
          (body_.vertex(hole[i]) - a).cross(body_.vertex(hole[(i + 1) % count]) - a);
      double above = -std::numeric_limits<double>::infinity();
      for (std::size_t k = 2; k + 1 < count; ++k) {
        above = std::max(above, normal.dot(body_.vertex(hole[(i + k) % count]) - a));
      }
      const double length = normal.norm();
      const double height = length > 0.0 ? above / length : 0.0;
      if (height < least) {
        least = height;
        best = i;
      }
    }
    return best;
  }

  const ConvexPolyhedron& body_;
  std::vector<Ring> rings_;
};

// Vertices of low degree, no two of them neighbours.
Ring IndependentSet(const Rings& rings, const Ring& alive) {
  Ring chosen;
  std::vector<bool> taken;
  std::int32_t largest = 0;
  for (const int v : alive) largest = std::max(largest, v);
  taken.assign(largest + 1, false);
  for (const int v : alive) {
    if (taken[v] || static_cast<int>(rings.of(v).size()) > kMaxDegree) continue;
    chosen.push_back(v);
    for (const int w : rings.of(v)) taken[w] = true;
  }
  return chosen;
}

}  // namespace

HierarchicalSupport::HierarchicalSupport(const ConvexPolyhedron& body) : body_(body) {
  Rings rings(body);
  Ring alive(body.vertex_count());
  for (int v = 0; v < body.vertex_count(); ++v) alive[v] = v;

  // Finest first: the graph as it is, then as it is without the set removed from it.
  std::vector<std::vector<Ring>> graphs;  // by position in `alives`
  std::vector<Ring> alives;
  for (;;) {
    std::vector<Ring> graph;
    graph.reserve(alive.size());
    for (const int v : alive) graph.push_back(rings.of(v));
    graphs.push_back(std::move(graph));
    alives.push_back(alive);
    if (static_cast<int>(alive.size()) <= kCoarsest) break;
    Ring removed = IndependentSet(rings, alive);
    // Leave a body: four vertices at least.
    removed.resize(std::min(removed.size(), alive.size() - 4));
    if (removed.empty()) break;
    for (const int v : removed) rings.Remove(v);
    std::erase_if(alive, [&](int v) { return rings.of(v).empty(); });
  }

  // New numbers: the coarsest hull's vertices, then those that each finer hull adds.
  std::vector<std::int32_t> number(body.vertex_count(), -1);
  for (auto level = alives.rbegin(); level != alives.rend(); ++level) {
    for (const int v : *level) {
      if (number[v] >= 0) continue;
      number[v] = static_cast<std::int32_t>(vertices_.size());
      vertices_.push_back(v);
      points_.push_back(body.vertex(v) - body.interior_point(0));
    }
  }
  // The finest hull is the body, whose own climb ends each query.
  for (std::size_t i = alives.size(); i-- > std::min<std::size_t>(1, alives.size() - 1);) {
    Level level;
    level.begin.assign(alives[i].size() + 1, 0);
    for (std::size_t k = 0; k < alives[i].size(); ++k) {
      level.begin[number[alives[i][k]] + 1] = static_cast<std::int32_t>(graphs[i][k].size());
    }
    for (std::size_t k = 1; k < level.begin.size(); ++k) level.begin[k] += level.begin[k - 1];
    level.neighbors.resize(level.begin.back());
    for (std::size_t k = 0; k < alives[i].size(); ++k) {
      std::int32_t at = level.begin[number[alives[i][k]]];
      for (const int w : graphs[i][k]) level.neighbors[at++] = number[w];
    }
    graphs[i].clear();
    levels_.push_back(std::move(level));
  }
}

int HierarchicalSupport::Find(const Vector3d& direction) const {
  return SupportVertex(body_, direction, FindAboveBody(direction));
}

int HierarchicalSupport::FindAboveBody(const Vector3d& direction) const {
  std::int32_t best = 0;
  double height = Height(0, direction);
  const auto coarsest = static_cast<std::int32_t>(levels_.front().begin.size()) - 1;
  for (std::int32_t v = 1; v < coarsest; ++v) {
    const double h = Height(v, direction);
    if (h > height) {
      height = h;
      best = v;
    }
  }
  for (std::size_t i = 1; i < levels_.size(); ++i) {
    const Level& level = levels_[i];
    const std::int32_t from = best;
    for (std::int32_t k = level.begin[from]; k < level.begin[from + 1]; ++k) {
      const double h = Height(level.neighbors[k], direction);
      if (h > height) {
        height = h;
        best = level.neighbors[k];
      }
    }
  }
  return vertices_[best];
}

std::size_t HierarchicalSupport::bytes() const {
  std::size_t total =
      points_.capacity() * sizeof points_[0] + vertices_.capacity() * sizeof vertices_[0];
  for (const Level& level : levels_) {
    total += (level.begin.capacity() + level.neighbors.capacity()) * sizeof(std::int32_t);
  }
  return total;
}

}  // namespace touchstone
