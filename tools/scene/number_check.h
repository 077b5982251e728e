// SPDX-License-Identifier: MIT
//
// The numbers of a scene's steps against the same questions asked anew, and against the exact
// judge.
#ifndef TOUCHSTONE_TOOLS_SCENE_NUMBER_CHECK_H_
#define TOUCHSTONE_TOOLS_SCENE_NUMBER_CHECK_H_

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "touchstone/core/scene/scene.h"
#include "touchstone/tools/judged_query.h"
#include "touchstone/tools/scene/scene_file.h"

namespace touchstone {

// How many numbers of each kind were judged exactly.
struct JudgedNumbers {
  long distances = 0, depths = 0, continuous_depths = 0, travels = 0;
};

class NumberChecker {
 public:
  using Report = std::function<void(const std::string&)>;

  // Of each list of a step so many are judged, in turn: of convex parts, and where a mesh is one.
  static constexpr int kConvexAStep = 64, kMeshesAStep = 1;

  explicit NumberChecker(const SceneSpec& spec);

  // Reports what is missing, too many, or beyond its bounds. Steps in order: a continuous depth
  // follows the motion.
  void Check(const std::vector<WorldPose>& poses, const SceneStep& found, const Report& mismatch);
  // Reports what the judge finds, of some: numbers as they were told, warm caches and all.
  void Judge(const std::vector<WorldPose>& poses, const SceneStep& found, const Report& finding);

  long checked() const { return checked_; }
  const JudgedNumbers& judged() const { return judged_; }

 private:
  // Bodies and parts.
  using PartKey = std::tuple<int, int, int, int>;
  struct Bounds {
    double lower, upper;
  };
  using Listed = std::map<PartKey, std::vector<Bounds>>;
  struct Numbers {
    Listed distances, depths, continuous_depths, travels;
  };
  // What is wanted of two bodies: directions in which the second travels.
  struct Wanted {
    int a, b;
    std::optional<double> margin;
    bool depth = false, cpd = false;
    std::array<std::optional<Subscriptions::Travel>, 3> travels;
  };
  struct Parts {
    PartKey key;
    const ScenePart &p, &q;
    const WorldPose& frame;
    RelativePose pose;
    bool have_moved;
  };

  static Numbers Told(const SceneStep& found);
  void Expect(const Wanted& wanted, const Parts& parts, Numbers* expected);
  static void ExpectConvex(const Wanted& wanted, const Parts& parts, Numbers* expected);
  static Verdict ExpectMeshes(const Wanted& wanted, const Parts& parts, Numbers* expected);
  void ExpectContinuousDepth(const Parts& parts, Verdict verdict, Numbers* expected);
  void Compare(const char* what, const Listed& told, const Listed& expected,
               const Report& mismatch);

  template <class Number, class JudgeOne>
  void JudgeSome(const char* what, std::span<const Number> numbers, int most, long* judged,
                 const Report& finding, JudgeOne judge_one);
  void JudgeConvex(const std::vector<WorldPose>& poses, const SceneStep& found,
                   const Report& finding);
  void JudgeMeshes(const std::vector<WorldPose>& poses, const SceneStep& found,
                   const Report& finding);

  template <class Number>
  Parts PartsOf(const std::vector<WorldPose>& poses, const Number& number) const;
  const Wanted& WantedOf(int a, int b) const;

  const SceneSpec& spec_;
  std::vector<Wanted> wanted_;
  std::vector<WorldPose> poses_before_;
  std::map<PartKey, ContinuousPenetrationDepth> followed_;  // while they overlap
  Listed continuous_depths_;                                // as they last were
  ExactBodies bodies_;
  std::size_t turn_ = 0;
  long checked_ = 0;
  JudgedNumbers judged_;
};

// Whether two bodies take part in each other, by groups and ignored pairs.
bool MayMeet(const SceneSpec& spec, int a, int b);
// What is subscribed to for the pair alone; the travel is that of the body with the larger number.
Subscriptions OwnOfPair(const SceneSpec& spec, int a, int b);

// What is wrong with a continuous depth, a line each: exact placements beside its translation, a
// billionth of the pair's size outward and inward, must not overlap, and overlap.
std::vector<std::string> JudgedContinuousDepth(const TriangleMesh& a, const TriangleMesh& b,
                                               const RelativePose& pose,
                                               const ContinuousDepthResult& result);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_SCENE_NUMBER_CHECK_H_
