// SPDX-License-Identifier: MIT
//
// Points and planes of the arrangement of facets of M, named by features, never rounded: a point is
// a vertex of M, or where an edge of M crosses a plane, or where three planes meet. Each has a
// rounding with a bound, which decides nearly every sign, and homogeneous coordinates with big
// numbers on demand, which decide the rest.
#ifndef TOUCHSTONE_CORE_MINKOWSKI_SUM_GEOMETRY_INTERNAL_H_
#define TOUCHSTONE_CORE_MINKOWSKI_SUM_GEOMETRY_INTERNAL_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "touchstone/core/base/dyadic.h"
#include "touchstone/core/mesh/mesh_pair.h"
#include "touchstone/core/mesh/translation.h"
#include "touchstone/core/minkowski/bounded_vector_internal.h"
#include "touchstone/core/minkowski/convolution.h"
#include "touchstone/core/minkowski/flat_table_internal.h"
#include "touchstone/core/minkowski/sum_point_name.h"

namespace touchstone::internal {

// In the pair's scaled frame.
struct SumPlane {
  Eigen::Vector3d normal;  // each coordinate within normal_error
  double normal_error;
  Eigen::Vector3d origin;  // rounding of a point of the plane, each coordinate within origin_error
  double origin_error;
  // The points that it is named by: a facet's corners, the last one again where there are three;
  // or two, and the axis that it is parallel to.
  std::array<int, 4> points;
  int axis = -1;   // -1 for a facet's plane
  SumFacet facet;  // for a facet's plane
};

enum class SumPointForm : std::uint8_t {
  kVertex,    // parts: a vertex of A, one of B
  kOnEdge,    // two points that are vertices, a plane
  kOfPlanes,  // three planes
};

struct SumPoint {
  SumPointForm form;
  std::array<int, 3> parts;
  Eigen::Vector3d rounded;
  double error;  // of each coordinate; infinite where doubles cannot tell
};

// Whether two facets are two faces of one body, against one vertex of the other. If the faces share
// a side they share no more, as surfaces do not fold: neither cuts the other, and a plane may have
// two names. That faces apart from each other do not meet is not checked of a mesh, nor relied on.
inline bool AreOfOneVertex(const SumFacet& x, const SumFacet& y) {
  if (x.kind != y.kind || x.kind == SumFacetKind::kEdgeEdge) return false;
  return x.kind == SumFacetKind::kFaceVertex ? x.b == y.b : x.a == y.a;
}

// What was made for some of many numbers, where it stays.
template <class Item>
class KeptItems {
 public:
  // Null if nothing was made for the number.
  const Item* Find(int number) const {
    const auto i = static_cast<std::size_t>(number);
    return i < places_.size() && places_[i] >= 0 ? &items_[places_[i]] : nullptr;
  }
  const Item& Add(int number, Item item) {
    const auto i = static_cast<std::size_t>(number);
    if (i >= places_.size()) places_.resize(i + 1 + i / 2, -1);
    places_[i] = static_cast<int>(items_.size());
    return items_.emplace_back(std::move(item));
  }
  void Clear() {
    places_.clear();
    items_.clear();
  }

 private:
  std::vector<int> places_;
  std::deque<Item> items_;
};

// The outward normal of a facet, and how far each coordinate may be off.
BoundedVector FacetNormal(const MeshPair& pair, const SumFacet& facet);

class SumGeometry {
 public:
  // Keeps a reference to the pair.
  explicit SumGeometry(const MeshPair& pair) : pair_(pair) {}

  const MeshPair& pair() const { return pair_; }

  // Forgets everything, since the pair was placed anew. Keeps the storage.
  void Reset();

  // Makes room for so many facets.
  void Reserve(std::size_t facets);

  // Each returns the number of a new or known point.
  int AddVertex(SumVertex vertex);
  int AddOnEdge(int vertex, int other_vertex, int plane);
  int AddOfPlanes(int p, int q, int r);
  // The plane of a facet with these corners; its normal points outward.
  int AddFacetPlane(const SumFacet& facet, const std::array<int, 4>& corners);
  // The plane through two vertices and parallel to a coordinate axis, new or known.
  int AddEdgePlane(int vertex, int other_vertex, int axis);

  int point_count() const { return static_cast<int>(points_.size()); }
  const SumPoint& point(int i) const { return points_[i]; }
  const SumPlane& plane(int p) const { return planes_[p]; }
  // Facets in it are the numbers of their planes; requires all facets' planes added before others.
  SumPointName NameOf(int point) const;

  // Says that two planes are one. Points made of either from then on are the same.
  void Unite(int p, int q);
  int Root(int plane) const;

  // The side of a plane that a point lies on: 1 beyond, along the normal.
  int Side(int point, int plane);
  // The sign of x - y along a coordinate axis.
  int Compare(int x, int y, int axis);
  bool AreEqual(int x, int y);
  // The sign of coordinate `axis` of (y - x) x (z - x), for points of a plane.
  int Turn(int x, int y, int z, int axis, int plane);
  // The same in doubles alone; 0: they cannot tell.
  static int TriageTurn(const SumPoint& x, const SumPoint& y, const SumPoint& z, int axis);
  // The sign of det(normals of p, q, r).
  int NormalsDeterminant(int p, int q, int r);
  // The sign of the dot product of two normals.
  int NormalsAgree(int p, int q);
  // The sign of coordinate `axis` of normal p x normal q, and an axis where it is not zero (-1 if
  // the planes are parallel).
  int LineAlong(int p, int q, int axis);
  int LineAxis(int p, int q);
  // An axis where the normal is certainly not zero, as large as any; and its sign there.
  int NormalAxis(int plane);
  int NormalAlong(int plane, int axis);

  // A facet's outward normal, of unit length: each coordinate within 2^-18, most within 2^-40.
  Eigen::Vector3d UnitNormal(int plane);

  // Makes a wide or infinite rounding error narrow, by way of the exact point.
  void Sharpen(int point);
  // The point, sharpened where its error is above 2^-38, as few are: for what is told of it.
  const SumPoint& Sharp(int point);
  // Times the factor of the pair's exact pose, not scaled.
  const ExactPoint& Exact(int point);
  const Dyadic& factor() { return exact_pair().pose().factor(); }
  // How many signs needed big numbers.
  long exact_count() const { return exact_count_; }

 private:
  struct ExactPlane {
    DyadicVector normal;
    Dyadic offset;  // normal . x for the plane's points
  };
  // A turn that needed big numbers.
  struct KnownTurn {
    std::array<int, 3> points;  // in rising order
    int axis, sign;
  };
  ExactMeshPair& exact_pair() {
    if (!exact_pair_) exact_pair_.emplace(pair_);
    return *exact_pair_;
  }
  SumVertex VertexOf(int point) const;
  int Add(SumPointForm form, const std::array<int, 3>& parts);
  void RoundOnEdge(SumPoint* point) const;
  void RoundOfPlanes(SumPoint* point) const;
  static Estimate Height(const SumPoint& x, const SumPlane& plane);
  bool LiesOnByName(const SumPoint& x, int plane) const;
  bool LieOnOneEdge(const std::array<int, 3>& points) const;
  std::optional<int> SideOfFace(const SumPoint& x, int plane);
  std::optional<int> SideByEnds(const SumPoint& x, int plane);
  std::optional<int> SideAcrossAnEdge(const SumPoint& x, int plane);
  std::optional<int> SideByNames(const SumPoint& x, int plane);
  std::optional<int> TurnByNames(const std::array<int, 3>& points, int axis, int plane);
  std::optional<int> TurnAgainst(const std::array<int, 3>& points, int axis, int plane, int other);
  std::optional<SumVertex> VertexAbreast(const SumPoint& x, int axis) const;
  int CompareBesideVertex(const SumPoint& x, const SumPoint& y, int axis) const;
  int ExactTurn(std::array<int, 3> points, int axis);
  bool IsVertexOfFlatFacet(const SumPoint& x, const SumFacet& facet) const;
  const ExactPlane& ExactPlaneOf(int plane);
  ExactPoint MakeExact(const SumPoint& point);

  const MeshPair& pair_;
  std::optional<ExactMeshPair> exact_pair_;  // once it is asked for
  std::vector<SumPoint> points_;
  std::vector<SumPlane> planes_;
  mutable std::vector<int> roots_;
  NumberTable point_numbers_, edge_planes_, turn_numbers_;
  std::vector<KnownTurn> turns_;
  KeptItems<ExactPoint> exact_points_;
  KeptItems<ExactPlane> exact_planes_;
  long exact_count_ = 0;
};

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_MINKOWSKI_SUM_GEOMETRY_INTERNAL_H_
