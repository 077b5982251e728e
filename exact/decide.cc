// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/decide.h"

#include <Eigen/Geometry>
#include <cmath>

#include "touchstone/exact/exact_body_data.h"
#include "touchstone/exact/exit_values.h"
#include "touchstone/exact/support.h"

namespace touchstone::exact {
namespace {

// sign((v + e1 x + e2 y + e3 z) . m) for e1 >> e2 >> e3 > 0, infinitely small: the ray's direction
// moved off every plane through c. Zero only for m = 0.
int PerturbedSign(const IntegerVector& v, const IntegerVector& m) {
  if (const int sign = DotSign(v, m); sign != 0) return sign;
  for (const Integer& component : m) {
    if (sgn(component) != 0) return sgn(component);
  }
  return 0;
}

struct Portal {
  std::array<VertexPair, 3> pairs;
  std::array<IntegerVector, 3> points;  // less c; counterclockwise seen from outside
};

// The triangle of P's boundary that the perturbed ray from P's interior point leaves P by, as
// points of M: each vertex of P less Q's interior point. Faces are cut into fans; a triangle is
// crossed when the ray lies on the inner side of the three planes through it and the interior
// point.
class FirstPortal {
 public:
  FirstPortal(const PlacedPair& pair, const IntegerVector& interior_p)
      : body_(pair.p()), pair_(pair), interior_(interior_p), v_(ToDirection(pair.v())) {
    const Eigen::Vector3d inner = ToDouble(interior_);
    reach_ = 2 * body_.max_coordinate;
    // Six products of the direction (off by 2u) and two differences (u each, below the reach), with
    // at most nine roundings each, sums included: 54u reach^2 < 2^-47 reach^2.
    error_ = 0x1p-46 * reach_ * reach_;
    for (int i = 0; i < body_.vertex_count; ++i) {
      from_inner_.push_back(Eigen::Vector3d(body_.x[i], body_.y[i], body_.z[i]) - inner);
    }
  }

  std::optional<Portal> Find() const {
    for (int f = 0; f < body_.face_count; ++f) {
      const std::span<const int> loop = body_.face(f);
      for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
        if (Sign(loop[k], loop[k + 1]) > 0 && Sign(loop[0], loop[k]) > 0 &&
            Sign(loop[k + 1], loop[0]) > 0) {
          return Make(loop[0], loop[k], loop[k + 1]);
        }
      }
    }
    return std::nullopt;
  }

 private:
  Eigen::Vector3d ToDouble(const IntegerVector& point) const {
    long exponent = 0;
    const Eigen::Vector3d d = ToDirection(point, &exponent);
    const int e = static_cast<int>(exponent) + body_.exponent;
    return {std::ldexp(d.x(), e), std::ldexp(d.y(), e), std::ldexp(d.z(), e)};
  }

  // On which side of the plane through the interior point, a and b the ray runs.
  int Sign(int a, int b) const {
    const double value = v_.dot(from_inner_[a].cross(from_inner_[b]));
    if (error_ > 1e-250 && std::abs(value) > error_) return value > 0 ? 1 : -1;
    return PerturbedSign(pair_.v(),
                         Cross(body_.vertices[a] - interior_, body_.vertices[b] - interior_));
  }

  Portal Make(int a, int b, int c) const {
    Portal portal;
    portal.pairs = {VertexPair{a, -1}, VertexPair{b, -1}, VertexPair{c, -1}};
    for (int i = 0; i < 3; ++i) portal.points[i] = pair_.FromC(portal.pairs[i]);
    return portal;
  }

  const ExactBodyData& body_;
  const PlacedPair& pair_;
  const IntegerVector& interior_;
  Eigen::Vector3d v_;
  std::vector<Eigen::Vector3d> from_inner_;
  double reach_ = 0.0, error_ = 0.0;
};

// Pushes the portal outward until its plane supports M. Returns that plane's normal.
IntegerVector Push(const PlacedPair& pair, Portal* portal) {
  std::array<IntegerVector, 3>& a = portal->points;
  while (true) {
    IntegerVector n = Cross(a[1] - a[0], a[2] - a[0]);
    const VertexPair beyond = SupportingPair(pair, n);
    const IntegerVector w = pair.FromC(beyond);
    if (DotSign(n, w - a[0]) <= 0) return n;
    // The tetrahedron of the portal and w: the ray enters by the portal and leaves by the one face
    // between whose two old vertices the plane of the ray and w passes.
    int sign[3];
    for (int i = 0; i < 3; ++i) sign[i] = PerturbedSign(pair.v(), Cross(w, a[i]));
    for (int i = 0; i < 3; ++i) {
      if (sign[i] > 0 && sign[(i + 1) % 3] < 0) {
        const int replaced = (i + 2) % 3;
        portal->pairs[replaced] = beyond;
        a[replaced] = w;
        break;
      }
    }
  }
}

}  // namespace

ExactDecision Decide(const ExactBody& p, const ExactBody& q, const RelativePose& pose,
                     int interior_p, int interior_q) {
  const PlacedPair pair(p.data(), q.data(), pose, interior_p, interior_q);
  ExactDecision decision;
  if (IsZero(pair.c())) {
    decision.verdict = Verdict::kOverlap;
    return decision;
  }
  decision.interior_distance_squared = pair.ToLengthSquared(Dot(pair.c(), pair.c()));
  std::optional<Portal> portal = FirstPortal(pair, p.data().interior[interior_p]).Find();
  if (!portal.has_value()) return decision;  // the interior point is not interior
  const IntegerVector n = Push(pair, &*portal);

  const Ratio ratio = RatioOf(pair, n, portal->pairs[0]);
  const ExitValues values = ValuesAt(pair, n, ratio);
  ExactExit exit;
  exit.parameter = ToRational({ratio.denominator, ratio.numerator});
  exit.signed_distance = values.signed_distance.ToDouble();
  exit.exit_travel = values.exit_travel.ToDouble();
  for (int k = 0; k < 3; ++k) exit.exit_point[k] = values.exit_point[k].ToDouble();
  exit.normal_cosine = values.normal_cosine.ToDouble();
  exit.face_class = ClassOf(pair, Supporting(pair, n)).value_or(FaceClass::kEdgeEdge);
  exit.triangle = portal->pairs;
  const int sign = cmp(ratio.denominator, ratio.numerator);  // of s - 1
  decision.verdict = sign < 0    ? Verdict::kSeparate
                     : sign == 0 ? Verdict::kTouch
                                 : Verdict::kOverlap;
  decision.interior_distance = values.interior_distance.ToDouble();
  decision.exit = exit;
  return decision;
}

}  // namespace touchstone::exact
