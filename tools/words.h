// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_WORDS_H_
#define TOUCHSTONE_TOOLS_WORDS_H_

#include <array>
#include <initializer_list>
#include <optional>
#include <string_view>

#include "touchstone/core/cd_dual/result.h"

namespace touchstone {

inline constexpr std::array kAllSearches = {Search::kPublished, Search::kPhased, Search::kPortal};

// The one of `values` that prints as `word`.
template <class Enum>
std::optional<Enum> FromWord(std::string_view word, std::initializer_list<Enum> values) {
  for (const Enum value : values) {
    if (ToString(value) == word) return value;
  }
  return std::nullopt;
}

inline std::optional<Search> SearchFromWord(std::string_view word) {
  return FromWord(word, {Search::kPublished, Search::kPhased, Search::kPortal});
}

inline std::optional<Certainty> CertaintyFromWord(std::string_view word) {
  return FromWord(word, {Certainty::kFloat, Certainty::kExact});
}

inline std::optional<Verdict> VerdictFromWord(std::string_view word) {
  return FromWord(word, {Verdict::kSeparate, Verdict::kTouch, Verdict::kOverlap});
}

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_WORDS_H_
