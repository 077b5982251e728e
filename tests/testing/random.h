// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TESTS_TESTING_RANDOM_H_
#define TOUCHSTONE_TESTS_TESTING_RANDOM_H_

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

namespace touchstone::testing {

// SplitMix64 (Steele, Lea, Flood 2014): the same numbers on every machine for the same seed. Only
// operations that IEEE 754 rounds correctly are used, so the doubles are the same too.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t Bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  // Uniform in [0, 1), a multiple of 2^-53.
  double Unit() { return static_cast<double>(Bits() >> 11) * 0x1p-53; }
  double Uniform(double low, double high) { return low + (high - low) * Unit(); }
  // Uniform in {low, ..., high}, up to a bias of (high - low) 2^-64.
  int Int(int low, int high) {
    return low + static_cast<int>(Bits() % static_cast<std::uint64_t>(high - low + 1));
  }
  // Uniform on the unit sphere, up to rounding.
  Eigen::Vector3d Direction() {
    while (true) {
      const Eigen::Vector3d v(Uniform(-1, 1), Uniform(-1, 1), Uniform(-1, 1));
      const double squared = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
      if (squared <= 1.0 && squared >= 1e-4) return v / std::sqrt(squared);
    }
  }
  // A rotation, uniform, orthonormal up to rounding.
  Eigen::Matrix3d Rotation() {
    const Eigen::Vector3d x = Direction();
    Eigen::Vector3d y;
    double length = 0.0;
    while (length < 0.1) {
      const Eigen::Vector3d v = Direction();
      y = v - x * (x[0] * v[0] + x[1] * v[1] + x[2] * v[2]);
      length = std::sqrt(y[0] * y[0] + y[1] * y[1] + y[2] * y[2]);
    }
    y /= length;
    Eigen::Matrix3d r;
    r.col(0) = x;
    r.col(1) = y;
    r.col(2) << x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0];
    return r;
  }

 private:
  std::uint64_t state_;
};

}  // namespace touchstone::testing

#endif  // TOUCHSTONE_TESTS_TESTING_RANDOM_H_
