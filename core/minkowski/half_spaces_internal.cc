// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/half_spaces_internal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace touchstone::internal {

using Eigen::Vector3d;
using Height = HalfSpaceIntersection::Height;

int Compare(const Height& a, const Height& b) {
  return (a.numerator * b.denominator).compare(b.numerator * a.denominator);
}

// A corner of other planes is within w |n|^2 / det of the origin, at most 2^(3 digits + 4) times
// what its coordinates are counted in.
HalfSpaceIntersection::HalfSpaceIntersection(int digits) {
  const Integer far = Integer(1) << (3 * digits + 64);
  for (const auto& [x, y, z] :
       {std::array{1, 1, 1}, std::array{1, -1, -1}, std::array{-1, 1, -1}, std::array{-1, -1, 1}}) {
    const IntegerVector normal = {Integer(x), Integer(y), Integer(z)};
    AddPlane(MakeDirection(normal), {normal, far});
  }
  pole_exponent_ = 0;
  poles_.assign(kSimplexPlanes, Vector3d::Zero());
  // Opposite each plane the other three, counterclockwise.
  corners_ = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  for (Corner& t : corners_) {
    if (TurnOf(directions_[t[0]], directions_[t[1]], directions_[t[2]]) < 0) std::swap(t[1], t[2]);
  }
  neighbors_.resize(4);
  marks_.assign(4, 0);
  for (int t = 0; t < 4; ++t) {
    // Across from the side between two planes lies the corner without the third.
    for (int k = 0; k < 3; ++k) neighbors_[t][k] = corners_[t][(k + 2) % 3];
    for (const int plane : corners_[t]) corner_of_plane_[plane] = t;
  }
}

void HalfSpaceIntersection::AddPlane(const Direction& direction, const HalfSpace& half_space) {
  directions_.push_back(direction);
  planes_.push_back(half_space);
  corner_of_plane_.push_back(-1);
  plane_marks_.push_back(0);
  corner_from_.push_back(-1);
  int exponent = 0;
  const double offset = ToScaledDouble(half_space.offset, &exponent);
  Vector3d pole;
  for (int i = 0; i < 3; ++i) {
    int e = 0;
    const double x = ToScaledDouble(half_space.normal[i], &e) / offset;
    // The first plane that is not of the simplex gives the unit.
    if (i == 0 && plane_count() == kSimplexPlanes + 1) {
      pole_exponent_ = DigitsOf(half_space.normal) - exponent;
    }
    pole[i] = std::ldexp(x, e - exponent - pole_exponent_);
  }
  poles_.push_back(pole);
}

int HalfSpaceIntersection::IndexOf(int t, int plane) const {
  return corners_[t][0] == plane ? 0 : corners_[t][1] == plane ? 1 : 2;
}

int HalfSpaceIntersection::PlaneAcross(int t, int k) const {
  const int across = neighbors_[t][k];
  // It runs the shared edge the other way, so the third plane follows plane k there.
  return corners_[across][(IndexOf(across, corners_[t][k]) + 1) % 3];
}

// Crossing an edge that the direction lies beyond raises the corner along it, so no corner comes
// twice.
int HalfSpaceIntersection::Locate(const Direction& direction) const {
  int t = last_;
  for (int k = 0; k < 3;) {
    const Direction &a = directions_[corners_[t][k]], &b = directions_[corners_[t][(k + 1) % 3]];
    if (TurnOf(a, b, direction) < 0) {
      t = neighbors_[t][k];
      k = 0;
    } else {
      ++k;
    }
  }
  return t;
}

// With rows (n, w), det [a b c m] = det [n_a n_b n_c] w_m - (what w would be for a plane through
// the corner); over the offsets it is the orientation of the poles n / w. Each pole is off by
// 2^-50 of its size at most, a difference of two by twice that and a rounding; the determinant is
// six products of three such numbers.
int HalfSpaceIntersection::CutsOff(int plane, int corner) const {
  const auto& [a, b, c] = corners_[corner];
  const Vector3d& pole = poles_[plane];
  const Vector3d u = poles_[a] - pole, v = poles_[b] - pole, w = poles_[c] - pole;
  const double size = std::max({pole.cwiseAbs().maxCoeff(), poles_[a].cwiseAbs().maxCoeff(),
                                poles_[b].cwiseAbs().maxCoeff(), poles_[c].cwiseAbs().maxCoeff()});
  const double e = 0x1p-48 * size;
  const double lu = u.cwiseAbs().maxCoeff() + e, lv = v.cwiseAbs().maxCoeff() + e,
               lw = w.cwiseAbs().maxCoeff() + e;
  const double bound =
      1.1 * (6.0 * e * (lu * lv + lv * lw + lw * lu) + 60.0 * 0x1p-52 * lu * lv * lw) + 0x1p-1000;
  const double value = u.dot(v.cross(w));
  if (value > bound) return -1;
  if (value < -bound) return 1;
  const Height height = HeightOf(corner, planes_[plane].normal);
  return height.numerator.compare(planes_[plane].offset * height.denominator);
}

Height HalfSpaceIntersection::HeightOf(int corner, const IntegerVector& normal) const {
  const auto& [a, b, c] = corners_[corner];
  const IntegerVector &na = planes_[a].normal, &nb = planes_[b].normal, &nc = planes_[c].normal;
  const IntegerVector bc = Cross(nb, nc);
  return {planes_[a].offset * Dot(normal, bc) + planes_[b].offset * Dot(normal, Cross(nc, na)) +
              planes_[c].offset * Dot(normal, Cross(na, nb)),
          Dot(na, bc)};
}

void HalfSpaceIntersection::MarkCutOff(int plane, int corner) {
  ++mark_;
  cut_.clear();
  Mark(corner);
  for (std::size_t i = 0; i < cut_.size(); ++i) {
    for (const int next : neighbors_[cut_[i]]) {
      if (!IsMarked(next) && CutsOff(plane, next) > 0) Mark(next);
    }
  }
}

bool HalfSpaceIntersection::LosesPlane() {
  for (const int t : cut_) {
    for (int k = 0; k < 3; ++k) {
      if (IsMarked(neighbors_[t][k])) continue;
      plane_marks_[corners_[t][k]] = plane_marks_[corners_[t][(k + 1) % 3]] = mark_;
    }
  }
  for (const int t : cut_) {
    for (const int plane : corners_[t]) {
      if (plane >= kSimplexPlanes && plane_marks_[plane] != mark_) return true;
    }
  }
  return false;
}

int HalfSpaceIntersection::NewCorner() {
  if (!free_corners_.empty()) {
    const int t = free_corners_.back();
    free_corners_.pop_back();
    return t;
  }
  corners_.emplace_back();
  neighbors_.emplace_back();
  marks_.push_back(0);
  return corner_count() - 1;
}

void HalfSpaceIntersection::Replace(int plane) {
  std::vector<int> added;
  for (const int t : std::vector<int>(cut_)) {
    for (const int p : corners_[t]) corner_of_plane_[p] = -1;
  }
  for (const int t : cut_) {
    for (int k = 0; k < 3; ++k) {
      const int outside = neighbors_[t][k];
      if (IsMarked(outside)) continue;
      const int from = corners_[t][k], to = corners_[t][(k + 1) % 3];
      const int fresh = NewCorner();
      marks_[fresh] = 0;
      corners_[fresh] = {from, to, plane};
      neighbors_[fresh] = {outside, -1, -1};
      neighbors_[outside][(IndexOf(outside, to))] = fresh;
      corner_from_[from] = fresh;
      added.push_back(fresh);
    }
  }
  for (const int t : added) {
    const int next = corner_from_[corners_[t][1]];
    neighbors_[t][1] = next;
    neighbors_[next][2] = t;
    for (const int p : corners_[t]) corner_of_plane_[p] = t;
  }
  for (const int t : cut_) {
    corners_[t] = {-1, -1, -1};
    free_corners_.push_back(t);
  }
  last_ = added.front();
}

void HalfSpaceIntersection::Cut(const Direction& direction, const HalfSpace& half_space,
                                bool keep_all) {
  const int t = Locate(direction);
  AddPlane(direction, half_space);
  const int plane = plane_count() - 1;
  if (CutsOff(plane, t) > 0) {
    MarkCutOff(plane, t);
    if (!keep_all || !LosesPlane()) {
      Replace(plane);
      return;
    }
  }
  if (!keep_all) return;
  directions_.pop_back();
  planes_.pop_back();
  poles_.pop_back();
  corner_of_plane_.pop_back();
  plane_marks_.pop_back();
  corner_from_.pop_back();
  const int corners[] = {t};
  CutCorners(direction, corners, [](int, int) { return false; });
}

std::optional<int> HalfSpaceIntersection::CutCorners(const Direction& direction,
                                                     std::span<const int> corners,
                                                     const EdgeTest& is_kept) {
  ++mark_;
  cut_.clear();
  std::optional<Height> low, next_below;
  for (const int t : corners) {
    Height height = HeightOf(t, direction.exact);
    if (!low || Compare(height, *low) < 0) low = std::move(height);
    Mark(t);
  }
  for (std::size_t i = 0; i < cut_.size(); ++i) {
    for (const int t : neighbors_[cut_[i]]) {
      if (IsMarked(t)) continue;
      Height height = HeightOf(t, direction.exact);
      if (Compare(height, *low) >= 0) {
        Mark(t);
      } else if (!next_below || Compare(height, *next_below) > 0) {
        next_below = std::move(height);
      }
    }
  }
  for (const int t : cut_) {
    for (int k = 0; k < 3; ++k) {
      if (IsMarked(neighbors_[t][k]) && is_kept(corners_[t][k], corners_[t][(k + 1) % 3])) {
        return std::nullopt;
      }
    }
  }
  if (LosesPlane()) return std::nullopt;
  // Halfway between the two, on a grid at least four times as fine as the gap.
  const Integer both = low->denominator * next_below->denominator;
  const Integer high_part = low->numerator * next_below->denominator;
  const Integer low_part = next_below->numerator * low->denominator;
  const int gap_digits = static_cast<int>(msb(both)) - static_cast<int>(msb(high_part - low_part));
  const int shift = std::max(0, gap_digits + 3);
  const Integer offset = ((high_part + low_part) << shift) / (both << 1);
  AddPlane(direction, {Shifted(direction.exact, shift), offset});
  const int plane = plane_count() - 1;
  Replace(plane);
  return plane;
}

}  // namespace touchstone::internal
