// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_SCENE_SCENE_CHECK_H_
#define TOUCHSTONE_TOOLS_SCENE_SCENE_CHECK_H_

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "touchstone/core/scene/scene.h"
#include "touchstone/tools/judged_query.h"
#include "touchstone/tools/scene/number_check.h"
#include "touchstone/tools/scene/scene_file.h"

namespace touchstone {

// Holds a scene's steps against all pairs of bodies, each asked anew by Collide and Membership,
// with events derived from these, and their numbers by the queries of core/proximity, core/mesh and
// core/cpd; and against the exact judge. Bodies of the scene must have been added in the order of
// the specification.
class SceneChecker {
 public:
  // Of the pairs of a step so many are judged exactly, in turn; those in contact before others.
  static constexpr int kJudgedAStep = 64;

  explicit SceneChecker(const SceneSpec& spec) : spec_(spec), numbers_(spec) {}

  void Check(int step, const std::vector<WorldPose>& poses, const SceneStep& found);

  long mismatches() const { return mismatches_; }
  long findings() const { return findings_; }
  long pairs_checked() const { return pairs_checked_; }
  long pairs_judged() const { return pairs_judged_; }
  const NumberChecker& numbers() const { return numbers_; }
  // The first few of both, a line each.
  const std::vector<std::string>& details() const { return details_; }

 private:
  using Slots = std::pair<int, int>;

  bool WantsVerdict(int a, int b) const;
  Verdict AskPair(int a, int b, const RelativePose& pose) const;
  void CheckEvents(const std::map<Slots, Verdict>& now, const SceneStep& found);
  void JudgePair(int a, int b, const RelativePose& pose, Verdict said);
  void Mismatch(const std::string& what);
  void Finding(const std::string& what);

  const SceneSpec& spec_;
  NumberChecker numbers_;
  std::map<Slots, Verdict> before_;
  ExactBodies bodies_;
  int step_ = 0;
  std::size_t turn_ = 0;
  long mismatches_ = 0, findings_ = 0, pairs_checked_ = 0, pairs_judged_ = 0;
  std::vector<std::string> details_;
};

// "begin 3 7 touch".
std::string Text(const SceneEvent& event);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_SCENE_SCENE_CHECK_H_
