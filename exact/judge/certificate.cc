// SPDX-License-Identifier: GPL-3.0-or-later
//
// Check 2: the certificate proves the verdict, by itself.
#include <climits>
#include <cmath>

#include "touchstone/exact/faces.h"
#include "touchstone/exact/judge/checks.h"

namespace touchstone::exact {
namespace {

// Whether doubles prove that the direction separates: max over P of n.p < min over Q of n.q, by
// more than the error of both values and of n.t.
bool SeparatesInDoubles(const PlacedPair& pair, const Eigen::Vector3d& direction) {
  const double largest = direction.cwiseAbs().maxCoeff();
  if (!(largest > 0x1p-1000 && pair.error() > 0x1p-900)) return false;
  const Eigen::Vector3d n = direction / largest;  // off by half an ulp of itself
  const double most_p = Largest(pair.p(), n);
  const double least_q = -Largest(pair.q(), -(pair.rotation().transpose() * n));
  return most_p - least_q - n.dot(pair.translation()) < -4 * pair.error();
}

// max over P of n.p < min over Q of n.q, for a direction in P's frame.
const char* CheckDirection(const PlacedPair& pair, const Eigen::Vector3d& direction) {
  if (!direction.allFinite()) return "the direction is not finite";
  if (SeparatesInDoubles(pair, direction)) return nullptr;
  const IntegerVector n = ToInteger(direction, CommonExponent(direction.data(), 3, INT_MAX));
  if (IsZero(n)) return "the direction is zero";
  const IntegerVector n_in_q = pair.ToQ(n);
  const Integer most_p = pair.ValueP(n, ExtremeVertex(pair.p(), n));
  const Integer least_q = pair.ValueQ(n_in_q, n, ExtremeVertex(pair.q(), -n_in_q));
  return most_p < least_q ? nullptr : "the direction does not separate";
}

// max over M of n.(x - c) for the triangle's normal n.
Integer MostAlong(const JudgeContext& context, const NamedTriangle& triangle) {
  const SupportingFeatures& supporting = context.SupportingTriangle();
  return Dot(triangle.normal, context.pair.FromC({supporting.p[0], supporting.q[0]}));
}

// n.x < n.o for all x of M, that is, less c, n.x < n.v.
const char* CheckSeparatingFacet(const JudgeContext& context, const NamedTriangle& triangle) {
  if (IsZero(triangle.normal)) return "the direction is zero";
  return MostAlong(context, triangle) < triangle.ratio.numerator
             ? nullptr
             : "the direction does not separate";
}

// o - c = v = sum li ai with ai = vi - c: Cramer's rule, all signs relative to that of det [a1 a2
// a3], which is the ratio's denominator.
const char* CheckTetrahedron(const NamedTriangle& triangle) {
  const int sign = sgn(triangle.ratio.denominator);
  if (sign == 0) return "the tetrahedron is flat";
  for (const int side : triangle.sides) {
    if (side * sign < 0) return "o is outside the tetrahedron";
  }
  return cmp(triangle.ratio.denominator, triangle.ratio.numerator) * sign > 0
             ? nullptr
             : "o is not on c's side of the tetrahedron's far face";
}

const char* CheckTouch(const JudgeContext& context, const NamedTriangle& triangle) {
  if (IsZero(triangle.normal)) return "the three points are collinear";
  if (triangle.ratio.numerator != triangle.ratio.denominator) return "o is off the plane";
  if (MostAlong(context, triangle) > triangle.ratio.denominator)
    return "the plane does not support M";
  // o is in the plane, which c is strictly below as it supports M: v = sum li ai with li summing to
  // 1 and of the signs of the sides.
  for (const int side : triangle.sides) {
    if (side < 0) return "o is outside the triangle";
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
const char* Refute(const JudgeContext& context, const Certificate& certificate) {
  const PlacedPair& pair = context.pair;
  switch (certificate.kind) {
    case CertificateKind::kNone:
      return "absent";
    case CertificateKind::kSeparatingDirection:
      return CheckDirection(pair, certificate.direction);
    case CertificateKind::kSeparatingFacet:
      return CheckSeparatingFacet(context, context.Triangle(certificate.points));
    case CertificateKind::kEnclosingTetrahedron:
      return CheckTetrahedron(context.Triangle(certificate.points));
    case CertificateKind::kCoincidentInterior:
      return IsZero(pair.c()) ? nullptr : "c is not o";
    case CertificateKind::kTouchingFacet:
      return CheckTouch(context, context.Triangle(certificate.points));
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
  const auto kind = [&] { return std::string(ToString(certificate.kind)); };
  if (ProvenBy(certificate.kind) != verdict) {
    context.Add(FindingKind::kBadCertificate,
                kind() + " does not fit the verdict " + std::string(ToString(verdict)));
    return false;
  }
  if (const char* reason = Refute(context, certificate); reason != nullptr) {
    context.Add(FindingKind::kBadCertificate, kind() + ": " + reason);
    return false;
  }
  return true;
}

}  // namespace touchstone::exact
