// SPDX-License-Identifier: MIT
#include "touchstone/tools/numbers.h"

#include <array>
#include <cmath>

namespace touchstone {
namespace {

std::string Format(double value, std::chars_format format) {
  std::array<char, 64> text;
  const auto end = format == std::chars_format::hex
                       ? std::to_chars(text.data(), text.data() + text.size(), value, format).ptr
                       : std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

}  // namespace

std::optional<double> ParseDouble(std::string_view word) {
  const bool negative = word.starts_with('-');
  if (negative || word.starts_with('+')) word.remove_prefix(1);
  auto format = std::chars_format::general;
  if (word.starts_with("0x") || word.starts_with("0X")) {
    word.remove_prefix(2);
    format = std::chars_format::hex;
  }
  if (word.empty() || word.front() == '-' || word.front() == '+') return std::nullopt;
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value, format);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return negative ? -value : value;
}

std::string HexDouble(double value) {
  if (!std::isfinite(value)) return ShortDouble(value);
  return (std::signbit(value) ? "-0x" : "0x") + Format(std::fabs(value), std::chars_format::hex);
}

std::string ShortDouble(double value) { return Format(value, std::chars_format::general); }

}  // namespace touchstone
