// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/gauss_map.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "touchstone/core/base/orientation.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

// Cones are widened by this much (cosine and angle alike): far more than the rounding of unit
// vectors, which is below 2^-40.
constexpr double kPadding = 1e-9;

// A narrow cone round unit vectors, if that is less than a half-space: then it holds all their
// convex combinations. The axis goes from their mean towards whichever is furthest off, by smaller
// and smaller steps (Bădoiu and Clarkson 2003).
NormalCone ConeOf(std::span<const Vector3d> directions) {
  constexpr int kSteps = 32;
  Vector3d axis = Vector3d::Zero();
  for (const Vector3d& direction : directions) axis += direction;
  NormalCone best;
  for (int step = 0; step < kSteps; ++step) {
    const double length = axis.norm();
    if (length < 1e-3) break;
    axis /= length;
    double cosine = 1.0;
    Vector3d furthest = axis;
    for (const Vector3d& direction : directions) {
      const double along = axis.dot(direction);
      if (along < cosine) cosine = along, furthest = direction;
    }
    if (cosine > best.cosine) best = {axis, cosine};
    axis += furthest / (step + 2.0);
  }
  if (best.cosine < 1e-3) return {};
  // cos(θ + δ) >= cos θ - δ.
  return {best.axis, best.cosine - kPadding};
}

}  // namespace

class GaussMap::Builder {
 public:
  explicit Builder(const TriangleMesh& mesh)
      : mesh_(mesh), orientation_(mesh.vertices(), mesh.max_coordinate()) {}

  Data Build() {
    data_.neighbor_begin.push_back(0);
    data_.ray_begin.push_back(0);
    for (int v = 0; v < mesh_.vertex_count(); ++v) {
      AddVertex(v);
      data_.neighbor_begin.push_back(static_cast<int>(data_.neighbors.size()));
      data_.ray_begin.push_back(static_cast<int>(data_.rays.size()));
    }
    data_.edge_cones.resize(mesh_.edge_count());
    for (int e = 0; e < mesh_.edge_count(); ++e) AddEdge(e);
    return std::move(data_);
  }

 private:
  // The cross product of the edges to two neighbours.
  using Ray = std::pair<int, int>;
  static Ray RayAfter(const std::vector<int>& bounds, std::size_t i) {
    return {bounds[i], bounds[(i + 1) % bounds.size()]};
  }

  // The sign of det(a - v, b - v, c - v).
  int Side(int v, int a, int b, int c) const {
    return Orientation::ExactSide(orientation_.point(v), orientation_.point(a),
                                  orientation_.point(b), orientation_.point(c));
  }

  void AddVertex(int v) {
    std::vector<int> neighbors;
    for (const int h : mesh_.vertex_half_edges(v)) neighbors.push_back(mesh_.head(h));
    VertexKind kind = VertexKind::kWithin;
    NormalCone cone;
    if (!IsWithin(v)) {
      std::vector<int> bounds;
      std::vector<Ray> rays;
      kind = FindCone(v, neighbors, &bounds, &rays);
      if (kind == VertexKind::kCorner) {
        if (IsDent(v, bounds[0])) {
          kind = VertexKind::kNever;
          rays.clear();
        } else {
          data_.neighbors.insert(data_.neighbors.end(), bounds.begin(), bounds.end());
        }
      }
      for (const Ray& ray : rays) data_.rays.push_back(DirectionOf(v, ray));
      const std::size_t begin = data_.ray_begin[v];
      if (!rays.empty()) cone = ConeOf(std::span(data_.rays).subspan(begin));
    }
    data_.vertex_kinds.push_back(kind);
    data_.vertex_cones.push_back(cone);
  }

  // Whether v lies within a flat facet or a straight edge between two.
  bool IsWithin(int v) const {
    std::vector<int> bends;  // the other ends of edges that are not flat
    for (const int h : mesh_.vertex_half_edges(v)) {
      if (mesh_.edge_kind(mesh_.edge_of(h)) != EdgeKind::kFlat) bends.push_back(mesh_.head(h));
    }
    return bends.empty() || (bends.size() == 2 && orientation_.IsCollinear(v, bends[0], bends[1]));
  }

  // The cone {n : n.(w - v) <= 0}, as the cyclic list of neighbours whose planes bound it, such
  // that its extreme rays are w_i x w_{i+1} (less v), cut down by one neighbour after the other.
  VertexKind FindCone(int v, std::vector<int> neighbors, std::vector<int>* bounds,
                      std::vector<Ray>* rays) const {
    // Three that are not coplanar to begin with.
    std::size_t second = 1, third = 2;
    while (orientation_.IsCollinear(v, neighbors[0], neighbors[second])) ++second;
    std::swap(neighbors[1], neighbors[second]);
    while (Side(v, neighbors[0], neighbors[1], neighbors[third]) == 0) ++third;
    std::swap(neighbors[2], neighbors[third]);
    // The ray a x b must have (a x b).c < 0.
    if (Side(v, neighbors[0], neighbors[1], neighbors[2]) > 0)
      std::swap(neighbors[0], neighbors[1]);
    bounds->assign(neighbors.begin(), neighbors.begin() + 3);
    for (std::size_t k = 3; k < neighbors.size(); ++k) {
      const VertexKind kind = Cut(v, neighbors[k], bounds, rays);
      if (kind != VertexKind::kCorner) return kind;
    }
    for (std::size_t i = 0; i < bounds->size(); ++i) rays->push_back(RayAfter(*bounds, i));
    return VertexKind::kCorner;
  }

  // Cuts the cone by n.(w - v) <= 0. Where no inside is left, the rays that may be.
  VertexKind Cut(int v, int w, std::vector<int>* bounds, std::vector<Ray>* rays) const {
    const std::size_t size = bounds->size();
    // Ray i lies between bounds i and i + 1.
    std::vector<int> sides(size);
    for (std::size_t i = 0; i < size; ++i) {
      sides[i] = Side(v, (*bounds)[i], (*bounds)[(i + 1) % size], w);
    }
    const int least = *std::min_element(sides.begin(), sides.end());
    const int greatest = *std::max_element(sides.begin(), sides.end());
    if (greatest <= 0) return VertexKind::kCorner;  // nothing to cut
    if (least > 0) return VertexKind::kNever;
    if (least == 0) {  // a ray or a side is left
      for (std::size_t i = 0; i < size; ++i) {
        if (sides[i] == 0) rays->push_back(RayAfter(*bounds, i));
      }
      return VertexKind::kSpecial;
    }
    // Rays beyond go; a bound between two of them goes too. The new one stands between the bounds
    // on which the cut begins and ends. A ray in the plane itself stays a ray, so the bound whose
    // other ray goes is no longer needed.
    std::size_t begin = 0;
    while (!(sides[begin] > 0 && sides[(begin + size - 1) % size] <= 0)) ++begin;
    std::size_t end = begin;
    while (sides[(end + 1) % size] > 0) end = (end + 1) % size;
    // Bounds begin + 1 ... end lie between rays that go. Bound `begin` has ray begin - 1 before it.
    std::vector<int> cut;
    for (std::size_t i = (end + 1) % size;; i = (i + 1) % size) {
      // Bound end + 1 keeps its ray end + 1; if that is in the plane, the bound touches there only.
      const bool is_first = i == (end + 1) % size, is_last = i == begin;
      const bool is_needed =
          !(is_first && sides[i] == 0) && !(is_last && sides[(begin + size - 1) % size] == 0);
      if (is_needed) cut.push_back((*bounds)[i]);
      if (is_last) break;
    }
    cut.push_back(w);
    *bounds = std::move(cut);
    return VertexKind::kCorner;
  }

  // Whether the solid at v holds the directions that its neighbours lie below. A bound of the cone
  // is a corner of the link's convex hull, so the link turns there: the edge is convex if the solid
  // fills the hull's side of it, and reflex if it fills the other.
  bool IsDent(int v, int neighbor) const {
    for (const int h : mesh_.vertex_half_edges(v)) {
      if (mesh_.head(h) == neighbor) return mesh_.edge_kind(mesh_.edge_of(h)) == EdgeKind::kReflex;
    }
    return false;
  }

  // Within 2^-40.
  Vector3d DirectionOf(int v, const Ray& ray) const {
    const auto& [first, second] = ray;
    const Vector3d a = (mesh_.vertex(first) - mesh_.vertex(v)).normalized();
    const Vector3d b = (mesh_.vertex(second) - mesh_.vertex(v)).normalized();
    const Vector3d cross = a.cross(b);
    const double length = cross.norm();
    return length > 1e-3 ? Vector3d(cross / length) : orientation_.UnitNormal({v, first, second});
  }

  void AddEdge(int e) {
    const EdgeKind kind = mesh_.edge_kind(e);
    if (kind == EdgeKind::kFlat) return;
    const int h = mesh_.half_edge_of(e);
    const Vector3d& left = mesh_.face_normal(mesh_.face_of(h));
    const Vector3d& right = mesh_.face_normal(mesh_.face_of(mesh_.twin(h)));
    if (kind == EdgeKind::kConvex) {
      const Vector3d ends[] = {left, right};
      data_.edge_cones[e] = ConeOf(ends);
      data_.arcs.push_back({e, left, right});
      return;
    }
    // The longer way round passes the antipode of the shorter one's middle. Where the faces nearly
    // fold, that is along the edge's own cross product.
    Vector3d middle = -(left + right);
    if (middle.squaredNorm() < 1e-6) {
      middle = (mesh_.vertex(mesh_.head(h)) - mesh_.vertex(mesh_.tail(h))).cross(left - right);
    }
    middle.normalize();
    data_.arcs.push_back({e, left, middle});
    data_.arcs.push_back({e, middle, right});
  }

  const TriangleMesh& mesh_;
  const Orientation orientation_;
  Data data_;
};

GaussMap::GaussMap(const TriangleMesh& mesh)
    : data_(std::make_shared<const Data>(Builder(mesh).Build())) {}

}  // namespace touchstone
