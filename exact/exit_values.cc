// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/exit_values.h"

namespace touchstone::exact {

ExitValues ValuesAt(const PlacedPair& pair, const IntegerVector& n, const Ratio& ratio) {
  ExitValues values;
  const Real numerator(ratio.numerator), denominator(ratio.denominator);
  const Real excess(Integer(ratio.numerator - ratio.denominator));  // exact before it is rounded
  const Real c_length = Sqrt(Real(Dot(pair.c(), pair.c())));
  const Real n_length = Sqrt(Real(Dot(n, n)));
  values.interior_distance = pair.ToLength(c_length);
  values.signed_distance = excess / denominator / values.interior_distance;
  values.plane_distance = pair.ToLength(denominator / n_length);
  if (sgn(ratio.numerator) <= 0) return values;
  const Real rest = excess / numerator;  // 1 - s
  values.parameter = denominator / numerator;
  values.exit_travel = rest * values.interior_distance;
  values.normal_cosine = numerator / (n_length * c_length);
  for (int k = 0; k < 3; ++k) values.exit_point[k] = pair.ToLength(Real(pair.c()[k]) * rest);
  return values;
}

}  // namespace touchstone::exact
