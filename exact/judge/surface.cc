// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "touchstone/exact/judge_surface.h"
#include "touchstone/exact/mesh_membership.h"
#include "touchstone/exact/mesh_pair.h"

namespace touchstone::exact {
namespace {

using Rational = mpq_class;
using Point = std::array<Rational, 3>;
using Corners = std::array<Point, 3>;

Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point operator*(const Rational& f, const Point& a) { return {f * a[0], f * a[1], f * a[2]}; }
Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Rational Dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point Cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point NormalOf(const Corners& t) { return Cross(t[1] - t[0], t[2] - t[0]); }
bool IsFraction(const Rational& x) { return sgn(x) >= 0 && x <= 1; }

// Whether x, in the plane of the triangle, lies in it.
bool Holds(const Corners& t, const Point& normal, const Point& x) {
  for (int k = 0; k < 3; ++k) {
    if (sgn(Dot(normal, Cross(t[(k + 1) % 3] - t[k], x - t[k]))) < 0) return false;
  }
  return true;
}

Rational SquaredFromSegment(const Point& p, const Point& a, const Point& b) {
  const Point side = b - a, to = p - a;
  Rational part = Dot(side, to) / Dot(side, side);
  if (sgn(part) < 0) part = 0;
  if (part > 1) part = 1;
  const Point rest = to - part * side;
  return Dot(rest, rest);
}

// Where each line is nearest to the other, if that is on both segments.
std::optional<Rational> SquaredBetweenLines(const Point& a, const Point& b, const Point& c,
                                            const Point& d) {
  const Point u = b - a, v = d - c, w = a - c;
  const Rational uu = Dot(u, u), vv = Dot(v, v), uv = Dot(u, v), uw = Dot(u, w), vw = Dot(v, w);
  const Rational det = uu * vv - uv * uv;
  if (sgn(det) == 0) return std::nullopt;
  const Rational s = (uv * vw - vv * uw) / det, t = (uu * vw - uv * uw) / det;
  if (!IsFraction(s) || !IsFraction(t)) return std::nullopt;
  const Point between = w + s * u - t * v;
  return Dot(between, between);
}

// Over the inside of a face, or through it.
std::optional<Rational> SquaredFromPlane(const Point& p, const Corners& t) {
  const Point normal = NormalOf(t);
  const Rational height = Dot(normal, p - t[0]), length = Dot(normal, normal);
  if (!Holds(t, normal, p - (height / length) * normal)) return std::nullopt;
  return height * height / length;
}

bool PassesThrough(const Point& a, const Point& b, const Corners& t) {
  const Point normal = NormalOf(t);
  const Rational at_a = Dot(normal, a - t[0]), at_b = Dot(normal, b - t[0]);
  if (sgn(at_a) * sgn(at_b) >= 0) return false;
  return Holds(t, normal, a + (at_a / (at_a - at_b)) * (b - a));
}

Rational SquaredDistance(const Corners& a, const Corners& b) {
  Rational least = Dot(a[0] - b[0], a[0] - b[0]);
  const auto offer = [&](const Rational& squared) {
    if (squared < least) least = squared;
  };
  for (int i = 0; i < 3; ++i) {
    const Point &a0 = a[i], &a1 = a[(i + 1) % 3], &b0 = b[i], &b1 = b[(i + 1) % 3];
    if (PassesThrough(a0, a1, b) || PassesThrough(b0, b1, a)) return 0;
    if (const auto squared = SquaredFromPlane(a0, b)) offer(*squared);
    if (const auto squared = SquaredFromPlane(b0, a)) offer(*squared);
    for (int j = 0; j < 3; ++j) {
      offer(SquaredFromSegment(a[j], b0, b1));
      offer(SquaredFromSegment(b[j], a0, a1));
      if (const auto squared = SquaredBetweenLines(a0, a1, b[j], b[(j + 1) % 3])) offer(*squared);
    }
  }
  return least;
}

// The t at which a corner moving along s comes into the plane of a face, on the face.
std::optional<Rational> CornerOntoFace(const Point& p, const Corners& t, const Point& s) {
  const Point normal = NormalOf(t);
  const Rational rate = Dot(normal, s);
  if (sgn(rate) == 0) return std::nullopt;
  const Rational time = Dot(normal, t[0] - p) / rate;
  if (!Holds(t, normal, p + time * s)) return std::nullopt;
  return time;
}

// The t at which the segment cd, moving along s, crosses ab.
std::optional<Rational> SideOntoSide(const Point& a, const Point& b, const Point& c, const Point& d,
                                     const Point& s) {
  const Point u = b - a, v = d - c, normal = Cross(u, v);
  const Rational rate = Dot(normal, s);
  if (sgn(rate) == 0) return std::nullopt;
  const Rational time = Dot(normal, a - c) / rate;
  const Point w = a - (c + time * s);
  const Rational length = Dot(normal, normal);
  // a + x u = c + time s + y v, in the plane of u and v.
  const Rational x = Dot(Cross(v, w), normal) / length, y = Dot(Cross(u, w), normal) / length;
  if (!IsFraction(x) || !IsFraction(y)) return std::nullopt;
  return time;
}

// SplitMix64.
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : state_(seed) {}
  double Unit() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

class SurfaceJudge {
 public:
  SurfaceJudge(const TriangleMesh& a, const TriangleMesh& b, const RelativePose& pose,
               const SurfaceJudgeOptions& options)
      : pair_(a, b, pose), options_(options) {
    unit_ = Rational(1) / Rational(pair_.scale());
    const int exponent = pair_.exponent();
    if (exponent >= 0) {
      mpq_mul_2exp(unit_.get_mpq_t(), unit_.get_mpq_t(), static_cast<unsigned>(exponent));
    } else {
      mpq_div_2exp(unit_.get_mpq_t(), unit_.get_mpq_t(), static_cast<unsigned>(-exponent));
    }
  }

  std::vector<std::string> Distance(const SurfaceDistanceClaim& claim) {
    const bool meets = Meets(0, {0, 0, 0});
    if (!AreBounds(claim.lower_bound, claim.upper_bound)) return Finding("bounds out of order");
    if (claim.face_a < 0) {
      return meets ? findings_ : Finding("said to be zero, and the bodies are apart");
    }
    if (meets) return Finding("said to be positive, and the bodies meet");
    const Rational upper(claim.upper_bound), lower(claim.lower_bound);
    if (!AreFaces(claim.face_a, claim.face_b)) return Finding("names no faces");
    if (SquaredDistance(OfA(claim.face_a), OfB(claim.face_b)) > upper * upper) {
      Finding("the faces named are further apart than the upper bound");
    }
    const auto near =
        NearFaces(pair_.tree_a(), pair_.tree_b(), Eigen::Vector3d::Zero(), claim.lower_bound);
    const std::size_t every =
        std::max<std::size_t>(1, near.size() / static_cast<std::size_t>(options_.face_samples));
    for (std::size_t k = 0; k < near.size(); k += every) {
      const auto [face_a, face_b] = near[k];
      if (SquaredDistance(OfA(face_a), OfB(face_b)) >= lower * lower) continue;
      return Finding("faces " + std::to_string(face_a) + " and " + std::to_string(face_b) +
                     " are nearer than the lower bound");
    }
    return findings_;
  }

  std::vector<std::string> Travel(const SurfaceTravelClaim& claim) {
    if (!AreBounds(claim.lower_bound, claim.upper_bound)) return Finding("bounds out of order");
    const Point s{Rational(claim.s[0]), Rational(claim.s[1]), Rational(claim.s[2])};
    if (claim.is_hit && claim.face_a < 0) {
      return Meets(0, s) ? findings_ : Finding("said to be zero, and the bodies are apart");
    }
    // Apart before it; the first of the placements is the last moment, the others are before.
    Numbers numbers(options_.seed);
    const double last = claim.is_hit ? claim.lower_bound : claim.reach;
    for (int k = 0; k < options_.placements; ++k) {
      const double before = last * (k == 0 ? 1.0 - 0x1p-40 : numbers.Unit());
      const double t = !claim.is_hit && k == 0 ? last : before;
      if (Meets(Rational(t), s)) return Finding("they meet before the lower bound");
    }
    if (claim.is_hit && !MeetsBy(claim, s)) Finding("they do not meet by the upper bound");
    return findings_;
  }

 private:
  std::vector<std::string> Finding(const std::string& what) {
    findings_.push_back(what);
    return findings_;
  }

  static bool AreBounds(double lower, double upper) {
    return std::isfinite(upper) && lower >= 0.0 && lower <= upper;
  }
  bool AreFaces(int face_a, int face_b) const {
    return face_a >= 0 && face_a < pair_.a().face_count() && face_b >= 0 &&
           face_b < pair_.b().face_count();
  }

  // In true units.
  Point Of(const IntegerVector& v) const {
    return {unit_ * Rational(v[0]), unit_ * Rational(v[1]), unit_ * Rational(v[2])};
  }
  Corners OfA(int face) const {
    const auto& f = pair_.a().face(face);
    return {Of(pair_.point_a(f[0])), Of(pair_.point_a(f[1])), Of(pair_.point_a(f[2]))};
  }
  Corners OfB(int face) const {
    const auto& f = pair_.b().face(face);
    return {Of(pair_.point_b(f[0])), Of(pair_.point_b(f[1])), Of(pair_.point_b(f[2]))};
  }

  bool Meets(const Rational& t, const Point& s) const {
    return MeshMembership(pair_, ExactTranslation(t * s)) != Verdict::kSeparate;
  }

  // By the faces named, at some t within the bounds; or, where these slide in one plane, by bodies
  // that meet at the upper bound.
  bool MeetsBy(const SurfaceTravelClaim& claim, const Point& s) const {
    if (!AreFaces(claim.face_a, claim.face_b)) return false;
    const Rational lower(claim.lower_bound), upper(claim.upper_bound);
    const Corners a = OfA(claim.face_a), b = OfB(claim.face_b);
    const Point back = Rational(-1) * s;
    const auto is_due = [&](const std::optional<Rational>& time) {
      return time && *time >= lower && *time <= upper;
    };
    for (int i = 0; i < 3; ++i) {
      if (is_due(CornerOntoFace(b[i], a, s))) return true;
      if (is_due(CornerOntoFace(a[i], b, back))) return true;
      for (int j = 0; j < 3; ++j) {
        if (is_due(SideOntoSide(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3], s))) return true;
      }
    }
    return Meets(upper, s);
  }

  const PlacedMeshPair pair_;
  const SurfaceJudgeOptions& options_;
  Rational unit_;
  std::vector<std::string> findings_;
};

}  // namespace

std::vector<std::string> JudgeSurfaceDistance(const TriangleMesh& a, const TriangleMesh& b,
                                              const RelativePose& pose,
                                              const SurfaceDistanceClaim& claim,
                                              const SurfaceJudgeOptions& options) {
  return SurfaceJudge(a, b, pose, options).Distance(claim);
}

std::vector<std::string> JudgeSurfaceTravel(const TriangleMesh& a, const TriangleMesh& b,
                                            const RelativePose& pose,
                                            const SurfaceTravelClaim& claim,
                                            const SurfaceJudgeOptions& options) {
  return SurfaceJudge(a, b, pose, options).Travel(claim);
}

}  // namespace touchstone::exact
