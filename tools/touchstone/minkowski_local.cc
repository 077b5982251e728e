// SPDX-License-Identifier: MIT
#include "touchstone/tools/touchstone/minkowski_local.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <memory>
#include <numbers>

#include "touchstone/core/minkowski/local_sum.h"
#include "touchstone/tools/bench/minkowski_bench.h"
#include "touchstone/tools/mesh_arguments.h"
#include "touchstone/tools/numbers.h"
#include "touchstone/tools/result_json.h"
#include "touchstone/tools/touchstone/subcommands.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

// That --judge tries in the ball, a frame.
constexpr int kJudgedSegments = 20;

double ParseNumber(const std::string& option, const std::string& word) {
  const auto number = ParseDouble(word);
  if (!number || !std::isfinite(*number)) {
    throw BadInput{option + ": '" + word + "' is not a finite number"};
  }
  return *number;
}

Vector3d ParseVector(const std::string& option, const std::vector<std::string>& words,
                     const Vector3d& otherwise) {
  if (words.empty()) return otherwise;
  Vector3d x;
  for (int i = 0; i < 3; ++i) x[i] = ParseNumber(option, words[i]);
  return x;
}

// One frame's numbers.
struct FrameRow {
  double milliseconds;
  std::size_t triangles, facets, dropped;
  int cells;
  long added, kept, candidates, gathered, facet_pairs, crossings, patches, memberships, exact_signs;
  bool reused;
};

FrameRow RowOf(const LocalSum& sum, double milliseconds) {
  const long kept = std::count(sum.changes.begin(), sum.changes.end(), FacetChange::kKept);
  return {milliseconds,
          sum.triangles.size(),
          sum.facets.size(),
          sum.dropped.size(),
          sum.cell_count(),
          static_cast<long>(sum.facets.size()) - kept,
          kept,
          sum.candidates,
          sum.gathered,
          sum.facet_pairs,
          sum.crossings,
          sum.patches,
          sum.memberships,
          sum.exact_signs,
          sum.reused};
}

void WriteCsv(const std::string& path, const std::vector<FrameRow>& rows) {
  std::ofstream file(path);
  file << "frame,milliseconds,triangles,cells,facets,new,kept,dropped,candidates,gathered,"
          "facet_pairs,crossings,patches,memberships,exact_signs,reused\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const FrameRow& row = rows[i];
    file << i << ',' << ShortDouble(row.milliseconds) << ',' << row.triangles << ',' << row.cells
         << ',' << row.facets << ',' << row.added << ',' << row.kept << ',' << row.dropped << ','
         << row.candidates << ',' << row.gathered << ',' << row.facet_pairs << ',' << row.crossings
         << ',' << row.patches << ',' << row.memberships << ',' << row.exact_signs << ','
         << (row.reused ? 1 : 0) << '\n';
  }
  file.close();
  if (!file) throw BadInput{"--csv: " + path + " cannot be written"};
}

Json ToJson(const FrameRow& row) {
  return {{"milliseconds", row.milliseconds},
          {"triangles", row.triangles},
          {"cells", row.cells},
          {"facets", row.facets},
          {"new", row.added},
          {"kept", row.kept},
          {"dropped", row.dropped},
          {"candidates", row.candidates},
          {"gathered", row.gathered},
          {"facet_pairs", row.facet_pairs},
          {"crossings", row.crossings},
          {"patches", row.patches},
          {"memberships", row.memberships},
          {"exact_signs", row.exact_signs},
          {"reused", row.reused}};
}

double MedianMs(const std::vector<FrameRow>& rows) {
  std::vector<double> ms;
  for (const FrameRow& row : rows) ms.push_back(row.milliseconds);
  std::sort(ms.begin(), ms.end());
  return ms[ms.size() / 2];
}

void Print(const LocalSum& sum, const std::vector<FrameRow>& rows) {
  const FrameRow& last = rows.back();
  std::cout << "triangles        " << last.triangles << " in " << last.cells << " cells, "
            << sum.vertices.size() << " vertices, each within " << ShortDouble(sum.rounding) << '\n'
            << "facets           " << last.facets << ": " << last.added << " new, " << last.kept
            << " kept; " << last.dropped << " dropped\n"
            << "thin parts       " << sum.sheets.size() << " triangles, " << sum.segments.size()
            << " segments, " << sum.points.size() << " points\n"
            << "work             " << last.candidates << " candidates, " << last.gathered
            << " facets in the ball, " << last.crossings << " crossings, " << last.memberships
            << " memberships, " << last.exact_signs << " exact signs\n"
            << "milliseconds     " << ShortDouble(last.milliseconds);
  if (rows.size() > 1) {
    std::cout << ", median of " << rows.size() << " frames " << ShortDouble(MedianMs(rows));
  }
  std::cout << '\n';
}

}  // namespace

void AddLocalSumOptions(CLI::App* command, LocalSumArguments* arguments) {
  CLI::Option* ball =
      command
          ->add_option("--ball", arguments->ball,
                       "only what meets this ball of translations: centre x y z, radius")
          ->expected(4);
  const auto add = [&](const std::string& name, auto& value, const std::string& help) {
    return command->add_option(name, value, help)->needs(ball);
  };
  add("--builder", arguments->builder, "full, brute-force, sphere-hierarchy or gap-filling")
      ->capture_default_str();
  add("--frames", arguments->frames, "so many, B moving from one to the next")
      ->capture_default_str();
  add("--turn", arguments->turn, "degrees a frame, about B's origin")->capture_default_str();
  add("--axis", arguments->axis, "of the turn, in A's frame; z unless given")->expected(3);
  add("--travel", arguments->travel, "of B a frame, in A's frame; 0 unless given")->expected(3);
  add("--csv", arguments->csv, "write a line a frame to this file");
}

int RunLocalSum(const LocalSumArguments& arguments, const TriangleMesh& a, const TriangleMesh& b,
                const RelativePose& pose, const std::string& out, bool json) {
  const auto builder = LocalBuilderFromString(arguments.builder);
  if (!builder) {
    throw BadInput{"--builder: '" + arguments.builder +
                   "' is none of full, brute-force, sphere-hierarchy, gap-filling"};
  }
  if (arguments.frames < 1) throw BadInput{"--frames: at least one"};
  const Ball ball{ParseVector("--ball", arguments.ball, Vector3d::Zero()),
                  ParseNumber("--ball", arguments.ball[3])};
  const Vector3d axis = ParseVector("--axis", arguments.axis, Vector3d::UnitZ());
  const Vector3d travel = ParseVector("--travel", arguments.travel, Vector3d::Zero());
  if (!(axis.norm() > 0.0)) throw BadInput{"--axis: of length zero"};
  LocalMinkowskiSum sums(a, b, {*builder});
  std::vector<FrameRow> rows;
  int judged = 0, refuted = 0;
  for (int frame = 0; frame < arguments.frames; ++frame) {
    const double angle = frame * arguments.turn * std::numbers::pi / 180.0;
    const Eigen::Matrix3d turn =
        frame == 0 ? Eigen::Matrix3d(Eigen::Matrix3d::Identity())
                   : Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
    const auto placed =
        RelativePose::Make(turn * pose.rotation(), pose.translation() + frame * travel);
    if (!placed.ok()) throw BadInput{"--frames: " + placed.status().ToString()};
    const auto begin = std::chrono::steady_clock::now();
    const LocalSum& sum = sums.Update(*placed, ball);
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
    if (!sum.status.ok()) throw BadInput{"--ball: " + sum.status.ToString()};
    rows.push_back(RowOf(sum, time.count()));
    if (!arguments.judge) continue;
    judged += kJudgedSegments;
    refuted += CountRefutedSegments(a, b, *placed, ball, sum, kJudgedSegments,
                                    static_cast<std::uint64_t>(frame));
  }
  const LocalSum& sum = sums.sum();
  if (!out.empty() && !WriteOff(out, sum)) throw BadInput{"--out: " + out + " cannot be written"};
  if (!arguments.csv.empty()) WriteCsv(arguments.csv, rows);
  const int exit_code = refuted == 0 ? kFine : kFindings;
  if (!json) {
    Print(sum, rows);
    if (arguments.judge) {
      std::cout << "judge            " << judged << " segments, " << refuted << " refuted\n";
    }
    return exit_code;
  }
  Json result = ToJson(rows.back());
  result["builder"] = ToString(*builder);
  result["ball"] = {ball.center[0], ball.center[1], ball.center[2], ball.radius};
  result["vertices"] = sum.vertices.size();
  result["rounding"] = sum.rounding;
  result["sheets"] = sum.sheets.size();
  result["segments"] = sum.segments.size();
  result["points"] = sum.points.size();
  result["frames"] = arguments.frames;
  result["median_ms"] = MedianMs(rows);
  if (arguments.judge) result["judge"] = {{"segments", judged}, {"refuted", refuted}};
  std::cout << result.dump(2) << '\n';
  return exit_code;
}

}  // namespace touchstone
