// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/boundary.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>

#include "touchstone/core/mesh/membership.h"
#include "touchstone/core/minkowski/arrangement_internal.h"
#include "touchstone/core/minkowski/cells_internal.h"
#include "touchstone/core/minkowski/sample_internal.h"
#include "touchstone/core/minkowski/triangulate_cell_internal.h"

namespace touchstone {
namespace {

using internal::Arrangement;
using internal::Cell;
using internal::CellComplex;
using internal::SumGeometry;
using internal::SumPoint;
using internal::SumPointForm;

class Builder {
 public:
  Builder(const MeshPair& pair, const GaussMap& a, const GaussMap& b)
      : pair_(pair), geometry_(pair) {
    result_.facets = ReducedConvolution(pair, a, b).facets;
  }

  SumBoundary Run() {
    arrangement_ = internal::Arrange(&geometry_, result_.facets);
    complex_ = internal::FindCells(&geometry_, arrangement_);
    FormPatches();
    ClassifyPatches();
    for (std::size_t c = 0; c < complex_.cells.size(); ++c) {
      if (is_kept_[patch_[c]]) AddCell(static_cast<int>(c));
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

  // Cells that meet along a piece with no third beside them lie in M° together or not at all:
  // nothing else of ∂M comes there.
  void FormPatches() {
    cells_of_piece_.resize(complex_.pieces.size());
    for (int c = 0; c < cell_count(); ++c) {
      for (const int piece : cell(c).pieces) cells_of_piece_[piece].push_back(c);
    }
    patch_.resize(cell_count());
    std::iota(patch_.begin(), patch_.end(), 0);
    for (const std::vector<int>& cells : cells_of_piece_) {
      if (cells.size() == 2) patch_[Patch(cells[0])] = Patch(cells[1]);
    }
    for (int c = 0; c < cell_count(); ++c) patch_[c] = Patch(c);
  }

  int Patch(int c) {
    while (patch_[c] != c) c = patch_[c] = patch_[patch_[c]];
    return c;
  }

  void ClassifyPatches() {
    std::vector<char> is_buried(cell_count(), 0);
    std::vector<std::vector<int>> members(cell_count());
    for (int c = 0; c < cell_count(); ++c) {
      members[patch_[c]].push_back(c);
      is_buried[patch_[c]] |= cell(c).is_buried;
    }
    is_kept_.assign(cell_count(), 0);
    triangles_.resize(cell_count());
    for (int p = 0; p < cell_count(); ++p) {
      if (members[p].empty()) continue;
      ++result_.patches;
      if (!is_buried[p]) is_kept_[p] = IsOutsideM(members[p]);
    }
  }

  // By a sample point in the largest triangle of the patch.
  bool IsOutsideM(const std::vector<int>& cells) {
    double largest = -1.0;
    int cell_of_largest = -1;
    std::array<int, 3> triangle{};
    for (const int c : cells) {
      triangles_[c] = internal::TriangulateCell(
          &geometry_, arrangement_.groups[cell(c).group].plane, cell(c).loops);
      for (const std::array<int, 3>& t : triangles_[c]) {
        const double area = internal::SquaredArea(geometry_, t);
        if (area > largest) largest = area, triangle = t, cell_of_largest = c;
      }
    }
    if (cell_of_largest < 0) return false;
    const Cell& own = cell(cell_of_largest);
    const int facet = own.along.empty() ? own.against[0] : own.along[0];
    const internal::Sample sample =
        internal::SampleIn(&geometry_, arrangement_.facets[facet], triangle);
    const Verdict verdict = VerdictAt(sample);
    result_.detached_patches += verdict == Verdict::kSeparate;
    return verdict != Verdict::kOverlap;
  }

  Verdict VerdictAt(const internal::Sample& sample) {
    ++result_.memberships;
    return Membership(pair_, Translation(sample.rounded, sample.error, sample.exact), {},
                      &membership_cache_)
        .verdict;
  }

  void AddCell(int c) {
    const Cell& own = cell(c);
    const bool is_sheet = !own.along.empty() && !own.against.empty();
    const bool is_along = !own.along.empty();
    const int facet = is_along ? own.along[0] : own.against[0];
    for (std::array<int, 3> t : triangles_[c]) {
      if (!is_along) std::swap(t[1], t[2]);
      for (int& point : t) point = AddPoint(point);
      (is_sheet ? result_.sheets : result_.triangles).push_back(t);
      (is_sheet ? result_.facet_of_sheet : result_.facet_of_triangle).push_back(facet);
    }
  }

  int AddPoint(int point) {
    const auto [place, added] =
        number_of_point_.try_emplace(point, static_cast<int>(result_.vertices.size()));
    if (added) {
      const SumPoint& x = geometry_.point(point);
      result_.vertices.push_back(x.rounded / pair_.scale());
      result_.rounding = std::max(result_.rounding, x.error / pair_.scale());
      result_.names.push_back(geometry_.NameOf(point));
    }
    return place->second;
  }

  // Segments and points of ∂M with M° all around. Around a segment in the inside of two facets
  // some direction leads out of both; so only segments on three or more planes, or sides of planes,
  // can be such, and only points on four or more, or vertices of M.
  void AddLonePieces() {
    std::vector<std::vector<std::pair<int, bool>>> planes_of_point(geometry_.point_count());
    std::vector<char> is_near_kept(geometry_.point_count(), 0);
    for (std::size_t i = 0; i < complex_.pieces.size(); ++i) {
      const internal::Piece& piece = complex_.pieces[i];
      const bool is_kept = std::any_of(cells_of_piece_[i].begin(), cells_of_piece_[i].end(),
                                       [&](int c) { return is_kept_[patch_[c]] != 0; });
      std::vector<std::pair<int, bool>> planes;
      for (const int c : cells_of_piece_[i]) {
        const int root = arrangement_.groups[cell(c).group].plane;
        if (!cell(c).along.empty()) planes.emplace_back(root, true);
        if (!cell(c).against.empty()) planes.emplace_back(root, false);
      }
      std::sort(planes.begin(), planes.end());
      planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
      for (const int point : {piece.from, piece.to}) {
        is_near_kept[point] |= is_kept;
        auto& own = planes_of_point[point];
        own.insert(own.end(), planes.begin(), planes.end());
      }
      if (is_kept || planes.size() < 3) continue;
      const internal::Sample sample = internal::SampleBetween(&geometry_, piece.from, piece.to);
      if (VerdictAt(sample) == Verdict::kOverlap) continue;
      is_near_kept[piece.from] = is_near_kept[piece.to] = 1;
      result_.segments.push_back({AddPoint(piece.from), AddPoint(piece.to)});
    }
    for (int point = 0; point < geometry_.point_count(); ++point) {
      auto& planes = planes_of_point[point];
      std::sort(planes.begin(), planes.end());
      planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
      if (planes.size() < 4 || is_near_kept[point]) continue;
      const internal::Sample sample = internal::SampleBetween(&geometry_, point, point);
      if (VerdictAt(sample) != Verdict::kOverlap) result_.points.push_back(AddPoint(point));
    }
  }

  void CountComponents() {
    std::map<std::pair<int, int>, std::pair<int, int>> edges;  // ends: runs up and down, a triangle
    std::vector<int> parent(result_.triangles.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto find = [&](int t) {
      while (parent[t] != t) t = parent[t] = parent[parent[t]];
      return t;
    };
    for (std::size_t t = 0; t < result_.triangles.size(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const int u = result_.triangles[t][k], v = result_.triangles[t][(k + 1) % 3];
        const auto [place, added] = edges.try_emplace(std::minmax(u, v), 0, static_cast<int>(t));
        place->second.first += u < v ? 1 : -1;
        parent[find(static_cast<int>(t))] = find(place->second.second);
      }
    }
    std::unordered_map<int, int> component_of_root;
    result_.component_of_triangle.resize(result_.triangles.size());
    std::vector<std::pair<int, int>> corners;  // component, vertex
    for (std::size_t t = 0; t < result_.triangles.size(); ++t) {
      const auto [place, added] = component_of_root.try_emplace(
          find(static_cast<int>(t)), static_cast<int>(result_.components.size()));
      if (added) result_.components.emplace_back();
      result_.component_of_triangle[t] = place->second;
      ++result_.components[place->second].triangle_count;
      for (const int v : result_.triangles[t]) corners.emplace_back(place->second, v);
    }
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    for (const auto& [component, v] : corners) ++result_.components[component].vertex_count;
    for (const auto& [ends, edge] : edges) {
      ++result_.components[result_.component_of_triangle[edge.second]].edge_count;
      result_.border_edges += edge.first != 0;
    }
  }

  const MeshPair& pair_;
  SumGeometry geometry_;
  Arrangement arrangement_;
  CellComplex complex_;
  SumBoundary result_;
  MembershipCache membership_cache_;
  std::vector<std::vector<int>> cells_of_piece_;
  std::vector<int> patch_;
  std::vector<char> is_kept_;                               // by patch
  std::vector<std::vector<std::array<int, 3>>> triangles_;  // by cell
  std::unordered_map<int, int> number_of_point_;
};

}  // namespace

SumBoundary BuildSumBoundary(const MeshPair& pair, const GaussMap& a, const GaussMap& b) {
  return Builder(pair, a, b).Run();
}

}  // namespace touchstone
