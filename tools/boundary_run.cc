// SPDX-License-Identifier: MIT
#include "touchstone/tools/boundary_run.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "touchstone/core/minkowski/boundary.h"
#include "touchstone/exact/judge_minkowski.h"
#include "touchstone/exact/self_intersection.h"
#include "touchstone/tools/shapes/shapes.h"
#include "touchstone/tools/suites/random.h"

namespace touchstone {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t kSamples = 20;
constexpr std::array<int, 3> kFaceCounts = {12, 20, 32};
constexpr std::size_t kMostFacetsToEnumerate = 120;

double LargestCoordinate(const Shape& shape) {
  double largest = 0.0;
  for (const Vector3d& x : shape.vertices) largest = std::max(largest, x.cwiseAbs().maxCoeff());
  return largest;
}

bool IsSound(const Shape& shape) {
  const StatusOr<TriangleMesh> mesh = TriangleMesh::Build(shape.vertices, shape.faces);
  return mesh.ok() && !exact::FindSelfIntersection(*mesh);
}

// Coordinates rounded to multiples of `grid`, where that leaves a closed surface that crosses
// itself nowhere; else as they are.
Shape Snapped(const Shape& shape, double grid) {
  Shape snapped = shape;
  for (Vector3d& x : snapped.vertices) {
    for (int i = 0; i < 3; ++i) x[i] = grid * std::round(x[i] / grid);
  }
  return IsSound(snapped) ? snapped : shape;
}

struct Case {
  std::string name;
  Shape a, b;
  BoundaryTurn turn;
  Matrix3d rotation;
  Vector3d translation;
  bool is_of_size_one;
};

Shape RandomBody(const std::string& name, Random* random) {
  Shape shape = NamedShape(name, random->Pick(kFaceCounts));
  if (random->OneIn(3)) shape = Snapped(shape, random->OneIn(2) ? 0x1p-4 : 0x1p-10);
  if (random->OneIn(6)) {
    const Vector3d away = 2.5 * LargestCoordinate(shape) * Vector3d::UnitX();
    shape = Together(shape, Moved(shape, 1.0, away));
  }
  return shape;
}

// All lengths times a power of two, up to either end of what a body may have.
void Rescale(Random* random, Case* own) {
  const double of_a = LargestCoordinate(own->a), of_b = LargestCoordinate(own->b);
  const double least = std::exp2(std::ceil(std::log2(1e-100 / std::min(of_a, of_b))));
  const double greatest =
      std::exp2(std::floor(std::log2(1e100 / std::max({of_a, of_b, own->translation.norm()}))));
  const std::array<double, 5> scales = {1.0, 0x1p-20, 0x1p20, least, greatest};
  const double scale = random->OneIn(2) ? random->Pick(scales) : 1.0;
  own->a = Moved(own->a, scale, Vector3d::Zero());
  own->b = Moved(own->b, scale, Vector3d::Zero());
  own->translation *= scale;
  own->is_of_size_one = scale == 1.0;
}

Case MakeCase(std::uint64_t seed, std::uint64_t index) {
  const auto names = ShapeNames();
  Random random("boundary", seed, index);
  const std::string& name_a = names[index / names.size() % names.size()];
  const std::string& name_b = names[index % names.size()];
  Case own{"case " + std::to_string(index) + ", " + name_a + " and " + name_b,
           RandomBody(name_a, &random),
           RandomBody(name_b, &random),
           static_cast<BoundaryTurn>(random.Below(kBoundaryTurnCount)),
           random.AxisRotation(),
           Vector3d::Zero(),
           true};
  if (random.OneIn(6)) {
    const Shape speck = Moved(own.b, random.OneIn(2) ? 0.125 : 0x1p-10, {0.25, 0.25, 0.25});
    if (IsSound(speck)) own.b = speck;
  }
  if (own.turn == BoundaryTurn::kNearly) {
    const double angle = std::pow(10.0, -random.Integer(3, 15));
    const Vector3d axis =
        random.OneIn(2) ? random.SpherePoint() : Vector3d(Vector3d::Unit(random.Integer(0, 2)));
    own.rotation = Eigen::AngleAxisd(angle, axis).toRotationMatrix() * own.rotation;
  } else if (own.turn == BoundaryTurn::kAnyhow) {
    own.rotation = random.Rotation();
  }
  if (random.OneIn(2)) {
    for (int i = 0; i < 3; ++i) own.translation[i] = 0.25 * random.Integer(-12, 12);
  }
  Rescale(&random, &own);
  return own;
}

SumBoundary Build(const TriangleMesh& a, const TriangleMesh& b, const RelativePose& pose) {
  return BuildSumBoundary(MeshPair(a, b, pose), GaussMap(a), GaussMap(b));
}

// What a linear map leaves as it is.
std::vector<std::size_t> CountsOf(const SumBoundary& sum) {
  std::vector<std::size_t> counts = {sum.facets.size(), sum.vertices.size(), sum.triangles.size(),
                                     sum.sheets.size(), sum.segments.size(), sum.points.size()};
  std::vector<std::size_t> characteristics;
  for (const SumComponent& component : sum.components) {
    characteristics.push_back(static_cast<std::size_t>(component.euler_characteristic() + 1000));
  }
  std::sort(characteristics.begin(), characteristics.end());
  counts.insert(counts.end(), characteristics.begin(), characteristics.end());
  return counts;
}

// What is wrong, one line each.
std::vector<std::string> FindingsOf(const Case& own, BoundaryStats* stats) {
  const TriangleMesh a = MustBuild(own.a), b = MustBuild(own.b);
  const WorldPose of_a{Matrix3d::Identity(), Vector3d::Zero()};
  const WorldPose of_b{own.rotation, own.translation};
  const RelativePose pose = *RelativePose::FromWorld(of_a, of_b);
  const SumBoundary sum = Build(a, b, pose);
  const std::vector<std::size_t> counts = CountsOf(sum);
  std::vector<std::string> texts;
  exact::SumJudgeOptions options{.samples = 5, .lines = 2};
  // Turned by a rounded rotation, fractions are long.
  options.enumerate =
      own.turn == BoundaryTurn::kAligned && sum.facets.size() <= kMostFacetsToEnumerate;
  for (const exact::SumFinding& finding : exact::JudgeMinkowski(a, b, pose, sum, options)) {
    texts.push_back(std::string(ToString(finding.kind)) + ": " + finding.detail);
  }
  if (CountsOf(Build(b, a, *RelativePose::FromWorld(of_b, of_a))) != counts) {
    texts.emplace_back("the bodies swapped have another surface");
  }
  const Vector3d shift(1.5, -2.25, 3.0);  // sums with multiples of a quarter are exact
  if (own.is_of_size_one &&
      CountsOf(Build(a, b,
                     *RelativePose::FromWorld({Matrix3d::Identity(), shift},
                                              {own.rotation, own.translation + shift}))) !=
          counts) {
    texts.emplace_back("both bodies moved have another surface");
  }
  ++stats->cases;
  stats->triangles += sum.triangles.size();
  stats->components += sum.components.size();
  stats->with_thin_parts += !sum.sheets.empty() || !sum.segments.empty() || !sum.points.empty();
  stats->enumerated += options.enumerate;
  return texts;
}

}  // namespace

std::string_view ToString(BoundaryTurn turn) {
  switch (turn) {
    case BoundaryTurn::kAligned:
      return "aligned";
    case BoundaryTurn::kNearly:
      return "nearly aligned";
    case BoundaryTurn::kAnyhow:
      return "anyhow";
  }
  return "?";
}

std::array<BoundaryStats, kBoundaryTurnCount> RunBoundaryCases(
    const BoundaryRunOptions& options,
    const std::function<void(std::uint64_t, std::uint64_t)>& report) {
  std::array<BoundaryStats, kBoundaryTurnCount> stats;
  std::uint64_t findings = 0;
  for (std::uint64_t i = 0; i < options.count; ++i) {
    const Case own = MakeCase(options.seed, options.first + i);
    BoundaryStats& of_turn = stats[static_cast<int>(own.turn)];
    for (const std::string& text : FindingsOf(own, &of_turn)) {
      ++of_turn.findings;
      ++findings;
      if (of_turn.samples.size() < kSamples) of_turn.samples.push_back(own.name + ": " + text);
    }
    if (report) report(i + 1, findings);
  }
  return stats;
}

}  // namespace touchstone
