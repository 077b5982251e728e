// SPDX-License-Identifier: MIT
#include "touchstone/tools/scene/scene_check.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "touchstone/core/cd_dual/cd_dual.h"
#include "touchstone/core/mesh/membership.h"
#include "touchstone/exact/mesh_membership.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMostDetails = 20;

RelativePose PoseOf(const std::vector<WorldPose>& poses, int a, int b) {
  return *RelativePose::FromWorld(poses[a], poses[b]);
}

bool AreConvex(const ScenePart& p, const ScenePart& q) { return p.is_convex() && q.is_convex(); }

}  // namespace

std::string Text(const SceneEvent& event) {
  return std::string(ToString(event.kind)) + ' ' + std::to_string(event.bodies.a.slot) + ' ' +
         std::to_string(event.bodies.b.slot) + ' ' + std::string(ToString(event.verdict));
}

void SceneChecker::Mismatch(const std::string& what) {
  ++mismatches_;
  if (details_.size() < kMostDetails) {
    details_.push_back("step " + std::to_string(step_) + ": " + what);
  }
}

void SceneChecker::Finding(const std::string& what) {
  ++findings_;
  if (details_.size() < kMostDetails) {
    details_.push_back("step " + std::to_string(step_) + ", judge: " + what);
  }
}

bool SceneChecker::WantsVerdict(int a, int b) const {
  return MayMeet(spec_, a, b) &&
         (spec_.bodies[a].subscriptions.verdict || spec_.bodies[b].subscriptions.verdict ||
          OwnOfPair(spec_, a, b).verdict);
}

Verdict SceneChecker::AskPair(int a, int b, const RelativePose& pose) const {
  Verdict strongest = Verdict::kSeparate;
  const SceneShape &p = spec_.bodies[a].shape, &q = spec_.bodies[b].shape;
  for (int i = 0; i < p.part_count(); ++i) {
    for (int j = 0; j < q.part_count(); ++j) {
      const Verdict verdict =
          AreConvex(p.part(i), q.part(j))
              ? Collide(p.part(i).convex(), q.part(j).convex(), pose, {.early_exit = true}).verdict
              : Membership(MeshPair(p.part(i).mesh(), q.part(j).mesh(), pose),
                           Vector3d(Vector3d::Zero()))
                    .verdict;
      if (verdict == Verdict::kOverlap) return verdict;
      if (verdict == Verdict::kTouch) strongest = verdict;
    }
  }
  return strongest;
}

void SceneChecker::JudgePair(int a, int b, const RelativePose& pose, Verdict said) {
  ++pairs_judged_;
  const SceneShape &p = spec_.bodies[a].shape, &q = spec_.bodies[b].shape;
  Verdict exact = Verdict::kSeparate;
  for (int i = 0; i < p.part_count(); ++i) {
    for (int j = 0; j < q.part_count(); ++j) {
      Verdict verdict;
      if (AreConvex(p.part(i), q.part(j))) {
        const ConvexPolyhedron &body_p = p.part(i).convex(), &body_q = q.part(j).convex();
        const CollideResult result = Collide(body_p, body_q, pose);
        exact::JudgeOptions options;
        options.check_phase_maxima = false;
        for (const exact::Finding& finding :
             exact::Judge(bodies_.Get(body_p), bodies_.Get(body_q), pose, result, options)) {
          Finding("pair " + std::to_string(a) + ' ' + std::to_string(b) + ": " +
                  std::string(exact::ToString(finding.kind)) + ": " + finding.detail);
        }
        verdict = result.verdict;
      } else {
        verdict =
            exact::MeshMembership(exact::PlacedMeshPair(p.part(i).mesh(), q.part(j).mesh(), pose),
                                  exact::ExactTranslation(Vector3d::Zero()));
      }
      if (verdict == Verdict::kOverlap || exact == Verdict::kSeparate) exact = verdict;
    }
  }
  if (exact != said) {
    Finding("pair " + std::to_string(a) + ' ' + std::to_string(b) + " is " +
            std::string(ToString(exact)) + ", not " + std::string(ToString(said)));
  }
}

void SceneChecker::CheckEvents(const std::map<Slots, Verdict>& now, const SceneStep& found) {
  std::set<Slots> all;
  for (const auto& [pair, verdict] : before_) all.insert(pair);
  for (const auto& [pair, verdict] : now) all.insert(pair);
  std::vector<std::string> expected;
  for (const Slots& pair : all) {
    const bool was = before_.contains(pair), is = now.contains(pair);
    const char* kind = was && is ? "persist " : is ? "begin " : "end ";
    const Verdict verdict = is ? now.at(pair) : Verdict::kSeparate;
    expected.push_back(kind + std::to_string(pair.first) + ' ' + std::to_string(pair.second) + ' ' +
                       std::string(ToString(verdict)));
  }
  std::vector<std::string> told;
  for (const SceneEvent& event : found.events) told.push_back(Text(event));
  for (std::size_t i = 0; i < std::max(expected.size(), told.size()); ++i) {
    const std::string want = i < expected.size() ? expected[i] : "nothing";
    const std::string got = i < told.size() ? told[i] : "nothing";
    if (want != got) Mismatch("told '" + got + "' for '" + want + "'");
  }
}

void SceneChecker::Check(int step, const std::vector<WorldPose>& poses, const SceneStep& found) {
  step_ = step;
  std::map<Slots, Verdict> now;
  std::vector<std::tuple<int, int, Verdict>> candidates;
  const int n = static_cast<int>(spec_.bodies.size());
  for (int a = 0; a < n; ++a) {
    for (int b = a + 1; b < n; ++b) {
      if (!WantsVerdict(a, b)) continue;
      ++pairs_checked_;
      const Verdict verdict = AskPair(a, b, PoseOf(poses, a, b));
      if (verdict != Verdict::kSeparate) now[{a, b}] = verdict;
      candidates.emplace_back(a, b, verdict);
    }
  }
  CheckEvents(now, found);
  before_ = std::move(now);
  numbers_.Check(poses, found, [this](const std::string& what) { Mismatch(what); });
  numbers_.Judge(poses, found, [this](const std::string& what) { Finding(what); });
  // Those in contact first, the rest in turn.
  int judged = 0;
  for (const auto& [a, b, verdict] : candidates) {
    if (verdict == Verdict::kSeparate || judged >= kJudgedAStep / 2) continue;
    JudgePair(a, b, PoseOf(poses, a, b), verdict);
    ++judged;
  }
  for (std::size_t k = 0; k < candidates.size() && judged < kJudgedAStep; ++k) {
    const auto& [a, b, verdict] = candidates[turn_++ % candidates.size()];
    JudgePair(a, b, PoseOf(poses, a, b), verdict);
    ++judged;
  }
}

}  // namespace touchstone
