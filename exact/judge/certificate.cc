// SPDX-License-Identifier: GPL-3.0-or-later
//
// Check 2: the certificate proves the verdict, by itself.
#include <climits>
#include <cmath>

#include "touchstone/exact/judge/checks.h"
#include "touchstone/exact/support.h"

namespace touchstone::exact {
namespace {

// max over P of n.p < min over Q of n.q, for a direction in P's frame.
const char* CheckSeparation(const PlacedPair& pair, const IntegerVector& n) {
  if (IsZero(n)) return "the direction is zero";
  const IntegerVector n_in_q = pair.ToQ(n);
  const Integer most_p = pair.ValueP(n, ExtremeVertex(pair.p(), n));
  const Integer least_q = pair.ValueQ(n_in_q, n, ExtremeVertex(pair.q(), -n_in_q));
  return most_p < least_q ? nullptr : "the direction does not separate";
}

const char* CheckDirection(const PlacedPair& pair, const Eigen::Vector3d& direction) {
  if (!direction.allFinite()) return "the direction is not finite";
  const int exponent = CommonExponent(direction.data(), 3, INT_MAX);
  return CheckSeparation(pair, ToInteger(direction, exponent));
}

// o - c = v = sum li ai with ai = vi - c: Cramer's rule, all signs relative to that of det [a1 a2
// a3].
const char* CheckTetrahedron(const PlacedPair& pair, const std::array<VertexPair, 3>& points) {
  const IntegerVector a = pair.FromC(points[0]), b = pair.FromC(points[1]),
                      c = pair.FromC(points[2]);
  const IntegerVector ab = Cross(a, b);
  const Integer volume = Dot(ab, c);
  const int sign = sgn(volume);
  if (sign == 0) return "the tetrahedron is flat";
  const Integer la = Determinant(pair.v(), b, c), lb = Determinant(pair.v(), c, a),
                lc = Dot(pair.v(), ab);
  if (sgn(la) * sign < 0 || sgn(lb) * sign < 0 || sgn(lc) * sign < 0) {
    return "o is outside the tetrahedron";
  }
  const Integer l0 = volume - la - lb - lc;
  return sgn(l0) * sign > 0 ? nullptr : "o is not on c's side of the tetrahedron's far face";
}

const char* CheckTouch(const PlacedPair& pair, const std::array<VertexPair, 3>& points) {
  const IntegerVector a = pair.Difference(points[0]), b = pair.Difference(points[1]),
                      c = pair.Difference(points[2]);
  const IntegerVector n = Cross(b - a, c - a);
  if (IsZero(n)) return "the three points are collinear";
  if (DotSign(n, a) != 0) return "o is off the plane";
  const VertexPair extreme = SupportingPair(pair, n);
  if (DotSign(n, pair.Difference(extreme)) > 0) return "the plane does not support M";
  if (DotSign(n, Cross(a, b)) < 0 || DotSign(n, Cross(b, c)) < 0 || DotSign(n, Cross(c, a)) < 0) {
    return "o is outside the triangle";
  }
  return nullptr;
}

Verdict ProvenBy(CertificateKind kind) {
  switch (kind) {
    case CertificateKind::kSeparatingDirection:
    case CertificateKind::kSeparatingFacet:
      return Verdict::kSeparate;
    case CertificateKind::kEnclosingTetrahedron:
    case CertificateKind::kCoincidentInterior:
      return Verdict::kOverlap;
    case CertificateKind::kTouchingFacet:
      return Verdict::kTouch;
    case CertificateKind::kNone:
      break;
  }
  return Verdict::kUndecided;
}

// Why the certificate proves nothing; null if it holds.
const char* Refute(const PlacedPair& pair, const Certificate& certificate) {
  const std::array<VertexPair, 3>& points = certificate.points;
  switch (certificate.kind) {
    case CertificateKind::kNone:
      return "absent";
    case CertificateKind::kSeparatingDirection:
      return CheckDirection(pair, certificate.direction);
    case CertificateKind::kSeparatingFacet: {
      const IntegerVector a = pair.FromC(points[0]);
      return CheckSeparation(pair, Cross(pair.FromC(points[1]) - a, pair.FromC(points[2]) - a));
    }
    case CertificateKind::kEnclosingTetrahedron:
      return CheckTetrahedron(pair, points);
    case CertificateKind::kCoincidentInterior:
      return IsZero(pair.c()) ? nullptr : "c is not o";
    case CertificateKind::kTouchingFacet:
      return CheckTouch(pair, points);
  }
  return "of no known kind";
}

}  // namespace

bool CheckCertificate(const JudgeContext& context) {
  const Certificate& certificate = context.result.certificate;
  const Verdict verdict = context.result.verdict;
  if (certificate.kind == CertificateKind::kNone) {
    if (verdict != Verdict::kUndecided && !context.published()) {
      context.Add(FindingKind::kMissingPart, "no certificate");
    }
    return false;
  }
  const std::string kind(ToString(certificate.kind));
  if (ProvenBy(certificate.kind) != verdict) {
    context.Add(FindingKind::kBadCertificate,
                kind + " does not fit the verdict " + std::string(ToString(verdict)));
    return false;
  }
  if (const char* reason = Refute(context.pair, certificate); reason != nullptr) {
    context.Add(FindingKind::kBadCertificate, kind + ": " + reason);
    return false;
  }
  return true;
}

}  // namespace touchstone::exact
