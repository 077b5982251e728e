// SPDX-License-Identifier: MIT
//
// The paper's Table 2 and Figure 12 (Lee, Behar, Lien, Kim 2016): local Minkowski sums by every
// builder, on the four scenes, against the rotation from frame to frame.
#ifndef TOUCHSTONE_TOOLS_BENCH_MINKOWSKI_BENCH_H_
#define TOUCHSTONE_TOOLS_BENCH_MINKOWSKI_BENCH_H_

#include <functional>
#include <string>
#include <vector>

#include "touchstone/core/minkowski/local_sum.h"

namespace touchstone {

struct MinkowskiBenchRow {
  std::string scene;  // "torus-torus"; "torus-torus-depth" with a ball of 0.3 times the depth
  LocalBuilder builder;
  double rotation_deg;  // of A, from a frame to the next
  double median_ms;     // processor time of an update
  int facets;           // of the sum, median
  int mismatches;       // frames in which the result differs from that of the hierarchy
};

struct MinkowskiBenchOptions {
  std::vector<double> rotations_deg = {0.01, 0.1, 1.0, 10.0, 90.0};
  int frames = 60;
  // Of them, so many by brute force, and so many by the whole boundary.
  int brute_force_frames = 10, full_frames = 5;
  std::string figure_folder;  // where the meshes of Figure 12 go; empty: none
  std::function<void(double fraction)> progress;
};

// The ball lies where a fixed ray from the translation zero, which is in M°, leaves M: by bisection
// on membership, which is not timed. Each builder's first frame is not counted.
std::vector<MinkowskiBenchRow> RunMinkowskiBench(const MinkowskiBenchOptions& options);

// Whether two local sums hold the same pieces of the same facets, corners within `tolerance`.
bool AreSameSums(const LocalSum& x, const LocalSum& y, double tolerance);

struct RandomSumsReport {
  int balls = 0, nonempty = 0;
  long triangles = 0;
  int mismatches[4] = {};  // against kFull, by builder
  int misjudged = 0;       // samples, where an exact judge contradicts the result
  long judged = 0;
};
// All builders at random poses and balls of random pairs of small shapes, warm from ball to ball;
// samples off the surface on either side are judged by the exact half.
RandomSumsReport CompareOnRandomBalls(int balls, std::uint64_t seed);

// Of so many segments between random points of the ball, those that the exact half refutes: the
// ends lie on the same side of ∂M iff the segment crosses the sum an even number of times.
int CountRefutedSegments(const TriangleMesh& a, const TriangleMesh& b, const RelativePose& pose,
                         const Ball& ball, const LocalSum& sum, int segments, std::uint64_t seed);

// The surface as an OFF file. False if it cannot be written.
bool WriteOff(const std::string& path, const LocalSum& sum);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_BENCH_MINKOWSKI_BENCH_H_
