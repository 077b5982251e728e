// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/result.h"

#include "touchstone/core/base/enum_names.h"

namespace touchstone {

std::string_view ToString(Search value) {
  static constexpr std::string_view kNames[] = {"published", "phased", "portal"};
  return EnumName(kNames, value);
}

std::string_view ToString(FaceClass value) {
  static constexpr std::string_view kNames[] = {"FaceVertex", "VertexFace", "EdgeEdge",
                                                "FaceEdge",   "EdgeFace",   "FaceFace"};
  return EnumName(kNames, value);
}

std::string_view ToString(CertificateKind value) {
  static constexpr std::string_view kNames[] = {"none",
                                                "separating_direction",
                                                "separating_facet",
                                                "enclosing_tetrahedron",
                                                "coincident_interior",
                                                "touching_facet"};
  return EnumName(kNames, value);
}

std::string_view ToString(Phase value) {
  static constexpr std::string_view kNames[] = {"start",   "FaceVertex", "VertexFace", "EdgeEdge",
                                                "overlay", "portal",     "exact",      "cache"};
  return EnumName(kNames, value);
}

std::string_view ToString(PhaseClaim value) {
  static constexpr std::string_view kNames[] = {"not_run", "empty", "local", "maximum"};
  return EnumName(kNames, value);
}

std::string_view ToString(Termination value) {
  static constexpr std::string_view kNames[] = {"optimal", "early_exit", "coincident", "undecided"};
  return EnumName(kNames, value);
}

}  // namespace touchstone
