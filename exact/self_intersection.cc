// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/self_intersection.h"

#include <algorithm>
#include <climits>
#include <vector>

#include "touchstone/exact/integer.h"
#include "touchstone/exact/mesh_pair.h"
#include "touchstone/exact/triangle_cells.h"

namespace touchstone::exact {
namespace {

class Finder {
 public:
  explicit Finder(const TriangleMesh& mesh) : mesh_(mesh) {
    int exponent = INT_MAX;
    for (const Eigen::Vector3d& x : mesh.vertices()) {
      exponent = CommonExponent(x.data(), 3, exponent);
    }
    for (const Eigen::Vector3d& x : mesh.vertices()) points_.push_back(ToInteger(x, exponent));
  }

  std::optional<std::pair<int, int>> Run() const {
    // The mesh's own coordinates: boxes are exact.
    const std::vector<Eigen::Vector3d> doubles(mesh_.vertices().begin(), mesh_.vertices().end());
    const FaceTree tree(doubles, mesh_.faces());
    std::vector<std::pair<int, int>> near = NearFaces(tree, tree, Eigen::Vector3d::Zero(), 0.0);
    std::erase_if(near, [](const auto& pair) { return pair.first >= pair.second; });
    std::sort(near.begin(), near.end());
    for (const auto& [f, g] : near) {
      if (Intersect(f, g)) return std::pair(f, g);
    }
    return std::nullopt;
  }

 private:
  RationalPoint Rational(int v) const {
    return {mpq_class(points_[v][0]), mpq_class(points_[v][1]), mpq_class(points_[v][2])};
  }
  RationalTriangle Triangle(int f) const {
    const auto& [u, v, w] = mesh_.faces()[f];
    return RationalTriangle({Rational(u), Rational(v), Rational(w)});
  }
  // The side of face f's plane that vertex v lies on.
  int Side(int f, int v) const {
    const auto& t = mesh_.faces()[f];
    const IntegerVector& o = points_[t[0]];
    return sgn(Determinant(points_[t[1]] - o, points_[t[2]] - o, points_[v] - o));
  }
  static int PlaceIn(const std::array<int, 3>& face, int v) {
    return static_cast<int>(std::find(face.begin(), face.end(), v) - face.begin());
  }

  bool Intersect(int f, int g) const {
    const auto &t = mesh_.faces()[f], &u = mesh_.faces()[g];
    std::vector<int> shared, others;  // vertices of g
    for (const int v : u) (PlaceIn(t, v) < 3 ? shared : others).push_back(v);
    // One body's faces do not fold at an edge: the mesh was built. Three shared vertices would be a
    // face twice.
    if (shared.size() >= 2) return false;
    std::array<int, 3> sides;
    for (int k = 0; k < 3; ++k) sides[k] = Side(f, u[k]);
    if (std::all_of(sides.begin(), sides.end(), [](int s) { return s > 0; }) ||
        std::all_of(sides.begin(), sides.end(), [](int s) { return s < 0; })) {
      return false;
    }
    const RationalTriangle own = Triangle(f), other = Triangle(g);
    if (shared.empty()) return Share(own, other, sides);
    // From a shared vertex, what else the faces share would reach the far side of one of them: both
    // are convex, and so is what they share.
    return MeetsSide(own, t, other, shared[0]) || MeetsSide(other, u, own, shared[0]);
  }

  static bool Share(const RationalTriangle& t, const RationalTriangle& u,
                    const std::array<int, 3>& sides) {
    if (sides != std::array<int, 3>{0, 0, 0}) {
      const auto cut = t.CutFrom(u);
      return cut && t.Meets(*cut);
    }
    const auto& [a, b, c] = u.corners();
    return u.Holds(t.corners()[0]) || t.Meets({a, b}) || t.Meets({b, c}) || t.Meets({c, a});
  }

  // Whether the side of `face` opposite to its vertex `shared` meets the closed triangle `other`.
  static bool MeetsSide(const RationalTriangle& own, const std::array<int, 3>& face,
                        const RationalTriangle& other, int shared) {
    const int k = PlaceIn(face, shared);
    const RationalPoint &a = own.corners()[(k + 1) % 3], &b = own.corners()[(k + 2) % 3];
    const int side_a = other.Side(a), side_b = other.Side(b);
    if (side_a * side_b > 0) return false;
    if (side_a == 0 && side_b == 0) return other.Meets({a, b});
    const mpq_class rise_a = Dot(other.normal(), a - other.corners()[0]);
    const mpq_class rise_b = Dot(other.normal(), b - other.corners()[0]);
    const mpq_class s = rise_a / (rise_a - rise_b);
    RationalPoint x = b - a;
    for (int i = 0; i < 3; ++i) x[i] = a[i] + s * x[i];
    return other.Holds(x);
  }

  const TriangleMesh& mesh_;
  std::vector<IntegerVector> points_;
};

}  // namespace

std::optional<std::pair<int, int>> FindSelfIntersection(const TriangleMesh& mesh) {
  return Finder(mesh).Run();
}

}  // namespace touchstone::exact
