// SPDX-License-Identifier: MIT
#include "touchstone/tools/suites/random.h"

#include <bit>
#include <cmath>
#include <utility>

namespace touchstone {
namespace {

std::uint64_t SplitMix(std::uint64_t& state) {
  std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

// FNV-1a.
std::uint64_t Hash(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

}  // namespace

Random::Random(std::string_view name, std::uint64_t seed, std::uint64_t key) {
  std::uint64_t mix = Hash(name);
  mix = SplitMix(mix) ^ seed;
  mix = SplitMix(mix) ^ key;
  for (std::uint64_t& word : state_) word = SplitMix(mix);
}

std::uint64_t Random::Bits() {
  const std::uint64_t result = std::rotl(state_[1] * 5, 7) * 9;
  const std::uint64_t shifted = state_[1] << 17;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= shifted;
  state_[3] = std::rotl(state_[3], 45);
  return result;
}

std::uint64_t Random::Below(std::uint64_t bound) {
  const std::uint64_t excess = (0 - bound) % bound;  // 2^64 mod bound
  std::uint64_t bits = Bits();
  while (bits < excess) bits = Bits();
  return bits % bound;
}

int Random::Integer(int low, int high) {
  return low + static_cast<int>(Below(static_cast<std::uint64_t>(high - low) + 1));
}

double Random::Unit() { return static_cast<double>(Bits() >> 11) * 0x1p-53; }

Eigen::Vector3d Random::SpherePoint() {
  for (;;) {
    const double x = Uniform(-1.0, 1.0);
    const double y = Uniform(-1.0, 1.0);
    const double z = Uniform(-1.0, 1.0);
    const double squared = (x * x + y * y) + z * z;
    if (squared > 1.0 || squared < 0.01) continue;
    const double length = std::sqrt(squared);
    return {x / length, y / length, z / length};
  }
}

Eigen::Matrix3d Random::Rotation() {
  for (;;) {
    const double w = Uniform(-1.0, 1.0);
    const double x = Uniform(-1.0, 1.0);
    const double y = Uniform(-1.0, 1.0);
    const double z = Uniform(-1.0, 1.0);
    const double squared = (w * w + x * x) + (y * y + z * z);
    if (squared > 1.0 || squared < 0.01) continue;
    const double s = 2.0 / squared;
    Eigen::Matrix3d r;
    r(0, 0) = 1.0 - s * (y * y + z * z);
    r(0, 1) = s * (x * y - w * z);
    r(0, 2) = s * (x * z + w * y);
    r(1, 0) = s * (x * y + w * z);
    r(1, 1) = 1.0 - s * (x * x + z * z);
    r(1, 2) = s * (y * z - w * x);
    r(2, 0) = s * (x * z - w * y);
    r(2, 1) = s * (y * z + w * x);
    r(2, 2) = 1.0 - s * (x * x + y * y);
    return r;
  }
}

Eigen::Matrix3d Random::AxisRotation() {
  const int first = Integer(0, 2);
  const int step = Integer(1, 2);
  const int second = (first + step) % 3;
  const int third = 3 - first - second;
  const double a = OneIn(2) ? 1.0 : -1.0;
  const double b = OneIn(2) ? 1.0 : -1.0;
  // Columns e_first, e_second, e_third: even when the step is 1.
  const double parity = step == 1 ? 1.0 : -1.0;
  Eigen::Matrix3d r = Eigen::Matrix3d::Zero();
  r(first, 0) = a;
  r(second, 1) = b;
  r(third, 2) = a * b * parity;
  return r;
}

}  // namespace touchstone
