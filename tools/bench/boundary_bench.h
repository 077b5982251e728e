// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_BENCH_BOUNDARY_BENCH_H_
#define TOUCHSTONE_TOOLS_BENCH_BOUNDARY_BENCH_H_

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace touchstone {

// The whole boundary of one scene, B turned at random. Times are of the processor.
struct BoundaryRow {
  std::string scene;
  int faces_a = 0, faces_b = 0;
  long facets = 0, crossings = 0, cells = 0, memberships = 0, exact_signs = 0;  // of the last turn
  long triangles = 0, components = 0;
  double mean_facets = 0.0;  // of all turns
  // Of the turns, each the least of its repeats; Gauss maps included.
  double median_seconds = 0.0;
};

struct BoundaryBenchOptions {
  int rotations = 5;
  // How often each rotation is timed. What else the machine does adds to a time and never takes
  // from it, so the least is the best. Scenes and rotations take turns.
  int repeats = 1;
  std::uint64_t seed = 1;
};

// The paper's four scenes.
std::vector<BoundaryRow> TimePaperScenes(const BoundaryBenchOptions& options);
// Torus against torus, by the faces of each.
std::vector<BoundaryRow> TimeGrowth(std::span<const int> sizes,
                                    const BoundaryBenchOptions& options);
// The least squares slope of log time against log facets, and its standard error.
struct GrowthFit {
  double exponent = 0.0, error = 0.0;
};
GrowthFit FitGrowth(std::span<const BoundaryRow> rows);

// The greatest memory in use, in bytes, of a process of its own that builds the boundary of two
// tori of so many faces: program, libraries and meshes included. Nothing if it failed. Ask before
// this process has used much itself: a child counts what it was born with.
std::optional<double> PeakMemoryOfTori(int faces);

// One pair built by Nef polyhedra, too, in a process of its own that is ended at the limit.
struct NefRow {
  std::string pair;
  int faces_a = 0, faces_b = 0;
  double seconds = 0.0;  // ours
  std::optional<double> nef_seconds{};
  // Same facets, neighbours, Euler characteristics and slots; every vertex within its rounding of
  // the exact one.
  bool is_same = false;
};
enum class NefPairs {
  kFew,
  kMany,
  kAll,  // every two shapes, of few faces, the fewest first: an hour or more
};
// From the pair numbered `first` on.
std::vector<NefRow> CompareWithNef(NefPairs which, int first, double limit_seconds,
                                   std::uint64_t seed,
                                   const std::function<void(const NefRow&)>& report = {});

// Membership of translations anywhere in the box of M, cold but for memory.
struct MembershipRow {
  std::string pair;
  int faces_a = 0, faces_b = 0;
  double mean_us = 0.0, median_us = 0.0, p99_us = 0.0;
  long queries = 0, undecided = 0;  // by doubles alone
};
// Scenes, and the closed meshes of a folder against themselves, if one is given.
std::vector<MembershipRow> TimeMembership(const std::string& meshes, int queries,
                                          std::uint64_t seed);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_BENCH_BOUNDARY_BENCH_H_
