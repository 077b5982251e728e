// SPDX-License-Identifier: MIT
#include "touchstone/tools/campaign/reachable.h"

#include <array>

namespace touchstone {
namespace {

// What came up among 433,920 queries of each search over all suites.
constexpr std::array<std::string_view, 48> kPortal = {{
    "EdgeEdge exact overlap optimal exact",     "EdgeEdge exact separate optimal exact",
    "EdgeEdge exact touch optimal exact",       "EdgeEdge portal overlap optimal bound",
    "EdgeEdge portal overlap optimal exact",    "EdgeEdge portal separate optimal bound",
    "EdgeEdge portal separate optimal exact",   "EdgeEdge portal touch optimal exact",
    "EdgeFace exact overlap optimal exact",     "EdgeFace exact separate optimal exact",
    "EdgeFace exact touch optimal exact",       "EdgeFace portal overlap optimal exact",
    "EdgeFace portal separate optimal exact",   "EdgeFace portal touch optimal exact",
    "FaceEdge exact overlap optimal exact",     "FaceEdge exact separate optimal exact",
    "FaceEdge exact touch optimal exact",       "FaceEdge portal overlap optimal exact",
    "FaceEdge portal separate optimal exact",   "FaceEdge portal touch optimal exact",
    "FaceFace exact overlap optimal exact",     "FaceFace exact separate optimal exact",
    "FaceFace exact touch optimal exact",       "FaceFace portal overlap optimal exact",
    "FaceFace portal separate optimal exact",   "FaceFace portal touch optimal exact",
    "FaceVertex exact overlap optimal exact",   "FaceVertex exact separate optimal exact",
    "FaceVertex exact touch optimal exact",     "FaceVertex portal overlap optimal bound",
    "FaceVertex portal overlap optimal exact",  "FaceVertex portal separate optimal bound",
    "FaceVertex portal separate optimal exact", "FaceVertex portal touch optimal exact",
    "VertexFace exact overlap optimal exact",   "VertexFace exact separate optimal exact",
    "VertexFace exact touch optimal exact",     "VertexFace portal overlap optimal bound",
    "VertexFace portal overlap optimal exact",  "VertexFace portal separate optimal bound",
    "VertexFace portal separate optimal exact", "VertexFace portal touch optimal exact",
    "none portal overlap early_exit bound",     "none portal overlap early_exit exact",
    "none portal separate early_exit bound",    "none portal separate early_exit scan",
    "none start overlap coincident exact",      "none start separate early_exit bound",
}};
constexpr std::array<std::string_view, 123> kPhased = {{
    "EdgeEdge EdgeEdge overlap optimal bound",      "EdgeEdge EdgeEdge overlap optimal exact",
    "EdgeEdge EdgeEdge separate optimal bound",     "EdgeEdge EdgeEdge separate optimal exact",
    "EdgeEdge EdgeEdge touch optimal exact",        "EdgeEdge FaceVertex overlap optimal bound",
    "EdgeEdge FaceVertex overlap optimal exact",    "EdgeEdge FaceVertex separate optimal bound",
    "EdgeEdge FaceVertex separate optimal exact",   "EdgeEdge FaceVertex touch optimal exact",
    "EdgeEdge VertexFace overlap optimal bound",    "EdgeEdge VertexFace overlap optimal exact",
    "EdgeEdge VertexFace separate optimal bound",   "EdgeEdge VertexFace separate optimal exact",
    "EdgeEdge VertexFace touch optimal exact",      "EdgeEdge exact overlap optimal exact",
    "EdgeEdge exact separate optimal exact",        "EdgeEdge exact touch optimal exact",
    "EdgeEdge overlay overlap optimal exact",       "EdgeEdge overlay separate optimal exact",
    "EdgeEdge overlay touch optimal exact",         "EdgeEdge portal overlap optimal bound",
    "EdgeEdge portal overlap optimal exact",        "EdgeEdge portal separate optimal bound",
    "EdgeEdge portal separate optimal exact",       "EdgeEdge portal touch optimal exact",
    "EdgeFace EdgeEdge overlap optimal exact",      "EdgeFace EdgeEdge separate optimal exact",
    "EdgeFace EdgeEdge touch optimal exact",        "EdgeFace FaceVertex overlap optimal exact",
    "EdgeFace FaceVertex separate optimal exact",   "EdgeFace FaceVertex touch optimal exact",
    "EdgeFace VertexFace overlap optimal exact",    "EdgeFace VertexFace separate optimal exact",
    "EdgeFace VertexFace touch optimal exact",      "EdgeFace exact overlap optimal exact",
    "EdgeFace exact separate optimal exact",        "EdgeFace exact touch optimal exact",
    "EdgeFace overlay overlap optimal exact",       "EdgeFace portal overlap optimal exact",
    "EdgeFace portal separate optimal exact",       "EdgeFace portal touch optimal exact",
    "FaceEdge EdgeEdge overlap optimal exact",      "FaceEdge EdgeEdge separate optimal exact",
    "FaceEdge EdgeEdge touch optimal exact",        "FaceEdge FaceVertex overlap optimal exact",
    "FaceEdge FaceVertex separate optimal exact",   "FaceEdge FaceVertex touch optimal exact",
    "FaceEdge VertexFace overlap optimal exact",    "FaceEdge VertexFace separate optimal exact",
    "FaceEdge VertexFace touch optimal exact",      "FaceEdge exact overlap optimal exact",
    "FaceEdge exact separate optimal exact",        "FaceEdge exact touch optimal exact",
    "FaceEdge portal overlap optimal exact",        "FaceEdge portal separate optimal exact",
    "FaceEdge portal touch optimal exact",          "FaceFace EdgeEdge overlap optimal exact",
    "FaceFace EdgeEdge separate optimal exact",     "FaceFace EdgeEdge touch optimal exact",
    "FaceFace FaceVertex overlap optimal exact",    "FaceFace FaceVertex separate optimal exact",
    "FaceFace FaceVertex touch optimal exact",      "FaceFace VertexFace overlap optimal exact",
    "FaceFace VertexFace separate optimal exact",   "FaceFace VertexFace touch optimal exact",
    "FaceFace exact overlap optimal exact",         "FaceFace exact separate optimal exact",
    "FaceFace exact touch optimal exact",           "FaceFace portal overlap optimal exact",
    "FaceFace portal separate optimal exact",       "FaceFace portal touch optimal exact",
    "FaceVertex EdgeEdge overlap optimal exact",    "FaceVertex EdgeEdge separate optimal exact",
    "FaceVertex EdgeEdge touch optimal exact",      "FaceVertex FaceVertex overlap optimal bound",
    "FaceVertex FaceVertex overlap optimal exact",  "FaceVertex FaceVertex separate optimal bound",
    "FaceVertex FaceVertex separate optimal exact", "FaceVertex FaceVertex touch optimal exact",
    "FaceVertex exact overlap optimal exact",       "FaceVertex exact separate optimal exact",
    "FaceVertex exact touch optimal exact",         "FaceVertex overlay overlap optimal bound",
    "FaceVertex overlay overlap optimal exact",     "FaceVertex overlay separate optimal bound",
    "FaceVertex overlay separate optimal exact",    "FaceVertex overlay touch optimal exact",
    "FaceVertex portal overlap optimal bound",      "FaceVertex portal overlap optimal exact",
    "FaceVertex portal separate optimal bound",     "FaceVertex portal separate optimal exact",
    "FaceVertex portal touch optimal exact",        "VertexFace EdgeEdge overlap optimal exact",
    "VertexFace EdgeEdge separate optimal exact",   "VertexFace EdgeEdge touch optimal exact",
    "VertexFace VertexFace overlap optimal bound",  "VertexFace VertexFace overlap optimal exact",
    "VertexFace VertexFace separate optimal bound", "VertexFace VertexFace separate optimal exact",
    "VertexFace VertexFace touch optimal exact",    "VertexFace exact overlap optimal exact",
    "VertexFace exact separate optimal exact",      "VertexFace exact touch optimal exact",
    "VertexFace overlay overlap optimal bound",     "VertexFace overlay overlap optimal exact",
    "VertexFace overlay separate optimal bound",    "VertexFace overlay separate optimal exact",
    "VertexFace overlay touch optimal exact",       "VertexFace portal overlap optimal bound",
    "VertexFace portal overlap optimal exact",      "VertexFace portal separate optimal bound",
    "VertexFace portal separate optimal exact",     "VertexFace portal touch optimal exact",
    "none EdgeEdge separate early_exit bound",      "none EdgeEdge separate early_exit scan",
    "none FaceVertex separate early_exit bound",    "none FaceVertex separate early_exit scan",
    "none VertexFace separate early_exit bound",    "none VertexFace separate early_exit scan",
    "none overlay separate early_exit bound",       "none overlay separate early_exit scan",
    "none start overlap coincident exact",
}};

}  // namespace

std::span<const std::string_view> ReachableCombinations(const std::string& engine) {
  if (engine == "portal") return kPortal;
  if (engine == "phased") return kPhased;
  return {};
}

}  // namespace touchstone
