// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/exact_body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <climits>
#include <cmath>

#include "touchstone/exact/exact_body_data.h"

namespace touchstone::exact {
namespace {

// Outward normal of the plane of a loop and three vertices that span it: the first three in loop
// order that are not collinear. A loop is a convex polygon, so they turn left.
IntegerVector LoopNormal(const ExactBodyData& body, std::span<const int> loop,
                         std::array<int, 3>* plane) {
  const int size = static_cast<int>(loop.size());
  const IntegerVector& a = body.vertices[loop[0]];
  const IntegerVector ab = body.vertices[loop[1]] - a;
  for (int k = 2; k < size; ++k) {
    IntegerVector n = Cross(ab, body.vertices[loop[k]] - a);
    if (IsZero(n)) continue;
    *plane = {loop[0], loop[1], loop[k]};
    return n;
  }
  *plane = {loop[0], loop[1], loop[1]};
  return {};
}

}  // namespace

ExactBodyData::ExactBodyData(const ConvexPolyhedron& polyhedron,
                             const std::array<Eigen::Vector3d, 2>& interior_points)
    : body(polyhedron),
      vertex_count(polyhedron.vertex_count()),
      face_count(polyhedron.face_count()),
      interior_double(interior_points) {
  int common = INT_MAX;
  for (const Eigen::Vector3d& v : body.vertices()) common = CommonExponent(v.data(), 3, common);
  for (const Eigen::Vector3d& v : interior_points) common = CommonExponent(v.data(), 3, common);
  exponent = common;
  vertices.reserve(vertex_count);
  x.reserve(vertex_count), y.reserve(vertex_count), z.reserve(vertex_count);
  for (const Eigen::Vector3d& v : body.vertices()) {
    vertices.push_back(ToInteger(v, exponent));
    x.push_back(v.x()), y.push_back(v.y()), z.push_back(v.z());
    max_coordinate = std::max({max_coordinate, std::abs(v.x()), std::abs(v.y()), std::abs(v.z())});
  }
  for (int i = 0; i < 2; ++i) interior[i] = ToInteger(interior_points[i], exponent);
}

const Topology& ExactBodyData::topology() const {
  std::call_once(topology_once_, [this] { BuildTopology(); });
  return topology_;
}

const FaceNormals& ExactBodyData::normals() const {
  std::call_once(normals_once_, [this] { BuildNormals(); });
  return normals_;
}

const EdgeVectors& ExactBodyData::edge_vectors() const {
  std::call_once(edge_vectors_once_, [this] { BuildEdgeVectors(); });
  return edge_vectors_;
}

void ExactBodyData::BuildTopology() const {
  Topology& t = topology_;
  t.face_edges.resize(face_count);
  t.vertex_edges.resize(vertex_count);
  t.vertex_faces.resize(vertex_count);
  for (int f = 0; f < face_count; ++f) {
    const std::span<const int> loop = face(f);
    t.face_edges[f].reserve(loop.size());
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const int tail = loop[k], head = loop[(k + 1) % loop.size()];
      t.vertex_faces[tail].push_back(f);
      int found = -1;
      for (const int e : t.vertex_edges[tail]) {
        if (t.edges[e].tail == head || t.edges[e].head == head) found = e;
      }
      if (found < 0) {
        found = static_cast<int>(t.edges.size());
        t.edges.push_back({tail, head, f, -1});
        t.vertex_edges[tail].push_back(found);
        t.vertex_edges[head].push_back(found);
      } else {
        t.edges[found].right = f;
      }
      t.face_edges[f].push_back(found);
    }
  }
}

void ExactBodyData::BuildNormals() const {
  FaceNormals& n = normals_;
  n.exact.reserve(face_count), n.plane.resize(face_count), n.direction.reserve(face_count);
  for (int f = 0; f < face_count; ++f) {
    n.exact.push_back(LoopNormal(*this, face(f), &n.plane[f]));
    n.direction.push_back(ToDirection(n.exact.back()));
  }
}

IntegerVector ExactBodyData::Normal(int f) const {
  std::array<int, 3> plane;
  return LoopNormal(*this, face(f), &plane);
}

void ExactBodyData::BuildEdgeVectors() const {
  for (const ExactEdge& e : topology().edges) {
    edge_vectors_.exact.push_back(vertices[e.head] - vertices[e.tail]);
    edge_vectors_.direction.push_back(ToDirection(edge_vectors_.exact.back()));
  }
}

// Strictly behind the face's plane: in doubles where the bound allows. The determinant of three
// differences of coordinates up to X has six products below 8 X^3, each with at most 8 roundings,
// all sums included: 384u X^3 < 2^-44 X^3.
bool ExactBodyData::Has(const Feature& feature) const {
  const auto is_below = [&](int count) { return feature.index >= 0 && feature.index < count; };
  switch (feature.kind) {
    case FeatureKind::kVertex:
      return is_below(vertex_count);
    case FeatureKind::kEdge:
      return is_below(static_cast<int>(topology().edges.size()));
    case FeatureKind::kFace:
      return is_below(face_count);
  }
  return false;
}

bool ExactBodyData::IsBehind(int f, int i) const {
  const std::span<const int> loop = face(f);
  if (max_coordinate > 1e-80 && max_coordinate < 1e80) {
    const auto from_first = [&](double vx, double vy, double vz) {
      return Eigen::Vector3d(vx - x[loop[0]], vy - y[loop[0]], vz - z[loop[0]]);
    };
    const Eigen::Vector3d ab = from_first(x[loop[1]], y[loop[1]], z[loop[1]]);
    const Eigen::Vector3d ac = from_first(x[loop[2]], y[loop[2]], z[loop[2]]);
    const Eigen::Vector3d& point = interior_double[i];
    const double volume = ab.cross(ac).dot(from_first(point.x(), point.y(), point.z()));
    const double reach = std::max(max_coordinate, point.cwiseAbs().maxCoeff());
    if (volume < -0x1p-43 * (reach * reach * reach)) return true;
  }
  std::array<int, 3> plane;
  return DotSign(LoopNormal(*this, loop, &plane), vertices[loop[0]] - interior[i]) > 0;
}

bool ExactBodyData::InteriorPointIsInterior(int i) const {
  std::call_once(interior_once_[i], [this, i] {
    bool inside = face_count >= 4;
    for (int f = 0; f < face_count && inside; ++f) inside = IsBehind(f, i);
    is_interior_[i] = inside;
  });
  return is_interior_[i];
}

ExactBody::ExactBody(const ConvexPolyhedron& body)
    : ExactBody(body, body.interior_point(0), body.interior_point(1)) {}

ExactBody::ExactBody(const ConvexPolyhedron& body, const Eigen::Vector3d& interior_0,
                     const Eigen::Vector3d& interior_1)
    : data_(std::make_shared<const ExactBodyData>(
          body, std::array<Eigen::Vector3d, 2>{interior_0, interior_1})) {}

const ConvexPolyhedron& ExactBody::body() const { return data_->body; }

int ExactBody::edge_count() const { return static_cast<int>(data_->topology().edges.size()); }

std::pair<int, int> ExactBody::edge(int e) const {
  const ExactEdge& edge = data_->topology().edges[e];
  return {edge.tail, edge.head};
}

bool ExactBody::InteriorPointIsInterior(int i) const { return data_->InteriorPointIsInterior(i); }

}  // namespace touchstone::exact
