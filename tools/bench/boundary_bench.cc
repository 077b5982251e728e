// SPDX-License-Identifier: MIT
#include "touchstone/tools/bench/boundary_bench.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

#include "touchstone/core/mesh/membership.h"
#include "touchstone/core/minkowski/boundary.h"
#include "touchstone/exact/judge_minkowski.h"
#include "touchstone/exact/nef_mesh_sum.h"
#include "touchstone/tools/bench/times.h"
#include "touchstone/tools/mesh_io.h"
#include "touchstone/tools/shapes/paper_scenes.h"
#include "touchstone/tools/shapes/shapes.h"
#include "touchstone/tools/suites/random.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

// One scene at the same rotations time and again.
class TimedScene {
 public:
  TimedScene(const std::string& name, const Shape& a, const Shape& b,
             const BoundaryBenchOptions& options)
      : a_(MustBuild(a)), b_(MustBuild(b)), row_{name, a_.face_count(), b_.face_count()} {
    Random random("boundary_bench", options.seed, 0);
    for (int turn = 0; turn < options.rotations; ++turn) {
      poses_.push_back(*RelativePose::Make(random.Rotation(), Vector3d::Zero()));
    }
    least_.assign(poses_.size(), std::numeric_limits<double>::infinity());
  }

  void Time(int turn) {
    const double begin = ProcessorSeconds();
    const SumBoundary boundary =
        BuildSumBoundary(MeshPair(a_, b_, poses_[turn]), GaussMap(a_), GaussMap(b_));
    const double seconds = ProcessorSeconds() - begin;
    row_.facets = std::ssize(boundary.facets);
    row_.crossings = boundary.crossings;
    row_.cells = boundary.cells;
    row_.memberships = boundary.memberships;
    row_.exact_signs = boundary.exact_signs;
    row_.triangles = std::ssize(boundary.triangles);
    row_.components = std::ssize(boundary.components);
    if (least_[turn] == std::numeric_limits<double>::infinity()) {
      row_.mean_facets += static_cast<double>(row_.facets) / static_cast<double>(poses_.size());
    }
    least_[turn] = std::min(least_[turn], seconds);
  }

  BoundaryRow Row() const {
    BoundaryRow row = row_;
    row.median_seconds = Quantile(least_, 0.5);
    return row;
  }

 private:
  TriangleMesh a_, b_;
  BoundaryRow row_;
  std::vector<RelativePose> poses_;
  std::vector<double> least_;  // seconds, by turn
};

std::vector<BoundaryRow> TimeInTurns(std::vector<TimedScene> scenes,
                                     const BoundaryBenchOptions& options) {
  for (int repeat = 0; repeat < options.repeats; ++repeat) {
    for (int turn = 0; turn < options.rotations; ++turn) {
      for (TimedScene& scene : scenes) scene.Time(turn);
    }
  }
  std::vector<BoundaryRow> rows;
  for (const TimedScene& scene : scenes) rows.push_back(scene.Row());
  return rows;
}

// What a child tells its parent.
struct NefReport {
  double seconds;
  bool is_same;
};

std::optional<NefReport> RunNefInChild(const TriangleMesh& a, const TriangleMesh& b,
                                       const RelativePose& pose, const SumBoundary& boundary,
                                       double limit_seconds) {
  int ends[2];
  if (pipe(ends) != 0) return std::nullopt;
  const pid_t child = fork();
  if (child == 0) {
    alarm(static_cast<unsigned>(std::ceil(20.0 * limit_seconds)));
    const double begin = ProcessorSeconds();
    rlimit before{};
    getrlimit(RLIMIT_CPU, &before);
    const rlimit limit{static_cast<rlim_t>(std::ceil(limit_seconds)) + 1, before.rlim_max};
    setrlimit(RLIMIT_CPU, &limit);
    exact::MakeNefMeshSum(exact::PlacedMeshPair(a, b, pose));
    NefReport report{ProcessorSeconds() - begin, false};
    setrlimit(RLIMIT_CPU, &before);
    report.is_same =
        exact::JudgeMinkowski(a, b, pose, boundary, {.samples = 0, .lines = 0, .construct = true})
            .empty();
    const bool is_told = write(ends[1], &report, sizeof report) == sizeof report;
    _exit(is_told ? 0 : 1);
  }
  close(ends[1]);
  NefReport report;
  const bool is_told = child > 0 && read(ends[0], &report, sizeof report) == sizeof report;
  close(ends[0]);
  if (child > 0) waitpid(child, nullptr, 0);
  return is_told ? std::optional(report) : std::nullopt;
}

struct NefPair {
  std::string a, b;
  int faces_a, faces_b;
};

// Every two shapes, a shape with itself included, those with the least product of faces first.
std::vector<NefPair> AllNefPairs() {
  const std::vector<std::pair<std::string, int>> small = {
      {"box", 0},     {"key", 0},    {"l", 0},     {"u", 0},      {"slot", 0},   {"pocket", 0},
      {"hollow", 0},  {"axes", 0},   {"star", 0},  {"cone", 16},  {"torus", 32}, {"tori", 48},
      {"dimpled", 0}, {"spiked", 0}, {"fish", 48}, {"spoon", 48}, {"cup", 64},   {"gear", 96}};
  std::vector<std::pair<long, NefPair>> sized;
  for (std::size_t i = 0; i < small.size(); ++i) {
    for (std::size_t j = i; j < small.size(); ++j) {
      const auto& [a, faces_a] = small[i];
      const auto& [b, faces_b] = small[j];
      const auto count = [](const std::string& name, int faces) {
        return static_cast<long>(NamedShape(name, faces).faces.size());
      };
      sized.push_back({count(a, faces_a) * count(b, faces_b), {a, b, faces_a, faces_b}});
    }
  }
  std::stable_sort(sized.begin(), sized.end(),
                   [](const auto& x, const auto& y) { return x.first < y.first; });
  std::vector<NefPair> pairs;
  for (const auto& [product, pair] : sized) pairs.push_back(pair);
  return pairs;
}

std::vector<NefPair> ListNefPairs(NefPairs which) {
  if (which == NefPairs::kAll) return AllNefPairs();
  std::vector<NefPair> pairs = {{"box", "box", 0, 0}, {"u", "key", 0, 0}, {"hollow", "box", 0, 0}};
  if (which == NefPairs::kFew) return pairs;
  const std::vector<NefPair> more = {
      {"pocket", "key", 0, 0},   {"slot", "key", 0, 0},       {"l", "u", 0, 0},
      {"axes", "box", 0, 0},     {"axes", "axes", 0, 0},      {"star", "box", 0, 0},
      {"star", "u", 0, 0},       {"cone", "box", 24, 0},      {"cone", "axes", 24, 0},
      {"dimpled", "box", 0, 0},  {"dimpled", "spiked", 0, 0}, {"torus", "box", 48, 0},
      {"torus", "torus", 32, 32}};
  pairs.insert(pairs.end(), more.begin(), more.end());
  return pairs;
}

std::optional<TriangleMesh> ReadClosedMesh(const std::string& path) {
  const Loaded<PolygonSoup> soup = ReadPolygonSoup(path);
  if (!soup.ok() || !soup->IsClosed()) return std::nullopt;
  Shape shape;
  shape.vertices = soup->points;
  for (const std::vector<int>& loop : soup->polygons) {
    for (std::size_t k = 2; k < loop.size(); ++k) {
      shape.AddTriangle(loop[0], loop[k - 1], loop[k]);
    }
  }
  StatusOr<TriangleMesh> mesh = TriangleMesh::Build(shape.vertices, shape.faces);
  return mesh.ok() ? std::optional(*mesh) : std::nullopt;
}

MembershipRow TimePair(const std::string& name, const TriangleMesh& a, const TriangleMesh& b,
                       int queries, std::uint64_t seed) {
  constexpr int kRotations = 10;
  MembershipRow row{name, a.face_count(), b.face_count()};
  Random random("membership_bench", seed, 0);
  MembershipCache cache;
  std::vector<double> times;
  double sum = 0.0;
  for (int turn = 0; turn < kRotations; ++turn) {
    const MeshPair pair(a, b, *RelativePose::Make(random.Rotation(), Vector3d::Zero()));
    const double scale = 1.0 / pair.scale();
    Vector3d low = Vector3d::Constant(1e300), high = -low, low_b = low, high_b = high;
    for (const Vector3d& x : pair.a().points) low = low.cwiseMin(x), high = high.cwiseMax(x);
    for (const Vector3d& x : pair.b().points)
      low_b = low_b.cwiseMin(x), high_b = high_b.cwiseMax(x);
    Membership(pair, Vector3d(Vector3d::Zero()), {}, &cache);  // the memory
    for (int q = 0; q < queries / kRotations; ++q) {
      Vector3d x;
      for (int i = 0; i < 3; ++i) {
        x[i] = scale * random.Uniform(low[i] - high_b[i], high[i] - low_b[i]);
      }
      cache.crossing = {};
      const auto begin = std::chrono::steady_clock::now();
      const MembershipResult result = Membership(pair, x, {Certainty::kFloat}, &cache);
      const std::chrono::duration<double, std::micro> time =
          std::chrono::steady_clock::now() - begin;
      times.push_back(time.count());
      sum += time.count();
      row.undecided += result.verdict == Verdict::kUndecided;
    }
  }
  row.queries = std::ssize(times);
  row.mean_us = sum / static_cast<double>(times.size());
  row.median_us = Quantile(times, 0.5);
  row.p99_us = Quantile(times, 0.99);
  return row;
}

}  // namespace

std::vector<BoundaryRow> TimePaperScenes(const BoundaryBenchOptions& options) {
  std::vector<TimedScene> scenes;
  for (const PaperScene& scene : AllPaperScenes()) {
    scenes.emplace_back(scene.name, scene.a, scene.b, options);
  }
  return TimeInTurns(std::move(scenes), options);
}

std::vector<BoundaryRow> TimeGrowth(std::span<const int> sizes,
                                    const BoundaryBenchOptions& options) {
  std::vector<TimedScene> scenes;
  for (const int size : sizes) {
    const Shape torus = NamedShape("torus", size);
    scenes.emplace_back("torus-torus", torus, torus, options);
  }
  return TimeInTurns(std::move(scenes), options);
}

GrowthFit FitGrowth(std::span<const BoundaryRow> rows) {
  double n = 0.0, sum_x = 0.0, sum_y = 0.0, sum_xx = 0.0, sum_xy = 0.0, sum_yy = 0.0;
  for (const BoundaryRow& row : rows) {
    const double x = std::log(row.mean_facets), y = std::log(row.median_seconds);
    n += 1.0, sum_x += x, sum_y += y, sum_xx += x * x, sum_xy += x * y, sum_yy += y * y;
  }
  const double s_xx = sum_xx - sum_x * sum_x / n, s_xy = sum_xy - sum_x * sum_y / n,
               s_yy = sum_yy - sum_y * sum_y / n;
  const double slope = s_xy / s_xx, residue = std::max(0.0, s_yy - slope * s_xy);
  return {slope, n > 2.0 ? std::sqrt(residue / ((n - 2.0) * s_xx)) : 0.0};
}

std::optional<double> PeakMemoryOfTori(int faces) {
  const std::string torus = "shape:torus:" + std::to_string(faces);
  const pid_t child = fork();
  if (child < 0) return std::nullopt;
  if (child == 0) {
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    // Turned by a rational rotation: (1, 2, 2) / 3 and so on are unit vectors.
    execl("/proc/self/exe", "touchstone", "minkowski", torus.c_str(), torus.c_str(), "--pose",
          "0.333333333333333333", "-0.666666666666666667", "0.666666666666666667", "0",
          "0.666666666666666667", "0.666666666666666667", "0.333333333333333333", "0",
          "-0.666666666666666667", "0.333333333333333333", "0.666666666666666667", "0",
          static_cast<char*>(nullptr));
    _exit(127);
  }
  int status = 0;
  rusage usage{};
  if (wait4(child, &status, 0, &usage) != child || status != 0) return std::nullopt;
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

std::vector<NefRow> CompareWithNef(NefPairs which, int first, double limit_seconds,
                                   std::uint64_t seed,
                                   const std::function<void(const NefRow&)>& report) {
  std::vector<NefRow> rows;
  Random random("boundary_nef", seed, 0);
  const std::vector<NefPair> pairs = ListNefPairs(which);
  for (int i = 0; i < std::ssize(pairs); ++i) {
    const NefPair& names = pairs[i];
    const Eigen::Matrix3d turned = random.Rotation();
    if (i < first) continue;
    const TriangleMesh a = MustBuild(NamedShape(names.a, names.faces_a)),
                       b = MustBuild(NamedShape(names.b, names.faces_b));
    for (const bool is_turned : {false, true}) {
      const Eigen::Matrix3d rotation =
          is_turned ? turned : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
      const RelativePose pose = *RelativePose::Make(rotation, Vector3d::Zero());
      NefRow row{names.a + '/' + names.b + (is_turned ? ", turned" : ""), a.face_count(),
                 b.face_count()};
      const double begin = ProcessorSeconds();
      const SumBoundary boundary = BuildSumBoundary(MeshPair(a, b, pose), GaussMap(a), GaussMap(b));
      row.seconds = ProcessorSeconds() - begin;
      if (const auto told = RunNefInChild(a, b, pose, boundary, limit_seconds)) {
        row.nef_seconds = told->seconds;
        row.is_same = told->is_same;
      }
      if (report) report(row);
      rows.push_back(row);
    }
  }
  return rows;
}

std::vector<MembershipRow> TimeMembership(const std::string& meshes, int queries,
                                          std::uint64_t seed) {
  std::vector<MembershipRow> rows;
  for (const PaperScene& scene : AllPaperScenes()) {
    rows.push_back(TimePair(scene.name, MustBuild(scene.a), MustBuild(scene.b), queries, seed));
  }
  if (meshes.empty()) return rows;
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(meshes)) {
    paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  for (const auto& path : paths) {
    const std::optional<TriangleMesh> mesh = ReadClosedMesh(path);
    if (!mesh || mesh->face_count() < 1000 || mesh->face_count() > 20000) continue;
    rows.push_back(TimePair(path.stem().string(), *mesh, *mesh, queries, seed));
  }
  return rows;
}

}  // namespace touchstone
