// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TESTS_FUZZ_BYTES_H_
#define TOUCHSTONE_TESTS_FUZZ_BYTES_H_

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace touchstone {

// The fuzzer's bytes as numbers; zeros once they are used up.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  bool empty() const { return left_ == 0; }
  std::uint8_t Byte() {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }
  int Below(int bound) { return Byte() % bound; }

  // A small integer, a small integer moved by a few ulps, a number of any exponent, or any bits at
  // all, by the first byte: what numbers go wrong by.
  double Number() {
    const std::uint8_t kind = Byte();
    const double small = static_cast<std::int8_t>(Byte());
    switch (kind % 8) {
      case 0: {
        double moved = small;
        for (int i = kind / 8 % 4; i > 0; --i) moved = std::nextafter(moved, 1e300);
        return moved;
      }
      case 1:
        return std::ldexp(small, static_cast<std::int8_t>(Byte()) * 3);
      case 2: {
        std::uint64_t bits = 0;
        for (int i = 0; i < 8; ++i) bits = bits << 8 | Byte();
        double any;
        std::memcpy(&any, &bits, sizeof(any));
        return any;
      }
      case 3:
        return small + Byte() / 256.0;
      default:
        return small;
    }
  }
  Eigen::Vector3d Point() {
    Eigen::Vector3d point;
    for (int i = 0; i < 3; ++i) point[i] = Number();
    return point;
  }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

// Ends the program with a message when `holds` is false.
void Require(bool holds, const char* what);

}  // namespace touchstone

#endif  // TOUCHSTONE_TESTS_FUZZ_BYTES_H_
