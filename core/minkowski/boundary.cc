// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/boundary.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "touchstone/core/mesh/membership.h"
#include "touchstone/core/minkowski/arrangement_internal.h"
#include "touchstone/core/minkowski/cells_internal.h"
#include "touchstone/core/minkowski/facet_order_internal.h"
#include "touchstone/core/minkowski/flat_table_internal.h"
#include "touchstone/core/minkowski/patches_internal.h"
#include "touchstone/core/minkowski/sample_internal.h"
#include "touchstone/core/minkowski/triangulate_cell_internal.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;
using internal::Arrangement;
using internal::Cell;
using internal::CellComplex;
using internal::Piece;
using internal::SumGeometry;
using internal::SumPoint;

class Builder {
 public:
  Builder(const MeshPair& pair, const GaussMap& a, const GaussMap& b)
      : pair_(pair), geometry_(pair) {
    result_.facets = ReducedConvolution(pair, a, b).facets;
  }

  SumBoundary Run() {
    // Along a curve, and named at the end as they are listed.
    number_ = internal::AlongCurve(pair_, result_.facets);
    std::vector<SumFacet> facets;
    facets.reserve(number_.size());
    for (const int f : number_) facets.push_back(result_.facets[f]);
    arrangement_ = internal::Arrange(&geometry_, facets);
    complex_ = internal::FindCells(&geometry_, arrangement_);
    patches_.Form(complex_, {});
    ClassifyPatches();
    number_of_point_.assign(geometry_.point_count(), -1);
    for (std::size_t c = 0; c < complex_.cells.size(); ++c) {
      if (IsKept(static_cast<int>(c))) AddCell(static_cast<int>(c));
    }
    AddLonePieces();
    CountComponents();
    result_.facet_pairs = arrangement_.box_pairs;
    result_.crossings = arrangement_.crossings;
    result_.cells = static_cast<long>(complex_.cells.size());
    result_.exact_signs = geometry_.exact_count();
    return std::move(result_);
  }

 private:
  const Cell& cell(int c) const { return complex_.cells[c]; }
  int cell_count() const { return static_cast<int>(complex_.cells.size()); }
  int piece_count() const { return static_cast<int>(complex_.pieces.size()); }

  void ClassifyPatches() {
    std::vector<int> largest(complex_.cells.size(), -1);
    std::vector<double> area(complex_.cells.size(), -1.0);
    for (int c = 0; c < cell_count(); ++c) {
      const int p = patches_.of(c);
      if (patches_.is_buried(p)) continue;
      const double own = SquaredAreaOf(cell(c).loops[0]);
      if (own > area[p]) area[p] = own, largest[p] = c;
    }
    is_kept_.assign(complex_.cells.size(), 0);
    for (int p = 0; p < cell_count(); ++p) {
      result_.patches += patches_.of(p) == p;
      if (largest[p] >= 0) is_kept_[p] = IsOutsideM(largest[p]);
    }
  }

  double SquaredAreaOf(std::span<const int> loop) const {
    const Vector3d& from = geometry_.point(loop[0]).rounded;
    Vector3d twice = Vector3d::Zero(), before = geometry_.point(loop[1]).rounded - from;
    for (const int point : loop.subspan(2)) {
      const Vector3d after = geometry_.point(point).rounded - from;
      twice += before.cross(after);
      before = after;
    }
    return twice.squaredNorm();
  }

  std::vector<std::array<int, 3>> TrianglesOf(int c) {
    return internal::TriangulateCell(&geometry_, arrangement_.groups[cell(c).group].plane,
                                     cell(c).loops);
  }

  // By a sample point in the largest triangle of the cell.
  bool IsOutsideM(int c) {
    double largest = -1.0;
    std::array<int, 3> triangle{};
    for (const std::array<int, 3>& t : TrianglesOf(c)) {
      const double area = internal::SquaredArea(geometry_, t);
      if (area > largest) largest = area, triangle = t;
    }
    if (largest < 0.0) return false;
    const int facet = cell(c).along.empty() ? cell(c).against[0] : cell(c).along[0];
    ++result_.memberships;
    const Verdict verdict =
        internal::VerdictIn(&geometry_, arrangement_.facets[facet], triangle, &membership_cache_);
    result_.detached_patches += verdict == Verdict::kSeparate;
    return verdict != Verdict::kOverlap;
  }

  bool IsMiddleInM(int x, int y) {
    ++result_.memberships;
    return internal::VerdictBetween(&geometry_, x, y, &membership_cache_) == Verdict::kOverlap;
  }

  void AddCell(int c) {
    const Cell& own = cell(c);
    const bool is_sheet = !own.along.empty() && !own.against.empty();
    const bool is_along = !own.along.empty();
    const int facet = FirstOf(is_along ? own.along : own.against);
    for (std::array<int, 3> t : TrianglesOf(c)) {
      if (!is_along) std::swap(t[1], t[2]);
      for (int& point : t) point = AddPoint(point);
      (is_sheet ? result_.sheets : result_.triangles).push_back(t);
      (is_sheet ? result_.facet_of_sheet : result_.facet_of_triangle).push_back(facet);
    }
  }

  // The first in the result's list of facets that cover a cell.
  int FirstOf(std::span<const int> facets) const {
    int first = number_[facets[0]];
    for (const int f : facets) first = std::min(first, number_[f]);
    return first;
  }

  int AddPoint(int point) {
    int& number = number_of_point_[point];
    if (number < 0) {
      number = static_cast<int>(result_.vertices.size());
      const SumPoint& x = geometry_.Sharp(point);
      result_.vertices.push_back(x.rounded / pair_.scale());
      result_.rounding = std::max(result_.rounding, x.error / pair_.scale());
      result_.names.push_back(geometry_.NameOf(point));
      for (int& f : result_.names.back().facets) f = f < 0 ? f : number_[f];
    }
    return number;
  }

  // Segments and points of ∂M with M° all around. Around a segment in the inside of two facets
  // some direction leads out of both; so only segments on three or more planes, or sides of planes,
  // can be such, and only points on four or more, or vertices of M.
  void AddLonePieces() {
    std::vector<char> is_near_kept(geometry_.point_count(), 0);
    for (int i = 0; i < piece_count(); ++i) {
      if (IsNearKept(i)) MarkEnds(complex_.pieces[i], &is_near_kept);
    }
    std::vector<Piece> segments;
    for (int i = 0; i < piece_count(); ++i) {
      const Piece& piece = complex_.pieces[i];
      if (FacingSidesAt(i) < 3 || IsNearKept(i)) continue;
      planes_.clear();
      AddPlanes(i);
      if (planes_.size() < 3 || IsMiddleInM(piece.from, piece.to)) continue;
      segments.push_back(piece);
    }
    for (const Piece& piece : segments) {
      MarkEnds(piece, &is_near_kept);
      result_.segments.push_back({AddPoint(piece.from), AddPoint(piece.to)});
    }
    AddLonePoints(is_near_kept);
  }

  bool IsKept(int c) const { return is_kept_[patches_.of(c)] != 0; }

  bool IsNearKept(int piece) const {
    const std::span<const int> cells = patches_.CellsAt(piece);
    return std::any_of(cells.begin(), cells.end(), [&](int c) { return IsKept(c); });
  }

  int FacingSidesAt(int piece) const {
    int sides = 0;
    for (const int c : patches_.CellsAt(piece)) sides += internal::FacingSides(cell(c));
    return sides;
  }

  static void MarkEnds(const Piece& piece, std::vector<char>* marks) {
    (*marks)[piece.from] = (*marks)[piece.to] = 1;
  }

  // The planes of the cells at a piece, by which way they face, each once.
  void AddPlanes(int piece) {
    const auto add = [this](int plane, bool is_along) {
      const std::pair<int, bool> side(plane, is_along);
      if (std::find(planes_.begin(), planes_.end(), side) == planes_.end()) planes_.push_back(side);
    };
    for (const int c : patches_.CellsAt(piece)) {
      const int root = arrangement_.groups[cell(c).group].plane;
      if (!cell(c).along.empty()) add(root, true);
      if (!cell(c).against.empty()) add(root, false);
    }
  }

  void AddLonePoints(const std::vector<char>& is_near_kept) {
    const auto pieces_of_point =
        internal::ListByOwner<int>(geometry_.point_count(), [&](const auto& visit) {
          for (int i = 0; i < piece_count(); ++i) {
            for (const int point : {complex_.pieces[i].from, complex_.pieces[i].to}) {
              if (!is_near_kept[point]) visit(point, i);
            }
          }
        });
    for (int point = 0; point < geometry_.point_count(); ++point) {
      planes_.clear();
      for (const int piece : pieces_of_point.Of(point)) AddPlanes(piece);
      if (planes_.size() < 4 || IsMiddleInM(point, point)) continue;
      result_.points.push_back(AddPoint(point));
    }
  }

  void CountComponents() {
    struct Edge {
      int triangle;  // one of its own
      int balance;   // runs up less runs down
    };
    const int count = static_cast<int>(result_.triangles.size());
    internal::PairTable numbers(static_cast<int>(result_.vertices.size()));
    std::vector<Edge> edges;
    std::vector<int> parent(result_.triangles.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto find = [&](int t) {
      while (parent[t] != t) t = parent[t] = parent[parent[t]];
      return t;
    };
    for (int t = 0; t < count; ++t) {
      for (int k = 0; k < 3; ++k) {
        const int u = result_.triangles[t][k], v = result_.triangles[t][(k + 1) % 3];
        const auto [number, added] = numbers.Insert(std::min(u, v), std::max(u, v));
        if (added) edges.push_back({t, 0});
        edges[number].balance += u < v ? 1 : -1;
        parent[find(t)] = find(edges[number].triangle);
      }
    }
    std::vector<int> component_of_root(result_.triangles.size(), -1);
    for (int t = 0; t < count; ++t) {
      int& component = component_of_root[find(t)];
      if (component < 0) {
        component = static_cast<int>(result_.components.size());
        result_.components.emplace_back();
      }
      result_.component_of_triangle.push_back(component);
      ++result_.components[component].triangle_count;
    }
    for (const Edge& edge : edges) {
      ++result_.components[result_.component_of_triangle[edge.triangle]].edge_count;
      result_.border_edges += edge.balance != 0;
    }
    CountVertices();
  }

  // A vertex counts for every component that it belongs to.
  void CountVertices() {
    std::vector<std::pair<int, int>> corners;  // vertex, component
    for (std::size_t t = 0; t < result_.triangles.size(); ++t) {
      for (const int v : result_.triangles[t]) {
        corners.emplace_back(v, result_.component_of_triangle[t]);
      }
    }
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    for (const auto& [v, component] : corners) ++result_.components[component].vertex_count;
  }

  const MeshPair& pair_;
  SumGeometry geometry_;
  Arrangement arrangement_;
  CellComplex complex_;
  SumBoundary result_;
  MembershipCache membership_cache_;
  internal::Patches patches_;
  std::vector<char> is_kept_;                 // by patch
  std::vector<int> number_;                   // of the arrangement's facets, in the result's list
  std::vector<int> number_of_point_;          // in the result; -1: not there
  std::vector<std::pair<int, bool>> planes_;  // scratch
};

}  // namespace

SumBoundary BuildSumBoundary(const MeshPair& pair, const GaussMap& a, const GaussMap& b) {
  return Builder(pair, a, b).Run();
}

}  // namespace touchstone
