// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/phong_search_internal.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace touchstone::internal {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Bisections: two halve a cell's size.
constexpr int kLevels = 38;
constexpr int kCells = 2048;
// What coefficients are off by: 2^-48 as given, and at most 4 roundings of 2^-53 in each of 38
// bisections: 2^-45.4 in all. Of d·b, where |d| <= 1, twice that with its own roundings.
constexpr double kRounding = 0x1p-45;
constexpr double kProductRounding = 0x1p-44;
// λ below zero by this belongs to the triangle: in μ, of a cell with right angles whose legs are
// 2^-level/2, no more than 4 of this times 2^level/2.
constexpr double kOnSide = 1e-9;
// A cell enlarged has μ >= -2^-8, more than kOnSide at its smallest. A corner of it is an affine
// combination of those before whose weights add up to 1 + 4 · 2^-8 in size, so what holds of cubic
// coefficients within κ of a matrix holds there within 1.05 κ.
constexpr double kEnlarged = 0x1p-8;
constexpr double kEnlargedCubic = 1.05;
// Below 1 with that: where Newton's steps shrink.
constexpr double kContraction = 0.9;
constexpr int kNewtonLimit = 12;

struct Cell {
  Quartics b;
  std::array<Vector2d, 3> corners;     // λ_1, λ_2
  std::array<AtCorner, 3> at_corners;  // the triangle's own are known
  int level = 0;

  Vector2d ToTriangle(const Vector2d& mu) const {
    return corners[0] + mu[0] * (corners[1] - corners[0]) + mu[1] * (corners[2] - corners[0]);
  }
  Vector2d FromTriangle(const Vector2d& at) const {
    const Vector2d u = corners[1] - corners[0], v = corners[2] - corners[0], w = at - corners[0];
    const double area = u[0] * v[1] - u[1] * v[0];
    return Vector2d(w[0] * v[1] - w[1] * v[0], u[0] * w[1] - u[1] * w[0]) / area;
  }
};

bool IsInEnlarged(const Vector2d& mu) {
  return mu[0] >= -kEnlarged && mu[1] >= -kEnlarged && mu[0] + mu[1] <= 1.0 + kEnlarged;
}

// A row of equal i is a polynomial in one variable along the bisected side, of degree n: the
// halves' coefficients stand at both ends of de Casteljau's triangle.
void BisectRows(const std::array<double, 15>& b, std::array<double, 15>* first,
                std::array<double, 15>* second) {
  for (int i = 0; i <= 4; ++i) {
    const int n = 4 - i;
    std::array<double, 5> row;
    for (int k = 0; k <= n; ++k) row[k] = b[QuarticIndex(i, k)];
    for (int r = 0; r <= n; ++r) {
      (*first)[QuarticIndex(r, n - r)] = row[0];
      (*second)[QuarticIndex(r, i)] = row[n - r];
      for (int k = 0; k < n - r; ++k) row[k] = 0.5 * (row[k] + row[k + 1]);
    }
  }
}

// Across the middle m of the side from corner 1 to 2; m comes first, so that what was cut last is
// not cut next.
void Bisect(const Cell& cell, Cell* first, Cell* second) {
  BisectRows(cell.b.x, &first->b.x, &second->b.x);
  BisectRows(cell.b.y, &first->b.y, &second->b.y);
  const Vector2d middle = 0.5 * (cell.corners[1] + cell.corners[2]);
  const auto& at = cell.at_corners;
  first->corners = {middle, cell.corners[0], cell.corners[1]};
  first->at_corners = {AtCorner::kNothing, at[0], at[1]};
  second->corners = {middle, cell.corners[2], cell.corners[0]};
  second->at_corners = {AtCorner::kNothing, at[2], at[0]};
  first->level = second->level = cell.level + 1;
}

// Which coefficients are zero, or as good as zero, since a corner is.
std::array<bool, 15> Known(const Cell& cell) {
  constexpr int kAt[3] = {QuarticIndex(4, 0), QuarticIndex(0, 0), QuarticIndex(0, 4)};
  constexpr int kBeside[3][2] = {{QuarticIndex(3, 0), QuarticIndex(3, 1)},
                                 {QuarticIndex(1, 0), QuarticIndex(0, 1)},
                                 {QuarticIndex(1, 3), QuarticIndex(0, 3)}};
  std::array<bool, 15> known{};
  for (int c = 0; c < 3; ++c) {
    if (cell.at_corners[c] == AtCorner::kNothing) continue;
    known[kAt[c]] = true;
    if (cell.at_corners[c] != AtCorner::kVanishesTwice) continue;
    known[kBeside[c][0]] = known[kBeside[c][1]] = true;
  }
  return known;
}

double Cross(const Vector2d& a, const Vector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

// Whether d·F > 0 on the enlarged cell for some d, but at corners that are known. The narrowest
// cone that holds the coefficients gives d; what d is worth is then seen.
bool IsExcluded(const Cell& cell) {
  const std::array<bool, 15> known = Known(cell);
  Vector2d low = Vector2d::Zero(), high = low;
  bool is_first = true;
  for (int c = 0; c < 15; ++c) {
    if (known[c]) continue;
    const Vector2d p(cell.b.x[c], cell.b.y[c]);
    if (is_first) {
      low = high = p;
      is_first = false;
      continue;
    }
    const double from_low = Cross(low, p), from_high = Cross(high, p);
    if (from_low < 0.0 && from_high > 0.0) return false;
    if (from_low < 0.0) low = p;
    if (from_high > 0.0) high = p;
  }
  const double low_length = low.norm(), high_length = high.norm();
  if (!(low_length > 0.0 && high_length > 0.0)) return false;
  const Vector2d d = (0.5 / low_length) * low + (0.5 / high_length) * high;
  double least = 1.0, least_known = 0.0, most = 0.0;
  for (int c = 0; c < 15; ++c) {
    const double height = d[0] * cell.b.x[c] + d[1] * cell.b.y[c];
    most = std::max(most, height);
    (known[c] ? least_known : least) = std::min(known[c] ? least_known : least, height);
  }
  // Enlarged by μ >= -η, coefficients leave their range by (1 + 4η)^4 - 1 < 17 η of half of it.
  const double eta = 4.0 * kOnSide * std::exp2(0.5 * cell.level);
  return least > kProductRounding + 9.0 * eta * (most - std::min(least, least_known));
}

struct Local {
  Vector2d value;
  Matrix2d jacobian;
};

Local Evaluate(const Quartics& b, const Vector2d& mu) {
  const double m0 = 1.0 - mu[0] - mu[1], m1 = mu[0], m2 = mu[1];
  std::array<double, 15> x = b.x, y = b.y;
  for (int degree = 4; degree > 1; --degree) {
    for (int i = 0; i < degree; ++i) {
      for (int k = 0; k < degree - i; ++k) {
        const int p = QuarticIndex(i + 1, k), q = QuarticIndex(i, k), r = QuarticIndex(i, k + 1);
        x[q] = m0 * x[p] + m1 * x[q] + m2 * x[r];
        y[q] = m0 * y[p] + m1 * y[q] + m2 * y[r];
      }
    }
  }
  constexpr int kP = QuarticIndex(1, 0), kQ = QuarticIndex(0, 0), kR = QuarticIndex(0, 1);
  Local local;
  local.value = {m0 * x[kP] + m1 * x[kQ] + m2 * x[kR], m0 * y[kP] + m1 * y[kQ] + m2 * y[kR]};
  local.jacobian << 4.0 * (x[kQ] - x[kP]), 4.0 * (x[kR] - x[kP]), 4.0 * (y[kQ] - y[kP]),
      4.0 * (y[kR] - y[kP]);
  return local;
}

Matrix2d Inverse(const Matrix2d& m, double determinant) {
  Matrix2d adjugate;
  adjugate << m(1, 1), -m(0, 1), -m(1, 0), m(0, 0);
  return adjugate / determinant;
}

double RowSum(const Matrix2d& m) { return m.cwiseAbs().rowwise().sum().maxCoeff(); }

enum class AtMostOne : std::uint8_t { kUnknown, kNone, kOne };

// kNone, or that the enlarged cell has no two zeros.
AtMostOne Contract(const Cell& cell) {
  for (const AtCorner at : cell.at_corners) {
    if (at != AtCorner::kNothing) return AtMostOne::kUnknown;
  }
  std::array<Matrix2d, 10> derivatives;
  Matrix2d mean = Matrix2d::Zero();
  int count = 0;
  const auto &x = cell.b.x, &y = cell.b.y;
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 4 - i; ++k) {
      const int p = QuarticIndex(i + 1, k), q = QuarticIndex(i, k), r = QuarticIndex(i, k + 1);
      Matrix2d& d = derivatives[count++];
      d << 4.0 * (x[q] - x[p]), 4.0 * (x[r] - x[p]), 4.0 * (y[q] - y[p]), 4.0 * (y[r] - y[p]);
      mean += d;
    }
  }
  mean *= 0.1;
  const double determinant = mean.determinant();
  if (!(std::abs(determinant) > 0.0)) return AtMostOne::kUnknown;
  const Matrix2d inverse = Inverse(mean, determinant);
  double kappa = 0.0;
  for (const Matrix2d& d : derivatives) {
    kappa = std::max(kappa, RowSum(inverse * d - Matrix2d::Identity()));
  }
  // A derivative's coefficient is off by 8 times what F's are, two in a row; and the products.
  const double off = RowSum(inverse) * kRounding;
  kappa = kEnlargedCubic * (kappa + 32.0 * off);
  if (!(kappa < kContraction * kEnlargedCubic)) return AtMostOne::kUnknown;
  // Zeros of the enlarged cell differ from its middle by no more than 2/3 + 2^-7 in either μ.
  const Vector2d middle = Vector2d::Constant(1.0 / 3.0);
  const Vector2d step = middle - inverse * Evaluate(cell.b, middle).value;
  const double reach = 0.675 * kappa + 8.0 * off + kEnlarged;
  if (step.minCoeff() + reach < 0.0 || step.sum() - 2.0 * reach > 1.0) return AtMostOne::kNone;
  return AtMostOne::kOne;
}

class Search {
 public:
  Search(const Quartics& quartics, const std::array<AtCorner, 3>& corners) {
    Cell& whole = stack_[0];
    whole.b = quartics;
    // λ_0 is 1 - λ_1 - λ_2.
    whole.corners = {Vector2d(0.0, 0.0), Vector2d(1.0, 0.0), Vector2d(0.0, 1.0)};
    whole.at_corners = corners;
  }

  QuarticZeros Run() {
    // One of each level waits, and two of the last.
    for (int size = 1; size > 0;) {
      if (++found_.cells > kCells) {
        found_.is_complete = false;
        break;
      }
      const Cell cell = stack_[--size];
      if (IsExcluded(cell) || IsDecided(cell)) continue;
      if (cell.level == kLevels) {
        Leave(cell);
        continue;
      }
      Bisect(cell, &stack_[size], &stack_[size + 1]);
      size += 2;
    }
    return found_;
  }

 private:
  bool IsDecided(const Cell& cell) {
    const AtMostOne held = Contract(cell);
    if (held != AtMostOne::kOne) return held == AtMostOne::kNone;
    for (int i = 0; i < found_.count; ++i) {
      const QuarticZero& zero = found_.zeros[i];
      if (zero.is_simple && IsInEnlarged(cell.FromTriangle({zero.at[1], zero.at[2]}))) return true;
    }
    Vector2d mu = Vector2d::Constant(1.0 / 3.0);
    for (int i = 0; i < kNewtonLimit; ++i) {
      const Local here = Evaluate(cell.b, mu);
      const double determinant = here.jacobian.determinant();
      if (!(std::abs(determinant) > 0.0)) return false;
      const Vector2d step = Inverse(here.jacobian, determinant) * here.value;
      mu -= step;
      if (!(mu.cwiseAbs().maxCoeff() < 4.0)) return false;
      // Newton's next step would be less than roundings.
      if (step.norm() < 0x1p-26) {
        if (!IsInEnlarged(mu)) return false;
        Add(cell.ToTriangle(mu), true);
        return true;
      }
    }
    return false;
  }

  void Leave(const Cell& cell) {
    found_.is_complete = false;
    const Vector2d middle = cell.ToTriangle(Vector2d::Constant(1.0 / 3.0));
    // Those that touch are one place; where no end is seen the middle is as good as any.
    constexpr double kBeside = 0x1p-16;
    for (int i = 0; i < found_.count; ++i) {
      const QuarticZero& zero = found_.zeros[i];
      if (!zero.is_simple && (Vector2d(zero.at[1], zero.at[2]) - middle).norm() < kBeside) return;
    }
    Add(middle, false);
  }

  void Add(const Vector2d& at, bool is_simple) {
    if (found_.count == QuarticZeros::kCapacity) {
      found_.is_complete = false;
      return;
    }
    found_.zeros[found_.count++] = {{1.0 - at[0] - at[1], at[0], at[1]}, is_simple};
  }

  std::array<Cell, kLevels + 2> stack_;
  QuarticZeros found_;
};

}  // namespace

QuarticZeros FindZeros(const Quartics& quartics, const std::array<AtCorner, 3>& corners) {
  double sum = 0.0;
  for (int c = 0; c < 15; ++c) sum += std::abs(quartics.x[c]) + std::abs(quartics.y[c]);
  if (!std::isfinite(sum)) {
    QuarticZeros none;
    none.is_complete = false;
    return none;
  }
  return Search(quartics, corners).Run();
}

}  // namespace touchstone::internal
