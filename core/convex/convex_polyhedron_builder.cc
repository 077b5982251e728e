// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "touchstone/core/base/orientation.h"
#include "touchstone/core/base/vertex_checks.h"
#include "touchstone/core/convex/convex_polyhedron.h"
#include "touchstone/core/convex/convexity_internal.h"
#include "touchstone/core/convex/corner_margins_internal.h"
#include "touchstone/core/convex/face_planes_internal.h"
#include "touchstone/core/convex/interior_points_internal.h"
#include "touchstone/core/convex/topology_internal.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMaxIndices = std::size_t{1} << 30;  // of loops together: indices are int

Status CheckLoops(std::span<const std::vector<int>> faces, int vertex_count) {
  if (faces.size() < 4) {
    return {StatusCode::kTooFewFaces, ElementKind::kNone, -1, -1,
            "a body has four faces at least, not " + std::to_string(faces.size())};
  }
  std::size_t index_count = 0;
  std::vector<int> last_face(vertex_count, -1);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const int f = static_cast<int>(i);
    const auto fail = [f](StatusCode code, int other, const std::string& what) {
      return Status{code, ElementKind::kFace, f, other, "face " + std::to_string(f) + what};
    };
    index_count += faces[i].size();
    if (index_count > kMaxIndices) {
      return fail(StatusCode::kOutOfRange, -1, " and those before have more than 2^30 vertices");
    }
    for (int v : faces[i]) {
      if (v < 0 || v >= vertex_count) {
        return fail(StatusCode::kBadIndex, v,
                    " names vertex " + std::to_string(v) + " of " + std::to_string(vertex_count));
      }
      if (last_face[v] == f) {
        return fail(StatusCode::kDegenerateFace, v,
                    " names vertex " + std::to_string(v) + " twice");
      }
      last_face[v] = f;
    }
    if (faces[i].size() < 3) {
      return fail(StatusCode::kDegenerateFace, -1, " has fewer than three vertices");
    }
  }
  const auto unused = std::find(last_face.begin(), last_face.end(), -1);
  if (unused != last_face.end()) {
    const int v = static_cast<int>(unused - last_face.begin());
    return {StatusCode::kUnreferencedVertex, ElementKind::kVertex, v, -1,
            "no face uses vertex " + std::to_string(v)};
  }
  return {};
}

// The diagonal of the bounding box: no side of the box exceeds the diameter, so it is at most
// sqrt(3) times that. A body of full dimension and size 1e-100 or more has a side of 1e-117 or
// more, whose square does not underflow; 12 units cover the roundings.
double DiameterBound(std::span<const Vector3d> vertices) {
  Vector3d low = vertices[0], high = vertices[0];
  for (const Vector3d& vertex : vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  const Vector3d side = high - low;
  const double squared = side[0] * side[0] + side[1] * side[1] + side[2] * side[2];
  return std::sqrt(squared) * (1.0 + 12 * 0x1p-52);
}

}  // namespace

StatusOr<ConvexPolyhedron> ConvexPolyhedron::Build(std::span<const Vector3d> vertices,
                                                   std::span<const std::vector<int>> faces) {
  if (Status status = CheckVertices(vertices); !status.ok()) return status;
  const int vertex_count = static_cast<int>(vertices.size());
  if (Status status = CheckLoops(faces, vertex_count); !status.ok()) return status;
  if (Status status = CheckDistinct(vertices); !status.ok()) return status;

  auto data = std::make_shared<ConvexPolyhedronData>();
  data->vertices.assign(vertices.begin(), vertices.end());
  std::size_t index_count = 0;
  for (const std::vector<int>& loop : faces) index_count += loop.size();
  data->face_vertices.reserve(index_count);
  data->face_begin.reserve(faces.size() + 1);
  data->face_begin.push_back(0);
  for (const std::vector<int>& loop : faces) {
    data->face_vertices.insert(data->face_vertices.end(), loop.begin(), loop.end());
    data->face_begin.push_back(static_cast<int>(data->face_vertices.size()));
  }
  for (const Vector3d& vertex : vertices) {
    data->max_coordinate = std::max(data->max_coordinate, vertex.cwiseAbs().maxCoeff());
  }
  data->diameter_bound = DiameterBound(vertices);

  if (Status status = internal::BuildTopology(data.get()); !status.ok()) return status;
  const Orientation orientation(data->vertices, data->max_coordinate);
  if (Status status = internal::CheckFullDimensional(orientation, *data); !status.ok()) {
    return status;
  }
  std::vector<internal::FaceAxis> axes;
  if (Status status = internal::BuildFacePlanes(orientation, data.get(), &axes); !status.ok()) {
    return status;
  }
  if (Status status = internal::CheckLocalConvexity(orientation, axes, data.get()); !status.ok()) {
    return status;
  }
  if (Status status = internal::FindInteriorPoints(orientation, data.get()); !status.ok()) {
    return status;
  }
  const ScaledPoint o = orientation.Scale(data->interior[0]);
  if (Status status = internal::CheckSingleWinding(orientation, *data, o); !status.ok()) {
    return status;
  }
  data->bounding_ellipsoid = BoundVertices(data->vertices, data->interior[0]);
  data->corner_margins = internal::CornerMargins(*data);
  data->support.Build(*data);
  // A triangle is its own plane.
  if (index_count == 3 * faces.size()) std::vector<std::array<int, 3>>().swap(data->face_planes);
  ConvexPolyhedron body(std::move(data));
  assert(body.FindValidationError().ok());
  return body;
}

}  // namespace touchstone
