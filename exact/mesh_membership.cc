// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/mesh_membership.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "touchstone/exact/triangle_cells.h"

namespace touchstone::exact {
namespace {

using Eigen::Vector3d;

enum class Body { kA, kB };
constexpr Body Other(Body body) { return body == Body::kA ? Body::kB : Body::kA; }

// A vertex of either mesh, as it stands in the query.
struct Corner {
  Body body;
  int vertex;
};
using Corners = std::array<Corner, 3>;

double MaxAbs(const Vector3d& v) { return v.cwiseAbs().maxCoeff(); }

// u . (v x w), a sum of six products of three numbers.
double Triple(const Vector3d& u, const Vector3d& v, const Vector3d& w) {
  return u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
         u[2] * (v[0] * w[1] - v[1] * w[0]);
}

// value * 2^exponent, off by 2^-50 of itself.
double ToDouble(const mpq_class& value, int exponent) {
  long of_n = 0, of_d = 0;
  const double n = mpz_get_d_2exp(&of_n, value.get_num_mpz_t());
  const double d = mpz_get_d_2exp(&of_d, value.get_den_mpz_t());
  const long e = of_n - of_d + exponent;
  return e < -1000 ? 0.0 : std::ldexp(n / d, static_cast<int>(std::min(e, 1000L)));
}

// Both meshes at the query's translation: integers times one positive factor, and doubles.
class Placed {
 public:
  Placed(const PlacedMeshPair& pair, const ExactTranslation& x)
      : pair_(pair), denominator_(x.denominator) {
    shift_ = static_cast<mp_bitcnt_t>(std::max(0, pair.exponent() - x.exponent));
    for (int i = 0; i < 3; ++i) {
      offset_[i] = x.coordinates[i] * pair.scale();
      mpz_mul_2exp(offset_[i].get_mpz_t(), offset_[i].get_mpz_t(),
                   static_cast<mp_bitcnt_t>(std::max(0, x.exponent - pair.exponent())));
      offset_double_[i] = ToDouble(mpq_class(x.coordinates[i], x.denominator), x.exponent);
    }
    // Points are off by 2^-50 of their size, the offset too, and their sum by as little.
    error_ = 0x1p-48 * (pair.size() + MaxAbs(offset_double_));
  }

  const PlacedMeshPair& pair() const { return pair_; }
  const TriangleMesh& mesh(Body body) const { return body == Body::kA ? pair_.a() : pair_.b(); }
  Corners corners(Body body, int f) const {
    const auto& t = mesh(body).faces()[f];
    return {Corner{body, t[0]}, Corner{body, t[1]}, Corner{body, t[2]}};
  }
  const Vector3d& offset() const { return offset_double_; }
  // Of each coordinate of a point in doubles.
  double error() const { return error_; }

  Vector3d Double(const Corner& c) const {
    return c.body == Body::kA ? pair_.doubles_a()[c.vertex]
                              : Vector3d(pair_.doubles_b()[c.vertex] + offset_double_);
  }
  IntegerVector Exact(const Corner& c) const {
    IntegerVector point = c.body == Body::kA ? pair_.point_a(c.vertex) : pair_.point_b(c.vertex);
    for (int i = 0; i < 3; ++i) {
      mpz_mul_2exp(point[i].get_mpz_t(), point[i].get_mpz_t(), shift_);
      point[i] *= denominator_;
      if (c.body == Body::kB) point[i] += offset_[i];
    }
    return point;
  }
  RationalPoint Rational(const Corner& c) const {
    const IntegerVector point = Exact(c);
    return {mpq_class(point[0]), mpq_class(point[1]), mpq_class(point[2])};
  }
  RationalTriangle Triangle(Body body, int f) const {
    const Corners at = corners(body, f);
    return RationalTriangle({Rational(at[0]), Rational(at[1]), Rational(at[2])});
  }
  // A point of the integers' space in true units, off by error().
  Vector3d Double(const RationalPoint& x) const {
    const mpq_class unit(1, pair_.scale() * denominator_);
    const int exponent = pair_.exponent() - static_cast<int>(shift_);
    return {ToDouble(x[0] * unit, exponent), ToDouble(x[1] * unit, exponent),
            ToDouble(x[2] * unit, exponent)};
  }

  // The sign of (b - a) x (c - a) . (d - a). In doubles each difference is off by 2 error_ and one
  // rounding; the determinant is six products of three such numbers.
  int Side(const Corner& a, const Corner& b, const Corner& c, const Corner& d) const {
    const Vector3d o = Double(a);
    const Vector3d u = Double(b) - o, v = Double(c) - o, w = Double(d) - o;
    const double value = Triple(u, v, w);
    const double e = 2.0 * error_;
    const double lu = MaxAbs(u) + e, lv = MaxAbs(v) + e, lw = MaxAbs(w) + e;
    const double bound =
        1.1 * (6.0 * e * (lu * lv + lv * lw + lw * lu) + 60.0 * 0x1p-52 * lu * lv * lw) + 1e-320;
    if (value > bound) return 1;
    if (value < -bound) return -1;
    const IntegerVector origin = Exact(a);
    return sgn(Determinant(Exact(b) - origin, Exact(c) - origin, Exact(d) - origin));
  }

 private:
  const PlacedMeshPair& pair_;
  const Integer& denominator_;
  mp_bitcnt_t shift_;
  IntegerVector offset_;
  Vector3d offset_double_;
  double error_;
};

bool OnOneSide(const std::array<int, 3>& sides) {
  return sides[0] != 0 && sides[0] == sides[1] && sides[1] == sides[2];
}

class Query {
 public:
  Query(const PlacedMeshPair& pair, const ExactTranslation& x) : placed_(pair, x) {}

  Verdict Run() {
    const PlacedMeshPair& pair = placed_.pair();
    // Faces that cross settle it: they are looked for first, and fractions come last.
    std::vector<std::pair<int, int>> unsettled;
    for (const auto& [f, g] :
         NearFaces(pair.tree_a(), pair.tree_b(), placed_.offset(), 4.0 * placed_.error())) {
      const Meeting meeting = Meet(f, g);
      if (meeting == Meeting::kCross) return Verdict::kOverlap;
      if (meeting == Meeting::kMayShare) unsettled.emplace_back(f, g);
    }
    for (const auto& [f, g] : unsettled) {
      if (!Share(placed_.Triangle(Body::kA, f), placed_.Triangle(Body::kB, g))) continue;
      met_[0][f].push_back(g);
      met_[1][g].push_back(f);
    }
    for (const Body body : {Body::kA, Body::kB}) {
      if (SomePieceIsInside(body) || SomeUntouchedComponentIsInside(body)) return Verdict::kOverlap;
    }
    return met_[0].empty() ? Verdict::kSeparate : Verdict::kTouch;
  }

 private:
  enum class Meeting { kNone, kMayShare, kCross };

  const std::map<int, std::vector<int>>& met(Body body) const {
    return met_[body == Body::kA ? 0 : 1];
  }

  Meeting Meet(int f, int g) const {
    const Corners t = placed_.corners(Body::kA, f), u = placed_.corners(Body::kB, g);
    if (AreClearlyApart(t, u)) return Meeting::kNone;
    std::array<int, 3> of_t, of_u;
    for (int k = 0; k < 3; ++k) of_u[k] = placed_.Side(t[0], t[1], t[2], u[k]);
    if (OnOneSide(of_u)) return Meeting::kNone;
    for (int k = 0; k < 3; ++k) of_t[k] = placed_.Side(u[0], u[1], u[2], t[k]);
    if (OnOneSide(of_t)) return Meeting::kNone;
    return Pierces(t, u, of_u) || Pierces(u, t, of_t) ? Meeting::kCross : Meeting::kMayShare;
  }

  // Whether a plane strictly between the triangles is found in doubles, of those along a side of
  // each, or two sides of one, or square to a triangle along a side of it. Any direction will do:
  // a point's height along it is off by the point's error() in each coordinate, and three roundings
  // of each product.
  bool AreClearlyApart(const Corners& t, const Corners& u) const {
    const Vector3d o = placed_.Double(t[0]);
    std::array<Vector3d, 3> p, q, sides_t, sides_u;
    for (int k = 0; k < 3; ++k) p[k] = placed_.Double(t[k]) - o, q[k] = placed_.Double(u[k]) - o;
    double size = 0.0;
    for (int k = 0; k < 3; ++k) {
      sides_t[k] = p[(k + 1) % 3] - p[k];
      sides_u[k] = q[(k + 1) % 3] - q[k];
      size = std::max({size, MaxAbs(p[k]), MaxAbs(q[k])});
    }
    const double error = 1.1 * (2.0 * placed_.error() + 8.0 * 0x1p-52 * size);
    const auto parts = [&](const Vector3d& normal) {
      double least_t = normal.dot(p[0]), greatest_t = least_t;
      double least_u = normal.dot(q[0]), greatest_u = least_u;
      for (int k = 1; k < 3; ++k) {
        const double x = normal.dot(p[k]), y = normal.dot(q[k]);
        least_t = std::min(least_t, x), greatest_t = std::max(greatest_t, x);
        least_u = std::min(least_u, y), greatest_u = std::max(greatest_u, y);
      }
      const double bound = 2.0 * normal.cwiseAbs().sum() * error + 1e-320;
      return least_u - greatest_t > bound || least_t - greatest_u > bound;
    };
    const Vector3d normal_t = sides_t[0].cross(sides_t[1]);
    const Vector3d normal_u = sides_u[0].cross(sides_u[1]);
    if (parts(normal_t) || parts(normal_u)) return true;
    for (int k = 0; k < 3; ++k) {
      if (parts(normal_t.cross(sides_t[k])) || parts(normal_u.cross(sides_u[k]))) return true;
      for (const Vector3d& side : sides_u) {
        if (parts(sides_t[k].cross(side))) return true;
      }
    }
    return false;
  }

  // Whether an edge of u, its corners on these sides of t's plane, passes strictly through t. Then
  // faces cross in their interiors, and so do the solids.
  bool Pierces(const Corners& t, const Corners& u, const std::array<int, 3>& sides) const {
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      if (sides[k] * sides[next] >= 0) continue;
      const int first = placed_.Side(u[k], u[next], t[0], t[1]);
      if (first != 0 && placed_.Side(u[k], u[next], t[1], t[2]) == first &&
          placed_.Side(u[k], u[next], t[2], t[0]) == first) {
        return true;
      }
    }
    return false;
  }

  static bool IsCoplanar(const RationalTriangle& t, const RationalTriangle& u) {
    return t.Side(u.corners()[0]) == 0 && t.Side(u.corners()[1]) == 0 &&
           t.Side(u.corners()[2]) == 0;
  }

  static std::array<RationalSegment, 3> Sides(const RationalTriangle& t) {
    const auto& [a, b, c] = t.corners();
    return {RationalSegment{a, b}, RationalSegment{b, c}, RationalSegment{c, a}};
  }

  // Whether the closed triangles share a point.
  static bool Share(const RationalTriangle& t, const RationalTriangle& u) {
    if (!IsCoplanar(t, u)) {
      const std::optional<RationalSegment> cut = t.CutFrom(u);
      return cut && t.Meets(*cut);
    }
    const auto sides = Sides(u);
    return u.Holds(t.corners()[0]) ||
           std::any_of(sides.begin(), sides.end(), [&](const auto& side) { return t.Meets(side); });
  }

  // Whether a piece of positive area of some face that meets the other surface lies inside the
  // other solid, or on a face of it that faces the same way.
  bool SomePieceIsInside(Body body) {
    for (const auto& [f, others] : met(body)) {
      const RationalTriangle t = placed_.Triangle(body, f);
      std::vector<RationalTriangle> coplanar;
      std::vector<RationalSegment> cuts;
      for (const int g : others) {
        const RationalTriangle u = placed_.Triangle(Other(body), g);
        if (IsCoplanar(t, u)) {
          coplanar.push_back(u);
          const auto sides = Sides(u);
          cuts.insert(cuts.end(), sides.begin(), sides.end());
        } else {
          const std::optional<RationalSegment> cut = t.CutFrom(u);
          if (!cut) continue;
          // A point alone is cut through, lest a sample be just there.
          const bool is_point = cut->first == cut->second;
          const bool is_first_corner = cut->first == t.corners()[0];
          cuts.emplace_back(cut->first, !is_point ? cut->second : t.corners()[is_first_corner]);
        }
      }
      for (const RationalTriangle::Piece& piece : t.Pieces(cuts)) {
        if (IsInside(body, t, coplanar, piece.sample)) return true;
      }
    }
    return false;
  }

  bool IsInside(Body body, const RationalTriangle& t, const std::vector<RationalTriangle>& coplanar,
                const RationalPoint& sample) {
    for (const RationalTriangle& u : coplanar) {
      if (u.Holds(sample)) return sgn(Dot(t.normal(), u.normal())) > 0;
    }
    return IsInSolid(Other(body), sample);
  }

  bool SomeUntouchedComponentIsInside(Body body) {
    const TriangleMesh& mesh = placed_.mesh(body);
    const std::vector<int> component = ComponentOfVertex(mesh);
    std::vector<char> is_done(mesh.vertex_count(), 0);  // by component
    for (const auto& [f, others] : met(body)) is_done[component[mesh.faces()[f][0]]] = 1;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      if (is_done[component[v]]) continue;
      is_done[component[v]] = 1;
      if (IsInSolid(Other(body), placed_.Rational({body, v}))) return true;
    }
    return false;
  }

  // Whether a point that is not on the surface lies inside the solid, by a ray in a direction close
  // to that of x that meets no edge: one of the first few does.
  bool IsInSolid(Body solid, const RationalPoint& x) const {
    const Vector3d at = placed_.Double(x);
    const double size = 4.0 * (placed_.pair().size() + MaxAbs(placed_.offset()));
    // x = numerators / denominator: signs are those of integers.
    Integer denominator = 1;
    for (const mpq_class& value : x) denominator = lcm(denominator, value.get_den());
    IntegerVector numerators;
    for (int i = 0; i < 3; ++i) numerators[i] = x[i].get_num() * (denominator / x[i].get_den());
    const int most_attempts = 6 * placed_.mesh(solid).face_count() + 1;
    for (int attempt = 1; attempt <= most_attempts; ++attempt) {
      // On a curve that meets each plane in two points at most; times 2^20.
      const IntegerVector direction = {1 << 20, attempt, attempt * attempt};
      const Vector3d along(1.0, attempt * 0x1p-20, attempt * attempt * 0x1p-20);
      const double drift = size * attempt * attempt * 0x1p-20 + 4.0 * placed_.error();
      bool inside = false, is_clear = true;
      for (int f = 0; f < placed_.mesh(solid).face_count() && is_clear; ++f) {
        if (!IsNearRay(solid, f, at, drift)) continue;
        const RayMeeting meeting = TriageRay(solid, f, at, along);
        if (meeting != RayMeeting::kUnsure) {
          inside ^= meeting == RayMeeting::kCrosses;
          continue;
        }
        const Corners corners = placed_.corners(solid, f);
        IntegerVector from_x[3];
        for (int k = 0; k < 3; ++k) {
          from_x[k] = denominator * placed_.Exact(corners[k]) - numerators;
        }
        int least = 1, greatest = -1;
        for (int k = 0; k < 3; ++k) {
          const int side = DotSign(direction, Cross(from_x[k], from_x[(k + 1) % 3]));
          least = std::min(least, side);
          greatest = std::max(greatest, side);
        }
        if (least < 0 && greatest > 0) continue;
        is_clear = least != 0 && greatest != 0;
        // The line passes through; ahead iff the plane is met at a positive multiple.
        inside ^= sgn(Determinant(from_x[0], from_x[1], from_x[2])) * (least + greatest) > 0;
      }
      if (is_clear) return inside;
    }
    // Each plane through x and an edge holds two of the directions at most, so x is on an edge.
    return false;
  }

  enum class RayMeeting { kMisses, kCrosses, kUnsure };

  // The same in doubles. Corners less `at` are off by 2 error() and one rounding each. The line's
  // side of an edge is the sum of six products of `along` and two of these; the three sides add up
  // to normal . along, and the determinant of the three corners is normal . u.
  RayMeeting TriageRay(Body solid, int f, const Vector3d& at, const Vector3d& along) const {
    const Corners corners = placed_.corners(solid, f);
    const Vector3d from_x[3] = {placed_.Double(corners[0]) - at, placed_.Double(corners[1]) - at,
                                placed_.Double(corners[2]) - at};
    const double e = 2.0 * placed_.error(), unit = 60.0 * 0x1p-52;
    const double size[3] = {MaxAbs(from_x[0]) + e, MaxAbs(from_x[1]) + e, MaxAbs(from_x[2]) + e};
    const double l = MaxAbs(along);
    bool some_left = false, some_right = false, some_unsure = false;
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      const double side = Triple(along, from_x[k], from_x[next]);
      const double bound =
          1.1 * l * (6.0 * e * (size[k] + size[next]) + unit * size[k] * size[next]) + 1e-320;
      some_left |= side > bound;
      some_right |= side < -bound;
      some_unsure |= !(std::abs(side) > bound);
    }
    if (some_left && some_right) return RayMeeting::kMisses;
    if (some_unsure) return RayMeeting::kUnsure;
    const double height = Triple(from_x[0], from_x[1], from_x[2]);
    const double bound =
        1.1 * (6.0 * e * (size[0] * size[1] + size[1] * size[2] + size[2] * size[0]) +
               unit * size[0] * size[1] * size[2]) +
        1e-320;
    if (!(std::abs(height) > bound)) return RayMeeting::kUnsure;
    return (height > 0.0) == some_left ? RayMeeting::kCrosses : RayMeeting::kMisses;
  }

  // Whether the face's box comes within `drift` of the ray from `at` along x.
  bool IsNearRay(Body body, int f, const Vector3d& at, double drift) const {
    const Corners corners = placed_.corners(body, f);
    const Vector3d a = placed_.Double(corners[0]), b = placed_.Double(corners[1]),
                   c = placed_.Double(corners[2]);
    const Vector3d low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    return high[0] >= at[0] - drift && low[1] <= at[1] + drift && high[1] >= at[1] - drift &&
           low[2] <= at[2] + drift && high[2] >= at[2] - drift;
  }

  // A number for each vertex, equal where faces join them.
  static std::vector<int> ComponentOfVertex(const TriangleMesh& mesh) {
    std::vector<int> parent(mesh.vertex_count());
    for (int v = 0; v < mesh.vertex_count(); ++v) parent[v] = v;
    const auto find = [&](int v) {
      while (parent[v] != v) v = parent[v] = parent[parent[v]];
      return v;
    };
    for (const auto& t : mesh.faces()) {
      parent[find(t[0])] = find(t[1]);
      parent[find(t[1])] = find(t[2]);
    }
    for (int v = 0; v < mesh.vertex_count(); ++v) parent[v] = find(v);
    return parent;
  }

  const Placed placed_;
  std::array<std::map<int, std::vector<int>>, 2>
      met_;  // a face of A, of B: those it shares points with
};

}  // namespace

Verdict MeshMembership(const PlacedMeshPair& pair, const ExactTranslation& x) {
  return Query(pair, x).Run();
}

}  // namespace touchstone::exact
