// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/judge/values.h"

#include <cmath>
#include <cstdio>

#include "touchstone/exact/judge/checks.h"

namespace touchstone::exact {
namespace {

std::string Format(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

// |stated - exact| <= error, with room for the reference's own 1e-75 of `exact_size`.
bool Within(const Real& distance, const Real& exact_size, double error) {
  return !(distance > Real(error) + Scale(exact_size, -200));
}
// The same less the reference's own 2^-58 and that of the subtraction: only a filter.
bool Within(const Extended& distance, const Extended& exact_size, double error) {
  return distance + Scale(exact_size, -56) < Extended(error) ||
         (distance.sign() == 0 && exact_size.sign() == 0 && error == 0);
}

// Holds a result's numbers to the truth, given as Real or as Extended. What is wrong is described
// for Real only: an Extended that finds fault, or is not sure, asks for a Real.
template <class Number>
class ValueChecks {
 public:
  // With nowhere to add to, only all_hold() tells.
  ValueChecks(const JudgeContext& context, bool add) : context_(context), add_(add) {}

  bool all_hold() const { return all_hold_; }

  void CheckInteriorDifference() {
    const PlacedPair& pair = context_.pair;
    for (int k = 0; k < 3; ++k) {
      const Number exact = pair.ToLength(Number(pair.c()[k]));
      const double stated = context_.result.interior_difference[k];
      if (std::isfinite(stated) &&
          Within(Abs(Number(stated) - exact), Abs(exact), 0x1p-47 * pair.size())) {
        continue;
      }
      return Add(FindingKind::kValueOutOfBounds, [] { return "interior_difference is not c"; });
    }
  }

  void CheckNumbers(const ExitValuesOf<Number>& exact) {
    const CollideResult& result = context_.result;
    const Amplifications amplification = AmplificationsAt(exact, context_.pair.size());
    if (result.signed_distance.has_value()) {
      CheckBoundedValue("d", *result.signed_distance, exact.signed_distance,
                        amplification.signed_distance);
    }
    if (result.exit_travel.has_value()) {
      CheckBoundedValue("g", *result.exit_travel, exact.exit_travel, amplification.exit_travel);
    }
    if (result.exit_point.has_value()) CheckExitPoint(exact, amplification.exit_travel);
  }

 private:
  template <class Describe>
  void Add(FindingKind kind, const Describe& describe) {
    all_hold_ = false;
    if (add_) context_.Add(kind, describe());
  }

  void CheckBoundedValue(const char* name, const BoundedValue& stated, const Number& exact,
                         double amplification) {
    const auto is = [&] { return std::string(name) + " = " + Format(stated.value); };
    if (!std::isfinite(stated.value)) return Add(FindingKind::kValueOutOfBounds, is);
    if (!std::isfinite(stated.error) || !std::isfinite(stated.condition) || stated.error < 0 ||
        stated.condition < 0) {
      return Add(FindingKind::kLooseBound,
                 [&] { return is() + ": the error or condition is no bound"; });
    }
    if (!Within(Abs(Number(stated.value) - exact), Abs(exact), stated.error)) {
      Add(FindingKind::kValueOutOfBounds, [&] {
        return is() + " +- " + Format(stated.error) + ", is " + Format(exact.ToDouble());
      });
    }
    const double size = std::abs(stated.value);
    if (size == 0) {
      if (stated.error > kConditionFactor * kErrorFactor * amplification) {
        Add(FindingKind::kLooseBound, [&] { return is() + " +- " + Format(stated.error); });
      }
      return;
    }
    const double most = kConditionFactor * (1 + amplification / size);
    if (!(stated.condition <= most)) {
      Add(FindingKind::kLooseBound, [&] {
        return is() + ": condition " + Format(stated.condition) + ", at most " + Format(most);
      });
    } else if (stated.error > kErrorFactor * stated.condition * size) {
      Add(FindingKind::kLooseBound, [&] {
        return is() + " +- " + Format(stated.error) + " at condition " + Format(stated.condition);
      });
    }
  }

  void CheckExitPoint(const ExitValuesOf<Number>& exact, double amplification) {
    const Eigen::Vector3d& stated = *context_.result.exit_point;
    const double error = context_.result.exit_point_error;
    if (!stated.allFinite()) {
      return Add(FindingKind::kValueOutOfBounds, [] { return "the exit point is not finite"; });
    }
    Number squared(0.0), exact_squared(0.0);
    for (int k = 0; k < 3; ++k) {
      const Number difference = Number(stated[k]) - exact.exit_point[k];
      squared = squared + difference * difference;
      exact_squared = exact_squared + exact.exit_point[k] * exact.exit_point[k];
    }
    if (!(error >= 0) || !Within(Sqrt(squared), Sqrt(exact_squared), error)) {
      Add(FindingKind::kValueOutOfBounds, [&] {
        return "exit point off by " + Format(Sqrt(squared).ToDouble()) + ", says " + Format(error);
      });
    }
    const double limit =
        kConditionFactor * kErrorFactor * (amplification + std::abs(exact.exit_travel.ToDouble()));
    if (!(error <= limit)) {
      Add(FindingKind::kLooseBound, [&] { return "exit_point_error " + Format(error); });
    }
  }

  const JudgeContext& context_;
  bool add_;
  bool all_hold_ = true;
};

void CheckInteriorDifference(const JudgeContext& context) {
  if (Extended::Holds(context.pair.c()) && Extended::Holds(context.pair.scale())) {
    ValueChecks<Extended> filter(context, false);
    filter.CheckInteriorDifference();
    if (filter.all_hold()) return;
  }
  ValueChecks<Real>(context, true).CheckInteriorDifference();
}

}  // namespace

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
  if (sgn(ratio.numerator) <= 0) {
    return context.Add(FindingKind::kValueOutOfBounds,
                       "numbers for a plane that the ray never meets");
  }
  if (const auto exact = ExtendedValuesAt(context.pair, normal, ratio)) {
    ValueChecks<Extended> filter(context, false);
    filter.CheckNumbers(*exact);
    if (filter.all_hold()) return;
  }
  ValueChecks<Real>(context, true).CheckNumbers(ValuesAt(context.pair, normal, ratio));
}

}  // namespace touchstone::exact
