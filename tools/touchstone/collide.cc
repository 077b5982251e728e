// SPDX-License-Identifier: MIT
#include <array>
#include <iostream>
#include <memory>
#include <vector>

#include "touchstone/tools/judged_query.h"
#include "touchstone/tools/mesh_arguments.h"
#include "touchstone/tools/mesh_io.h"
#include "touchstone/tools/numbers.h"
#include "touchstone/tools/result_json.h"
#include "touchstone/tools/touchstone/subcommands.h"

namespace touchstone {
namespace {

struct Arguments {
  std::string p, q;
  std::vector<std::string> pose;
  std::string search = "portal";
  std::string certainty = "exact";
  bool early_exit = false, common_point = false, judge = false, hull = false, trace = false,
       json = false;
};

ConvexPolyhedron Load(const std::string& path, bool hull) {
  Loaded<ConvexPolyhedron> body = ReadBody(path, hull);
  if (!body.ok()) throw BadInput{body.error()};
  return *body;
}

void PrintJudgement(const Arguments& arguments, const JudgedQuery& query, bool constructed) {
  if (!arguments.judge) return;
  if (query.findings.empty()) {
    std::cout << "judge            no findings" << (constructed ? "; M was built whole, too" : "")
              << '\n';
  }
  for (const NamedFinding& finding : query.findings)
    std::cout << "judge            " << finding.kind << ": " << finding.detail << '\n';
  for (const NamedFinding& finding : query.rounding_findings) {
    std::cout << "judge            in doubles only: " << finding.kind << ": " << finding.detail
              << '\n';
  }
}

int RunCollide(const Arguments& arguments) {
  const PlacedPair pair{Load(arguments.p, arguments.hull), Load(arguments.q, arguments.hull),
                        ParsePose(arguments.pose)};
  const CollideOptions options{.search = ParseSearch(arguments.search),
                               .certainty = ParseCertainty(arguments.certainty),
                               .early_exit = arguments.early_exit,
                               .common_point = arguments.common_point,
                               .trace = arguments.trace};
  const JudgeDepth depth = DepthForOneQuery(pair);
  ExactBodies bodies;
  JudgedQuery query =
      Ask(pair, options);  // warms the caches, so that the time shown is the search's
  query = arguments.judge ? AskAndJudge(pair, options, depth, bodies) : Ask(pair, options);

  if (arguments.json) {
    Json json = {{"p",
                  {{"file", arguments.p},
                   {"vertices", pair.p.vertex_count()},
                   {"faces", pair.p.face_count()}}},
                 {"q",
                  {{"file", arguments.q},
                   {"vertices", pair.q.vertex_count()},
                   {"faces", pair.q.face_count()}}},
                 {"search", arguments.search},
                 {"certainty", arguments.certainty},
                 {"early_exit", arguments.early_exit}};
    json.update(ToJson(query.result));
    json["search_ns"] = query.search_ns;
    if (arguments.judge) {
      json["judge"] = {{"findings", ToJson(query.findings)},
                       {"rounding_findings", ToJson(query.rounding_findings)},
                       {"constructed", depth.construct},
                       {"judge_ns", query.judge_ns}};
    }
    std::cout << json.dump(2) << '\n';
  } else {
    std::cout << "P                " << arguments.p << ": " << pair.p.vertex_count()
              << " vertices, " << pair.p.face_count() << " faces\n"
              << "Q                " << arguments.q << ": " << pair.q.vertex_count()
              << " vertices, " << pair.q.face_count() << " faces\n"
              << "search           " << arguments.search << ", " << arguments.certainty << '\n';
    PrintResult(std::cout, query.result);
    PrintJudgement(arguments, query, depth.construct);
    std::cout << "time             " << ShortDouble(query.search_ns) << " ns";
    if (arguments.judge) std::cout << ", judge " << ShortDouble(query.judge_ns) << " ns";
    std::cout << '\n';
  }
  return query.findings.empty() ? kFine : kFindings;
}

}  // namespace

void AddCollide(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("collide", "Do two convex bodies meet? Prints the verdict and its proof");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("P", arguments->p, "mesh file of P: OFF, OBJ, STL or PLY")->required();
  command->add_option("Q", arguments->q, "mesh file of Q")->required();
  command
      ->add_option("--pose", arguments->pose,
                   "Q's placement relative to P: 12 numbers, row-major 3x4 [R | t]")
      ->expected(1, -1);
  command->add_option("--search", arguments->search, "published, phased or portal")
      ->capture_default_str();
  command->add_option("--certainty", arguments->certainty, "float or exact")->capture_default_str();
  command->add_flag("--common-point", arguments->common_point,
                    "Name a point of both bodies where they touch or overlap");
  command->add_flag("--early-exit", arguments->early_exit,
                    "stop as soon as the verdict is certain");
  command->add_flag("--judge", arguments->judge, "check every part of the answer exactly");
  command->add_flag("--hull", arguments->hull, "take the convex hulls of the meshes");
  command->add_flag("--trace", arguments->trace, "print the faces visited, by phase");
  command->add_flag("--json", arguments->json, "print JSON");
  command->callback([arguments, &exit_code] { exit_code = RunCollide(*arguments); });
}

}  // namespace touchstone
