// SPDX-License-Identifier: MIT
#include "touchstone/tools/touchstone/cpd.h"

#include <chrono>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "touchstone/core/mesh/membership.h"
#include "touchstone/tools/cpd_run.h"
#include "touchstone/tools/mesh_arguments.h"
#include "touchstone/tools/numbers.h"
#include "touchstone/tools/result_json.h"
#include "touchstone/tools/table.h"
#include "touchstone/tools/touchstone/subcommands.h"

namespace touchstone {
namespace {

struct Arguments {
  std::string a, b, scene, csv, svg, normals = "angle";
  std::vector<std::string> pose;
  int frames = kPaperFrames;
  bool judge = false, premise = false, json = false;
};

ContinuousDepthOptions OptionsOf(const Arguments& arguments) {
  const auto options = NormalsFromWord(arguments.normals);
  if (options) return *options;
  throw BadInput{"--normals: '" + arguments.normals +
                 "' is none of angle, area, uniform, interpolated, mean"};
}

std::string Words(const Eigen::Vector3d& v) {
  return ShortDouble(v[0]) + " " + ShortDouble(v[1]) + " " + ShortDouble(v[2]);
}

int RunPair(const Arguments& arguments) {
  const TriangleMesh a = LoadMesh(arguments.a), b = LoadMesh(arguments.b);
  const RelativePose pose = ParsePose(arguments.pose);
  const ContactBody body_a(a), body_b(b);
  const MeshPair pair(a, b, pose);
  const auto begin = std::chrono::steady_clock::now();
  const MeshDepthResult depth = MeshPenetrationDepth(pair, body_a, body_b);
  const std::chrono::duration<double, std::milli> depth_time =
      std::chrono::steady_clock::now() - begin;
  ContinuousPenetrationDepth solver(a, b, OptionsOf(arguments));
  const ContinuousDepthResult cpd = solver.Update(pose);
  const ContactSpaceResult contact = ContactSpaceProjection(pair);

  std::vector<std::string> findings;
  if (arguments.judge) {
    findings = JudgedMeshDepth(a, b, pose, depth, 60);
    const auto own = JudgedPhong(a, b, pose, solver, OptionsOf(arguments), cpd, depth.lower_bound);
    findings.insert(findings.end(), own.begin(), own.end());
  }
  if (arguments.json) {
    Json json = {{"a", arguments.a},
                 {"b", arguments.b},
                 {"cpd",
                  {{"status", ToString(cpd.status)},
                   {"translation", ToJson(cpd.translation)},
                   {"magnitude", cpd.translation.norm()},
                   {"direction", ToJson(cpd.direction)},
                   {"residual", cpd.residual},
                   {"point_on_a", ToJson(cpd.point_on_a)},
                   {"point_on_b", ToJson(cpd.point_on_b)},
                   {"iterations", cpd.iterations},
                   {"local_triangles", cpd.local_triangles},
                   {"minkowski_ms", cpd.minkowski_ms},
                   {"phong_ms", cpd.phong_ms},
                   {"total_ms", cpd.total_ms}}},
                 {"depth",
                  {{"status", ToString(depth.status)},
                   {"translation", ToJson(depth.translation)},
                   {"lower", depth.lower_bound},
                   {"upper", depth.upper_bound},
                   {"kind", ToString(depth.kind)},
                   {"pieces", depth.pieces},
                   {"memberships", depth.memberships},
                   {"ms", depth_time.count()}}},
                 {"contact_space",
                  {{"translation", ToJson(contact.translation)},
                   {"magnitude", contact.translation.norm()},
                   {"iterations", contact.iterations}}}};
    if (arguments.judge) json["judge"] = {{"findings", findings}};
    std::cout << json.dump(2) << '\n';
  } else {
    std::cout << "cpd              " << ToString(cpd.status) << ", "
              << ShortDouble(cpd.translation.norm()) << "\n  translation    "
              << Words(cpd.translation) << "\n  residual       " << ShortDouble(cpd.residual)
              << "\n  local sums     " << cpd.iterations << ", " << cpd.local_triangles
              << " triangles in the last\n  ms             " << Fixed(cpd.minkowski_ms, 3)
              << " sum, " << Fixed(cpd.phong_ms, 3) << " projection, " << Fixed(cpd.total_ms, 3)
              << " in all\n"
              << "depth            " << ToString(depth.status) << ", "
              << ShortDouble(depth.lower_bound) << " to " << ShortDouble(depth.upper_bound)
              << "\n  translation    " << Words(depth.translation) << "\n  nearest        "
              << ToString(depth.kind) << "\n  ms             " << Fixed(depth_time.count(), 3)
              << "\ncontact space    " << ShortDouble(contact.translation.norm())
              << ", a local optimum\n";
    if (arguments.judge) {
      std::cout << "judge            " << findings.size() << " findings\n";
      for (const std::string& finding : findings) std::cout << "  " << finding << '\n';
    }
  }
  return findings.empty() ? kFine : kFindings;
}

int RunScene(const Arguments& arguments) {
  const PaperScene* scene = FindPaperScene(arguments.scene);
  if (scene == nullptr) {
    std::string names;
    for (const PaperScene& each : AllPaperScenes()) names += " " + each.name;
    throw BadInput{"--scene: '" + arguments.scene + "' is none of" + names};
  }
  if (arguments.frames < 1) throw BadInput{"--frames: at least one"};
  const std::vector<CpdFrame> frames = RunCpdScene(*scene, arguments.frames, OptionsOf(arguments));
  const auto write = [&](const std::string& path, const auto& print) {
    if (path.empty()) return;
    std::ofstream out(path);
    print(out);
    if (!out) throw BadInput{path + " cannot be written"};
  };
  write(arguments.csv, [&](std::ostream& out) { WriteCpdCsv(frames, out); });
  write(arguments.svg, [&](std::ostream& out) { WriteCpdSvg(scene->name, frames, out); });
  int found = 0, ended = 0, findings = 0;
  std::vector<double> total;
  for (const CpdFrame& frame : frames) {
    found += frame.cpd.status == ContinuousDepthStatus::kFound;
    ended += frame.cpd.branch_ended;
    findings += frame.cpd.status != ContinuousDepthStatus::kSeparate &&
                frame.cpd.translation.norm() < frame.depth.lower_bound * (1.0 - 1e-9);
    if (arguments.judge) {
      const TriangleMesh a = MustBuild(scene->a), b = MustBuild(scene->b);
      findings +=
          static_cast<int>(JudgedMeshDepth(a, b, scene->PoseAt(frame.s), frame.depth, 12).size());
    }
  }
  if (arguments.json) {
    std::cout << Json({{"scene", scene->name},
                       {"frames", frames.size()},
                       {"found", found},
                       {"branches_ended", ended},
                       {"findings", findings}})
                     .dump(2)
              << '\n';
  } else {
    std::cout << "scene            " << scene->name << "\nframes           " << frames.size()
              << "\nfound            " << found << "\nbranches ended   " << ended
              << "\nfindings         " << findings << '\n';
    if (arguments.csv.empty() && arguments.svg.empty()) WriteCpdCsv(frames, std::cout);
  }
  return findings == 0 ? kFine : kFindings;
}

// Theorem 3's premise, by scene.
int RunPremise(const Arguments& arguments) {
  Json json = Json::array();
  Table table;
  table.Row({"scene", "triangles of ∂M", "median angle", "above 10°", "solutions", "median angle",
             "above 10°"});
  for (const PaperScene& scene : AllPaperScenes()) {
    if (!arguments.scene.empty() && scene.name != arguments.scene) continue;
    const PremiseRow row = MeasurePremise(scene, 5, 40);
    json.push_back({{"scene", row.scene},
                    {"triangles", row.triangles},
                    {"median_deg", row.median_deg},
                    {"share_above_10", row.share_above_10},
                    {"solutions", row.solutions},
                    {"solutions_median_deg", row.solutions_median_deg},
                    {"solutions_above_10", row.solutions_above_10}});
    table.Row({row.scene, std::to_string(row.triangles), Fixed(row.median_deg, 1) + "°",
               Fixed(100.0 * row.share_above_10, 1) + " %", std::to_string(row.solutions),
               Fixed(row.solutions_median_deg, 1) + "°",
               Fixed(100.0 * row.solutions_above_10, 1) + " %"});
  }
  if (arguments.json) {
    std::cout << json.dump(2) << '\n';
  } else {
    table.PrintMarkdown(std::cout);
  }
  return kFine;
}

int RunCpd(const Arguments& arguments) {
  if (!arguments.scene.empty() && FindPaperScene(arguments.scene) == nullptr) {
    return RunScene(arguments);  // which names it
  }
  if (arguments.premise) return RunPremise(arguments);
  if (!arguments.scene.empty()) return RunScene(arguments);
  if (arguments.a.empty() || arguments.b.empty()) throw BadInput{"two meshes, or --scene"};
  return RunPair(arguments);
}

}  // namespace

void AddCpd(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "cpd", "Continuous and global penetration depth of two closed meshes, or along a scene");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("A", arguments->a, kMeshHelp);
  command->add_option("B", arguments->b, "the other, the same way");
  command->add_option("--pose", arguments->pose, "B's placement: 12 numbers, row-major 3x4 [R | t]")
      ->expected(1, -1);
  command->add_option("--scene", arguments->scene,
                      "a motion of the paper's: cone-axes, spoon-cup, fish-torus, torus-torus");
  command->add_option("--frames", arguments->frames, "of the motion")->capture_default_str();
  command->add_option("--csv", arguments->csv, "file for magnitudes and directions");
  command->add_option("--svg", arguments->svg, "file for them as a figure");
  command->add_flag("--judge", arguments->judge, "hold the depth against the exact half");
  command
      ->add_option("--normals", arguments->normals,
                   "of the Minkowski boundary, for CPD: weighted by angle, area, or uniform at its "
                   "vertices; interpolated, as the paper's Figure 2a; or mean: over a radius")
      ->capture_default_str();
  command->add_flag("--premise", arguments->premise,
                    "instead: the angles between the normals at triangles' corners, by scene");
  command->add_flag("--json", arguments->json, "print JSON");
  command->callback([arguments, &exit_code] { exit_code = RunCpd(*arguments); });
}

}  // namespace touchstone
