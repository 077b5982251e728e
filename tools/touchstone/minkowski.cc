// SPDX-License-Identifier: MIT
#include <chrono>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "touchstone/core/minkowski/boundary.h"
#include "touchstone/exact/judge_minkowski.h"
#include "touchstone/exact/self_intersection.h"
#include "touchstone/tools/mesh_arguments.h"
#include "touchstone/tools/numbers.h"
#include "touchstone/tools/result_json.h"
#include "touchstone/tools/touchstone/minkowski_local.h"
#include "touchstone/tools/touchstone/subcommands.h"

namespace touchstone {
namespace {

// The judge cuts all facets by each other, and builds the sum by Nef polyhedra, where either takes
// some seconds at most.
constexpr std::size_t kMostFacetsToEnumerate = 250;
constexpr long kMostFacePairsToConstruct = 500;

struct Arguments {
  std::string a, b, out;
  std::vector<std::string> pose;
  LocalSumArguments local;
  bool judge = false, json = false;
};

struct Judgement {
  std::vector<exact::SumFinding> findings;
  exact::SumJudgeOptions options;
  double seconds = 0.0;
};

double SecondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void WriteOff(const std::string& path, const SumBoundary& boundary) {
  std::ofstream file(path);
  file << "OFF\n" << boundary.vertices.size() << ' ' << boundary.triangles.size() << " 0\n";
  for (const Eigen::Vector3d& x : boundary.vertices) {
    file << ShortDouble(x[0]) << ' ' << ShortDouble(x[1]) << ' ' << ShortDouble(x[2]) << '\n';
  }
  for (const auto& [u, v, w] : boundary.triangles) {
    file << "3 " << u << ' ' << v << ' ' << w << '\n';
  }
  file.close();
  if (!file) throw BadInput{"--out: " + path + " cannot be written"};
}

Judgement JudgeIt(const TriangleMesh& a, const TriangleMesh& b, const RelativePose& pose,
                  const SumBoundary& boundary) {
  Judgement judgement;
  judgement.options.enumerate = boundary.facets.size() <= kMostFacetsToEnumerate;
  judgement.options.construct =
      static_cast<long>(a.face_count()) * b.face_count() <= kMostFacePairsToConstruct;
  const auto begin = std::chrono::steady_clock::now();
  judgement.findings = exact::JudgeMinkowski(a, b, pose, boundary, judgement.options);
  judgement.seconds = SecondsSince(begin);
  return judgement;
}

Json ToJson(const Arguments& arguments, const SumBoundary& boundary, double seconds,
            const Judgement& judgement) {
  Json characteristics = Json::array(), findings = Json::array();
  for (const SumComponent& component : boundary.components) {
    characteristics.push_back(component.euler_characteristic());
  }
  for (const exact::SumFinding& finding : judgement.findings) {
    findings.push_back({{"kind", ToString(finding.kind)}, {"detail", finding.detail}});
  }
  Json json = {{"a", arguments.a},
               {"b", arguments.b},
               {"triangles", boundary.triangles.size()},
               {"components", boundary.components.size()},
               {"seconds", seconds},
               {"findings", findings},
               {"vertices", boundary.vertices.size()},
               {"euler_characteristics", characteristics},
               {"rounding", boundary.rounding},
               {"sheets", boundary.sheets.size()},
               {"segments", boundary.segments.size()},
               {"points", boundary.points.size()},
               {"facets", boundary.facets.size()},
               {"facet_pairs", boundary.facet_pairs},
               {"crossings", boundary.crossings},
               {"cells", boundary.cells},
               {"patches", boundary.patches},
               {"memberships", boundary.memberships},
               {"exact_signs", boundary.exact_signs}};
  if (!arguments.out.empty()) json["out"] = arguments.out;
  if (arguments.judge) {
    json["judge"] = {{"samples", judgement.options.samples},
                     {"lines", judgement.options.lines},
                     {"enumerated", judgement.options.enumerate},
                     {"constructed", judgement.options.construct},
                     {"seconds", judgement.seconds}};
  }
  return json;
}

void Print(const Arguments& arguments, const SumBoundary& boundary, double seconds,
           const Judgement& judgement) {
  std::cout << "triangles        " << boundary.triangles.size() << ", " << boundary.vertices.size()
            << " vertices, each within " << ShortDouble(boundary.rounding) << '\n'
            << "components       " << boundary.components.size() << ", Euler characteristics";
  for (const SumComponent& component : boundary.components) {
    std::cout << ' ' << component.euler_characteristic();
  }
  std::cout << "\nthin parts       " << boundary.sheets.size() << " triangles, "
            << boundary.segments.size() << " segments, " << boundary.points.size() << " points\n"
            << "work             " << boundary.facets.size() << " facets, " << boundary.crossings
            << " crossings, " << boundary.cells << " cells, " << boundary.memberships
            << " memberships, " << boundary.exact_signs << " exact signs\n"
            << "seconds          " << ShortDouble(seconds) << '\n';
  if (!arguments.judge) return;
  std::cout << "judge            " << judgement.findings.size() << " findings in "
            << ShortDouble(judgement.seconds) << " s"
            << (judgement.options.enumerate ? ", every cell" : "")
            << (judgement.options.construct ? ", by Nef polyhedra, too" : "") << '\n';
  for (const exact::SumFinding& finding : judgement.findings) {
    std::cout << "                 " << ToString(finding.kind) << ": " << finding.detail << '\n';
  }
}

// Loads a mesh; throws BadInput if two of its faces meet that do not hang together.
TriangleMesh LoadEmbedded(const std::string& word) {
  TriangleMesh mesh = LoadMesh(word);
  if (const auto faces = exact::FindSelfIntersection(mesh)) {
    throw BadInput{word + ": faces " + std::to_string(faces->first) + " and " +
                   std::to_string(faces->second) + " meet"};
  }
  return mesh;
}

int RunMinkowski(const Arguments& arguments) {
  const TriangleMesh a = LoadEmbedded(arguments.a), b = LoadEmbedded(arguments.b);
  const RelativePose pose = ParsePose(arguments.pose);
  if (!arguments.local.ball.empty()) {
    LocalSumArguments local = arguments.local;
    local.judge = arguments.judge;
    return RunLocalSum(local, a, b, pose, arguments.out, arguments.json);
  }
  const auto begin = std::chrono::steady_clock::now();
  const SumBoundary boundary = BuildSumBoundary(MeshPair(a, b, pose), GaussMap(a), GaussMap(b));
  const double seconds = SecondsSince(begin);
  if (!arguments.out.empty()) WriteOff(arguments.out, boundary);
  Judgement judgement;
  if (arguments.judge) judgement = JudgeIt(a, b, pose, boundary);
  if (arguments.json) {
    std::cout << ToJson(arguments, boundary, seconds, judgement).dump(2) << '\n';
  } else {
    Print(arguments, boundary, seconds, judgement);
  }
  return judgement.findings.empty() ? kFine : kFindings;
}

}  // namespace

void AddMinkowski(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "minkowski", "The whole boundary of the Minkowski difference of two closed meshes");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("A", arguments->a, kMeshHelp)->required();
  command->add_option("B", arguments->b, "the other, the same way")->required();
  command->add_option("--pose", arguments->pose, "B's placement: 12 numbers, row-major 3x4 [R | t]")
      ->expected(1, -1);
  command->add_option("--out", arguments->out, "write the surface to this OFF file");
  AddLocalSumOptions(command, &arguments->local);
  command->add_flag("--judge", arguments->judge, "check the whole result exactly");
  command->add_flag("--json", arguments->json, "print JSON");
  command->callback([arguments, &exit_code] { exit_code = RunMinkowski(*arguments); });
}

}  // namespace touchstone
