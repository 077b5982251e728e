// SPDX-License-Identifier: MIT
//
// The words in which every query answers.
#ifndef TOUCHSTONE_CORE_BASE_VERDICT_H_
#define TOUCHSTONE_CORE_BASE_VERDICT_H_

#include <string_view>

namespace touchstone {

// Of the closed bodies.
enum class Verdict {
  kSeparate,   // they share no point
  kTouch,      // they share a point, their interiors do not
  kOverlap,    // their interiors share a point
  kUndecided,  // floating point alone could not tell; never returned under Certainty::kExact
};

// Which arithmetic decided the verdict.
enum class Tier {
  kBound,  // doubles with a proven error bound
  kScan,   // doubles, every vertex compared with the plain bound
  kExact,  // exact signs
  kNone,   // undecided, or a search that proves nothing (kPublished)
};

enum class Certainty {
  kFloat,  // doubles with proven bounds; may answer kUndecided
  kExact,  // goes on to exact signs where the bounds do not decide
};

enum class FeatureKind { kVertex, kEdge, kFace };

// A feature of one body, by an element's index. Where coplanar faces or collinear edges make the
// supporting feature larger than any element, `index` names one element of it and stands for all.
struct Feature {
  FeatureKind kind = FeatureKind::kVertex;
  int index = -1;
  friend bool operator==(const Feature&, const Feature&) = default;
};

std::string_view ToString(Verdict value);
std::string_view ToString(Tier value);
std::string_view ToString(Certainty value);
std::string_view ToString(FeatureKind value);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_BASE_VERDICT_H_
