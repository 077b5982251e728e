// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/result.h"

namespace touchstone {
namespace {

template <class Enum, std::size_t N>
std::string_view Name(const std::string_view (&names)[N], Enum value) {
  const auto i = static_cast<std::size_t>(value);
  return i < N ? names[i] : "?";
}

}  // namespace

std::string_view ToString(Verdict value) {
  static constexpr std::string_view kNames[] = {"separate", "touch", "overlap", "undecided"};
  return Name(kNames, value);
}

std::string_view ToString(Tier value) {
  static constexpr std::string_view kNames[] = {"bound", "scan", "exact", "none"};
  return Name(kNames, value);
}

std::string_view ToString(Search value) {
  static constexpr std::string_view kNames[] = {"published", "phased", "portal"};
  return Name(kNames, value);
}

std::string_view ToString(Certainty value) {
  static constexpr std::string_view kNames[] = {"float", "exact"};
  return Name(kNames, value);
}

std::string_view ToString(FaceClass value) {
  static constexpr std::string_view kNames[] = {"FaceVertex", "VertexFace", "EdgeEdge",
                                                "FaceEdge",   "EdgeFace",   "FaceFace"};
  return Name(kNames, value);
}

std::string_view ToString(FeatureKind value) {
  static constexpr std::string_view kNames[] = {"vertex", "edge", "face"};
  return Name(kNames, value);
}

std::string_view ToString(CertificateKind value) {
  static constexpr std::string_view kNames[] = {"none",
                                                "separating_direction",
                                                "separating_facet",
                                                "enclosing_tetrahedron",
                                                "coincident_interior",
                                                "touching_facet"};
  return Name(kNames, value);
}

std::string_view ToString(Phase value) {
  static constexpr std::string_view kNames[] = {"start",   "FaceVertex", "VertexFace", "EdgeEdge",
                                                "overlay", "portal",     "exact",      "cache"};
  return Name(kNames, value);
}

std::string_view ToString(PhaseClaim value) {
  static constexpr std::string_view kNames[] = {"not_run", "empty", "local", "maximum"};
  return Name(kNames, value);
}

std::string_view ToString(Termination value) {
  static constexpr std::string_view kNames[] = {"optimal", "early_exit", "coincident", "undecided"};
  return Name(kNames, value);
}

}  // namespace touchstone
