// SPDX-License-Identifier: MIT
#include "touchstone/tools/scene/scene_check.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "touchstone/core/cd_dual/cd_dual.h"
#include "touchstone/core/cpd/mesh_penetration_depth.h"
#include "touchstone/core/mesh/membership.h"
#include "touchstone/core/proximity/directional_distance.h"
#include "touchstone/core/proximity/distance.h"
#include "touchstone/core/proximity/penetration_depth.h"
#include "touchstone/exact/judge_proximity.h"
#include "touchstone/exact/mesh_membership.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;
using PartKey = std::tuple<int, int, int, int>;

constexpr std::size_t kMostDetails = 20;

RelativePose PoseOf(const std::vector<WorldPose>& poses, int a, int b) {
  return *RelativePose::FromWorld(poses[a], poses[b]);
}

bool AreConvex(const ScenePart& p, const ScenePart& q) { return p.is_convex() && q.is_convex(); }

template <class Number>
PartKey KeyOf(const Number& number) {
  return {static_cast<int>(number.bodies.a.slot), static_cast<int>(number.bodies.b.slot),
          number.part_a, number.part_b};
}

// Values and their bounds, by what they are of.
template <class Number, class ValueOf>
std::map<PartKey, std::vector<BoundedValue>> Listed(std::span<const Number> numbers,
                                                    ValueOf value_of) {
  std::map<PartKey, std::vector<BoundedValue>> listed;
  for (const Number& number : numbers) {
    if (number.status == NumberStatus::kFound) {
      listed[KeyOf(number)].push_back(value_of(number.result));
    }
  }
  return listed;
}

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

bool SceneChecker::MayMeet(int a, int b) const {
  const Filter &f = spec_.bodies[a].filter, &g = spec_.bodies[b].filter;
  if ((f.group & g.mask) == 0 || (g.group & f.mask) == 0) return false;
  return std::none_of(spec_.ignored.begin(), spec_.ignored.end(), [&](const auto& pair) {
    return std::minmax(pair.first, pair.second) == std::minmax(a, b);
  });
}

// Of the pair alone: what its bodies want is added where it is needed.
Subscriptions SceneChecker::WantedOf(int a, int b) const {
  Subscriptions wanted;
  wanted.verdict = false;
  for (const auto& [first, second, own] : spec_.pairs) {
    if (std::minmax(first, second) != std::minmax(a, b)) continue;
    wanted = own;
    if (first > second && wanted.travel) wanted.travel->direction *= -1.0;
  }
  return wanted;
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

// The depth of two parts of which one is a mesh, computed anew without a cache.
void SceneChecker::CheckMeshDepth(int a, int b, int i, int j, const RelativePose& pose,
                                  const SceneStep& found) {
  const ScenePart &p = spec_.bodies[a].shape.part(i), &q = spec_.bodies[b].shape.part(j);
  const auto told =
      std::find_if(found.mesh_depths.begin(), found.mesh_depths.end(), [&](const auto& number) {
        return KeyOf(number) == PartKey{a, b, i, j};
      });
  const MeshPair pair(p.mesh(), q.mesh(), pose);
  const std::string of = "depth of bodies " + std::to_string(a) + ' ' + std::to_string(b);
  if (Membership(pair, Vector3d(Vector3d::Zero())).verdict != Verdict::kOverlap) {
    if (told != found.mesh_depths.end()) Mismatch(of + " is too many");
    return;
  }
  if (told == found.mesh_depths.end()) return Mismatch(of + " is missing");
  const MeshDepthResult depth = MeshPenetrationDepth(pair, p.contact_body(), q.contact_body());
  if (!(told->result.lower_bound <= depth.upper_bound &&
        depth.lower_bound <= told->result.upper_bound)) {
    Mismatch(of + " is beyond its bounds");
  }
}

void SceneChecker::CheckNumbers(const std::vector<WorldPose>& poses, const SceneStep& found) {
  const auto distances =
      Listed(found.distances, [](const DistanceResult& r) { return r.distance; });
  const auto depths = Listed(found.depths, [](const PenetrationResult& r) { return r.depth; });
  const auto travels =
      Listed(found.travels, [](const DirectionalResult& r) { return r.enter.travel; });
  std::map<PartKey, std::vector<BoundedValue>> want_distances, want_depths, want_travels;
  const int n = static_cast<int>(spec_.bodies.size());
  for (int a = 0; a < n; ++a) {
    for (int b = a + 1; b < n; ++b) {
      if (!MayMeet(a, b)) continue;
      const Subscriptions &of_a = spec_.bodies[a].subscriptions,
                          &of_b = spec_.bodies[b].subscriptions;
      const Subscriptions own = WantedOf(a, b);
      const bool depth = of_a.depth || of_b.depth || own.depth;
      const bool distance = of_a.distance || of_b.distance || own.distance;
      if (!depth && !distance && !of_a.travel && !of_b.travel && !own.travel) continue;
      const double margin = std::max(
          {of_a.distance.value_or(0.0), of_b.distance.value_or(0.0), own.distance.value_or(0.0)});
      const RelativePose pose = PoseOf(poses, a, b);
      const SceneShape &p = spec_.bodies[a].shape, &q = spec_.bodies[b].shape;
      for (int i = 0; i < p.part_count(); ++i) {
        for (int j = 0; j < q.part_count(); ++j) {
          if (!AreConvex(p.part(i), q.part(j))) {
            if (depth) CheckMeshDepth(a, b, i, j, pose, found);
            continue;
          }
          const ConvexPolyhedron &body_p = p.part(i).convex(), &body_q = q.part(j).convex();
          const PartKey key{a, b, i, j};
          if (distance) {
            const DistanceResult result = Distance(body_p, body_q, pose);
            if (result.distance.value <= margin) want_distances[key] = {result.distance};
          }
          if (depth) {
            const PenetrationResult result = PenetrationDepth(body_p, body_q, pose);
            if (result.verdict == Verdict::kOverlap) want_depths[key] = {result.depth};
          }
          const auto travel = [&](const std::optional<Subscriptions::Travel>& wanted,
                                  double sense) {
            if (!wanted) return;
            const Vector3d s = poses[a].rotation.transpose() * Vector3d(sense * wanted->direction);
            const auto result = DirectionalDistance(body_p, body_q, pose, s);
            if (!result.ok() || result->kind != TravelKind::kInterval ||
                result->leave.travel.value < 0.0 || result->enter.travel.value > wanted->reach) {
              return;
            }
            want_travels[key].push_back(result->enter.travel);
          };
          travel(of_a.travel, -1.0);
          travel(of_b.travel, 1.0);
          travel(own.travel, 1.0);
        }
      }
    }
  }
  const auto compare = [&](const char* what, const auto& got, const auto& want) {
    std::set<PartKey> keys;
    for (const auto& [key, values] : got) keys.insert(key);
    for (const auto& [key, values] : want) keys.insert(key);
    for (const PartKey& key : keys) {
      const auto x = got.find(key), y = want.find(key);
      const std::string of = std::string(what) + " of bodies " + std::to_string(std::get<0>(key)) +
                             ' ' + std::to_string(std::get<1>(key));
      if (x == got.end() || y == want.end() || x->second.size() != y->second.size()) {
        Mismatch(of + (x == got.end() ? " is missing" : " is too many"));
        continue;
      }
      for (std::size_t k = 0; k < x->second.size(); ++k) {
        const BoundedValue &u = x->second[k], &v = y->second[k];
        if (!(std::abs(u.value - v.value) <= u.error + v.error)) {
          Mismatch(of + " is beyond its bounds");
        }
      }
    }
  };
  compare("distance", distances, want_distances);
  compare("depth", depths, want_depths);
  compare("travel", travels, want_travels);
}

void SceneChecker::Check(int step, const std::vector<WorldPose>& poses, const SceneStep& found) {
  step_ = step;
  std::map<Slots, Verdict> now;
  std::vector<std::tuple<int, int, Verdict>> candidates;
  const int n = static_cast<int>(spec_.bodies.size());
  for (int a = 0; a < n; ++a) {
    for (int b = a + 1; b < n; ++b) {
      if (!MayMeet(a, b)) continue;
      if (!spec_.bodies[a].subscriptions.verdict && !spec_.bodies[b].subscriptions.verdict &&
          !WantedOf(a, b).verdict) {
        continue;
      }
      ++pairs_checked_;
      const Verdict verdict = AskPair(a, b, PoseOf(poses, a, b));
      if (verdict != Verdict::kSeparate) now[{a, b}] = verdict;
      candidates.emplace_back(a, b, verdict);
    }
  }
  CheckEvents(now, found);
  before_ = std::move(now);
  CheckNumbers(poses, found);
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
  // Numbers as they were told, warm caches and all.
  const auto report = [&](const char* what, const auto& number, const auto& found_by_judge) {
    for (const exact::Finding& finding : found_by_judge) {
      Finding(std::string(what) + " of bodies " + std::to_string(number.bodies.a.slot) + ' ' +
              std::to_string(number.bodies.b.slot) + ": " +
              std::string(exact::ToString(finding.kind)) + ": " + finding.detail);
    }
  };
  exact::ProximityJudgeOptions options;
  options.all_faces = false;
  const auto part = [&](const BodyHandle& body, int i) -> const ConvexPolyhedron& {
    return spec_.bodies[body.slot].shape.part(i).convex();
  };
  int numbers = 0;
  for (const auto& number : found.distances) {
    if (number.status != NumberStatus::kFound || ++numbers > kJudgedAStep) continue;
    report("distance", number,
           exact::JudgeDistance(bodies_.Get(part(number.bodies.a, number.part_a)),
                                bodies_.Get(part(number.bodies.b, number.part_b)),
                                PoseOf(poses, static_cast<int>(number.bodies.a.slot),
                                       static_cast<int>(number.bodies.b.slot)),
                                number.result, options));
  }
  numbers = 0;
  for (const auto& number : found.depths) {
    if (number.status != NumberStatus::kFound || ++numbers > kJudgedAStep) continue;
    report("depth", number,
           exact::JudgePenetration(bodies_.Get(part(number.bodies.a, number.part_a)),
                                   bodies_.Get(part(number.bodies.b, number.part_b)),
                                   PoseOf(poses, static_cast<int>(number.bodies.a.slot),
                                          static_cast<int>(number.bodies.b.slot)),
                                   number.result, options));
  }
}

}  // namespace touchstone
