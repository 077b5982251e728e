// SPDX-License-Identifier: MIT
#include "touchstone/core/convex/convexity_internal.h"

#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <string>

#include "touchstone/core/base/dyadic.h"

namespace touchstone::internal {
namespace {

// Disjoint sets of faces, each represented by its smallest member.
class FaceSets {
 public:
  explicit FaceSets(int count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  int Find(int f) {
    while (parent_[f] != f) f = parent_[f] = parent_[parent_[f]];
    return f;
  }
  void Join(int f, int g) {
    f = Find(f);
    g = Find(g);
    if (f < g) parent_[g] = f;
    if (g < f) parent_[f] = g;
  }

 private:
  std::vector<int> parent_;
};

// Where the right face of an edge lies, seen from its left face's plane.
struct Bend {
  int side;         // 1 beyond, -1 below, 0 coplanar
  int vertex = -1;  // one of the right face's, on that side
};

Bend BendAt(const Orientation& orientation, const ConvexPolyhedronData& data, const Edge& edge) {
  // The right face is convex and lies on one side of the edge's line, so its vertices off that line
  // all lie on one side of the left plane. Its three plane vertices are not all on the line.
  for (int v : data.face_plane(edge.right)) {
    if (v == edge.tail || v == edge.head) continue;
    const int side = orientation.ExactSide(data.face_plane(edge.left), v);
    if (side != 0) return {side, v};
  }
  return {0};
}

// Whether coplanar faces f and g lie on top of each other: their normals point opposite ways.
bool IsFolded(const Orientation& orientation, const ConvexPolyhedronData& data,
              const FaceAxis& axis_f, int g) {
  const std::array<int, 3> plane = data.face_plane(g);
  return orientation.ExactTurn(plane[0], plane[1], plane[2], axis_f.axis) != axis_f.sign;
}

// The sign of det(a - o, b - o, d), d the sum of t - o over the three plane vertices t of `face`:
// the side of the ray from o through the middle of that face, seen from the plane through o, a, b.
int SideOfRay(const Orientation& orientation, const ConvexPolyhedronData& data, int face,
              const ScaledPoint& o, int a, int b) {
  double value = 0.0, error = 0.0, magnitude = 0.0;
  for (int t : data.face_plane(face)) {
    const Estimate estimate = Orientation::TriageSide(o, orientation.point(a), orientation.point(b),
                                                      orientation.point(t));
    value += estimate.value;
    error += estimate.error;
    magnitude += std::abs(estimate.value);
  }
  // The sums themselves: three roundings each of at most 2^-52 of the magnitudes.
  error = 1.0001 * (error + 4 * 0x1p-52 * magnitude);
  if (value > error) return 1;
  if (value < -error) return -1;
  const DyadicVector origin = ToDyadic(o.exact);
  DyadicVector ray;
  for (int t : data.face_plane(face)) {
    ray = ray + (ToDyadic(orientation.point(t).exact) - origin);
  }
  return Determinant(ToDyadic(orientation.point(a).exact) - origin,
                     ToDyadic(orientation.point(b).exact) - origin, ray)
      .sign();
}

}  // namespace

Status CheckFullDimensional(const Orientation& orientation, const ConvexPolyhedronData& data) {
  const int n = data.vertex_count();
  const auto collinear = [&](int v) {
    for (int axis = 0; axis < 3; ++axis) {
      if (orientation.ExactTurn(0, 1, v, axis) != 0) return false;
    }
    return true;
  };
  int third = 2;
  while (third < n && collinear(third)) ++third;
  for (int v = third + 1; v < n; ++v) {
    if (orientation.ExactSide({0, 1, third}, v) != 0) return {};
  }
  return {StatusCode::kFlat, ElementKind::kNone, -1, -1, "all vertices lie in one plane"};
}

Status VertexBeyondFace(int face, int vertex) {
  return {StatusCode::kNotConvex, ElementKind::kFace, face, vertex,
          "vertex " + std::to_string(vertex) + " lies beyond the plane of face " +
              std::to_string(face)};
}

Status CheckLocalConvexity(const Orientation& orientation, const std::vector<FaceAxis>& axes,
                           ConvexPolyhedronData* data) {
  FaceSets facets(data->face_count());
  std::optional<Status> first_defect;
  bool has_convex = false, has_reflex = false;
  for (const Edge& edge : data->edges) {
    const Bend bend = BendAt(orientation, *data, edge);
    if (bend.side < 0) {
      has_convex = true;
    } else if (bend.side > 0) {
      has_reflex = true;
      if (!first_defect) first_defect = VertexBeyondFace(edge.left, bend.vertex);
    } else if (IsFolded(orientation, *data, axes[edge.left], edge.right)) {
      return Status{StatusCode::kNotConvex, ElementKind::kEdge, edge.tail, edge.head,
                    "faces " + std::to_string(edge.left) + " and " + std::to_string(edge.right) +
                        " are folded onto each other"};
    } else {
      facets.Join(edge.left, edge.right);
    }
    if (has_convex && has_reflex) return *first_defect;
  }
  if (has_reflex) {
    return {StatusCode::kInconsistentOrientation, ElementKind::kFace, 0, -1,
            "all faces run clockwise seen from outside: reverse them"};
  }
  data->facet_of_face.resize(data->face_count());
  for (int f = 0; f < data->face_count(); ++f) data->facet_of_face[f] = facets.Find(f);
  return {};
}

std::optional<int> FindVertexBeyond(const Orientation& orientation,
                                    const ConvexPolyhedronData& data, int f) {
  for (int v = 0; v < data.vertex_count(); ++v) {
    if (orientation.ExactSide(data.face_plane(f), v) > 0) return v;
  }
  return std::nullopt;
}

Status CheckSingleWinding(const Orientation& orientation, const ConvexPolyhedronData& data,
                          const ScaledPoint& o) {
  const int pierced = 0;
  for (int f = 1; f < data.face_count(); ++f) {
    const std::span<const int> loop(data.face_vertices.data() + data.face_begin[f],
                                    data.face_vertices.data() + data.face_begin[f + 1]);
    bool missed = false;
    for (std::size_t i = 0; i < loop.size() && !missed; ++i) {
      const int next = loop[i + 1 < loop.size() ? i + 1 : 0];
      missed = SideOfRay(orientation, data, pierced, o, loop[i], next) < 0;
    }
    if (missed) continue;
    for (int g : {f, pierced}) {
      if (const auto v = FindVertexBeyond(orientation, data, g)) return VertexBeyondFace(g, *v);
    }
    return {StatusCode::kNotConvex, ElementKind::kFace, f, -1,
            "the surface winds round its middle more than once: faces " + std::to_string(f) +
                " and " + std::to_string(pierced) + " overlap seen from there"};
  }
  return {};
}

}  // namespace touchstone::internal
