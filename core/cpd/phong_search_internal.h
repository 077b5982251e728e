// SPDX-License-Identifier: MIT
//
// Every zero on a triangle of two polynomials of degree 4, with proof: what Ψ(λ) q(λ) is, times
// Σ λ_k λ_k+1 (phong_projection).
//
//   here        meaning
//   λ           barycentric coordinates in the triangle
//   μ           in a cell of its subdivision
//   b_ijk       Bernstein coefficients, i + j + k = 4:
//               F = Σ b_ijk 4! / (i! j! k!) λ_0^i λ_1^j λ_2^k
#ifndef TOUCHSTONE_CORE_CPD_PHONG_SEARCH_INTERNAL_H_
#define TOUCHSTONE_CORE_CPD_PHONG_SEARCH_INTERNAL_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace touchstone::internal {

// Coefficients by rows of equal i, and in a row by k.
constexpr int QuarticIndex(int i, int k) {
  constexpr int kRow[] = {0, 5, 9, 12, 14};
  return kRow[i] + k;
}

struct Quartics {
  std::array<double, 15> x, y;

  void Set(int i, int k, const Eigen::Vector2d& b) {
    x[QuarticIndex(i, k)] = b[0];
    y[QuarticIndex(i, k)] = b[1];
  }
};

// What the polynomials are known to be zero at, and not asked for.
enum class AtCorner : std::uint8_t {
  kNothing,
  kVanishes,  // F
  // And F's first derivatives, up to roundings: what is told of the zeros round it is that there
  // are none but within roundings over the second derivatives.
  kVanishesTwice,
};

struct QuarticZero {
  Eigen::Vector3d at;  // λ
  // Simple, and the only one of its cell. Otherwise the middle of a few cells of size 2^-19 that
  // hold nothing, or several, or a multiple one.
  bool is_simple = false;
};

struct QuarticZeros {
  // Sixteen simple ones, by Bézout, and as many places that are left.
  static constexpr int kCapacity = 32;
  std::array<QuarticZero, kCapacity> zeros;
  int count = 0;
  // Every zero with λ >= -1e-9 that is not at a corner is one of these, and all are simple.
  bool is_complete = true;
  int cells = 0;  // looked at
};

// Coefficients are at most 1 in size, each with an error of no more than 2^-48.
//
// The triangle is bisected until each cell is shown to hold no zero, or one at most. A cell holds
// none if some direction d has d·b > 0 for all its coefficients, for F is in their hull. With P the
// inverse of the mean of the derivatives' coefficients, ‖I - P F'‖ <= κ < 1 on the cell if it holds
// for those, and then its zeros are within κ of the cell's size of one Newton step from the middle;
// two would be nearer to each other than they are. Either is shown for the cell enlarged by more
// than 1e-9 of the triangle, so that no zero is lost between triangles, or cells.
//
// Complexity: a cell takes some 150 operations; 2^11 cells at most, mostly fewer than 30. No
// errors: what is not finite has none, and is not complete. Source: Farin, "Triangular
// Bernstein-Bézier patches", 1986; Krawczyk's test for existence.
QuarticZeros FindZeros(const Quartics& quartics, const std::array<AtCorner, 3>& corners);

}  // namespace touchstone::internal

#endif  // TOUCHSTONE_CORE_CPD_PHONG_SEARCH_INTERNAL_H_
