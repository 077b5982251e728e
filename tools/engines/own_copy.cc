// SPDX-License-Identifier: MIT
#include "touchstone/tools/engines/own_copy.h"

#include <vector>

namespace touchstone {

ConvexPolyhedron OwnCopy(const ConvexPolyhedron& body) {
  std::vector<std::vector<int>> faces;
  faces.reserve(static_cast<std::size_t>(body.face_count()));
  for (int f = 0; f < body.face_count(); ++f)
    faces.emplace_back(body.face(f).begin(), body.face(f).end());
  StatusOr<ConvexPolyhedron> copy = ConvexPolyhedron::Build(body.vertices(), faces);
  return copy.ok() ? *copy : body;
}

}  // namespace touchstone
