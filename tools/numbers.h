// SPDX-License-Identifier: MIT
//
// Numbers as text, whatever the locale.
#ifndef TOUCHSTONE_TOOLS_NUMBERS_H_
#define TOUCHSTONE_TOOLS_NUMBERS_H_

#include <charconv>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace touchstone {

// The nearest double to a whole word: decimal (1.5e-3), hexadecimal (0x1.8p-3), nan or inf. Nothing
// for any other word, and for a number beyond a double's range.
std::optional<double> ParseDouble(std::string_view word);

// Hexadecimal, every bit: 0x1.8p-3.
std::string HexDouble(double value);
// The shortest decimal that reads back as `value`.
std::string ShortDouble(double value);

// A whole word as an integer in the range of the type.
template <std::integral Integer>
std::optional<Integer> ParseInteger(std::string_view word) {
  Integer value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_NUMBERS_H_
