// SPDX-License-Identifier: MIT
#include "touchstone/core/base/status.h"

namespace touchstone {

std::string_view ToString(StatusCode code) {
  switch (code) {
    case StatusCode::kOk:
      return "ok";
    case StatusCode::kNonFinite:
      return "non_finite";
    case StatusCode::kOutOfRange:
      return "out_of_range";
    case StatusCode::kTooFewVertices:
      return "too_few_vertices";
    case StatusCode::kTooFewFaces:
      return "too_few_faces";
    case StatusCode::kBadIndex:
      return "bad_index";
    case StatusCode::kDegenerateFace:
      return "degenerate_face";
    case StatusCode::kUnreferencedVertex:
      return "unreferenced_vertex";
    case StatusCode::kDuplicateVertex:
      return "duplicate_vertex";
    case StatusCode::kOpen:
      return "open";
    case StatusCode::kNonManifold:
      return "non_manifold";
    case StatusCode::kInconsistentOrientation:
      return "inconsistent_orientation";
    case StatusCode::kInward:
      return "inward";
    case StatusCode::kFolded:
      return "folded";
    case StatusCode::kNonPlanarFace:
      return "non_planar_face";
    case StatusCode::kNotConvex:
      return "not_convex";
    case StatusCode::kFlat:
      return "flat";
    case StatusCode::kNoInteriorPoint:
      return "no_interior_point";
    case StatusCode::kBadRotation:
      return "bad_rotation";
  }
  return "?";
}

std::string_view ToString(ElementKind kind) {
  switch (kind) {
    case ElementKind::kNone:
      return "none";
    case ElementKind::kVertex:
      return "vertex";
    case ElementKind::kEdge:
      return "edge";
    case ElementKind::kFace:
      return "face";
    case ElementKind::kRow:
      return "row";
  }
  return "?";
}

std::string Status::ToString() const {
  std::string line(touchstone::ToString(code));
  if (element != ElementKind::kNone) {
    line += " (";
    line += touchstone::ToString(element);
    line += ' ' + std::to_string(index);
    if (other >= 0) line += ", " + std::to_string(other);
    line += ')';
  }
  if (!message.empty()) line += ": " + message;
  return line;
}

}  // namespace touchstone
