// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/membership.h"

#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "touchstone/exact/mesh_membership.h"
#include "touchstone/tools/mesh_arguments.h"
#include "touchstone/tools/numbers.h"
#include "touchstone/tools/result_json.h"
#include "touchstone/tools/touchstone/subcommands.h"
#include "touchstone/tools/words.h"

namespace touchstone {
namespace {

struct Arguments {
  std::string a, b;
  std::vector<std::string> pose, at;
  std::string certainty = "exact";
  bool judge = false, json = false;
};

Eigen::Vector3d ParsePoint(const std::vector<std::string>& words) {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3 && !words.empty(); ++i) {
    const auto number = ParseDouble(words[i]);
    if (!number || !std::isfinite(*number)) {
      throw BadInput{"--at: '" + words[i] + "' is not a finite number"};
    }
    x[i] = *number;
  }
  return x;
}

int RunMembership(const Arguments& arguments) {
  const TriangleMesh a = LoadMesh(arguments.a), b = LoadMesh(arguments.b);
  const RelativePose pose = ParsePose(arguments.pose);
  const Eigen::Vector3d x = ParsePoint(arguments.at);
  const MembershipOptions options{ParseCertainty(arguments.certainty)};
  const MeshPair pair(a, b, pose);
  MembershipCache cache;
  Membership(pair, x, options, &cache);  // warms the memory; then cold but for that
  cache.crossing = {};
  const auto begin = std::chrono::steady_clock::now();
  const MembershipResult result = Membership(pair, x, options, &cache);
  const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - begin;

  Verdict exact = result.verdict;
  if (arguments.judge) {
    exact = exact::MeshMembership(exact::PlacedMeshPair(a, b, pose), exact::ExactTranslation(x));
  }
  const bool is_wrong = result.verdict != Verdict::kUndecided && result.verdict != exact;
  if (arguments.json) {
    Json json = {{"a", arguments.a},
                 {"b", arguments.b},
                 {"at", {x[0], x[1], x[2]}},
                 {"answer", ToString(result.verdict)},
                 {"tier", ToString(result.tier)},
                 {"microseconds", time.count()},
                 {"box_tests", result.box_tests},
                 {"triangle_tests", result.triangle_tests},
                 {"exact_tests", result.exact_tests}};
    if (result.face_a >= 0) json["faces"] = {result.face_a, result.face_b};
    if (arguments.judge) json["judge"] = {{"answer", ToString(exact)}, {"agrees", !is_wrong}};
    std::cout << json.dump(2) << '\n';
  } else {
    std::cout << "answer           " << ToString(result.verdict) << '\n'
              << "tier             " << ToString(result.tier) << '\n'
              << "microseconds     " << ShortDouble(time.count()) << '\n'
              << "tests            " << result.box_tests << " of nodes, " << result.triangle_tests
              << " of triangles, " << result.exact_tests << " exact\n";
    if (result.face_a >= 0) {
      std::cout << "faces            " << result.face_a << " of A, " << result.face_b << " of B\n";
    }
    if (arguments.judge) {
      std::cout << "judge            " << ToString(exact) << (is_wrong ? ": wrong" : "") << '\n';
    }
  }
  return is_wrong ? kFindings : kFine;
}

}  // namespace

void AddMembership(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "membership", "Do the interiors of two closed meshes meet when B is moved by x?");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("A", arguments->a, kMeshHelp)->required();
  command->add_option("B", arguments->b, "the other, the same way")->required();
  command->add_option("--at", arguments->at, "the translation x of B, in A's frame: 3 numbers")
      ->expected(3)
      ->required();
  command
      ->add_option("--pose", arguments->pose,
                   "B's placement before that: 12 numbers, row-major 3x4 [R | t]")
      ->expected(1, -1);
  command->add_option("--certainty", arguments->certainty, "float or exact")->capture_default_str();
  command->add_flag("--judge", arguments->judge, "decide it by the exact half, too");
  command->add_flag("--json", arguments->json, "print JSON");
  command->callback([arguments, &exit_code] { exit_code = RunMembership(*arguments); });
}

}  // namespace touchstone
