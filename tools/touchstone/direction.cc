// SPDX-License-Identifier: MIT
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "touchstone/tools/numbers.h"
#include "touchstone/tools/touchstone/proximity_output.h"
#include "touchstone/tools/touchstone/subcommands.h"

namespace touchstone {
namespace {

struct Arguments : BodyArguments {
  std::vector<std::string> along;
  bool published = false;
};

Eigen::Vector3d ParseDirection(const std::vector<std::string>& words) {
  Eigen::Vector3d s = Eigen::Vector3d::Zero();
  if (words.size() != 3) {
    throw BadInput{"--along: takes 3 numbers, not " + std::to_string(words.size())};
  }
  for (int k = 0; k < 3; ++k) {
    const auto number = ParseDouble(words[k]);
    if (!number) throw BadInput{"--along: '" + words[k] + "' is not a number"};
    s[k] = *number;
  }
  return s;
}

int RunDirection(const Arguments& arguments) {
  const PlacedPair pair = LoadPair(arguments);
  const Eigen::Vector3d s = ParseDirection(arguments.along);
  const Certainty certainty = ParseCertainty(arguments.certainty);
  // Once to check the direction, and to warm the caches, so that the time shown is the search's.
  const auto first = DirectionalDistance(pair.p, pair.q, pair.pose, s, {certainty});
  if (!first.ok()) throw BadInput{"--along: " + first.status().ToString()};
  const auto depth = ProximityDepthForOneQuery(pair, certainty);
  ExactBodies bodies;
  const auto query = AskDirection(pair, s, certainty,
                                  arguments.judge ? ProximityDepth(depth) : std::nullopt, bodies);
  std::optional<Judged<PublishedTravel>> published;
  if (arguments.published) published = AskPublishedDirection(pair, s, query.result);
  if (arguments.json) {
    Json json = DescribeQuery(arguments, pair, depth, query);
    json["along"] = ToJson(s);
    if (published) {
      json["published"] = ToJson(published->result);
      json["published"]["findings"] = ToJson(published->findings);
      json["published"]["query_ns"] = published->query_ns;
    }
    std::cout << json.dump(2) << '\n';
  } else {
    PrintQuery(arguments, pair, depth, query);
    if (published) {
      PrintResult(std::cout, published->result);
      for (const NamedFinding& finding : published->findings)
        std::cout << "not so           " << finding.kind << ": " << finding.detail << '\n';
    }
  }
  return query.findings.empty() ? kFine : kFindings;
}

}  // namespace

void AddDirection(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "direction", "When do two convex bodies meet, the second moved along a direction?");
  const auto arguments = std::make_shared<Arguments>();
  AddBodyArguments(command, arguments.get());
  command
      ->add_option("--along", arguments->along,
                   "the direction s, 3 numbers in P's frame; travels are t of Q + t s")
      ->expected(1, -1)
      ->required();
  command->add_flag("--published", arguments->published,
                    "also the paper's own construction, held against the answer");
  command->callback([arguments, &exit_code] { exit_code = RunDirection(*arguments); });
}

}  // namespace touchstone
