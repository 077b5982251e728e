// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_BASE_HOST_ARITHMETIC_H_
#define TOUCHSTONE_CORE_BASE_HOST_ARITHMETIC_H_

#include <string>
#include <string_view>

namespace touchstone {

enum class Rounding { kToNearest, kUpward, kDownward, kTowardZero, kUnknown };

// How the calling thread computes at the moment. Hosts change these: game engines flush denormals
// to zero, interval libraries round upward, and both may forget to change back.
//
// No answer of the library depends on it: error bounds hold in every rounding mode, lengths are
// scaled away from underflow, and exact signs are integer arithmetic. Reported all the same, since
// last digits and times do depend on it.
struct HostArithmetic {
  Rounding rounding = Rounding::kToNearest;
  bool flushes_results = false;   // a denormal result becomes zero
  bool flushes_operands = false;  // a denormal operand counts as zero
  bool extended = false;          // intermediate results keep more than 53 bits

  friend bool operator==(const HostArithmetic&, const HostArithmetic&) = default;
};

// By experiment in the calling thread, not by asking a control register.
HostArithmetic DetectHostArithmetic();

std::string_view ToString(Rounding rounding);
// One line: "rounds to nearest, keeps denormals".
std::string Describe(const HostArithmetic& host);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_BASE_HOST_ARITHMETIC_H_
