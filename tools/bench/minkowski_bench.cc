// SPDX-License-Identifier: MIT
#include "touchstone/tools/bench/minkowski_bench.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>

#include "touchstone/core/mesh/membership.h"
#include "touchstone/core/mesh/nearest_on_triangle.h"
#include "touchstone/exact/mesh_membership.h"
#include "touchstone/tools/bench/times.h"
#include "touchstone/tools/numbers.h"
#include "touchstone/tools/shapes/paper_scenes.h"
#include "touchstone/tools/shapes/shapes.h"
#include "touchstone/tools/suites/random.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

constexpr LocalBuilder kBuilders[] = {LocalBuilder::kFull, LocalBuilder::kBruteForce,
                                      LocalBuilder::kSphereHierarchy, LocalBuilder::kGapFilling};
constexpr double kFirstTurnDeg = 30.0;
constexpr double kDepthRatio = 0.3;  // of CPD's ball
// Corners are rounded to 1e-13 of the sum's size or so.
constexpr double kTolerance = 1e-9 * kPaperSumRadius;

// Where the ray from zero leaves M.
Vector3d ExitPoint(const MeshPair& pair) {
  const Vector3d direction(0.36, 0.48, 0.8);
  double low = 0.0, high = 2.1 * kPaperSumRadius;
  for (int i = 0; i < 45; ++i) {
    const double middle = 0.5 * (low + high);
    const Vector3d x = middle * direction;
    (Membership(pair, x).verdict == Verdict::kOverlap ? low : high) = middle;
  }
  return low * direction;
}

std::array<Vector3d, 3> CornersOf(const LocalSum& sum, std::size_t t) {
  const auto& [a, b, c] = sum.triangles[t];
  return {sum.vertices[a], sum.vertices[b], sum.vertices[c]};
}

// A ball of 0.3 times the depth round the boundary's nearest point to zero.
Ball DepthBall(LocalMinkowskiSum* whole, const RelativePose& pose) {
  const LocalSum& sum = whole->Update(pose, {Vector3d::Zero(), 4.0 * kPaperSumRadius});
  Ball ball;
  double depth = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < sum.triangles.size(); ++t) {
    const auto [a, b, c] = CornersOf(sum, t);
    const Vector3d x = NearestOnTriangle(Vector3d::Zero(), a, b, c);
    if (x.norm() < depth) depth = x.norm(), ball.center = x;
  }
  ball.radius = kDepthRatio * depth;
  return ball;
}

struct Timings {
  std::vector<double> ms, facets;
  int mismatches = 0;
};

// One scene with all builders at once, frame by frame.
class SceneBench {
 public:
  SceneBench(const PaperScene& scene, const MinkowskiBenchOptions& options)
      : scene_(scene), options_(options), a_(MustBuild(scene.a)), b_(MustBuild(scene.b)) {}

  void Run(double rotation_deg, bool with_depth_ball, std::vector<MinkowskiBenchRow>* rows) {
    for (int k = 0; k < 4; ++k) {
      sums_[k].emplace(a_, b_, LocalSumOptions{kBuilders[k]});
      timings_[k] = {};
    }
    for (int frame = 0; frame <= options_.frames; ++frame) {
      const RelativePose pose = scene_.PoseAt(scene_.AtTurn(kFirstTurnDeg + rotation_deg * frame));
      if (frame == 0 && with_depth_ball) ball_ = DepthBall(&*sums_[0], pose);
      if (!with_depth_ball) ball_ = {ExitPoint(MeshPair(a_, b_, pose)), kPaperBallRadius};
      RunFrame(frame, pose);
    }
    for (int k = 0; k < 4; ++k) {
      rows->push_back({scene_.name + (with_depth_ball ? "-depth" : ""), kBuilders[k], rotation_deg,
                       Quantile(timings_[k].ms, 0.5),
                       static_cast<int>(Quantile(timings_[k].facets, 0.5)),
                       timings_[k].mismatches});
    }
  }

  void WriteFigure(const std::string& folder) {
    const RelativePose pose = scene_.PoseAt(scene_.AtTurn(kFirstTurnDeg));
    LocalMinkowskiSum whole(a_, b_, {LocalBuilder::kFull}), local(a_, b_);
    const Ball ball{ExitPoint(MeshPair(a_, b_, pose)), kPaperBallRadius};
    WriteOff(folder + '/' + scene_.name + "-full.off",
             whole.Update(pose, {Vector3d::Zero(), 4.0 * kPaperSumRadius}));
    WriteOff(folder + '/' + scene_.name + "-local.off", local.Update(pose, ball));
  }

 private:
  int FramesOf(int k) const {
    return k == 0 ? options_.full_frames : k == 1 ? options_.brute_force_frames : options_.frames;
  }

  void RunFrame(int frame, const RelativePose& pose) {
    Update(2, frame, pose);
    for (const int k : {3, 1, 0}) {
      if (frame > FramesOf(k)) continue;
      Update(k, frame, pose);
      timings_[k].mismatches += !AreSameSums(sums_[2]->sum(), sums_[k]->sum(), kTolerance);
    }
  }

  void Update(int k, int frame, const RelativePose& pose) {
    const double begin = ProcessorMs();
    const LocalSum& sum = sums_[k]->Update(pose, ball_);
    const double ms = ProcessorMs() - begin;
    if (frame == 0) return;
    timings_[k].ms.push_back(ms);
    timings_[k].facets.push_back(static_cast<double>(sum.facets.size()));
  }

  const PaperScene& scene_;
  const MinkowskiBenchOptions& options_;
  const TriangleMesh a_, b_;
  std::array<std::optional<LocalMinkowskiSum>, 4> sums_;
  std::array<Timings, 4> timings_;
  Ball ball_;
};

// A triangle or another piece, to be compared.
struct SumPiece {
  SumFacet facet;
  std::array<Vector3d, 3> corners;
};

std::vector<SumPiece> PiecesOf(const LocalSum& sum) {
  std::vector<SumPiece> pieces;
  for (std::size_t t = 0; t < sum.triangles.size(); ++t) {
    pieces.push_back({sum.facets[sum.facet_of_triangle[t]], CornersOf(sum, t)});
  }
  for (std::size_t t = 0; t < sum.sheets.size(); ++t) {
    const auto& [a, b, c] = sum.sheets[t];
    pieces.push_back(
        {sum.facets[sum.facet_of_sheet[t]], {sum.vertices[a], sum.vertices[b], sum.vertices[c]}});
  }
  for (const auto& [a, b] : sum.segments) {
    pieces.push_back({{}, {sum.vertices[a], sum.vertices[b], sum.vertices[b]}});
  }
  for (const int x : sum.points) {
    pieces.push_back({{}, {sum.vertices[x], sum.vertices[x], sum.vertices[x]}});
  }
  return pieces;
}

bool AreAlike(const SumPiece& x, const SumPiece& y, double tolerance) {
  for (int turn = 0; turn < 3; ++turn) {
    double distance = 0.0;
    for (int k = 0; k < 3; ++k) {
      distance = std::max(distance, (x.corners[k] - y.corners[(k + turn) % 3]).norm());
    }
    if (distance <= tolerance) return true;
  }
  return false;
}

// Whether the segment crosses the triangle, in doubles: random points miss edges.
bool Crosses(const Vector3d& p, const Vector3d& q, const std::array<Vector3d, 3>& t) {
  const auto volume = [](const Vector3d& a, const Vector3d& b, const Vector3d& c,
                         const Vector3d& d) { return (b - a).cross(c - a).dot(d - a); };
  if ((volume(t[0], t[1], t[2], p) > 0) == (volume(t[0], t[1], t[2], q) > 0)) return false;
  const bool side = volume(p, q, t[0], t[1]) > 0;
  return (volume(p, q, t[1], t[2]) > 0) == side && (volume(p, q, t[2], t[0]) > 0) == side;
}

Vector3d PointInBall(const Ball& ball, Random* random) {
  while (true) {
    const Vector3d x(random->Uniform(-1, 1), random->Uniform(-1, 1), random->Uniform(-1, 1));
    if (x.norm() <= 1.0) return ball.center + ball.radius * x;
  }
}

Vector3d RandomDirection(Random* random) {
  while (true) {
    const Vector3d x = PointInBall({Vector3d::Zero(), 1.0}, random);
    if (x.norm() > 0.1) return x.normalized();
  }
}

// Of a segment between two random points of the ball, the ends lie on the same side of ∂M iff it
// crosses the sum an even number of times.
bool IsRefuted(const exact::PlacedMeshPair& judge, const LocalSum& sum, const Ball& ball,
               Random* random) {
  const Vector3d p = PointInBall(ball, random), q = PointInBall(ball, random);
  bool changes = false;
  for (std::size_t t = 0; t < sum.triangles.size(); ++t) {
    changes ^= Crosses(p, q, CornersOf(sum, t));
  }
  const auto is_inside = [&](const Vector3d& x) {
    return exact::MeshMembership(judge, exact::ExactTranslation(x)) == Verdict::kOverlap;
  };
  return changes != (is_inside(p) != is_inside(q));
}

}  // namespace

std::vector<MinkowskiBenchRow> RunMinkowskiBench(const MinkowskiBenchOptions& options) {
  std::vector<MinkowskiBenchRow> rows;
  const std::size_t steps = AllPaperScenes().size() * (options.rotations_deg.size() + 1);
  std::size_t step = 0;
  const auto tell = [&] {
    if (options.progress) options.progress(static_cast<double>(++step) / steps);
  };
  for (const PaperScene& scene : AllPaperScenes()) {
    SceneBench bench(scene, options);
    if (!options.figure_folder.empty()) bench.WriteFigure(options.figure_folder);
    for (const double rotation : options.rotations_deg) {
      bench.Run(rotation, false, &rows);
      tell();
    }
    bench.Run(0.1, true, &rows);
    tell();
  }
  return rows;
}

bool AreSameSums(const LocalSum& x, const LocalSum& y, double tolerance) {
  std::vector<SumPiece> of_x = PiecesOf(x), of_y = PiecesOf(y);
  if (of_x.size() != of_y.size()) return false;
  const auto by_facet = [](const SumPiece& p, const SumPiece& q) { return p.facet < q.facet; };
  std::stable_sort(of_x.begin(), of_x.end(), by_facet);
  std::stable_sort(of_y.begin(), of_y.end(), by_facet);
  // Each of a facet's pieces has its like among the other's of that facet.
  for (std::size_t i = 0; i < of_x.size(); ++i) {
    const auto [first, last] = std::equal_range(of_y.begin(), of_y.end(), of_x[i], by_facet);
    if (std::none_of(first, last,
                     [&](const SumPiece& piece) { return AreAlike(of_x[i], piece, tolerance); })) {
      return false;
    }
  }
  return true;
}

RandomSumsReport CompareOnRandomBalls(int balls, std::uint64_t seed) {
  constexpr int kBallsOfAPair = 50;
  constexpr const char* kNames[] = {"box",   "l",      "u",    "star", "torus", "cone",
                                    "spoon", "hollow", "axes", "fish", "cup",   "dimpled"};
  constexpr int kNameCount = static_cast<int>(std::size(kNames));
  RandomSumsReport report;
  for (int done = 0; done < balls; done += kBallsOfAPair) {
    Random random("local sums", seed, static_cast<std::uint64_t>(done));
    const TriangleMesh a = MustBuild(NamedShape(kNames[random.Integer(0, kNameCount - 1)], 40));
    const TriangleMesh b = MustBuild(NamedShape(kNames[random.Integer(0, kNameCount - 1)], 40));
    const double size = a.max_coordinate() + b.max_coordinate();
    std::array<std::optional<LocalMinkowskiSum>, 4> sums;
    for (int k = 0; k < 4; ++k) sums[k].emplace(a, b, LocalSumOptions{kBuilders[k]});
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Ball ball;
    for (int i = 0; i < kBallsOfAPair && done + i < balls; ++i) {
      // A new place now and then, small steps between.
      const bool is_jump = i % 5 == 0;
      const double step = is_jump ? 3.0 : std::pow(10.0, random.Uniform(-6.0, -1.0));
      const Vector3d axis = RandomDirection(&random);
      rotation = Eigen::AngleAxisd(step, axis).toRotationMatrix() * rotation;
      if (is_jump) {
        ball = {0.8 * size * random.Unit() * RandomDirection(&random),
                0.4 * size * random.Unit() * random.Unit()};
      } else {
        ball.center += 0.2 * step * size * RandomDirection(&random);
      }
      const auto pose = RelativePose::Make(rotation, Vector3d::Zero());
      if (!pose.ok()) continue;
      ++report.balls;
      for (int k = 0; k < 4; ++k) {
        const LocalSum& sum = sums[k]->Update(*pose, ball);
        if (k > 0) report.mismatches[k] += !AreSameSums(sums[0]->sum(), sum, 1e-9 * size);
      }
      const LocalSum& sum = sums[3]->sum();
      report.nonempty += !sum.triangles.empty();
      report.triangles += static_cast<long>(sum.triangles.size());
      report.misjudged += IsRefuted(exact::PlacedMeshPair(a, b, *pose), sum, ball, &random);
      ++report.judged;
    }
  }
  return report;
}

int CountRefutedSegments(const TriangleMesh& a, const TriangleMesh& b, const RelativePose& pose,
                         const Ball& ball, const LocalSum& sum, int segments, std::uint64_t seed) {
  const exact::PlacedMeshPair judge(a, b, pose);
  Random random("segments", seed, 0);
  int refuted = 0;
  for (int i = 0; i < segments; ++i) refuted += IsRefuted(judge, sum, ball, &random);
  return refuted;
}

bool WriteOff(const std::string& path, const LocalSum& sum) {
  std::ofstream file(path);
  file << "OFF\n" << sum.vertices.size() << ' ' << sum.triangles.size() << " 0\n";
  for (const Vector3d& x : sum.vertices) {
    file << ShortDouble(x[0]) << ' ' << ShortDouble(x[1]) << ' ' << ShortDouble(x[2]) << '\n';
  }
  for (const auto& [u, v, w] : sum.triangles) {
    file << "3 " << u << ' ' << v << ' ' << w << '\n';
  }
  file.close();
  return static_cast<bool>(file);
}

}  // namespace touchstone
