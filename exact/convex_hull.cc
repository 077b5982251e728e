// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/convex_hull.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <vector>

namespace touchstone::exact {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Loop = std::vector<int>;

Status Refuse(StatusCode code, std::string message, int index = -1) {
  Status status;
  status.code = code;
  status.message = std::move(message);
  if (index >= 0) {
    status.element = ElementKind::kVertex;
    status.index = index;
  }
  return status;
}

bool AllCoplanar(const std::vector<Point>& points) {
  std::size_t i = 1;
  while (i < points.size() && points[i] == points[0]) ++i;
  std::size_t j = i + 1;
  while (j < points.size() && CGAL::collinear(points[0], points[i], points[j])) ++j;
  if (j >= points.size()) return true;
  return std::all_of(points.begin(), points.end(), [&](const Point& x) {
    return CGAL::coplanar(points[0], points[i], points[j], x);
  });
}

// The facets of CGAL's triangulated hull: triangles joined across edges whose two planes are one.
class Facets {
 public:
  explicit Facets(const Mesh& hull) : hull_(hull), parent_(hull.number_of_faces()) {
    std::iota(parent_.begin(), parent_.end(), 0);
    for (const Mesh::Edge_index e : hull.edges()) {
      const Mesh::Halfedge_index h = hull.halfedge(e), g = hull.opposite(h);
      if (CGAL::coplanar(At(hull.source(h)), At(hull.target(h)), At(hull.target(hull.next(h))),
                         At(hull.target(hull.next(g))))) {
        parent_[Root(hull.face(h))] = Root(hull.face(g));
      }
    }
  }

  // The outline of each facet, counterclockwise from outside, without vertices within its sides.
  std::vector<std::vector<Mesh::Vertex_index>> Outlines() {
    std::vector<std::vector<Mesh::Vertex_index>> outlines;
    std::vector<bool> done(parent_.size(), false);
    for (const Mesh::Halfedge_index h : hull_.halfedges()) {
      const int root = Root(hull_.face(h));
      if (done[root] || !OnOutline(h)) continue;
      done[root] = true;
      outlines.push_back(Walk(h));
    }
    return outlines;
  }

 private:
  const Point& At(Mesh::Vertex_index v) const { return hull_.point(v); }

  int Root(Mesh::Face_index f) {
    int i = static_cast<int>(f);
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  bool OnOutline(Mesh::Halfedge_index h) {
    return Root(hull_.face(h)) != Root(hull_.face(hull_.opposite(h)));
  }

  std::vector<Mesh::Vertex_index> Walk(Mesh::Halfedge_index start) {
    std::vector<Mesh::Vertex_index> all, corners;
    Mesh::Halfedge_index h = start;
    do {
      all.push_back(hull_.source(h));
      h = hull_.next(h);
      while (!OnOutline(h)) h = hull_.next(hull_.opposite(h));
    } while (h != start);
    for (std::size_t k = 0; k < all.size(); ++k) {
      const Point &before = At(all[(k + all.size() - 1) % all.size()]), &here = At(all[k]),
                  &after = At(all[(k + 1) % all.size()]);
      if (!CGAL::collinear(before, here, after)) corners.push_back(all[k]);
    }
    return corners;
  }

  const Mesh& hull_;
  std::vector<int> parent_;
};

void StartAtSmallest(Loop* loop) {
  std::rotate(loop->begin(), std::min_element(loop->begin(), loop->end()), loop->end());
}

// Faces sorted, each from its smallest vertex; as fans of triangles unless whole facets are wanted.
std::vector<Loop> CanonicalFaces(std::vector<Loop> loops, const HullOptions& options) {
  std::vector<Loop> faces;
  for (Loop& loop : loops) {
    StartAtSmallest(&loop);
    if (options.merge_coplanar) {
      faces.push_back(std::move(loop));
      continue;
    }
    for (std::size_t k = 1; k + 1 < loop.size(); ++k)
      faces.push_back({loop[0], loop[k], loop[k + 1]});
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

}  // namespace

StatusOr<ConvexPolyhedron> ConvexHull(std::span<const Eigen::Vector3d> points,
                                      const HullOptions& options) {
  std::vector<Point> distinct;
  std::map<Point, int> first;  // of each distinct point, its first index in `points`
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d& x = points[i];
    if (!x.allFinite()) {
      return Refuse(StatusCode::kNonFinite, "a point is not finite", static_cast<int>(i));
    }
    const Point point(x.x(), x.y(), x.z());
    if (first.emplace(point, static_cast<int>(i)).second) distinct.push_back(point);
  }
  if (distinct.size() < 4)
    return Refuse(StatusCode::kTooFewVertices, "fewer than four distinct points");
  if (AllCoplanar(distinct)) return Refuse(StatusCode::kFlat, "all points lie in one plane");
  Mesh hull;
  CGAL::convex_hull_3(distinct.begin(), distinct.end(), hull);

  std::vector<Loop> loops;
  std::vector<int> used;
  for (const std::vector<Mesh::Vertex_index>& outline : Facets(hull).Outlines()) {
    Loop& loop = loops.emplace_back();
    for (const Mesh::Vertex_index v : outline) loop.push_back(first.at(hull.point(v)));
    used.insert(used.end(), loop.begin(), loop.end());
  }
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::vector<Eigen::Vector3d> vertices;
  for (const int i : used) vertices.push_back(points[i]);
  for (Loop& loop : loops) {
    for (int& v : loop) {
      v = static_cast<int>(std::lower_bound(used.begin(), used.end(), v) - used.begin());
    }
  }
  return ConvexPolyhedron::Build(vertices, CanonicalFaces(std::move(loops), options));
}

}  // namespace touchstone::exact
