// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/tests/exact/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "touchstone/exact/convert.h"
#include "touchstone/exact/convex_hull.h"
#include "touchstone/exact/decide.h"
#include "touchstone/exact/exit_values.h"
#include "touchstone/exact/judge/values.h"
#include "touchstone/exact/phase_maxima.h"
#include "touchstone/exact/support.h"

namespace touchstone::exact {
namespace {

bool Includes(const std::vector<int>& set, std::span<const int> some) {
  return std::all_of(some.begin(), some.end(),
                     [&](int v) { return std::find(set.begin(), set.end(), v) != set.end(); });
}

// An element of the body that spans the supporting feature.
Feature ElementOf(const ExactBodyData& body, const std::vector<int>& supporting) {
  const int dimension = Dimension(body, supporting);
  if (dimension == 0) return {FeatureKind::kVertex, supporting[0]};
  if (dimension == 2) {
    for (int f = 0; f < body.face_count; ++f) {
      if (Includes(supporting, body.face(f))) return {FeatureKind::kFace, f};
    }
  }
  const auto& edges = body.topology().edges;
  for (int e = 0; e < static_cast<int>(edges.size()); ++e) {
    const int ends[] = {edges[e].tail, edges[e].head};
    if (Includes(supporting, ends)) return {FeatureKind::kEdge, e};
  }
  return {};
}

BoundedValue Bounded(const Real& exact, double amplification) {
  const double value = exact.ToDouble();
  return {value, 0x1p-52 * std::abs(value), value == 0 ? 1.0 : 1 + amplification / std::abs(value)};
}

CertificateKind KindFor(Verdict verdict) {
  return verdict == Verdict::kSeparate ? CertificateKind::kSeparatingFacet
         : verdict == Verdict::kTouch  ? CertificateKind::kTouchingFacet
                                       : CertificateKind::kEnclosingTetrahedron;
}

}  // namespace

std::uint64_t Random::Next() {
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

int Random::Integer(int low, int high) {
  return low + static_cast<int>(Next() % static_cast<std::uint64_t>(high - low + 1));
}

double Random::Real(double low, double high) {
  return low + (high - low) * (static_cast<double>(Next() >> 11) * 0x1p-53);
}

Eigen::Vector3d Random::OnSphere() {
  while (true) {
    const Eigen::Vector3d x(Real(-1, 1), Real(-1, 1), Real(-1, 1));
    if (const double n = x.squaredNorm(); n > 0.01 && n < 1) return x / std::sqrt(n);
  }
}

ConvexPolyhedron Hull(const Points& points, bool merge_coplanar) {
  return ConvexHull(points, {.merge_coplanar = merge_coplanar}).value();
}

ConvexPolyhedron Box(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  Points corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back((i & 1 ? high : low).x(), (i & 2 ? high : low).y(),
                         (i & 4 ? high : low).z());
  }
  return Hull(corners);
}

ConvexPolyhedron GridHull(Random* random, int count, int reach, bool merge_coplanar) {
  while (true) {
    Points points;
    for (int i = 0; i < count; ++i) {
      points.emplace_back(random->Integer(-reach, reach), random->Integer(-reach, reach),
                          random->Integer(-reach, reach));
    }
    const StatusOr<ConvexPolyhedron> hull = ConvexHull(points, {.merge_coplanar = merge_coplanar});
    if (hull.ok()) return *hull;
  }
}

ConvexPolyhedron EllipsoidHull(Random* random, int count, const Eigen::Vector3d& axes) {
  Points points;
  for (int i = 0; i < count; ++i) points.push_back(axes.cwiseProduct(random->OnSphere()));
  return Hull(points);
}

Eigen::Matrix3d CubeRotation(Random* random) {
  while (true) {
    Eigen::Matrix3d r = Eigen::Matrix3d::Zero();
    int column[3] = {0, 1, 2};
    for (int i = 2; i > 0; --i) std::swap(column[i], column[random->Integer(0, i)]);
    for (int i = 0; i < 3; ++i) r(i, column[i]) = random->Integer(0, 1) != 0 ? 1 : -1;
    if (r.determinant() > 0) return r;
  }
}

Eigen::Matrix3d RoundedRotation(Random* random) {
  return Eigen::AngleAxisd(random->Real(0, 3.14), random->OnSphere()).toRotationMatrix();
}

RelativePose Pose(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation) {
  return RelativePose::Make(rotation, translation).value();
}

CollideResult GoodResult(const ExactBody& p, const ExactBody& q, const RelativePose& pose) {
  CollideResult result;
  const PlacedPair pair(p.data(), q.data(), pose, 0, 0);
  const ExactDecision decision = Decide(p, q, pose);
  const ExactExit& exit = decision.exit.value();
  const IntegerVector a = pair.FromC(exit.triangle[0]);
  const IntegerVector n = Cross(pair.FromC(exit.triangle[1]) - a, pair.FromC(exit.triangle[2]) - a);
  const SupportingFeatures supporting = Supporting(pair, n);
  const ExitValues values = ValuesAt(pair, n, RatioOf(pair, n));
  const Amplifications amplifications = AmplificationsAt(values, pair.size());

  result.verdict = decision.verdict;
  result.tier = Tier::kExact;
  result.phase = Phase::kPortal;
  result.termination = Termination::kOptimal;
  result.interior_difference = pair.c_double();
  result.face = ExitFace{exit.face_class, ElementOf(pair.p(), supporting.p),
                         ElementOf(pair.q(), supporting.q), exit.triangle};
  result.signed_distance = Bounded(values.signed_distance, amplifications.signed_distance);
  result.exit_travel = Bounded(values.exit_travel, amplifications.exit_travel);
  result.exit_point = exit.exit_point;
  result.exit_point_error = 0x1p-52 * exit.exit_point.norm();
  result.certificate.kind = KindFor(decision.verdict);
  result.certificate.points = exit.triangle;
  return result;
}

void AddPhaseMaxima(const ExactBody& p, const ExactBody& q, const RelativePose& pose,
                    CollideResult* result) {
  const PlacedPair pair(p.data(), q.data(), pose, 0, 0);
  std::array<std::optional<Ratio>, 3> best;
  const auto offer = [&](int phase, FaceClass face_class, Feature feature_p, Feature feature_q,
                         const IntegerVector& n) {
    Ratio ratio = RatioOf(pair, n);
    if (best[phase].has_value() && Compare(ratio, *best[phase]) <= 0) return;
    const double d = ValuesAt(pair, n, ratio).signed_distance.ToDouble();
    result->phases[phase] = {PhaseClaim::kMaximum, face_class, feature_p, feature_q, d};
    best[phase] = std::move(ratio);
  };
  for (int f = 0; f < pair.p().face_count; ++f) {
    const IntegerVector n = FaceVertexNormal(pair, f);
    const Feature vertex{FeatureKind::kVertex, SupportingPair(pair, n).q};
    offer(0, FaceClass::kFaceVertex, {FeatureKind::kFace, f}, vertex, n);
  }
  for (int f = 0; f < pair.q().face_count; ++f) {
    const IntegerVector n = VertexFaceNormal(pair, f);
    const Feature vertex{FeatureKind::kVertex, SupportingPair(pair, n).p};
    offer(1, FaceClass::kVertexFace, vertex, {FeatureKind::kFace, f}, n);
  }
  for (int e_p = 0; e_p < p.edge_count(); ++e_p) {
    for (int e_q = 0; e_q < q.edge_count(); ++e_q) {
      if (!ArcsCross(pair, e_p, e_q)) continue;
      offer(2, FaceClass::kEdgeEdge, {FeatureKind::kEdge, e_p}, {FeatureKind::kEdge, e_q},
            EdgeEdgeNormal(pair, e_p, e_q));
    }
  }
  for (int phase = 0; phase < 3; ++phase) {
    if (!best[phase].has_value()) result->phases[phase].claim = PhaseClaim::kEmpty;
  }
}

}  // namespace touchstone::exact
