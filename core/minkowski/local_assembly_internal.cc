// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/local_assembly_internal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "touchstone/core/minkowski/arrangement_internal.h"
#include "touchstone/core/minkowski/box_lanes_internal.h"
#include "touchstone/core/minkowski/cells_internal.h"
#include "touchstone/core/minkowski/local_surface_internal.h"
#include "touchstone/core/minkowski/patches_internal.h"
#include "touchstone/core/minkowski/sample_internal.h"
#include "touchstone/core/minkowski/triangulate_cell_internal.h"

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

class Assembler {
 public:
  Assembler(SumGeometry* geometry, const GatheredFacets& gathered, const ScaledBall& ball,
            AssemblyScope scope, MembershipCache* cache, LocalSum* sum)
      : geometry_(*geometry),
        gathered_(gathered),
        ball_(ball),
        is_whole_(scope == AssemblyScope::kWhole),
        cache_(*cache),
        sum_(*sum) {
    geometry_.Reset();
  }

  void Run() {
    arrangement_ = is_whole_
                       ? Arrange(&geometry_, gathered_.facets)
                       : Arrange(&geometry_, gathered_.facets, gathered_.is_active, gathered_.near);
    complex_ = FindCells(&geometry_, arrangement_);
    MeasurePieces();
    SelectCells();
    // Of a piece that is not in the ball not all cells may be known.
    patches_.Form(complex_, is_whole_ ? std::span<const char>() : is_near_);
    ClassifyPatches();
    AddCells();
    AddLonePieces();
    NumberFacets();
    sum_.facet_pairs = arrangement_.box_pairs;
    sum_.crossings = arrangement_.crossings;
    sum_.cells = static_cast<long>(complex_.cells.size());
    sum_.exact_signs = geometry_.exact_count();
  }

 private:
  const Cell& cell(int c) const { return complex_.cells[c]; }
  int cell_count() const { return static_cast<int>(complex_.cells.size()); }
  const Vector3d& At(int point) const { return geometry_.point(point).rounded; }

  void MeasurePieces() {
    is_near_.resize(complex_.pieces.size());
    for (std::size_t i = 0; i < complex_.pieces.size(); ++i) {
      const Piece& piece = complex_.pieces[i];
      is_near_[i] =
          DistanceToSegment(ball_.center(), At(piece.from), At(piece.to)) <= ball_.reach();
    }
  }

  void SelectCells() {
    is_selected_.resize(complex_.cells.size());
    for (int c = 0; c < cell_count(); ++c) is_selected_[c] = MeetsBall(cell(c));
  }

  // By a border, or because the ball passes through its inside.
  bool MeetsBall(const Cell& own) const {
    for (const int piece : own.pieces) {
      if (is_near_[piece]) return true;
    }
    const SumPlane& plane = geometry_.plane(arrangement_.groups[own.group].plane);
    const double squared = plane.normal.squaredNorm();
    const double height = plane.normal.dot(ball_.center() - plane.origin);
    if (!(std::abs(height) <= ball_.reach() * std::sqrt(squared))) return false;
    const Vector3d foot = ball_.center() - height / squared * plane.normal;
    int axis = 0;
    plane.normal.cwiseAbs().maxCoeff(&axis);
    return IsInLoops(own.loops, foot, axis);
  }

  // By the parity of a ray; the point is not within the slack of any border.
  bool IsInLoops(std::span<const std::span<const int>> loops, const Vector3d& x, int axis) const {
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    bool inside = false;
    for (const std::span<const int> loop : loops) {
      const Vector3d* u = &At(loop.back());
      for (const int point : loop) {
        const Vector3d* v = &At(point);
        if (((*u)[i] > x[i]) != ((*v)[i] > x[i])) {
          const Vector3d &low = (*u)[i] > x[i] ? *v : *u, &high = (*u)[i] > x[i] ? *u : *v;
          inside ^= (high[i] - low[i]) * (x[j] - low[j]) > (high[j] - low[j]) * (x[i] - low[i]);
        }
        u = v;
      }
    }
    return inside;
  }

  bool IsWanted(int c) const { return is_whole_ || is_selected_[c]; }

  void ClassifyPatches() {
    std::vector<int> largest(complex_.cells.size(), -1);
    std::vector<double> area(complex_.cells.size(), -1.0);
    for (int c = 0; c < cell_count(); ++c) {
      if (!IsWanted(c)) continue;
      const int p = patches_.of(c);
      const double own = SquaredAreaOf(cell(c).loops[0]);
      if (own > area[p]) area[p] = own, largest[p] = c;
    }
    is_kept_.assign(complex_.cells.size(), 0);
    triangles_.resize(complex_.cells.size());
    for (int p = 0; p < cell_count(); ++p) {
      if (area[p] < 0.0) continue;
      ++sum_.patches;
      if (!patches_.is_buried(p)) is_kept_[p] = IsOutsideM(largest[p]);
    }
  }

  double SquaredAreaOf(std::span<const int> loop) const {
    Vector3d twice = Vector3d::Zero();
    for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
      twice += (At(loop[k]) - At(loop[0])).cross(At(loop[k + 1]) - At(loop[0]));
    }
    return twice.squaredNorm();
  }

  const std::vector<std::array<int, 3>>& TrianglesOf(int c) {
    if (triangles_[c].empty()) {
      PutInOrder(cell(c).loops);
      triangles_[c] = TriangulateCell(&geometry_, arrangement_.groups[cell(c).group].plane, loops_);
    }
    return triangles_[c];
  }

  // Sets `loops_` to the same loops, each begun at its first point in the order of coordinates,
  // holes by that point: so that a cell is cut into the same triangles whatever else was there to
  // be numbered.
  void PutInOrder(std::span<const std::span<const int>> unordered) {
    points_of_loops_.clear();
    for (const std::span<const int> loop : unordered) {
      points_of_loops_.insert(points_of_loops_.end(), loop.begin(), loop.end());
    }
    const auto is_before = [&](int x, int y) {
      for (int axis = 0; axis < 3; ++axis) {
        const int sign = geometry_.Compare(x, y, axis);
        if (sign != 0) return sign < 0;
      }
      return false;
    };
    loops_.clear();
    auto begin = points_of_loops_.begin();
    for (const std::span<const int> loop : unordered) {
      const auto end = begin + std::ssize(loop);
      std::rotate(begin, std::min_element(begin, end, is_before), end);
      loops_.emplace_back(begin, end);
      begin = end;
    }
    std::sort(
        loops_.begin() + 1, loops_.end(),
        [&](std::span<const int> x, std::span<const int> y) { return is_before(x[0], y[0]); });
  }

  // By a sample point in the largest triangle of the cell.
  bool IsOutsideM(int c) {
    double largest = -1.0;
    std::array<int, 3> triangle{};
    for (const std::array<int, 3>& t : TrianglesOf(c)) {
      const double area = SquaredArea(geometry_, t);
      if (area > largest) largest = area, triangle = t;
    }
    if (largest < 0.0) return false;
    ++sum_.memberships;
    const Verdict verdict =
        VerdictIn(&geometry_, arrangement_.facets[FacetOf(c)], triangle, &cache_);
    sum_.detached_patches += verdict == Verdict::kSeparate;
    return verdict != Verdict::kOverlap;
  }

  int FacetOf(int c) const { return cell(c).along.empty() ? cell(c).against[0] : cell(c).along[0]; }

  bool IsMiddleInM(int x, int y) {
    ++sum_.memberships;
    return VerdictBetween(&geometry_, x, y, &cache_) == Verdict::kOverlap;
  }

  void AddCells() {
    int number = 0;
    for (int c = 0; c < cell_count(); ++c) {
      if (!is_selected_[c] || !IsKept(c)) continue;
      const bool is_along = !cell(c).along.empty();
      const bool is_sheet = is_along && !cell(c).against.empty();
      const Vector3d normal = geometry_.UnitNormal(FacetOf(c));
      for (std::array<int, 3> t : TrianglesOf(c)) {
        if (!is_along) std::swap(t[1], t[2]);
        for (int& point : t) point = AddPoint(point);
        (is_sheet ? sum_.sheets : sum_.triangles).push_back(t);
        (is_sheet ? sum_.facet_of_sheet : sum_.facet_of_triangle).push_back(FacetOf(c));
        if (is_sheet) continue;
        sum_.cell_of_triangle.push_back(number);
        sum_.triangle_normals.push_back(normal);
      }
      number += !is_sheet;
    }
  }

  int AddPoint(int point) {
    if (number_of_point_.empty()) number_of_point_.assign(geometry_.point_count(), -1);
    int& number = number_of_point_[point];
    if (number < 0) {
      number = static_cast<int>(sum_.vertices.size());
      const SumPoint& x = geometry_.Sharp(point);
      sum_.vertices.push_back(x.rounded / geometry_.pair().scale());
      sum_.rounding = std::max(sum_.rounding, x.error / geometry_.pair().scale());
      sum_.names.push_back(geometry_.NameOf(point));
    }
    return number;
  }

  // As for the whole boundary (boundary.cc), for pieces and points in the ball: there all planes
  // that pass are known.
  void AddLonePieces() {
    std::vector<char> is_near_kept(geometry_.point_count(), 0);
    for (int i = 0; i < static_cast<int>(complex_.pieces.size()); ++i) {
      if (is_near_[i] && IsNearKept(i)) MarkEnds(i, &is_near_kept);
    }
    std::vector<std::uint64_t> planes_of_points;
    for (int i = 0; i < static_cast<int>(complex_.pieces.size()); ++i) {
      const Piece& piece = complex_.pieces[i];
      if (!is_near_[i] || (is_near_kept[piece.from] && is_near_kept[piece.to])) continue;
      const std::vector<FacingPlane>& planes = PlanesOf(i);
      for (const int point : {piece.from, piece.to}) {
        if (is_near_kept[point] || !IsInBall(point)) continue;
        for (const FacingPlane& plane : planes) planes_of_points.push_back(KeyOf(point, plane));
      }
      if (IsNearKept(i) || planes.size() < 3) continue;
      if (IsMiddleInM(piece.from, piece.to)) continue;
      segments_.push_back(piece);
    }
    for (const Piece& piece : segments_) {
      is_near_kept[piece.from] = is_near_kept[piece.to] = 1;
      sum_.segments.push_back({AddPoint(piece.from), AddPoint(piece.to)});
    }
    AddLonePoints(std::move(planes_of_points), is_near_kept);
  }

  bool IsKept(int c) const { return is_kept_[patches_.of(c)] != 0; }

  bool IsNearKept(int piece) const {
    const std::span<const int> cells = patches_.CellsAt(piece);
    return std::any_of(cells.begin(), cells.end(), [&](int c) { return IsKept(c); });
  }

  void MarkEnds(int piece, std::vector<char>* marks) const {
    (*marks)[complex_.pieces[piece].from] = (*marks)[complex_.pieces[piece].to] = 1;
  }

  // The planes of the cells at a piece, by which way they face.
  const std::vector<FacingPlane>& PlanesOf(int piece) {
    planes_.clear();
    for (const int c : patches_.CellsAt(piece)) {
      const int root = arrangement_.groups[cell(c).group].plane;
      if (!cell(c).along.empty()) planes_.push_back({root, 1});
      if (!cell(c).against.empty()) planes_.push_back({root, 0});
    }
    std::sort(planes_.begin(), planes_.end());
    planes_.erase(std::unique(planes_.begin(), planes_.end()), planes_.end());
    return planes_;
  }

  // A point, a plane through it, and which way that faces: in one number, to be sorted.
  static std::uint64_t KeyOf(int point, const FacingPlane& plane) {
    return static_cast<std::uint64_t>(point) << 32 | static_cast<std::uint64_t>(plane[0]) << 1 |
           static_cast<std::uint64_t>(plane[1]);
  }

  void AddLonePoints(std::vector<std::uint64_t> planes_of_points,
                     const std::vector<char>& is_near_kept) {
    std::sort(planes_of_points.begin(), planes_of_points.end());
    const auto last = std::unique(planes_of_points.begin(), planes_of_points.end());
    for (auto first = planes_of_points.begin(); first != last;) {
      const int point = static_cast<int>(*first >> 32);
      planes_.clear();
      for (; first != last && static_cast<int>(*first >> 32) == point; ++first) {
        const auto plane = static_cast<std::uint32_t>(*first);
        planes_.push_back({static_cast<int>(plane >> 1), static_cast<int>(plane & 1)});
      }
      if (planes_.size() >= 4 && !is_near_kept[point] &&
          (!FaceOneSide(geometry_, planes_) || MayBeWithinFacet(point)) &&
          !IsMiddleInM(point, point)) {
        sum_.points.push_back(AddPoint(point));
      }
    }
  }

  // Whether a facet of another plane than `planes_` may hold the point, as far as doubles tell: one
  // that only a corner or an edge of others touches is not cut there.
  bool MayBeWithinFacet(int point) {
    if (facet_boxes_.empty()) ListFacetBoxes();
    const SumPoint& x = geometry_.point(point);
    const Vector3d reach = Vector3d::Constant(x.error);
    hits_.clear();
    facet_boxes_.Meeting({x.rounded - reach, x.rounded + reach}, &hits_);
    return std::any_of(hits_.begin(), hits_.end(), [&](int f) {
      const int root = geometry_.Root(arrangement_.facets[f].plane);
      if (std::any_of(planes_.begin(), planes_.end(),
                      [&](const FacingPlane& each) { return each[0] == root; })) {
        return false;
      }
      const SumPlane& plane = geometry_.plane(arrangement_.facets[f].plane);
      const Vector3d way = x.rounded - plane.origin;
      const double error =
          1.01 * (x.error + plane.origin_error + kUnit * way.cwiseAbs().maxCoeff());
      return TriageSign(HeightAlong(plane.normal, plane.normal_error, way, error)) == 0;
    });
  }

  void ListFacetBoxes() {
    for (const ArrangedFacet& facet : arrangement_.facets) {
      Box3 box{At(facet.corners[0]), At(facet.corners[0])};
      for (const int corner : facet.corners) {
        const SumPoint& x = geometry_.point(corner);
        box.low = box.low.cwiseMin(x.rounded - Vector3d::Constant(x.error));
        box.high = box.high.cwiseMax(x.rounded + Vector3d::Constant(x.error));
      }
      facet_boxes_.Add(box);
    }
  }

  bool IsInBall(int point) const { return (At(point) - ball_.center()).norm() <= ball_.reach(); }

  // Lists the facets that the output mentions, and numbers them anew.
  void NumberFacets() {
    std::vector<int> number(gathered_.facets.size(), -1);
    const auto mention = [&](int facet) {
      if (facet >= 0) number[facet] = 0;
    };
    for (const int f : sum_.facet_of_triangle) mention(f);
    for (const int f : sum_.facet_of_sheet) mention(f);
    for (const SumPointName& name : sum_.names) {
      for (const int f : name.facets) mention(f);
    }
    for (std::size_t f = 0; f < number.size(); ++f) {
      if (number[f] < 0) continue;
      number[f] = static_cast<int>(sum_.facets.size());
      sum_.facets.push_back(gathered_.facets[f]);
    }
    for (int& f : sum_.facet_of_triangle) f = number[f];
    for (int& f : sum_.facet_of_sheet) f = number[f];
    for (SumPointName& name : sum_.names) {
      for (int& f : name.facets) f = f < 0 ? f : number[f];
    }
  }

  SumGeometry& geometry_;
  const GatheredFacets& gathered_;
  const ScaledBall& ball_;
  const bool is_whole_;
  MembershipCache& cache_;
  LocalSum& sum_;
  Arrangement arrangement_;
  CellComplex complex_;
  std::vector<char> is_near_;      // pieces: in the ball
  std::vector<char> is_selected_;  // cells: meet the ball
  Patches patches_;
  std::vector<char> is_kept_;                               // by patch
  std::vector<std::vector<std::array<int, 3>>> triangles_;  // by cell
  std::vector<int> points_of_loops_;                        // scratch
  std::vector<std::span<const int>> loops_;                 // scratch
  std::vector<FacingPlane> planes_;                         // scratch
  std::vector<Piece> segments_;
  BoxLanes facet_boxes_;  // of the arrangement's facets, once they are asked for
  std::vector<int> hits_;
  std::vector<int> number_of_point_;  // in the sum; -1: not there
};

}  // namespace

void AssembleLocalSum(SumGeometry* geometry, const GatheredFacets& gathered, const ScaledBall& ball,
                      AssemblyScope scope, MembershipCache* cache, LocalSum* sum) {
  Assembler(geometry, gathered, ball, scope, cache, sum).Run();
  FindNeighbors(sum);
  FindVertexNormals(sum);
}

}  // namespace touchstone::internal
