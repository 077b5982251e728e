// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_SUITES_RANDOM_H_
#define TOUCHSTONE_TOOLS_SUITES_RANDOM_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace touchstone {

// A stream of numbers that is the same on every machine: integer arithmetic (xoshiro256**, seeded
// through splitmix64), then sums, products and square roots of doubles in a written order. No
// std::*_distribution and no libm, whose results differ between libraries.
class Random {
 public:
  // Streams of different names, seeds or keys are independent.
  Random(std::string_view name, std::uint64_t seed, std::uint64_t key);

  std::uint64_t Bits();
  // Uniform in [0, bound), bound > 0, without bias.
  std::uint64_t Below(std::uint64_t bound);
  // Uniform in [low, high], both included.
  int Integer(int low, int high);
  // Uniform multiples of 2^-53 in [0, 1).
  double Unit();
  double Uniform(double low, double high) { return low + (high - low) * Unit(); }
  // True once in `n` times.
  bool OneIn(int n) { return Below(static_cast<std::uint64_t>(n)) == 0; }

  template <class T>
  const T& Pick(std::span<const T> items) {
    return items[Below(items.size())];
  }
  template <class T, std::size_t N>
  const T& Pick(const std::array<T, N>& items) {
    return items[Below(N)];
  }

  // Uniform on the unit sphere, by rejection in the cube; of unit length up to rounding.
  Eigen::Vector3d SpherePoint();
  // Uniform over rotations: a quaternion by rejection in the 4-ball, its matrix by plain
  // arithmetic; orthonormal up to rounding.
  Eigen::Matrix3d Rotation();
  // One of the 24 rotations that map the axes to axes: exact.
  Eigen::Matrix3d AxisRotation();

 private:
  std::array<std::uint64_t, 4> state_;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_SUITES_RANDOM_H_
