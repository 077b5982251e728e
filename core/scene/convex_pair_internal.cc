// SPDX-License-Identifier: MIT
#include "touchstone/core/scene/convex_pair_internal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "touchstone/core/cd_dual/cd_dual.h"
#include "touchstone/core/cd_dual/exact_portal.h"
#include "touchstone/core/cd_dual/signs.h"
#include "touchstone/core/proximity/distance.h"

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

constexpr double kUnit = 0x1p-52;      // of rounding, in any mode
constexpr double kUp = 1.0 + 0x1p-46;  // more than a handful of roundings in a row
constexpr double kDown = 1.0 - 0x1p-46;
constexpr double kStretch = 1.0 + 1.6e-6;  // R stretches by sqrt(1 + 3e-6) at most, and shrinks
constexpr double kShrink = 1.0 - 1.6e-6;   // by no more

// Within these sizes products of four lengths neither overflow nor sink below the rounding of the
// largest; beyond them the margins that need such products are not taken.
constexpr double kLeastSize = 0x1p-200, kLargestSize = 0x1p200;

double MaxAbs(const Vector3d& v) { return v.cwiseAbs().maxCoeff(); }

// dt = tq - tp is off by a unit of itself. A coordinate of R a takes three products, each passing
// three roundings, of together at most 1.75 max|a|: below 7.2 u max|a|. The two differences that
// make (R a - R' b) - dt of them add a unit each of sums of at most 1.75 (max|a| + max|b|) + |dt|.
// Together below 16 u (max|a| + max|b| + |dt|).
double CoordinateError(const PlacedPart& p, const PlacedPart& q, const Vector3d& dt) {
  return 16.0 * kUnit * (p.part->max_coordinate() + q.part->max_coordinate() + MaxAbs(dt));
}

bool HasFairSize(const PlacedPart& p, const PlacedPart& q, const Vector3d& dt) {
  const double least = std::min(p.part->max_coordinate(), q.part->max_coordinate());
  const double largest = std::max({p.part->max_coordinate(), q.part->max_coordinate(), MaxAbs(dt)});
  return least > kLeastSize && largest < kLargestSize;
}

// The vertex of a body that is furthest along `direction` (its own frame, off by at most 8 u in
// each coordinate, of length about one), up to `slack`: no point of the body is further by more.
struct Highest {
  Vector3d point;
  double slack;
};

// A corner that no neighbour beats, where the climb's lanes prove it. Else the best of all
// vertices: a computed height is off by 3.01 u |d|_1 max|v| and by 8 u |v|_1 of the direction,
// below 31 u max|v|; two of them are compared.
Highest FindHighest(const ConvexPolyhedron& body, const Vector3d& direction, int* corner) {
  const SupportTable& table = body.support_table();
  if (*corner < 0 || *corner >= table.corner_count()) {
    *corner = table.Look(direction[0], direction[1], direction[2]);
  }
  int steps = 0;
  const SupportTable::Peak peak = table.Climb(*corner, direction, &steps);
  *corner = peak.corner;
  const SupportTable::Corner& found = table.corner(peak.corner);
  Highest highest{Vector3d(found.x, found.y, found.z), 0.0};
  if (peak.certain) return highest;
  double height = direction.dot(highest.point);
  for (const Vector3d& v : body.vertices()) {
    const double h = direction.dot(v);
    if (h > height) {
      height = h;
      highest.point = v;
    }
  }
  highest.slack = 62.0 * kUnit * body.max_coordinate();
  return highest;
}

// How far apart P and Q are at least along n, of length one up to rounding; not positive: nothing
// is proven. (R^T n is off by 3.01 u |n|_1 < 8 u in each coordinate.)
double GapAlong(const PlacedPart& p, const PlacedPart& q, const Vector3d& n, CornerPair* support) {
  const Highest a = FindHighest(p.part->convex(), p.pose->rotation.transpose() * n, &support->p);
  const Highest b = FindHighest(q.part->convex(), -(q.pose->rotation.transpose() * n), &support->q);
  const Vector3d dt = q.pose->translation - p.pose->translation;
  const Vector3d difference = dt + (q.pose->rotation * b.point - p.pose->rotation * a.point);
  // |n|_1 < 2; the dot product adds 3.01 u of its terms.
  const double error = 2.0 * (CoordinateError(p, q, dt) + 4.0 * kUnit * MaxAbs(difference));
  return kDown * (n.dot(difference) - kUp * (error + a.slack + b.slack));
}

// How far o is at least inside the plane of a, b, c, counterclockwise from outside; not positive:
// nothing is proven. The points are taken exactly. Edges are off by a unit of themselves, so a
// coordinate of their cross product by less than 10 u |e||f| (largest coordinates), and N.a by that
// along a and 3.1 u of its terms.
double HeightInside(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d e = b - a, f = c - a, normal = e.cross(f);
  const double normal_error = 10.0 * kUnit * MaxAbs(e) * MaxAbs(f);
  const double error = normal_error * a.lpNorm<1>() + 4.0 * kUnit * normal.lpNorm<1>() * MaxAbs(a);
  // A flat triangle proves nothing: no height is divided by no area.
  const double height = normal.dot(a) - kUp * error;
  return height > 0.0 ? kDown * height / (kUp * (normal.norm() + 2.0 * normal_error)) : 0.0;
}

// The point a - b of M from corners of both, or c from interior points.
Vector3d PointOfM(const PlacedPart& p, const PlacedPart& q, const Vector3d& a, const Vector3d& b,
                  const Vector3d& dt) {
  return (p.pose->rotation * a - q.pose->rotation * b) - dt;
}

Vector3d CornerPoint(const ConvexPolyhedron& body, int corner) {
  const SupportTable::Corner& found = body.support_table().corner(corner);
  return {found.x, found.y, found.z};
}

bool HasCorners(const PlacedPart& p, const PlacedPart& q, CornerPair pair) {
  return pair.p >= 0 && pair.p < p.part->convex().support_table().corner_count() && pair.q >= 0 &&
         pair.q < q.part->convex().support_table().corner_count();
}

// Takes n, of any length, as the direction that separates, if it can be proven to.
bool KeepDirection(const PlacedPart& p, const PlacedPart& q, const Vector3d& n, PairState* state,
                   Margin* margin) {
  const double length = n.norm();
  if (!(length > 0.0) || !std::isfinite(length)) return false;
  const Vector3d direction = n / length;
  CornerPair support{-1, -1};
  const double gap = GapAlong(p, q, direction, &support);
  if (!(gap > margin->value)) return false;
  state->has_direction = true;
  state->direction = direction;
  state->support = support;
  *margin = {Verdict::kSeparate, gap};
  return true;
}

// A direction found for verdicts is far from the best. Where the bodies are further apart than it
// shows, the closest points' direction is worth what it costs: the pair sleeps the longer.
void ImproveDirection(const PlacedPart& p, const PlacedPart& q, const RelativePose& pose,
                      PairState* state, Margin* margin) {
  const DistanceResult distance =
      Distance(p.part->convex(), q.part->convex(), pose, {.certainty = Certainty::kFloat});
  if (distance.kind != DistanceKind::kSeparate) return;
  KeepDirection(p, q, p.pose->rotation * distance.direction, state, margin);
}

// Balls that are hardly apart hold bodies that are further apart: along the last direction, or from
// middle to middle.
void StretchMargin(const PlacedPart& p, const PlacedPart& q, const SceneRules& rules,
                   PairState* state, Margin* margin) {
  if (rules.guesses && state->has_direction) {
    const Margin found = MarginByDirection(p, q, state);
    if (found.value > margin->value) {
      *margin = found;
      return;
    }
  }
  const Vector3d between =
      (q.pose->translation - p.pose->translation) + (q.turned_middle - p.turned_middle);
  KeepDirection(p, q, between, state, margin);
}

// The same for a pair that is looked at often, since its margins are short: now and again, and the
// more seldom where it did not pay.
void ImproveInTurn(const PlacedPart& p, const PlacedPart& q, PairState* state, Margin* margin,
                   SceneCounters* counters) {
  constexpr std::uint8_t kLooksBetween = 8;
  if (state->patience > 0) {
    --state->patience;
    return;
  }
  ++counters->improved;
  const double before = margin->value;
  const auto pose = RelativePose::FromWorld(*p.pose, *q.pose);
  assert(pose.ok());  // kMaxWorldTranslation
  ImproveDirection(p, q, *pose, state, margin);
  if (margin->value < 2.0 * before) state->patience = kLooksBetween;
}

Verdict DecideByExactSigns(const PlacedPart& p, const PlacedPart& q, const RelativePose& pose) {
  MinkowskiDifference m(p.part->convex(), q.part->convex(), pose);
  ChooseInteriorDifference(&m);
  Signs signs(m, Certainty::kExact);
  PhaseCounts counts;
  const ExactExit exit = FindExactExit(&signs, {}, &counts);
  return exit.side_of_origin > 0   ? Verdict::kOverlap
         : exit.side_of_origin < 0 ? Verdict::kSeparate
                                   : Verdict::kTouch;
}

// Asks Collide, and proves anew with a margin what it found.
Margin Ask(const PlacedPart& p, const PlacedPart& q, const SceneRules& rules, double enough,
           PairState* state, SceneCounters* counters) {
  ++counters->queries;
  CollideCache cache;
  if (rules.guesses && state->has_triangle) {
    cache.has_triangle = true;
    std::copy(state->triangle, state->triangle + 3, cache.triangle.begin());
    cache.interior_p = state->interior_p;
    cache.interior_q = state->interior_q;
  }
  state->has_direction = state->has_triangle = false;
  const auto pose = RelativePose::FromWorld(*p.pose, *q.pose);
  assert(pose.ok());  // kMaxWorldTranslation
  if (!rules.doubles_first) {
    ++counters->exact_queries;
    return {DecideByExactSigns(p, q, *pose), 0.0};
  }
  const CollideResult result =
      Collide(p.part->convex(), q.part->convex(), *pose, {.early_exit = true}, &cache);
  if (result.exact_signs > 0) ++counters->exact_queries;
  Margin margin{result.verdict, 0.0};
  if (!rules.margins && !rules.guesses) return margin;
  if (result.verdict == Verdict::kSeparate) {
    if (cache.has_direction) {
      KeepDirection(p, q, p.pose->rotation * cache.direction, state, &margin);
    }
    if (rules.margins && margin.value < enough) {
      ++counters->improved;
      ImproveDirection(p, q, *pose, state, &margin);
    }
  } else if (result.verdict == Verdict::kOverlap && cache.has_triangle) {
    std::copy(cache.triangle.begin(), cache.triangle.end(), state->triangle);
    state->interior_p = static_cast<std::uint8_t>(cache.interior_p & 1);
    state->interior_q = static_cast<std::uint8_t>(cache.interior_q & 1);
    state->has_triangle = true;
    const Margin simplex = MarginBySimplex(p, q, *state);
    if (simplex.verdict == Verdict::kOverlap) {
      margin = simplex;
    } else {
      state->has_triangle = false;
    }
  }
  return margin;
}

}  // namespace

PlacedPart Place(const ScenePart& part, const WorldPose& pose) {
  return {&part, &pose, pose.rotation * part.middle()};
}

Margin MarginByBalls(const PlacedPart& p, const PlacedPart& q) {
  const Vector3d dt = q.pose->translation - p.pose->translation;
  const Vector3d between = dt + (q.turned_middle - p.turned_middle);
  // Off by sqrt(3) coordinate errors and the length's own rounding. Lengths above 1e-150 keep their
  // bits when squared; shorter ones only look shorter, by less than 2^-500.
  const double error = 2.0 * CoordinateError(p, q, dt) + 0x1p-500;
  const double length = between.norm();
  const double outer = kStretch * (p.part->outer_radius() + q.part->outer_radius());
  const double apart = kDown * length - kUp * (outer + error);
  if (apart > 0.0) return {Verdict::kSeparate, kDown * apart};
  const double inner = kShrink * (p.part->inner_radius() + q.part->inner_radius());
  const double within = kDown * inner - kUp * (length + error);
  if (within > 0.0 && p.part->is_convex() && q.part->is_convex()) {
    return {Verdict::kOverlap, kDown * within};
  }
  return {};
}

Margin MarginByDirection(const PlacedPart& p, const PlacedPart& q, PairState* state) {
  const double gap = GapAlong(p, q, state->direction, &state->support);
  if (!(gap > 0.0)) return {};
  return {Verdict::kSeparate, gap};
}

// The tetrahedron of the computed points holds the ball whose radius is the least of the heights
// over o, if all are positive: a closed surface with o strictly inside of all of its planes winds
// around the ball. The exact points are within sqrt(3) coordinate errors of the computed ones, so
// the exact tetrahedron, which is in M, holds the ball that is smaller by that.
Margin MarginBySimplex(const PlacedPart& p, const PlacedPart& q, const PairState& state) {
  const Vector3d dt = q.pose->translation - p.pose->translation;
  if (!HasFairSize(p, q, dt)) return {};
  const ConvexPolyhedron &body_p = p.part->convex(), &body_q = q.part->convex();
  Vector3d v[3];
  for (int k = 0; k < 3; ++k) {
    if (!HasCorners(p, q, state.triangle[k])) return {};
    v[k] = PointOfM(p, q, CornerPoint(body_p, state.triangle[k].p),
                    CornerPoint(body_q, state.triangle[k].q), dt);
  }
  const Vector3d c = PointOfM(p, q, body_p.interior_point(state.interior_p),
                              body_q.interior_point(state.interior_q), dt);
  const double height =
      std::min(std::min(HeightInside(v[0], v[1], v[2]), HeightInside(c, v[1], v[0])),
               std::min(HeightInside(c, v[2], v[1]), HeightInside(c, v[0], v[2])));
  const double margin = height - 2.0 * kUp * CoordinateError(p, q, dt);
  if (!(margin > 0.0)) return {};
  return {Verdict::kOverlap, kDown * margin};
}

Margin DecideConvex(const PlacedPart& p, const PlacedPart& q, const SceneRules& rules,
                    double enough, PairState* state, SceneCounters* counters) {
  if (rules.balls) {
    Margin margin = MarginByBalls(p, q);
    if (margin.verdict != Verdict::kUndecided) {
      ++counters->by_balls;
      if (margin.verdict == Verdict::kSeparate && rules.margins && margin.value < enough) {
        StretchMargin(p, q, rules, state, &margin);
      }
      return margin;
    }
  }
  if (rules.guesses) {
    Margin margin;
    if (state->has_direction) margin = MarginByDirection(p, q, state);
    if (margin.verdict == Verdict::kUndecided && state->has_triangle) {
      margin = MarginBySimplex(p, q, *state);
    }
    if (margin.verdict != Verdict::kUndecided) {
      ++counters->by_guess;
      if (margin.verdict == Verdict::kSeparate && rules.margins && margin.value < enough) {
        ImproveInTurn(p, q, state, &margin, counters);
      }
      return margin;
    }
  }
  return Ask(p, q, rules, enough, state, counters);
}

}  // namespace touchstone::internal
