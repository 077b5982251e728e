// SPDX-License-Identifier: MIT
#include "touchstone/core/base/host_arithmetic.h"

#include <bit>
#include <cstdint>

namespace touchstone {
namespace {

// Operands the compiler cannot know.
double Opaque(double value) {
  volatile double hidden = value;
  return hidden;
}

// A tie between 1 and 1 + 2^-52, above and below zero, tells the modes apart.
Rounding DetectRounding() {
  const double above = Opaque(1.0) + Opaque(0x1p-53), below = Opaque(-1.0) - Opaque(0x1p-53);
  const bool up = above > 1.0, down = below < -1.0;
  const bool past_half = Opaque(1.0) + Opaque(0x1.8p-53) > 1.0;
  if (up) return down ? Rounding::kUnknown : Rounding::kUpward;
  if (down) return Rounding::kDownward;
  return past_half ? Rounding::kToNearest : Rounding::kTowardZero;
}

}  // namespace

HostArithmetic DetectHostArithmetic() {
  HostArithmetic host;
  host.rounding = DetectRounding();
  const double flushed = Opaque(0x1p-1022) * Opaque(0.5);
  host.flushes_results = std::bit_cast<std::uint64_t>(flushed) == 0;
  const double denormal = Opaque(std::bit_cast<double>(std::uint64_t{1} << 51));
  host.flushes_operands = Opaque(denormal * Opaque(4.0)) == 0.0;
  // 1 + 2^-60 - 1 is zero but in wider registers; upward, one unit.
  const double rest = (Opaque(1.0) + Opaque(0x1p-60)) - Opaque(1.0);
  host.extended = rest == 0x1p-60;
  return host;
}

std::string_view ToString(Rounding rounding) {
  switch (rounding) {
    case Rounding::kToNearest:
      return "to nearest";
    case Rounding::kUpward:
      return "upward";
    case Rounding::kDownward:
      return "downward";
    case Rounding::kTowardZero:
      return "toward zero";
    case Rounding::kUnknown:
      break;
  }
  return "in a mode of its own";
}

std::string Describe(const HostArithmetic& host) {
  std::string text = "rounds " + std::string(ToString(host.rounding));
  if (host.flushes_results) text += ", flushes denormal results";
  if (host.flushes_operands) text += ", takes denormal operands for zero";
  if (!host.flushes_results && !host.flushes_operands) text += ", keeps denormals";
  if (host.extended) text += ", keeps extra bits";
  return text;
}

}  // namespace touchstone
