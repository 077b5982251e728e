// SPDX-License-Identifier: MIT
#include "touchstone/tools/campaign/reachable.h"

#include <array>
#include <optional>

#include "touchstone/core/cd_dual/result.h"

namespace touchstone {
namespace {

constexpr std::array kClasses = {FaceClass::kFaceVertex, FaceClass::kVertexFace,
                                 FaceClass::kEdgeEdge,   FaceClass::kFaceEdge,
                                 FaceClass::kEdgeFace,   FaceClass::kFaceFace};
constexpr std::array kVerdicts = {Verdict::kSeparate, Verdict::kTouch, Verdict::kOverlap};
constexpr std::array kTiers = {Tier::kBound, Tier::kScan, Tier::kExact};

// Of an end with an exit face: kOptimal. Three rules hold whatever the search and the phase.
bool NamesFaceAtTier(FaceClass face_class, Verdict verdict, Tier tier) {
  // Scans of all vertices prove separation by a direction, never a facet.
  if (tier == Tier::kScan) return false;
  if (tier == Tier::kExact) return true;
  // That o is in the plane is a sign that is zero, and no bound proves a zero.
  if (verdict == Verdict::kTouch) return false;
  // That a feature is parallel to the facet's plane is a zero, too, but for what spans the plane.
  return face_class == FaceClass::kFaceVertex || face_class == FaceClass::kVertexFace ||
         face_class == FaceClass::kEdgeEdge;
}

// Which phase may have named the facet that was then proven to be of this class at this tier.
bool PhasedEndsAt(Phase phase, FaceClass face_class, Tier tier) {
  switch (phase) {
    case Phase::kFaceVertex:
      // Its own face, or the one across an edge of that face's polygon, an edge of P plus a vertex
      // of Q, where doubles see no gain or no arcs: P's part is an edge at least.
      return face_class != FaceClass::kVertexFace;
    case Phase::kVertexFace:
      return face_class != FaceClass::kFaceVertex;
    case Phase::kEdgeEdge:
      return true;
    case Phase::kOverlay:
      // A face that the search turned to and gained by. SEARCH-EE has looked, by the same doubles,
      // at all pairs of edges next to its best face: a pair turned to is one across a tie, whose
      // level vertices take exact signs.
      return face_class != FaceClass::kEdgeEdge || tier == Tier::kExact;
    case Phase::kPortal:
      // Where phases have nothing left to move to, or what they named could not be proven.
      return true;
    case Phase::kExact:
      return tier == Tier::kExact;
    default:
      return false;
  }
}

bool PortalEndsAt(Phase phase, Tier tier) {
  return phase == Phase::kPortal || (phase == Phase::kExact && tier == Tier::kExact);
}

std::string Words(std::optional<FaceClass> face_class, Phase phase, Verdict verdict,
                  Termination termination, Tier tier) {
  const auto word = [](std::string_view text) { return ' ' + std::string(text); };
  return (face_class ? std::string(ToString(*face_class)) : "none") + word(ToString(phase)) +
         word(ToString(verdict)) + word(ToString(termination)) + word(ToString(tier));
}

// Ends without a face: c = o, or an early exit. A cache is not asked here, and kExact leaves
// nothing undecided.
void AddFaceless(Search search, std::vector<std::string>& list) {
  const auto add = [&](Phase phase, Verdict verdict, Termination termination, Tier tier) {
    list.push_back(Words(std::nullopt, phase, verdict, termination, tier));
  };
  // c = o is three zeros.
  add(Phase::kStart, Verdict::kOverlap, Termination::kCoincident, Tier::kExact);
  if (search == Search::kPortal) {
    // Balls and ellipsoids apart; then a direction, or a triangle with o behind it.
    add(Phase::kStart, Verdict::kSeparate, Termination::kEarlyExit, Tier::kBound);
    add(Phase::kPortal, Verdict::kSeparate, Termination::kEarlyExit, Tier::kBound);
    add(Phase::kPortal, Verdict::kSeparate, Termination::kEarlyExit, Tier::kScan);
    add(Phase::kPortal, Verdict::kOverlap, Termination::kEarlyExit, Tier::kBound);
    add(Phase::kPortal, Verdict::kOverlap, Termination::kEarlyExit, Tier::kExact);
    return;
  }
  // A face with d > 0 separates, whichever it is; overlap takes the exit face.
  for (const Phase phase :
       {Phase::kFaceVertex, Phase::kVertexFace, Phase::kEdgeEdge, Phase::kOverlay}) {
    add(phase, Verdict::kSeparate, Termination::kEarlyExit, Tier::kBound);
    add(phase, Verdict::kSeparate, Termination::kEarlyExit, Tier::kScan);
  }
}

std::vector<std::string> ListOf(Search search) {
  std::vector<std::string> list;
  AddFaceless(search, list);
  for (const FaceClass face_class : kClasses) {
    for (int i = 0; i < kPhaseCount; ++i) {
      const auto phase = static_cast<Phase>(i);
      for (const Verdict verdict : kVerdicts) {
        for (const Tier tier : kTiers) {
          if (!NamesFaceAtTier(face_class, verdict, tier)) continue;
          const bool ends = search == Search::kPortal ? PortalEndsAt(phase, tier)
                                                      : PhasedEndsAt(phase, face_class, tier);
          if (ends) list.push_back(Words(face_class, phase, verdict, Termination::kOptimal, tier));
        }
      }
    }
  }
  return list;
}

}  // namespace

const std::vector<std::string>& ReachableCombinations(const std::string& engine) {
  static const std::vector<std::string> portal = ListOf(Search::kPortal);
  static const std::vector<std::string> phased = ListOf(Search::kPhased);
  static const std::vector<std::string> none;
  return engine == "portal" ? portal : engine == "phased" ? phased : none;
}

}  // namespace touchstone
