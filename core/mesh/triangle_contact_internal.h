// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MESH_TRIANGLE_CONTACT_INTERNAL_H_
#define TOUCHSTONE_CORE_MESH_TRIANGLE_CONTACT_INTERNAL_H_

#include <Eigen/Core>
#include <array>
#include <optional>
#include <set>

#include "touchstone/core/base/orientation.h"
#include "touchstone/core/base/verdict.h"
#include "touchstone/core/mesh/crossing_prism.h"
#include "touchstone/core/mesh/link.h"
#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/mesh/translation.h"

namespace touchstone::internal {

// Where B is in a query, scaled: its points are those of the placed mesh plus `value`. The
// difference of such a point and a point of A, formed in doubles, is off by at most `error` in each
// coordinate, its own roundings included.
struct Offset {
  Eigen::Vector3d value;
  double error;
  // What bounds the error of a height above a plane, formed in parts: times the plane's length, and
  // times its normal's error.
  double for_length, for_error;
};
inline constexpr double kUnderflow = 0x1p-1000;
Offset MakeOffset(const MeshPair& pair, const Translation& x);
// The least height of a point over a plane that is one for certain, where the point, the plane's
// own and the offset were multiplied by the normal apart.
inline double LeastHeight(const FacePlane& plane, const Offset& offset) {
  return offset.for_length * plane.length + offset.for_error * plane.error + kUnderflow;
}

// What doubles prove of two closed triangles.
enum class Triage {
  kApart,  // they share no point
  kCross,  // an edge of one passes through the other, each strictly within: there solids overlap
  kUnsure,
};
// Where they cross, `crossing` is set.
Triage TriageTriangles(const MeshPair& pair, int face_a, int face_b, const Offset& offset,
                       Crossing* crossing);

// Where surfaces meet, exactly, and whether solids overlap there.
//
// The points that two triangles share form points, segments and polygons. Each corner of these is a
// vertex of one body on a face, edge or vertex of the other, or a crossing of two edges, or of an
// edge and a face. Near any other point the bodies look as they do near a corner, seen along the
// segment or polygon, so only corners are looked at. Where an edge crosses a face, solids overlap.
// At other corners the links of the two features are compared: that depends on the features and
// the rotation, not on the translation, and is done once for each pair of features.
class ExactContact {
 public:
  ExactContact(const MeshPair& pair, const Translation& x);

  // kOverlap if the solids overlap near a corner of what the two triangles share (corners met
  // before are not looked at again), else kTouch if they share anything, else kSeparate.
  Verdict Meet(int face_a, int face_b);

  // The point of A or of B + x, times one positive factor common to both.
  DyadicVector PointOfA(int v);
  DyadicVector PointOfB(int v);

 private:
  struct Corners {  // of a pair of triangles
    int face_a, face_b;
    std::array<DyadicVector, 3> a, b;
    DyadicVector normal_a, normal_b;
  };
  using Points = std::array<DyadicVector, 3>;

  // Looks at a contact of two features; whether the solids overlap there, if it is a new one.
  bool Overlaps(Feature a, Feature b);
  Link LinkAt(bool is_a, Feature feature) const;
  // What of the triangle the point, in its plane, lies on; nothing if it lies off it.
  static std::optional<Feature> On(const TriangleMesh& mesh, int face, const Points& corners,
                                   const DyadicVector& normal, const DyadicVector& point);
  bool VerticesMeet(const Corners& c, const std::array<int, 3>& sides_of_a,
                    const std::array<int, 3>& sides_of_b);
  bool EdgesMeet(const Corners& c);
  static bool EdgePassesThrough(const DyadicVector& from, const DyadicVector& to,
                                const Points& triangle);

  const MeshPair& pair_;
  ExactMeshPair exact_;
  DyadicVector shift_;  // x, times the common factor
  Dyadic denominator_;
  bool has_denominator_;
  std::set<std::array<int, 4>> seen_;
  bool found_contact_ = false;
};

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MESH_TRIANGLE_CONTACT_INTERNAL_H_
