// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/gauss_arrangement_internal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "touchstone/core/minkowski/cone_tree.h"

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

// An arc shorter than half a circle, counterclockwise round its pole.
struct WholeArc {
  int tail, head;
  int edge;  // -1: the cone of a special vertex
};

class Arranger {
 public:
  Arranger(const TriangleMesh& mesh, const GaussMap& map) : mesh_(mesh), map_(map) {}

  GaussArrangement Arrange(bool with_reflex) {
    for (int f = 0; f < mesh_.face_count(); ++f) {
      arrangement_.vertex_of_face.push_back(arrangement_.vertices.Add(NormalOfFace(mesh_, f)));
    }
    for (int e = 0; e < mesh_.edge_count(); ++e) {
      if (mesh_.edge_kind(e) == EdgeKind::kConvex) AddConvexArc(e);
      if (mesh_.edge_kind(e) == EdgeKind::kReflex && with_reflex) AddReflexArc(e);
    }
    for (int v = 0; v < mesh_.vertex_count(); ++v) {
      if (map_.vertex_kind(v) == VertexKind::kSpecial) AddSpecialCone(v);
    }
    arrangement_.arc_count = static_cast<int>(arcs_.size());
    CutArcs();
    CollectPieces();
    return std::move(arrangement_);
  }

 private:
  const Direction& vertex(int i) const { return arrangement_.vertices[i]; }
  const Direction& pole(int arc) const { return arrangement_.poles[arc]; }

  void AddArc(int tail, int head, int edge, Direction pole) {
    arcs_.push_back({tail, head, edge});
    arrangement_.poles.push_back(std::move(pole));
  }

  int NormalLeft(int e) const { return arrangement_.vertex_of_face[mesh_.half_edge_of(e) / 3]; }
  int NormalRight(int e) const {
    return arrangement_.vertex_of_face[mesh_.twin(mesh_.half_edge_of(e)) / 3];
  }

  // From the left face's normal to the right one's is counterclockwise round the half-edge where
  // the edge is convex, by less than half a circle, and where it is reflex, by more.
  void AddConvexArc(int e) { AddArc(NormalLeft(e), NormalRight(e), e, DirectionOfEdge(mesh_, e)); }

  // Split at the middle; where rounding leaves one half no shorter than half a circle, at a third
  // and two thirds of the circle instead.
  void AddReflexArc(int e) {
    const Direction along = DirectionOfEdge(mesh_, e);
    const int left = NormalLeft(e), right = NormalRight(e);
    const Vector3d sum = vertex(left).unit + vertex(right).unit;
    const Vector3d forward = along.unit.cross(vertex(left).unit);
    const Vector3d middle = sum.squaredNorm() < 1e-6 ? forward : Vector3d(-sum.normalized());
    if (AddThrough(left, {middle}, right, e, along)) return;
    const Vector3d& start = vertex(left).unit;
    const double sine = std::sqrt(0.75);
    AddThrough(left, {-0.5 * start + sine * forward, -0.5 * start - sine * forward}, right, e,
               along);
  }

  // Arcs through points of the great circle near those given, unless one would be half a circle or
  // longer.
  bool AddThrough(int from, const std::vector<Vector3d>& points, int to, int e,
                  const Direction& along) {
    std::vector<Direction> stops = {vertex(from)};
    for (const Vector3d& x : points) {
      // d x (x x d) = x for an x orthogonal to d; any vector in place of x x d stays in the plane.
      stops.push_back(MakeDirection(Cross(along.exact, ToIntegers(x.cross(along.unit)))));
    }
    stops.push_back(vertex(to));
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
      if (TurnOf(along, stops[i], stops[i + 1]) <= 0) return false;
    }
    int last = from;
    for (std::size_t i = 1; i < stops.size(); ++i) {
      const int next = arrangement_.vertices.Add(stops[i]);
      AddArc(last, next, e, along);
      last = next;
    }
    return true;
  }

  // The directions along which a special vertex is extreme: the rays w_i x w_j that no neighbour
  // forbids, one or two, and what lies between.
  void AddSpecialCone(int v) {
    std::vector<Direction> along;
    for (const int h : mesh_.vertex_half_edges(v)) {
      along.push_back(
          MakeDirection(DifferenceToIntegers(mesh_.vertex(mesh_.head(h)), mesh_.vertex(v))));
    }
    std::vector<int> rays;
    for (std::size_t i = 0; i < along.size(); ++i) {
      for (std::size_t j = 0; j < along.size(); ++j) {
        const IntegerVector cross = Cross(along[i].exact, along[j].exact);
        if (DigitsOf(cross) == 0) continue;
        const Direction ray = MakeDirection(cross);
        const bool is_allowed = std::all_of(
            along.begin(), along.end(), [&](const Direction& w) { return SideOf(w, ray) <= 0; });
        if (is_allowed) rays.push_back(arrangement_.vertices.Add(ray));
      }
    }
    std::sort(rays.begin(), rays.end());
    rays.erase(std::unique(rays.begin(), rays.end()), rays.end());
    for (std::size_t i = 1; i < rays.size(); ++i) {
      const IntegerVector cross = Cross(vertex(rays[0]).exact, vertex(rays[i]).exact);
      if (DigitsOf(cross) != 0) AddArc(rays[0], rays[i], -1, MakeDirection(cross));
    }
  }

  NormalCone ConeOfArc(const WholeArc& arc) const {
    const Vector3d sum = vertex(arc.tail).unit + vertex(arc.head).unit;
    const double length = sum.norm();
    if (length < 1e-3) return {};
    const Vector3d axis = sum / length;
    // Roundings move the cosine by far less than this.
    const double cosine = axis.dot(vertex(arc.tail).unit) - 1e-9;
    return cosine < 1e-3 ? NormalCone{} : NormalCone{axis, cosine};
  }

  void CutArcs() {
    std::vector<NormalCone> cones;
    std::vector<int> items;
    for (std::size_t i = 0; i < arcs_.size(); ++i) {
      cones.push_back(ConeOfArc(arcs_[i]));
      items.push_back(static_cast<int>(i));
      cuts_.push_back({arcs_[i].tail, arcs_[i].head});
    }
    const ConeTree tree(cones, std::move(items));
    CutAtLoneVertices(tree);
    std::vector<std::pair<int, int>> pairs;
    tree.Pairs(tree, &pairs);
    for (const auto& [i, j] : pairs) {
      if (i < j) CutEachOther(i, j);
    }
  }

  // A normal at which no arc ends can lie on one.
  void CutAtLoneVertices(const ConeTree& tree) {
    std::vector<bool> is_end(arrangement_.vertices.size());
    for (const WholeArc& arc : arcs_) is_end[arc.tail] = is_end[arc.head] = true;
    std::vector<int> near;
    for (int i = 0; i < arrangement_.vertices.size(); ++i) {
      if (is_end[i]) continue;
      near.clear();
      tree.Along(vertex(i).unit, &near);
      for (const int arc : near) {
        if (SideOf(pole(arc), vertex(i)) == 0) CutAt(arc, i);
      }
    }
  }

  // Whether a point of the arc's great circle lies strictly within the arc.
  bool IsWithin(int arc, const Direction& x) const {
    return TurnOf(pole(arc), vertex(arcs_[arc].tail), x) > 0 &&
           TurnOf(pole(arc), x, vertex(arcs_[arc].head)) > 0;
  }

  void CutEachOther(int i, int j) {
    const WholeArc arc_i = arcs_[i], arc_j = arcs_[j];
    const int tail_j = SideOf(pole(i), vertex(arc_j.tail));
    const int head_j = SideOf(pole(i), vertex(arc_j.head));
    if (tail_j * head_j > 0) return;
    const int tail_i = SideOf(pole(j), vertex(arc_i.tail));
    const int head_i = SideOf(pole(j), vertex(arc_i.head));
    if (tail_i * head_i > 0) return;
    // An end on the other's great circle is where the two can meet, and on one great circle each
    // cuts the other with its ends.
    if (tail_j == 0) CutAt(i, arc_j.tail);
    if (head_j == 0) CutAt(i, arc_j.head);
    if (tail_i == 0) CutAt(j, arc_i.tail);
    if (head_i == 0) CutAt(j, arc_i.head);
    if (tail_j == 0 || head_j == 0 || tail_i == 0 || head_i == 0) return;
    // Left to right of i, j passes right to left of it as seen the other way; else they pass
    // through opposite points.
    if (tail_j == tail_i) return;
    Direction crossing = MakeDirection(Cross(pole(i).exact, pole(j).exact));
    if (!IsWithin(i, crossing)) crossing = Opposite(crossing);
    const int vertex = arrangement_.vertices.Add(crossing);
    cuts_[i].push_back(vertex);
    cuts_[j].push_back(vertex);
  }

  void CutAt(int arc, int point) {
    if (point == arcs_[arc].tail || point == arcs_[arc].head) return;
    if (IsWithin(arc, vertex(point))) cuts_[arc].push_back(point);
  }

  void CollectPieces() {
    std::map<std::pair<int, int>, std::size_t> pieces;
    for (std::size_t i = 0; i < arcs_.size(); ++i) {
      std::vector<int>& cuts = cuts_[i];
      std::sort(cuts.begin(), cuts.end());
      cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
      const int arc = static_cast<int>(i);
      std::sort(cuts.begin(), cuts.end(), [&](int x, int y) {
        return x != y && TurnOf(pole(arc), vertex(x), vertex(y)) > 0;
      });
      for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
        const auto key = std::minmax(cuts[k], cuts[k + 1]);
        const auto [place, added] = pieces.try_emplace(key, arrangement_.pieces.size());
        if (added) arrangement_.pieces.push_back({cuts[k], cuts[k + 1], arc, {}});
        if (arcs_[i].edge >= 0) {
          arrangement_.pieces[place->second].edges.push_back(arcs_[i].edge);
        }
      }
    }
  }

  const TriangleMesh& mesh_;
  const GaussMap& map_;
  GaussArrangement arrangement_;
  std::vector<WholeArc> arcs_;
  std::vector<std::vector<int>> cuts_;  // by arc: its vertices
};

}  // namespace

Direction DirectionOfEdge(const TriangleMesh& mesh, int e) {
  const int h = mesh.half_edge_of(e);
  return MakeDirection(DifferenceToIntegers(mesh.vertex(mesh.head(h)), mesh.vertex(mesh.tail(h))));
}

Direction NormalOfFace(const TriangleMesh& mesh, int f) {
  const Triangle& face = mesh.face(f);
  return MakeDirection(
      Cross(Primitive(DifferenceToIntegers(mesh.vertex(face[1]), mesh.vertex(face[0]))),
            Primitive(DifferenceToIntegers(mesh.vertex(face[2]), mesh.vertex(face[0])))));
}

GaussArrangement ArrangeGaussMap(const TriangleMesh& mesh, const GaussMap& map, bool with_reflex) {
  return Arranger(mesh, map).Arrange(with_reflex);
}

}  // namespace touchstone::internal
