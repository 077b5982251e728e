// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "touchstone/core/mesh/triangle_contact_internal.h"

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

double MaxAbs(const Vector3d& v) { return v.cwiseAbs().maxCoeff(); }

// Everything about two triangles that doubles can tell.
class Triager {
 public:
  Triager(const MeshPair& pair, int face_a, int face_b, const Offset& offset, Crossing* crossing)
      : pair_(pair),
        face_a_(face_a),
        face_b_(face_b),
        corners_a_(pair.a().mesh.face(face_a)),
        corners_b_(pair.b().mesh.face(face_b)),
        offset_(offset),
        crossing_(crossing) {}

  Triage Run() {
    if (PlaneOfA() || PlaneOfB()) return Triage::kApart;
    return CompareEdges();
  }

 private:
  static bool AreAllOnOneSide(const int (&sides)[3]) {
    return sides[0] != 0 && sides[0] == sides[1] && sides[1] == sides[2];
  }

  // Whether the plane of A's face parts the triangles. Most pairs end here: no branch but the last.
  bool PlaneOfA() {
    const FacePlane& plane = pair_.a().planes[face_a_];
    const double height = plane.height - plane.normal.dot(offset_.value);
    const double least = LeastHeight(plane, offset_);
    const auto& points = pair_.b().points;
    const double heights[3] = {plane.normal.dot(points[corners_b_[0]]) - height,
                               plane.normal.dot(points[corners_b_[1]]) - height,
                               plane.normal.dot(points[corners_b_[2]]) - height};
    if (AreAllBeyond(heights, least)) return true;
    const Vector3d& origin = pair_.a().points[plane.vertex];
    for (int k = 0; k < 3; ++k) {
      b_[k] = points[corners_b_[k]] + offset_.value;
      sides_of_b_[k] = SideOf(plane, heights[k], least, b_[k] - origin);
    }
    return AreAllOnOneSide(sides_of_b_);
  }

  bool PlaneOfB() {
    const FacePlane& plane = pair_.b().planes[face_b_];
    const double height = plane.height + plane.normal.dot(offset_.value);
    const double least = LeastHeight(plane, offset_);
    const auto& points = pair_.a().points;
    const double heights[3] = {plane.normal.dot(points[corners_a_[0]]) - height,
                               plane.normal.dot(points[corners_a_[1]]) - height,
                               plane.normal.dot(points[corners_a_[2]]) - height};
    if (AreAllBeyond(heights, least)) return true;
    const Vector3d origin = pair_.b().points[plane.vertex] + offset_.value;
    for (int k = 0; k < 3; ++k) {
      a_[k] = points[corners_a_[k]];
      sides_of_a_[k] = SideOf(plane, heights[k], least, a_[k] - origin);
    }
    return AreAllOnOneSide(sides_of_a_);
  }

  static bool AreAllBeyond(const double (&heights)[3], double least) {
    const double low = std::min(std::min(heights[0], heights[1]), heights[2]);
    const double high = std::max(std::max(heights[0], heights[1]), heights[2]);
    return (low > least) | (high < -least);
  }

  int SideOf(const FacePlane& plane, double height, double least,
             const Vector3d& difference) const {
    if (height > least) return 1;
    if (height < -least) return -1;
    return TriageSign(HeightAlong(plane.normal, plane.error, difference, offset_.error));
  }

  // The triangles share a point iff an edge of one meets the other: all six must be cleared.
  Triage CompareEdges() {
    FindLeastTurn();
    if (HasNoZero(sides_of_a_) && HasNoZero(sides_of_b_)) return CompareOnLine();
    for (int k = 0; k < 3; ++k) FindEdgeOfA(k), FindEdgeOfB(k);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) turns_[i][j] = Turn(i, j);
    }
    bool is_clear = true;
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      const Triage of_b = EdgeAgainst(sides_of_b_[k], sides_of_b_[next],
                                      {turns_[0][k], turns_[1][k], turns_[2][k]});
      if (of_b == Triage::kCross) return Cross(false, k);
      const Triage of_a = EdgeAgainst(sides_of_a_[k], sides_of_a_[next],
                                      {turns_[k][0], turns_[k][1], turns_[k][2]});
      if (of_a == Triage::kCross) return Cross(true, k);
      is_clear &= of_a == Triage::kApart && of_b == Triage::kApart;
    }
    return is_clear ? Triage::kApart : Triage::kUnsure;
  }

  static bool HasNoZero(const int (&sides)[3]) {
    return sides[0] != 0 && sides[1] != 0 && sides[2] != 0;
  }

  // No corner lies in the other's plane, so two edges of each triangle pass through it, and hold
  // the ends of what the line that the planes share has of the triangle: four turns tell the order
  // of these ends. An end strictly between the other triangle's is a crossing.
  Triage CompareOnLine() {
    int edges_a[2], edges_b[2];
    FindPassing(sides_of_a_, edges_a);
    FindPassing(sides_of_b_, edges_b);
    for (int k = 0; k < 2; ++k) FindEdgeOfA(edges_a[k]), FindEdgeOfB(edges_b[k]);
    int turns[2][2];
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) turns[i][j] = Turn(edges_a[i], edges_b[j]);
    }
    bool is_clear = true;
    for (int k = 0; k < 2; ++k) {
      // Of the two edges one passes upward, one downward: equal turns are different sides.
      const int of_a = turns[k][0] * turns[k][1], of_b = turns[0][k] * turns[1][k];
      if (of_b > 0) return Cross(false, edges_b[k]);
      if (of_a > 0) return Cross(true, edges_a[k]);
      is_clear &= of_a < 0 && of_b < 0;
    }
    return is_clear ? Triage::kApart : Triage::kUnsure;
  }

  static void FindPassing(const int (&sides)[3], int edges[2]) {
    // The corner that is alone on its side.
    const int alone = sides[0] == sides[1] ? 2 : sides[0] == sides[2] ? 1 : 0;
    edges[0] = alone;
    edges[1] = (alone + 2) % 3;
  }

  Triage Cross(bool edge_is_of_a, int side) {
    *crossing_ = edge_is_of_a ? Crossing{true, 3 * face_a_ + side, face_b_}
                              : Crossing{false, 3 * face_b_ + side, face_a_};
    return Triage::kCross;
  }

  // An edge whose ends lie on these sides of the triangle's plane and whose line passes the
  // triangle's sides with these turns: it passes through iff the ends lie on either side and all
  // turns agree.
  static Triage EdgeAgainst(int side, int next_side, const std::array<int, 3>& turns) {
    if (side != 0 && side == next_side) return Triage::kApart;
    const int least = std::min({turns[0], turns[1], turns[2]});
    const int greatest = std::max({turns[0], turns[1], turns[2]});
    if (least < 0 && greatest > 0) return Triage::kApart;
    const bool all_agree = least == greatest && least != 0;
    return all_agree && side * next_side < 0 ? Triage::kCross : Triage::kUnsure;
  }

  // Seen from A's first corner: edge i of A is u_i from p_i, edge j of B v_j from r_j.
  void FindEdgeOfA(int i) {
    u_[i] = a_[i == 2 ? 0 : i + 1] - a_[i];
    moments_of_a_[i] = (a_[i] - a_[0]).cross(u_[i]);
  }
  void FindEdgeOfB(int j) {
    v_[j] = b_[j == 2 ? 0 : j + 1] - b_[j];
    moments_of_b_[j] = v_[j].cross(b_[j] - a_[0]);
  }

  // The sign of u_i x v_j . (r_j - p_i) = u_i . (v_j x r_j) - v_j . (p_i x u_i).
  int Turn(int i, int j) const {
    const double turn = u_[i].dot(moments_of_b_[j]) - v_[j].dot(moments_of_a_[i]);
    return turn > least_turn_ ? 1 : turn < -least_turn_ ? -1 : TurnOfEdges(i, j);
  }

  // Differences of points of A are off by the offset's error e at most, of B by twice that. With
  // these added to their sizes, either product of three changes by at most 6 (e |v||r| + |u| 2 e
  // |r| + |u||v| e), and is rounded by 5.1 units of 6 |u||v||r|. No p is longer than `size` either.
  void FindLeastTurn() {
    const auto longest = [](const Vector3d& p, const Vector3d& q, const Vector3d& r) {
      return ((p.cwiseMax(q).cwiseMax(r)) - p.cwiseMin(q).cwiseMin(r)).maxCoeff();
    };
    const double e = offset_.error;
    const double of_a = longest(a_[0], a_[1], a_[2]), of_b = longest(b_[0], b_[1], b_[2]);
    const double lu = of_a + e, lv = of_b + 2.0 * e;
    // B's points are as far from a_0 as b_0 is and a side, at most.
    const double size = std::max(of_a, 1.01 * (MaxAbs(b_[0] - a_[0]) + of_b)) + e;
    least_turn_ =
        1.02 * 12.0 * (e * (lv * size + 2.0 * lu * size + lu * lv) + 6.2 * kUnit * lu * lv * size) +
        kUnderflow;
  }

  // The sign of (edge i of A) x (edge j of B) . (from A's edge to B's).
  int TurnOfEdges(int i, int j) const {
    const Vector3d edge_a = a_[(i + 1) % 3] - a_[i];
    const Vector3d edge_b = b_[(j + 1) % 3] - b_[j];
    // A difference of two points of A is rounded once; one of two points of B is off by twice
    // what a difference between A and B is.
    const double la = MaxAbs(edge_a), lb = MaxAbs(edge_b), error_b = 2.0 * offset_.error;
    // As for a plane's normal: two roundings on each of two paths, and the data.
    const double error = 1.01 * (2.0 * la * error_b + 6.2 * kUnit * la * lb) + kUnderflow;
    return TriageSign(HeightAlong(edge_a.cross(edge_b), error, b_[j] - a_[i], offset_.error));
  }

  const MeshPair& pair_;
  const int face_a_, face_b_;
  const Triangle &corners_a_, &corners_b_;
  const Offset& offset_;
  Crossing* const crossing_;
  Vector3d a_[3], b_[3];
  Vector3d u_[3], v_[3], moments_of_a_[3], moments_of_b_[3];
  double least_turn_;
  int sides_of_a_[3], sides_of_b_[3];
  int turns_[3][3];
};

}  // namespace

// A point of B plus the offset, minus a point of A: the points' own errors, that of the offset, and
// two roundings of numbers of at most 2 + |offset|.
//
// Heights in parts, n . b + n . x - n . a: coordinates of points are at most 1 and no difference is
// above reach = 2 + |x|, so the three products are off by 3.01 units of |n| reach at most and their
// sums by 2.02, all within 3 |n| error, as the error is 2.02 units of reach at least. The data add
// |n| error, and what the normal is off by times three coordinates of a difference and its error.
Offset MakeOffset(const MeshPair& pair, const Translation& x) {
  const Vector3d value = pair.scale() * x.value;
  const double error = 1.01 * (pair.a().point_error + pair.b().point_error +
                               pair.scale() * x.error + 2.0 * kUnit * (2.0 + MaxAbs(value))) +
                       kUnderflow;
  const double reach = 2.0 + MaxAbs(value);
  return {value, error, 4.04 * error, 3.03 * (reach + error)};
}

Triage TriageTriangles(const MeshPair& pair, int face_a, int face_b, const Offset& offset,
                       Crossing* crossing) {
  return Triager(pair, face_a, face_b, offset, crossing).Run();
}

}  // namespace touchstone::internal
