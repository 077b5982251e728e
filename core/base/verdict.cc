// SPDX-License-Identifier: MIT
#include "touchstone/core/base/verdict.h"

#include "touchstone/core/base/enum_names.h"

namespace touchstone {

std::string_view ToString(Verdict value) {
  static constexpr std::string_view kNames[] = {"separate", "touch", "overlap", "undecided"};
  return EnumName(kNames, value);
}

std::string_view ToString(Tier value) {
  static constexpr std::string_view kNames[] = {"bound", "scan", "exact", "none"};
  return EnumName(kNames, value);
}

std::string_view ToString(Certainty value) {
  static constexpr std::string_view kNames[] = {"float", "exact"};
  return EnumName(kNames, value);
}

std::string_view ToString(FeatureKind value) {
  static constexpr std::string_view kNames[] = {"vertex", "edge", "face"};
  return EnumName(kNames, value);
}

}  // namespace touchstone
