// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_BASE_STATUS_H_
#define TOUCHSTONE_CORE_BASE_STATUS_H_

#include <cassert>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace touchstone {

// What is wrong with data that a builder refused. Each code names one defect.
enum class StatusCode {
  kOk,
  kNonFinite,           // a coordinate is NaN or infinite
  kOutOfRange,          // a magnitude outside [1e-100, 1e100] for the body, or above for a pose
  kTooFewVertices,      // fewer than four vertices
  kTooFewFaces,         // fewer than four faces
  kBadIndex,            // a face names a vertex that does not exist
  kDegenerateFace,      // fewer than three vertices, a repeated vertex, or all collinear
  kUnreferencedVertex,  // a vertex that no face uses
  kDuplicateVertex,     // two vertices with equal coordinates
  kOpen,                // an edge with one face
  kNonManifold,         // an edge with more than two faces, a pinched vertex, two components
  kInconsistentOrientation,  // an edge run twice in the same sense, or all faces inward
  kInward,                   // a component of a mesh that faces the wrong way
  kFolded,                   // two faces at an edge that lie on top of each other
  kNonPlanarFace,            // a vertex of a face off its plane, by exact signs
  kNotConvex,                // a vertex strictly beyond a face's plane, or a face not convex
  kFlat,                     // all vertices in one plane, or a component that encloses no volume
  kNoInteriorPoint,          // so thin that no triple of doubles was proven strictly inside
  kBadRotation,  // determinant not positive, or RᵀR off the identity by more than 1e-6
};

// The kind of element that `Status::index` counts.
enum class ElementKind { kNone, kVertex, kEdge, kFace, kRow };

std::string_view ToString(StatusCode code);
std::string_view ToString(ElementKind kind);

// The outcome of building something from data. A failure names the element.
struct Status {
  StatusCode code = StatusCode::kOk;
  ElementKind element = ElementKind::kNone;
  int index = -1;  // which vertex, face or row; for an edge its first vertex
  int other = -1;  // a second element where the defect is a relation: the edge's second vertex, the
                   // other duplicate, the vertex off the face's plane
  std::string message;

  bool ok() const { return code == StatusCode::kOk; }
  // One line: code, element and message, as a program should print it.
  std::string ToString() const;
};

// Either a value or the status that says why there is none.
template <class T>
class StatusOr {
 public:
  StatusOr(T value) : value_(std::move(value)) {}
  StatusOr(Status status) : status_(std::move(status)) { assert(!status_.ok()); }

  bool ok() const { return value_.has_value(); }
  const Status& status() const { return status_; }
  const T& value() const& {
    assert(ok());
    return *value_;
  }
  T&& value() && {
    assert(ok());
    return *std::move(value_);
  }
  const T& operator*() const& { return value(); }
  const T* operator->() const { return &value(); }

 private:
  std::optional<T> value_;
  Status status_;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_BASE_STATUS_H_
