// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/judge/values.h"

#include <cmath>
#include <cstdio>

#include "touchstone/exact/judge/checks.h"

namespace touchstone::exact {
namespace {

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

// |stated - exact| <= error, with room for the reference's own 1e-75.
bool Within(const Real& distance, const Real& exact_size, double error) {
  return !(distance > Real(error) + Scale(exact_size, -200));
}

void CheckBoundedValue(const JudgeContext& context, const char* name, const BoundedValue& stated,
                       const Real& exact, double amplification) {
  const std::string is = std::string(name) + " = " + Number(stated.value);
  if (!std::isfinite(stated.value)) {
    return context.Add(FindingKind::kValueOutOfBounds, is);
  }
  if (!std::isfinite(stated.error) || !std::isfinite(stated.condition) || stated.error < 0 ||
      stated.condition < 0) {
    return context.Add(FindingKind::kLooseBound, is + ": the error or condition is no bound");
  }
  if (!Within(Abs(Real(stated.value) - exact), Abs(exact), stated.error)) {
    context.Add(FindingKind::kValueOutOfBounds,
                is + " +- " + Number(stated.error) + ", is " + Number(exact.ToDouble()));
  }
  const double size = std::abs(stated.value);
  if (size == 0) {
    if (stated.error > kConditionFactor * kErrorFactor * amplification) {
      context.Add(FindingKind::kLooseBound, is + " +- " + Number(stated.error));
    }
    return;
  }
  if (stated.condition > kConditionFactor * (1 + amplification / size)) {
    context.Add(FindingKind::kLooseBound,
                is + ": condition " + Number(stated.condition) + ", at most " +
                    Number(kConditionFactor * (1 + amplification / size)));
  } else if (stated.error > kErrorFactor * stated.condition * size) {
    context.Add(FindingKind::kLooseBound,
                is + " +- " + Number(stated.error) + " at condition " + Number(stated.condition));
  }
}

void CheckExitPoint(const JudgeContext& context, const ExitValues& exact, double amplification) {
  const Eigen::Vector3d& stated = *context.result.exit_point;
  const double error = context.result.exit_point_error;
  if (!stated.allFinite()) {
    return context.Add(FindingKind::kValueOutOfBounds, "the exit point is not finite");
  }
  Real squared, exact_squared;
  for (int k = 0; k < 3; ++k) {
    const Real difference = Real(stated[k]) - exact.exit_point[k];
    squared = squared + difference * difference;
    exact_squared = exact_squared + exact.exit_point[k] * exact.exit_point[k];
  }
  if (!(error >= 0) || !Within(Sqrt(squared), Sqrt(exact_squared), error)) {
    context.Add(
        FindingKind::kValueOutOfBounds,
        "exit point off by " + Number(Sqrt(squared).ToDouble()) + ", says " + Number(error));
  }
  const double limit =
      kConditionFactor * kErrorFactor * (amplification + std::abs(exact.exit_travel.ToDouble()));
  if (error > limit) {
    context.Add(FindingKind::kLooseBound, "exit_point_error " + Number(error));
  }
}

void CheckInteriorDifference(const JudgeContext& context) {
  for (int k = 0; k < 3; ++k) {
    const Real exact = context.pair.ToLength(Real(context.pair.c()[k]));
    const double stated = context.result.interior_difference[k];
    if (std::isfinite(stated) &&
        Within(Abs(Real(stated) - exact), Abs(exact), 0x1p-47 * context.pair.size())) {
      continue;
    }
    return context.Add(FindingKind::kValueOutOfBounds, "interior_difference is not c");
  }
}

}  // namespace

Amplifications AmplificationsAt(const ExitValues& values, double size) {
  const Real one(1.0), s = values.parameter, length = values.interior_distance;
  const Real g = Real(size) * (one + s) / values.normal_cosine;
  const Real d = g / (s * s * length * length) + Abs(values.signed_distance) * Real(size) / length;
  return {d.ToDouble(), g.ToDouble()};
}

void CheckValues(const JudgeContext& context) {
  CheckInteriorDifference(context);
  const CollideResult& result = context.result;
  if (!result.signed_distance.has_value() && !result.exit_travel.has_value() &&
      !result.exit_point.has_value()) {
    return;
  }
  // The published search may name a facet that is not the exit: its numbers are held to the facet
  // named, so that one fault is one finding. All else is held to the truth.
  IntegerVector normal;
  Ratio ratio;
  if (context.face.has_value()) {
    normal = context.face->normal, ratio = context.face->ratio;
  } else {
    const std::array<VertexPair, 3>& t = context.Decision().exit->triangle;
    const IntegerVector a = context.pair.FromC(t[0]);
    normal = Cross(context.pair.FromC(t[1]) - a, context.pair.FromC(t[2]) - a);
    ratio = context.ExitRatio();
  }
  const ExitValues exact = ValuesAt(context.pair, normal, ratio);
  if (sgn(ratio.numerator) <= 0) {
    return context.Add(FindingKind::kValueOutOfBounds,
                       "numbers for a plane that the ray never meets");
  }
  const Amplifications amplification = AmplificationsAt(exact, context.pair.size());
  if (result.signed_distance.has_value()) {
    CheckBoundedValue(context, "d", *result.signed_distance, exact.signed_distance,
                      amplification.signed_distance);
  }
  if (result.exit_travel.has_value()) {
    CheckBoundedValue(context, "g", *result.exit_travel, exact.exit_travel,
                      amplification.exit_travel);
  }
  if (result.exit_point.has_value()) CheckExitPoint(context, exact, amplification.exit_travel);
}

}  // namespace touchstone::exact
