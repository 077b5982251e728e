// SPDX-License-Identifier: MIT
//
//   paper, section 5   here     meaning
//   l                  gap      signed travel along the line c o from where Q just touches P;
//                               positive: apart. In the bodies' own length, semi-axes 100.
#ifndef TOUCHSTONE_TOOLS_BENCH_WORKLOAD_H_
#define TOUCHSTONE_TOOLS_BENCH_WORKLOAD_H_

#include <cstdint>
#include <string>
#include <vector>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/cd_dual/result.h"
#include "touchstone/core/convex/convex_polyhedron.h"
#include "touchstone/exact/exact_body.h"
#include "touchstone/tools/suites/placement.h"

namespace touchstone {

// P and Q on their line of contact, still to be placed at a gap.
struct BenchLine {
  int p = 0, q = 0;  // indices of bodies
  ContactLine line;
};

struct Workload {
  std::vector<ConvexPolyhedron> bodies;
  std::vector<exact::ExactBody> exact_bodies;  // in step with `bodies`
  std::vector<BenchLine> lines;
};

// The kinds of bodies, by the names used in tables:
//   ellipsoid-A   the hull of n random points on an ellipsoid 100 A : 100 : 100
//   prism, slab   a polygon of n/2 random points of a circle of radius 100, between two parallel
//                 planes 200 or 4 apart: two large facets, n/2 long edges
//   bipyramid     the polygon of n - 2 points between two apexes: two corners with n - 2 edges
//   grid          the hull of the lattice points in a ball, of about n corners: coplanar and
//                 parallel faces everywhere
//   parallel      the prism, standing upright on another that is turned about its axis and moved
//                 along it: a large face on a large face, exactly parallel at any gap
//   mesh          the hulls of real meshes with n/2 to 2 n corners, size 100 (needs a folder)
bool IsBenchShape(const std::string& shape);

// What a generator needs to know; `seed` makes the stream.
struct WorkloadKey {
  std::string shape;
  int n = 0;
  std::uint64_t seed = 1;
  std::string meshes_dir;
};

// Two bodies, P fixed and Q in `orientations` random orientations, each moving along a random line:
// the paper's experiment. Empty where there is no such body (no mesh of that size).
Workload MakeRepeatWorkload(const WorkloadKey& key, int orientations);

// `pairs` different pairs among so many bodies that no cache holds them: in total `vertices`, and
// never fewer than 16 bodies.
Workload MakeMixedWorkload(const WorkloadKey& key, int pairs, int vertices);

// `motions` motions of two bodies, each of `frames` consecutive lines: Q turns about an axis of its
// own by `degrees` a frame while the line of contact stays, so that every frame can be placed at
// the same gap.
Workload MakeWarmWorkload(const WorkloadKey& key, int motions, int frames, double degrees);

// Q's pose on every line at this gap, and the exact verdicts there.
std::vector<RelativePose> PlaceAtGap(const Workload& workload, double gap);
std::vector<Verdict> ExactVerdicts(const Workload& workload,
                                   const std::vector<RelativePose>& poses);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_BENCH_WORKLOAD_H_
