// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/enclosure_internal.h"

#include <cmath>
#include <string>
#include <vector>

#include "touchstone/core/base/dyadic.h"

namespace touchstone::internal {
namespace {

// The sign of the volume that each component encloses: the sum of det(a - o, b - o, c - o) over
// its faces, o one of its vertices. Each determinant carries its own bound; a sum of n doubles adds
// at most n units (2^-52) of the sum of their magnitudes, which is itself computed with as many
// roundings.
std::vector<int> VolumeSigns(const Orientation& orientation, const TriangleMeshData& data) {
  const std::size_t count = data.components.size();
  std::vector<double> volume(count, 0.0), magnitude(count, 0.0), error(count, 0.0);
  const auto origin = [&](int component) {
    return data.faces[data.components[component].first_face][0];
  };
  for (int f = 0; f < data.face_count(); ++f) {
    const int component = data.component_of_face[f];
    const auto& [a, b, c] = data.faces[f];
    const Estimate term =
        Orientation::TriageSide(orientation.point(origin(component)), orientation.point(a),
                                orientation.point(b), orientation.point(c));
    volume[component] += term.value;
    magnitude[component] += std::abs(term.value);
    error[component] += term.error;
  }
  std::vector<int> signs(count, 0);
  std::vector<char> is_open(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const double n = data.components[i].face_count;
    const double bound = (1.0 + (n + 4) * 0x1p-51) * (error[i] + n * 0x1p-51 * magnitude[i]);
    is_open[i] = !(std::abs(volume[i]) > bound);
    signs[i] = volume[i] > 0 ? 1 : -1;
  }
  std::vector<Dyadic> exact(count);
  for (int f = 0; f < data.face_count(); ++f) {
    const int component = data.component_of_face[f];
    if (!is_open[component]) continue;
    const DyadicVector o = ToDyadic(data.vertices[origin(component)]);
    const auto& [a, b, c] = data.faces[f];
    exact[component] = exact[component] + Determinant(ToDyadic(data.vertices[a]) - o,
                                                      ToDyadic(data.vertices[b]) - o,
                                                      ToDyadic(data.vertices[c]) - o);
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (is_open[i]) signs[i] = exact[i].sign();
  }
  return signs;
}

// The ray from a vertex p in the direction of x, with p moved by (0, ε, ε²) for an infinitely small
// ε: then it meets no edge and no vertex, and parities need no special cases.
class Ray {
 public:
  Ray(const Orientation& orientation, const TriangleMeshData& data, int p)
      : orientation_(orientation), data_(data), p_(p) {}

  // Whether the ray crosses face f.
  bool Crosses(int f) const {
    // Seen along x, the ray is the point p. Its parity in the triangle counts the sides that pass
    // above it in z where their ends lie on either side of it in y.
    const Triangle& face = data_.faces[f];
    bool inside = false;
    for (int k = 0; k < 3; ++k) {
      const int a = face[k], b = face[(k + 1) % 3];
      if (IsBeyondInY(a) != IsBeyondInY(b)) inside ^= PassesAbove(a, b);
    }
    if (!inside) return false;
    // The line of the ray meets the triangle; beyond p iff p lies on the side of the plane that the
    // x axis points away from. A vertex in the plane is a touch, which an embedded surface has not.
    const int facing = orientation_.ExactTurn(face[0], face[1], face[2], 0);
    return orientation_.ExactSide(face, p_) * facing < 0;
  }

 private:
  bool IsBeyondInY(int v) const { return data_.vertices[v][1] > data_.vertices[p_][1]; }

  // Whether segment a b, whose ends lie on either side of p in y, passes above p in z.
  bool PassesAbove(int a, int b) const {
    if (!IsBeyondInY(b)) std::swap(a, b);
    // (b_y - a_y)(p_z - a_z) - (b_z - a_z)(p_y - a_y) < 0, where b_y > a_y.
    const int turn = orientation_.ExactTurn(a, b, p_, 0);
    if (turn != 0) return turn < 0;
    // With p moved it grows by -(b_z - a_z) ε + (b_y - a_y) ε².
    return data_.vertices[b][2] > data_.vertices[a][2];
  }

  const Orientation& orientation_;
  const TriangleMeshData& data_;
  const int p_;
};

void FindDepths(const Orientation& orientation, TriangleMeshData* data) {
  const int count = static_cast<int>(data->components.size());
  if (count == 1) return;
  std::vector<char> is_enclosed_by(count);
  for (int component = 0; component < count; ++component) {
    MeshComponent& piece = data->components[component];
    const Ray ray(orientation, *data, data->faces[piece.first_face][0]);
    is_enclosed_by.assign(count, 0);
    for (int f = 0; f < data->face_count(); ++f) {
      const int other = data->component_of_face[f];
      if (other != component && ray.Crosses(f)) is_enclosed_by[other] ^= 1;
    }
    for (const char is_enclosed : is_enclosed_by) piece.depth += is_enclosed;
  }
}

}  // namespace

Status CheckEnclosure(const Orientation& orientation, TriangleMeshData* data) {
  FindDepths(orientation, data);
  const std::vector<int> signs = VolumeSigns(orientation, *data);
  for (std::size_t i = 0; i < signs.size(); ++i) {
    const MeshComponent& component = data->components[i];
    const std::string name = "the component of face " + std::to_string(component.first_face);
    if (signs[i] == 0) {
      return {StatusCode::kFlat, ElementKind::kFace, component.first_face, -1,
              name + " encloses no volume"};
    }
    if ((signs[i] > 0) != (component.depth % 2 == 0)) {
      const std::string in = std::to_string(component.depth) + " others";
      return {StatusCode::kInward, ElementKind::kFace, component.first_face, -1,
              name + (component.depth % 2 == 0
                          ? ", enclosed by " + in + ", faces inward"
                          : ", enclosed by " + in + ", bounds a cavity but faces outward")};
    }
  }
  return {};
}

}  // namespace touchstone::internal
