// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/exit_values.h"

namespace touchstone::exact {
namespace {

template <class Number>
Number Length(const IntegerVector& v) {
  const Number x(v[0]), y(v[1]), z(v[2]);
  return Sqrt(x * x + y * y + z * z);
}

template <class Number>
ExitValuesOf<Number> Values(const PlacedPair& pair, const IntegerVector& n, const Ratio& ratio) {
  ExitValuesOf<Number> values;
  const Number numerator(ratio.numerator), denominator(ratio.denominator);
  const Number excess(Integer(ratio.numerator - ratio.denominator));  // exact before it is rounded
  const Number c_length = Length<Number>(pair.c());
  const Number n_length = Length<Number>(n);
  values.interior_distance = pair.ToLength(c_length);
  values.signed_distance = excess / denominator / values.interior_distance;
  values.plane_distance = pair.ToLength(denominator / n_length);
  if (sgn(ratio.numerator) <= 0) return values;
  const Number rest = excess / numerator;  // 1 - s
  values.parameter = denominator / numerator;
  values.exit_travel = rest * values.interior_distance;
  values.normal_cosine = numerator / (n_length * c_length);
  for (int k = 0; k < 3; ++k) values.exit_point[k] = pair.ToLength(Number(pair.c()[k]) * rest);
  return values;
}

}  // namespace

ExitValues ValuesAt(const PlacedPair& pair, const IntegerVector& n, const Ratio& ratio) {
  return Values<Real>(pair, n, ratio);
}

std::optional<ExitValuesOf<Extended>> ExtendedValuesAt(const PlacedPair& pair,
                                                       const IntegerVector& n, const Ratio& ratio) {
  if (!Extended::Holds(n) || !Extended::Holds(pair.c()) || !Extended::Holds(pair.scale()) ||
      !Extended::Holds(ratio.numerator) || !Extended::Holds(ratio.denominator)) {
    return std::nullopt;
  }
  return Values<Extended>(pair, n, ratio);
}

}  // namespace touchstone::exact
