// SPDX-License-Identifier: MIT
#include "touchstone/tools/scene/number_check.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "touchstone/core/mesh/membership.h"
#include "touchstone/core/minkowski/convolution.h"
#include "touchstone/core/proximity/directional_distance.h"
#include "touchstone/core/proximity/distance.h"
#include "touchstone/core/proximity/penetration_depth.h"
#include "touchstone/exact/judge_proximity.h"
#include "touchstone/exact/judge_surface.h"
#include "touchstone/exact/mesh_membership.h"
#include "touchstone/tools/cpd_run.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

// A continuous depth's translation is on the boundary up to this part of the pair's size.
constexpr double kBesideBoundary = 1e-9;

template <class Number>
std::tuple<int, int, int, int> KeyOf(const Number& number) {
  return {static_cast<int>(number.bodies.a.slot), static_cast<int>(number.bodies.b.slot),
          number.part_a, number.part_b};
}

Vector3d InFrame(const WorldPose& frame, const Subscriptions::Travel& travel) {
  return frame.rotation.transpose() * travel.direction;
}

bool AreSame(const WorldPose& x, const WorldPose& y) {
  return x.rotation == y.rotation && x.translation == y.translation;
}

// Of ∂M, outward, where its facet has an area.
Vector3d NormalOf(const MeshPair& pair, const SumFacet& facet) {
  const SumCorners corners = CornersOf(pair, facet);
  const auto point = [&](int k) -> Vector3d {
    return pair.a().points[corners.vertices[k].a] - pair.b().points[corners.vertices[k].b];
  };
  return (point(1) - point(0)).cross(point(corners.count - 1) - point(0)).stableNormalized();
}

}  // namespace

bool MayMeet(const SceneSpec& spec, int a, int b) {
  const Filter &f = spec.bodies[a].filter, &g = spec.bodies[b].filter;
  if ((f.group & g.mask) == 0 || (g.group & f.mask) == 0) return false;
  return std::none_of(spec.ignored.begin(), spec.ignored.end(), [&](const auto& pair) {
    return std::minmax(pair.first, pair.second) == std::minmax(a, b);
  });
}

Subscriptions OwnOfPair(const SceneSpec& spec, int a, int b) {
  Subscriptions wanted;
  wanted.verdict = false;
  for (const auto& [first, second, own] : spec.pairs) {
    if (std::minmax(first, second) != std::minmax(a, b)) continue;
    wanted = own;
    if (first > second && wanted.travel) wanted.travel->direction *= -1.0;
  }
  return wanted;
}

std::vector<std::string> JudgedContinuousDepth(const TriangleMesh& a, const TriangleMesh& b,
                                               const RelativePose& pose,
                                               const ContinuousDepthResult& result) {
  if (result.status == ContinuousDepthStatus::kSeparate) return {"said to be separate"};
  const MeshPair pair(a, b, pose);
  const exact::PlacedMeshPair exact_pair(a, b, pose);
  const double step = kBesideBoundary / pair.scale();
  std::vector<Vector3d> outward = {result.direction};
  if (result.features.a >= 0) outward.push_back(NormalOf(pair, result.features));
  const auto any_overlaps = [&](double sense, bool expected) {
    return std::any_of(outward.begin(), outward.end(), [&](const Vector3d& n) {
      const exact::ExactTranslation x(Vector3d(result.translation + sense * step * n));
      return (exact::MeshMembership(exact_pair, x) == Verdict::kOverlap) == expected;
    });
  };
  std::vector<std::string> findings;
  if (!any_overlaps(1.0, false)) findings.push_back("beyond the translation they overlap");
  if (!any_overlaps(-1.0, true)) findings.push_back("short of the translation they do not overlap");
  return findings;
}

NumberChecker::NumberChecker(const SceneSpec& spec) : spec_(spec) {
  const int n = static_cast<int>(spec.bodies.size());
  for (int a = 0; a < n; ++a) {
    for (int b = a + 1; b < n; ++b) {
      const Subscriptions own = OwnOfPair(spec, a, b);
      Wanted wanted{a, b, {}, false, false, {}};
      const Subscriptions* const all[] = {&spec.bodies[a].subscriptions,
                                          &spec.bodies[b].subscriptions, &own};
      bool any = false;
      for (int k = 0; k < 3; ++k) {
        const Subscriptions& each = *all[k];
        if (each.distance) wanted.margin = std::max(wanted.margin.value_or(0.0), *each.distance);
        wanted.depth |= each.depth;
        wanted.cpd |= each.cpd;
        wanted.travels[k] = each.travel;
        any |= each.distance || each.depth || each.cpd || each.travel;
      }
      if (wanted.travels[0]) wanted.travels[0]->direction *= -1.0;
      if (any && MayMeet(spec, a, b)) wanted_.push_back(wanted);
    }
  }
}

const NumberChecker::Wanted& NumberChecker::WantedOf(int a, int b) const {
  return *std::find_if(wanted_.begin(), wanted_.end(),
                       [&](const Wanted& wanted) { return wanted.a == a && wanted.b == b; });
}

NumberChecker::Numbers NumberChecker::Told(const SceneStep& found) {
  Numbers told;
  const auto list = [](const auto& numbers, Listed* listed, auto bounds_of) {
    for (const auto& number : numbers) {
      (*listed)[KeyOf(number)].push_back(bounds_of(number.result));
    }
  };
  const auto bounds = [](const BoundedValue& x) {
    return Bounds{x.value - x.error, x.value + x.error};
  };
  const auto as_said = [](const auto& result) {
    return Bounds{result.lower_bound, result.upper_bound};
  };
  list(found.distances, &told.distances, [&](const auto& r) { return bounds(r.distance); });
  list(found.mesh_distances, &told.distances, as_said);
  list(found.depths, &told.depths, [&](const auto& r) { return bounds(r.depth); });
  list(found.mesh_depths, &told.depths, as_said);
  list(found.travels, &told.travels, [&](const auto& r) { return bounds(r.enter.travel); });
  list(found.mesh_travels, &told.travels, as_said);
  for (const auto& number : found.continuous_depths) {
    for (const double x : number.result.translation) {
      told.continuous_depths[KeyOf(number)].push_back({x, x});
    }
  }
  return told;
}

void NumberChecker::ExpectConvex(const Wanted& wanted, const Parts& parts, Numbers* expected) {
  const ConvexPolyhedron &p = parts.p.convex(), &q = parts.q.convex();
  const auto add = [&](Listed* listed, const BoundedValue& x) {
    (*listed)[parts.key].push_back({x.value - x.error, x.value + x.error});
  };
  if (wanted.margin) {
    const DistanceResult result = Distance(p, q, parts.pose);
    if (result.distance.value <= *wanted.margin) add(&expected->distances, result.distance);
  }
  if (wanted.depth) {
    const PenetrationResult result = PenetrationDepth(p, q, parts.pose);
    if (result.verdict == Verdict::kOverlap) add(&expected->depths, result.depth);
  }
  for (const auto& travel : wanted.travels) {
    if (!travel) continue;
    const auto result = DirectionalDistance(p, q, parts.pose, InFrame(parts.frame, *travel));
    if (!result.ok() || result->kind != TravelKind::kInterval || result->leave.travel.value < 0.0 ||
        result->enter.travel.value > travel->reach) {
      continue;
    }
    add(&expected->travels, result->enter.travel);
  }
}

Verdict NumberChecker::ExpectMeshes(const Wanted& wanted, const Parts& parts, Numbers* expected) {
  const MeshPair pair(parts.p.mesh(), parts.q.mesh(), parts.pose);
  const Verdict verdict = Membership(pair, Vector3d(Vector3d::Zero())).verdict;
  const bool is_separate = verdict == Verdict::kSeparate;
  const auto add = [&](Listed* listed, double lower, double upper) {
    (*listed)[parts.key].push_back({lower, upper});
  };
  if (wanted.margin) {
    const SurfaceDistanceResult result =
        is_separate ? SurfaceDistance(pair) : SurfaceDistanceResult();
    if (result.distance <= *wanted.margin) {
      add(&expected->distances, result.lower_bound, result.upper_bound);
    }
  }
  if (wanted.depth && verdict == Verdict::kOverlap) {
    const MeshDepthResult result =
        MeshPenetrationDepth(pair, parts.p.contact_body(), parts.q.contact_body());
    add(&expected->depths, result.lower_bound, result.upper_bound);
  }
  for (const auto& travel : wanted.travels) {
    if (!travel) continue;
    SurfaceTravelResult result;
    result.is_hit = !is_separate;
    if (is_separate) result = SurfaceTravel(pair, InFrame(parts.frame, *travel), travel->reach);
    if (result.is_hit) add(&expected->travels, result.lower_bound, result.upper_bound);
  }
  return verdict;
}

// The scene's answers are those of a solver that is asked whenever one of the two moves, to the
// last bit.
void NumberChecker::ExpectContinuousDepth(const Parts& parts, Verdict verdict, Numbers* expected) {
  if (verdict != Verdict::kOverlap) {
    followed_.erase(parts.key);
    continuous_depths_.erase(parts.key);
    return;
  }
  if (parts.have_moved) {
    const auto [follower, is_new] =
        followed_.try_emplace(parts.key, parts.p.mesh(), parts.q.mesh());
    std::vector<Bounds>& last = continuous_depths_[parts.key];
    last.clear();
    for (const double x : follower->second.Update(parts.pose).translation) last.push_back({x, x});
  }
  expected->continuous_depths[parts.key] = continuous_depths_[parts.key];
}

void NumberChecker::Expect(const Wanted& wanted, const Parts& parts, Numbers* expected) {
  Verdict verdict;
  if (parts.p.is_convex() && parts.q.is_convex()) {
    ExpectConvex(wanted, parts, expected);
    if (!wanted.cpd) return;
    verdict = Collide(parts.p.convex(), parts.q.convex(), parts.pose, {.early_exit = true}).verdict;
  } else {
    verdict = ExpectMeshes(wanted, parts, expected);
  }
  if (wanted.cpd) ExpectContinuousDepth(parts, verdict, expected);
}

void NumberChecker::Compare(const char* what, const Listed& told, const Listed& expected,
                            const Report& mismatch) {
  std::set<PartKey> keys;
  for (const auto& [key, values] : told) keys.insert(key);
  for (const auto& [key, values] : expected) keys.insert(key);
  for (const PartKey& key : keys) {
    ++checked_;
    const auto x = told.find(key), y = expected.find(key);
    const std::string of = std::string(what) + " of bodies " + std::to_string(std::get<0>(key)) +
                           ' ' + std::to_string(std::get<1>(key));
    if (x == told.end()) {
      mismatch(of + " is missing");
    } else if (y == expected.end() || x->second.size() != y->second.size()) {
      mismatch(of + " is too many");
    } else {
      for (std::size_t k = 0; k < x->second.size(); ++k) {
        const Bounds &u = x->second[k], &v = y->second[k];
        if (!(u.lower <= v.upper && v.lower <= u.upper)) mismatch(of + " is beyond its bounds");
      }
    }
  }
}

void NumberChecker::Check(const std::vector<WorldPose>& poses, const SceneStep& found,
                          const Report& mismatch) {
  const bool is_first = poses_before_.empty();
  const auto has_moved = [&](int body) {
    return is_first || !AreSame(poses[body], poses_before_[body]);
  };
  Numbers expected;
  for (const Wanted& wanted : wanted_) {
    const SceneShape &p = spec_.bodies[wanted.a].shape, &q = spec_.bodies[wanted.b].shape;
    const RelativePose pose = *RelativePose::FromWorld(poses[wanted.a], poses[wanted.b]);
    const bool have_moved = has_moved(wanted.a) || has_moved(wanted.b);
    for (int i = 0; i < p.part_count(); ++i) {
      for (int j = 0; j < q.part_count(); ++j) {
        Expect(
            wanted,
            {{wanted.a, wanted.b, i, j}, p.part(i), q.part(j), poses[wanted.a], pose, have_moved},
            &expected);
      }
    }
  }
  poses_before_ = poses;
  const Numbers told = Told(found);
  Compare("distance", told.distances, expected.distances, mismatch);
  Compare("depth", told.depths, expected.depths, mismatch);
  Compare("continuous depth", told.continuous_depths, expected.continuous_depths, mismatch);
  Compare("travel", told.travels, expected.travels, mismatch);
}

template <class Number>
NumberChecker::Parts NumberChecker::PartsOf(const std::vector<WorldPose>& poses,
                                            const Number& number) const {
  const PartKey key = KeyOf(number);
  const auto [a, b, i, j] = key;
  return {key,
          spec_.bodies[a].shape.part(i),
          spec_.bodies[b].shape.part(j),
          poses[a],
          *RelativePose::FromWorld(poses[a], poses[b]),
          true};
}

template <class Number, class JudgeOne>
void NumberChecker::JudgeSome(const char* what, std::span<const Number> numbers, int most,
                              long* judged, const Report& finding, JudgeOne judge_one) {
  const std::size_t count = std::min(numbers.size(), static_cast<std::size_t>(most));
  for (std::size_t k = 0; k < count; ++k) {
    const Number& number = numbers[(turn_ + k) % numbers.size()];
    ++*judged;
    const std::string of = std::string(what) + " of bodies " +
                           std::to_string(number.bodies.a.slot) + ' ' +
                           std::to_string(number.bodies.b.slot) + ": ";
    for (const std::string& line : judge_one(number)) finding(of + line);
  }
}

void NumberChecker::JudgeConvex(const std::vector<WorldPose>& poses, const SceneStep& found,
                                const Report& finding) {
  exact::ProximityJudgeOptions options;
  options.all_faces = false;
  const auto lines = [](const std::vector<exact::Finding>& findings) {
    std::vector<std::string> text;
    for (const exact::Finding& each : findings) {
      text.push_back(std::string(exact::ToString(each.kind)) + ": " + each.detail);
    }
    return text;
  };
  const auto judge_with = [&](auto judge) {
    return [&, judge](const auto& number) {
      const Parts parts = PartsOf(poses, number);
      return lines(
          judge(bodies_.Get(parts.p.convex()), bodies_.Get(parts.q.convex()), parts, number));
    };
  };
  JudgeSome("distance", found.distances, kConvexAStep, &judged_.distances, finding,
            judge_with([&](const auto& p, const auto& q, const Parts& parts, const auto& number) {
              return exact::JudgeDistance(p, q, parts.pose, number.result, options);
            }));
  JudgeSome("depth", found.depths, kConvexAStep, &judged_.depths, finding,
            judge_with([&](const auto& p, const auto& q, const Parts& parts, const auto& number) {
              return exact::JudgePenetration(p, q, parts.pose, number.result, options);
            }));
  // Which of the travels wanted a result answers is not said: it must stand for one of them.
  JudgeSome("travel", found.travels, kConvexAStep, &judged_.travels, finding,
            judge_with([&](const auto& p, const auto& q, const Parts& parts, const auto& number) {
              std::vector<exact::Finding> findings;
              for (const auto& travel :
                   WantedOf(std::get<0>(parts.key), std::get<1>(parts.key)).travels) {
                if (!travel) continue;
                findings = exact::JudgeDirection(p, q, parts.pose, InFrame(parts.frame, *travel),
                                                 number.result, options);
                if (findings.empty()) break;
              }
              return findings;
            }));
}

void NumberChecker::JudgeMeshes(const std::vector<WorldPose>& poses, const SceneStep& found,
                                const Report& finding) {
  JudgeSome("distance", found.mesh_distances, kMeshesAStep, &judged_.distances, finding,
            [&](const auto& number) {
              const Parts parts = PartsOf(poses, number);
              const SurfaceDistanceResult& r = number.result;
              return exact::JudgeSurfaceDistance(
                  parts.p.mesh(), parts.q.mesh(), parts.pose,
                  {r.lower_bound, r.upper_bound, r.face_a, r.face_b});
            });
  JudgeSome("depth", found.mesh_depths, kMeshesAStep, &judged_.depths, finding,
            [&](const auto& number) {
              const Parts parts = PartsOf(poses, number);
              return JudgedMeshDepth(parts.p.mesh(), parts.q.mesh(), parts.pose, number.result, 12);
            });
  JudgeSome("continuous depth", found.continuous_depths, kMeshesAStep, &judged_.continuous_depths,
            finding, [&](const auto& number) {
              const Parts parts = PartsOf(poses, number);
              return JudgedContinuousDepth(parts.p.mesh(), parts.q.mesh(), parts.pose,
                                           number.result);
            });
  JudgeSome("travel", found.mesh_travels, kMeshesAStep, &judged_.travels, finding,
            [&](const auto& number) {
              const Parts parts = PartsOf(poses, number);
              const SurfaceTravelResult& r = number.result;
              std::vector<std::string> findings;
              for (const auto& travel :
                   WantedOf(std::get<0>(parts.key), std::get<1>(parts.key)).travels) {
                if (!travel) continue;
                findings = exact::JudgeSurfaceTravel(
                    parts.p.mesh(), parts.q.mesh(), parts.pose,
                    {InFrame(parts.frame, *travel), travel->reach, r.is_hit, r.lower_bound,
                     r.upper_bound, r.face_a, r.face_b});
                if (findings.empty()) break;
              }
              return findings;
            });
}

void NumberChecker::Judge(const std::vector<WorldPose>& poses, const SceneStep& found,
                          const Report& finding) {
  JudgeConvex(poses, found, finding);
  JudgeMeshes(poses, found, finding);
  ++turn_;
}

}  // namespace touchstone
