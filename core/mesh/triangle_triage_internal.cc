// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "touchstone/core/mesh/triangle_contact_internal.h"

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

constexpr double kUnderflow = 0x1p-1000;

double MaxAbs(const Vector3d& v) { return v.cwiseAbs().maxCoeff(); }

// Everything about two triangles that doubles can tell.
class Triager {
 public:
  Triager(const MeshPair& pair, int face_a, int face_b, const Offset& offset)
      : pair_(pair), face_a_(face_a), face_b_(face_b), offset_(offset) {
    for (int k = 0; k < 3; ++k) {
      a_[k] = pair.a().points[pair.a().mesh.face(face_a)[k]];
      b_[k] = pair.b().points[pair.b().mesh.face(face_b)[k]] + offset.value;
    }
  }

  Triage Run() {
    const FacePlane& plane_a = pair_.a().planes[face_a_];
    const Vector3d& origin_a = pair_.a().points[plane_a.vertex];
    for (int k = 0; k < 3; ++k) {
      sides_of_b_[k] =
          TriageSign(HeightAlong(plane_a.normal, plane_a.error, b_[k] - origin_a, offset_.error));
    }
    if (AreAllOnOneSide(sides_of_b_)) return Triage::kApart;
    const FacePlane& plane_b = pair_.b().planes[face_b_];
    const Vector3d origin_b = pair_.b().points[plane_b.vertex] + offset_.value;
    for (int k = 0; k < 3; ++k) {
      sides_of_a_[k] =
          TriageSign(HeightAlong(plane_b.normal, plane_b.error, a_[k] - origin_b, offset_.error));
    }
    if (AreAllOnOneSide(sides_of_a_)) return Triage::kApart;
    return CompareEdges();
  }

 private:
  static bool AreAllOnOneSide(const int (&sides)[3]) {
    return sides[0] != 0 && sides[0] == sides[1] && sides[1] == sides[2];
  }

  // The triangles share a point iff an edge of one meets the other: all six must be cleared.
  Triage CompareEdges() {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) turns_[i][j] = TurnOfEdges(i, j);
    }
    bool is_clear = true;
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      const Triage of_b = EdgeAgainst(sides_of_b_[k], sides_of_b_[next],
                                      {turns_[0][k], turns_[1][k], turns_[2][k]});
      const Triage of_a = EdgeAgainst(sides_of_a_[k], sides_of_a_[next],
                                      {turns_[k][0], turns_[k][1], turns_[k][2]});
      if (of_a == Triage::kCross || of_b == Triage::kCross) return Triage::kCross;
      is_clear &= of_a == Triage::kApart && of_b == Triage::kApart;
    }
    return is_clear ? Triage::kApart : Triage::kUnsure;
  }

  // An edge whose ends lie on these sides of the triangle's plane and whose line passes the
  // triangle's sides with these turns: it passes through iff the ends lie on either side and all
  // turns agree.
  static Triage EdgeAgainst(int side, int next_side, const std::array<int, 3>& turns) {
    if (side != 0 && side == next_side) return Triage::kApart;
    const auto [least, greatest] = std::minmax_element(turns.begin(), turns.end());
    if (*least < 0 && *greatest > 0) return Triage::kApart;
    const bool all_agree = *least == *greatest && *least != 0;
    return all_agree && side * next_side < 0 ? Triage::kCross : Triage::kUnsure;
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
  const Offset& offset_;
  Vector3d a_[3], b_[3];
  int sides_of_a_[3], sides_of_b_[3];
  int turns_[3][3];
};

}  // namespace

// A point of B plus the offset, minus a point of A: the points' own errors, that of the offset, and
// two roundings of numbers of at most 2 + |offset|.
Offset MakeOffset(const MeshPair& pair, const Translation& x) {
  const Vector3d value = pair.scale() * x.value;
  const double error = 1.01 * (pair.a().point_error + pair.b().point_error +
                               pair.scale() * x.error + 2.0 * kUnit * (2.0 + MaxAbs(value))) +
                       kUnderflow;
  return {value, error};
}

Triage TriageTriangles(const MeshPair& pair, int face_a, int face_b, const Offset& offset) {
  return Triager(pair, face_a, face_b, offset).Run();
}

}  // namespace touchstone::internal
