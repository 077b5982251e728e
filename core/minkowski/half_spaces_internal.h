// SPDX-License-Identifier: MIT
//
//   paper             here                     meaning
//   t_i, h_i          HalfSpace                n.x <= w, w > 0: below the plane of a face
//   Intersection(H)   HalfSpaceIntersection    a convex polyhedron round the origin
#ifndef TOUCHSTONE_CORE_MINKOWSKI_HALF_SPACES_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_HALF_SPACES_INTERNAL_H_

#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "touchstone/core/minkowski/directions_internal.h"

namespace touchstone::internal {

// {x : normal.x <= offset}, the offset positive.
struct HalfSpace {
  IntegerVector normal;
  Integer offset;
};

// The intersection of half-spaces, cut down by one after the other; every sign exact.
//
// A corner is where three planes meet; where more meet, there are several corners in one place,
// with flat edges between them. Seen as a Gauss map: the planes are points of the sphere, and each
// corner is the triangle of its planes, counterclockwise.
class HalfSpaceIntersection {
 public:
  using Corner = std::array<int, 3>;
  // Where a plane along some direction would pass the corner: a fraction, of positive denominator.
  struct Height {
    Integer numerator, denominator;
  };
  using EdgeTest = std::function<bool(int, int)>;

  // Begins with a simplex so large that it holds whatever planes round the origin enclose:
  // `digits` is at least that of every coordinate and offset to come.
  explicit HalfSpaceIntersection(int digits);

  // Cuts with a plane, by the name of the next number. Should it cut nothing off, or all that is
  // left of another plane, then either it is moved inwards, or outwards, until it cuts off the one
  // corner that is furthest along its normal and nothing else (`keep_all`); or, if not, the plane
  // that has no share in the surface is left out.
  void Cut(const Direction& direction, const HalfSpace& half_space, bool keep_all);

  // Cuts off the corners listed, and those beyond the lowest of them along the normal that hang
  // together with them, and nothing else, by a plane between these and the next corner. Returns the
  // plane's number; nothing, and changes nothing, if there is no such plane, or if an edge between
  // two of these corners is one that `is_kept` names, or if a plane would be lost.
  std::optional<int> CutCorners(const Direction& direction, std::span<const int> corners,
                                const EdgeTest& is_kept);

  int plane_count() const { return static_cast<int>(planes_.size()); }
  static constexpr int kSimplexPlanes = 4;  // the first, of the simplex
  const Direction& direction(int plane) const { return directions_[plane]; }
  const HalfSpace& plane(int i) const { return planes_[i]; }

  int corner_count() const { return static_cast<int>(corners_.size()); }
  bool is_alive(int corner) const { return corners_[corner][0] >= 0; }
  const Corner& corner(int t) const { return corners_[t]; }
  // Across the edge between planes k and k + 1 of a corner.
  int neighbor(int t, int k) const { return neighbors_[t][k]; }
  // A corner of the plane, or -1 if it has none.
  int corner_of_plane(int plane) const { return corner_of_plane_[plane]; }
  int IndexOf(int t, int plane) const;
  // The corner across edge k, and which of its planes is not in t.
  int PlaneAcross(int t, int k) const;
  // The corner whose triangle holds the direction.
  int Locate(const Direction& direction) const;

  // Whether a plane cuts the corner off (1), passes through it (0), or passes beyond it (-1).
  int CutsOff(int plane, int corner) const;
  bool IsFlat(int t, int k) const { return CutsOff(PlaneAcross(t, k), t) == 0; }
  Height HeightOf(int corner, const IntegerVector& normal) const;

 private:
  void AddPlane(const Direction& direction, const HalfSpace& half_space);
  bool IsMarked(int corner) const { return marks_[corner] == mark_; }
  void Mark(int corner) {
    marks_[corner] = mark_;
    cut_.push_back(corner);
  }
  // Marks all corners that the plane cuts off, from one of them.
  void MarkCutOff(int plane, int corner);
  // Whether all corners of some plane (not of the simplex) are marked.
  bool LosesPlane();
  // Puts the plane's face in the place of the marked corners.
  void Replace(int plane);
  int NewCorner();

  std::vector<Direction> directions_;
  std::vector<HalfSpace> planes_;
  std::vector<Eigen::Vector3d> poles_;  // normal / offset * 2^-pole_exponent_, within 2^-50 of size
  int pole_exponent_ = 0;
  std::vector<Corner> corners_;
  std::vector<std::array<int, 3>> neighbors_;
  std::vector<int> free_corners_, corner_of_plane_;
  std::vector<int> marks_, plane_marks_, corner_from_;
  std::vector<int> cut_;
  int mark_ = 0, last_ = 0;
};

int Compare(const HalfSpaceIntersection::Height& a, const HalfSpaceIntersection::Height& b);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_HALF_SPACES_INTERNAL_H_
