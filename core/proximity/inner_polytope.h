// SPDX-License-Identifier: MIT
//
//   here        meaning
//   K           a closed surface of triangles whose corners are points of M
//   distance    of o from a triangle's plane, from below, in scaled lengths
//
// If every triangle of K has o strictly on its inner side, K winds around o, and around every point
// that is nearer to o than all of K. So M, which holds the hull of K, holds that ball. K need not
// be convex for this.
#ifndef TOUCHSTONE_CORE_PROXIMITY_INNER_POLYTOPE_H_
#define TOUCHSTONE_CORE_PROXIMITY_INNER_POLYTOPE_H_

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "touchstone/core/cd_dual/signs.h"

namespace touchstone {

// A polytope inside M that grows outward, its triangles in order of their distance from o. Keeps
// its memory from query to query.
//
// Started from a tetrahedron and expanded only over points that lie beyond by proven signs, it is
// exactly the convex hull of its corners. After `Refresh`, with bodies that have moved, it is a
// closed surface around o, and perhaps not convex.
class InnerPolytope {
 public:
  struct Triangle {
    std::array<int, 3> corners;  // counterclockwise from outside
    std::array<int, 3> across;   // the triangle over side k, from corner k to the next
    Eigen::Vector3d normal;      // outward, any length
    double length = 0.0;         // |normal|
    double normal_error = 0.0;   // of each coordinate
    // At most the distance of o from the triangle plus the context's `distance_error`.
    double distance = 0.0;
    bool alive = false;
    unsigned seen = 0;  // the round of Expand that last looked at it
    bool is_beyond = false;
    unsigned stamp = 0;  // changes with every use of the slot
  };

  bool empty() const { return alive_ == 0; }
  int triangle_count() const { return alive_; }
  void Clear();

  // Begins with the tetrahedron of c and a triangle that is counterclockwise from outside. False if
  // a sign says that o is outside of it, or one cannot be told.
  bool Start(Signs* signs, const std::array<VertexPair, 3>& triangle);

  // Begins with the octahedron of the supports along three axes and against them. The same errors;
  // it need not be convex.
  bool StartFromSupports(Signs* signs, const Eigen::Matrix3d& axes, PhaseCounts* counts);

  // Takes the corners to where they are now. False if a corner does not exist in these bodies, or o
  // is not certainly on the inner side of every triangle.
  bool Refresh(Signs* signs);

  // Takes the nearest triangle off the queue, of those nearer than `limit`; -1 if there is none.
  int TakeNearest(double limit);
  // Puts a triangle back.
  void PutBack(int triangle) { Push(triangle); }

  const Triangle& triangle(int i) const { return triangles_[i]; }
  std::array<VertexPair, 3> Corners(int triangle) const;
  bool HasCorner(int triangle, VertexPair pair) const;

  enum class Growth {
    kGrown,
    kNotBeyond,  // the point does not lie beyond the triangle, or that cannot be told
    // The triangles that it lies beyond are no disc, or o is not on the inner side of a new
    // triangle (or that cannot be told): impossible while K is exactly convex and signs are exact.
    kImpossible,
  };
  // Takes in `w`: the triangles that it lies beyond, `triangle` among them, give way to a fan
  // around it. K stays as it was unless the answer is kGrown.
  Growth Expand(Signs* signs, int triangle, VertexPair w);

  // Triangles nearer than `least` by rounding alone have their normals taken by big numbers, where
  // those are allowed.
  void Sharpen(Signs* signs, double least);
  // The least distance of all triangles.
  double LeastDistance() const;
  // How far a `distance` may be above the truth.
  static double DistanceError(const MinkowskiDifference& m);

  // Calls visit(i) for every triangle.
  template <class Visit>
  void ForEach(const Visit& visit) const {
    for (int i = 0; i < static_cast<int>(triangles_.size()); ++i) {
      if (triangles_[i].alive) visit(i);
    }
  }

 private:
  struct Corner {
    VertexPair pair;
    Eigen::Vector3d point;  // scaled
    int exact = -1;         // its place in exact_points_, once it was needed
  };
  struct Queued {
    double distance;
    int triangle;
    unsigned stamp;
  };
  struct Side {
    int outside, side;  // of the triangle that stays
    int from, to;       // corners, as the fan runs
  };
  struct Step {
    int triangle, side;
  };

  bool Make(Signs* signs, std::span<const VertexPair> corners,
            std::span<const std::array<int, 3>> sides);
  int AddTriangle(int a, int b, int c);
  static double Tilt(const Triangle& t, double extent);
  void Straighten(Signs* signs, double extent, Triangle* t);
  void SetExactNormal(Signs* signs, Triangle* t);
  void SetDistance(Triangle* t) const;
  bool Evaluate(Signs* signs, int triangle);
  void Push(int triangle);
  void Kill(int triangle);
  // How a corner lies to a triangle's plane, 1 beyond it; nothing when that cannot be told.
  std::optional<int> IsBeyond(Signs* signs, int triangle, int corner);
  bool CollectHorizon(Signs* signs, int first, int apex);
  bool AddFan(Signs* signs, int apex);
  void MakeExact(Signs* signs, int corner);
  const DyadicVector& Exact(int corner) const { return exact_points_[corners_[corner].exact]; }
  DyadicVector ExactNormal(Signs* signs, const Triangle& t);

  std::vector<Corner> corners_;
  std::vector<DyadicVector> exact_points_;
  std::vector<Triangle> triangles_;
  std::vector<int> free_;
  std::vector<Queued> queue_;  // a heap, the nearest on top; entries of dead triangles stay
  std::vector<Side> horizon_;
  std::vector<Step> stack_;
  std::vector<int> dead_, fan_;
  int alive_ = 0;
  unsigned round_ = 0;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_PROXIMITY_INNER_POLYTOPE_H_
