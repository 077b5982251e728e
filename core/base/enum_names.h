// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_BASE_ENUM_NAMES_H_
#define TOUCHSTONE_CORE_BASE_ENUM_NAMES_H_

#include <cstddef>
#include <string_view>

namespace touchstone {

// The word for an enumerator, by its place in the list of words; "?" for what is no enumerator.
template <class Enum, std::size_t N>
std::string_view EnumName(const std::string_view (&names)[N], Enum value) {
  const auto i = static_cast<std::size_t>(value);
  return i < N ? names[i] : "?";
}

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_BASE_ENUM_NAMES_H_
