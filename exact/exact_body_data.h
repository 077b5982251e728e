// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef TOUCHSTONE_EXACT_EXACT_BODY_DATA_H_
#define TOUCHSTONE_EXACT_EXACT_BODY_DATA_H_

#include <Eigen/Core>
#include <array>
#include <mutex>
#include <span>
#include <vector>

#include "touchstone/core/base/verdict.h"
#include "touchstone/core/convex/convex_polyhedron.h"
#include "touchstone/exact/integer.h"

namespace touchstone::exact {

// left: the face whose loop runs from tail to head.
struct ExactEdge {
  int tail = -1, head = -1;
  int left = -1, right = -1;
};

struct Topology {
  std::vector<ExactEdge> edges;
  std::vector<std::vector<int>> face_edges;    // edge k joins face(f)[k] to the next of the loop
  std::vector<std::vector<int>> vertex_edges;  // by increasing number
  std::vector<std::vector<int>> vertex_faces;  // by increasing number
};

struct FaceNormals {
  std::vector<IntegerVector> exact;        // outward, any length
  std::vector<std::array<int, 3>> plane;   // three vertices of the face, not collinear
  std::vector<Eigen::Vector3d> direction;  // the same by ToDirection
};

struct EdgeVectors {
  std::vector<IntegerVector> exact;        // head less tail
  std::vector<Eigen::Vector3d> direction;  // the same by ToDirection
};

// What ExactBody knows. The first group is made at once, the rest when first asked for.
struct ExactBodyData {
  ExactBodyData(const ConvexPolyhedron& body, const std::array<Eigen::Vector3d, 2>& interior);

  ConvexPolyhedron body;
  int vertex_count = 0, face_count = 0;
  int exponent = 0;  // coordinate = integer * 2^exponent
  std::vector<IntegerVector> vertices;
  std::vector<double> x, y, z;  // the vertices again, by coordinate
  double max_coordinate = 0.0;
  std::array<IntegerVector, 2> interior;
  std::array<Eigen::Vector3d, 2> interior_double;

  std::span<const int> face(int f) const { return body.face(f); }
  // Whether there is such an element.
  bool HasVertex(int v) const { return v >= 0 && v < vertex_count; }
  bool Has(const Feature& feature) const;
  const Topology& topology() const;
  const FaceNormals& normals() const;
  const EdgeVectors& edge_vectors() const;
  // Outward normal of face f, of any length, made anew: where few are needed of many.
  IntegerVector Normal(int f) const;
  bool InteriorPointIsInterior(int i) const;

 private:
  void BuildTopology() const;
  void BuildNormals() const;
  void BuildEdgeVectors() const;
  bool IsBehind(int f, int i) const;

  mutable std::once_flag topology_once_, normals_once_, edge_vectors_once_, interior_once_[2];
  mutable Topology topology_;
  mutable FaceNormals normals_;
  mutable EdgeVectors edge_vectors_;
  mutable bool is_interior_[2] = {false, false};
};

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_EXACT_BODY_DATA_H_
