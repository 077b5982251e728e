// SPDX-License-Identifier: MIT
#include "touchstone/core/scene/scene.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "touchstone/tools/numbers.h"
#include "touchstone/tools/scene/scene_check.h"
#include "touchstone/tools/scene/scene_file.h"
#include "touchstone/tools/table.h"
#include "touchstone/tools/touchstone/subcommands.h"

namespace touchstone {
namespace {

struct Arguments {
  std::string file, demo, csv, numbers, record, save;
  std::vector<std::string> without;
  int steps = -1;
  bool check = false, json = false, threads = false;
};

SceneOptions ParseOptions(const Arguments& arguments) {
  SceneOptions options;
  options.threads = arguments.threads ? Threads::kAll : Threads::kOne;
  SceneRules& rules = options.rules;
  for (const std::string& rule : arguments.without) {
    if (rule == "broad_phase") {
      rules.broad_phase = BroadPhase::kAllPairs;
    } else if (rule == "tree") {
      rules.broad_phase = BroadPhase::kSweep;
    } else if (rule == "margins") {
      rules.margins = false;
    } else if (rule == "rest") {
      rules.rest = false;
    } else if (rule == "balls") {
      rules.balls = false;
    } else if (rule == "guesses") {
      rules.guesses = false;
    } else if (rule == "lazy_meshes") {
      rules.lazy_meshes = false;
    } else if (rule == "verdict_alone") {
      rules.verdict_alone = false;
    } else if (rule == "doubles_first") {
      rules.doubles_first = false;
    } else if (rule == "all") {
      rules = SceneRules::None();
    } else {
      throw BadInput{"--without: '" + rule +
                     "' is none of broad_phase, tree, margins, rest, balls, guesses, lazy_meshes, "
                     "verdict_alone, doubles_first, all"};
    }
  }
  return options;
}

Json LoadJson(const Arguments& arguments) {
  if (arguments.file.empty() == arguments.demo.empty()) {
    throw BadInput{"scene: give a FILE or --demo NAME"};
  }
  if (!arguments.file.empty()) return ReadSceneJson(arguments.file);
  Json json = MakeDemo(arguments.demo);
  if (json.is_null()) {
    std::string known;
    for (const std::string& name : DemoNames()) known += ' ' + name;
    throw BadInput{"--demo: there is no '" + arguments.demo + "'; known are" + known};
  }
  return json;
}

std::vector<BodyHandle> Fill(const SceneSpec& spec, const std::vector<WorldPose>& poses,
                             const std::string& source, Scene* scene) {
  const auto fail = [&](const std::string& element, const Status& status) {
    throw BadInput{source + ": " + element + ": " + status.ToString()};
  };
  std::vector<BodyHandle> bodies;
  for (std::size_t i = 0; i < spec.bodies.size(); ++i) {
    const SceneBodySpec& body = spec.bodies[i];
    const auto added = scene->Add(body.shape, poses[i], body.subscriptions, body.filter);
    if (!added.ok()) fail("bodies[" + std::to_string(i) + "]", added.status());
    bodies.push_back(*added);
  }
  for (std::size_t k = 0; k < spec.pairs.size(); ++k) {
    const auto& [a, b, wanted] = spec.pairs[k];
    if (const Status s = scene->SubscribePair(bodies[a], bodies[b], wanted); !s.ok()) {
      fail("pairs[" + std::to_string(k) + "]", s);
    }
  }
  for (const auto& [a, b] : spec.ignored) scene->SetIgnored(bodies[a], bodies[b], true);
  return bodies;
}

constexpr const char* kCsvHead =
    "step,ms,bodies_moved,pairs,by_rest,by_margin,looked_at,by_box,by_balls,by_guess,queries,"
    "exact_queries,meshes_apart,meshes_placed,begin,persist,end,distances,depths,travels,"
    "continuous_depths\n";

struct Tally {
  long begin = 0, persist = 0, end = 0;
};

Tally Count(const SceneStep& step) {
  Tally tally;
  for (const SceneEvent& event : step.events) {
    ++(event.kind == EventKind::kBegin ? tally.begin
       : event.kind == EventKind::kEnd ? tally.end
                                       : tally.persist);
  }
  return tally;
}

void WriteCsv(std::ostream& out, int step, double ms, const SceneStep& found) {
  const SceneCounters& c = found.counters;
  const Tally tally = Count(found);
  out << step << ',' << ShortDouble(ms);
  for (const long count : {c.bodies_moved, c.pairs, c.by_rest, c.by_margin, c.looked_at, c.by_box,
                           c.by_balls, c.by_guess, c.queries, c.exact_queries, c.meshes_apart,
                           c.meshes_placed, tally.begin, tally.persist, tally.end}) {
    out << ',' << count;
  }
  out << ',' << found.distances.size() + found.mesh_distances.size() << ','
      << found.depths.size() + found.mesh_depths.size() << ','
      << found.travels.size() + found.mesh_travels.size() << ',' << found.continuous_depths.size()
      << '\n';
}

constexpr const char* kNumbersHead =
    "step,quantity,body_a,part_a,body_b,part_b,value,lower,upper,x,y,z\n";

// A line for each number; x, y, z: the direction of a distance, the translation of a depth, the
// normal of a travel's contact where it is a mesh's; in the frame of the first part.
void WriteNumbers(std::ostream& out, int step, const SceneStep& found) {
  const auto line = [&](const char* quantity, const auto& number, double value, double lower,
                        double upper, const Eigen::Vector3d& v) {
    out << step << ',' << quantity << ',' << number.bodies.a.slot << ',' << number.part_a << ','
        << number.bodies.b.slot << ',' << number.part_b;
    for (const double x : {value, lower, upper, v[0], v[1], v[2]}) out << ',' << ShortDouble(x);
    out << '\n';
  };
  for (const auto& n : found.distances) {
    const DistanceResult& r = n.result;
    line("distance", n, r.distance.value, r.lower, r.upper, r.direction);
  }
  for (const auto& n : found.mesh_distances) {
    const SurfaceDistanceResult& r = n.result;
    line("distance", n, r.distance, r.lower_bound, r.upper_bound, r.direction);
  }
  for (const auto& n : found.depths) {
    const PenetrationResult& r = n.result;
    line("depth", n, r.depth.value, r.lower, r.upper, r.translation);
  }
  for (const auto& n : found.mesh_depths) {
    const MeshDepthResult& r = n.result;
    line("depth", n, r.upper_bound, r.lower_bound, r.upper_bound, r.translation);
  }
  for (const auto& n : found.continuous_depths) {
    const double length = n.result.translation.norm();
    line("continuous_depth", n, length, length, length, n.result.translation);
  }
  for (const auto& n : found.travels) {
    const BoundedValue& t = n.result.enter.travel;
    line("travel", n, t.value, t.value - t.error, t.value + t.error, Eigen::Vector3d::Zero());
  }
  for (const auto& n : found.mesh_travels) {
    const SurfaceTravelResult& r = n.result;
    line("travel", n, r.travel, r.lower_bound, r.upper_bound, r.normal);
  }
}

Json PosesJson(const std::vector<WorldPose>& poses) {
  Json json = Json::array();
  for (const WorldPose& pose : poses) {
    Json numbers = Json::array();
    for (int k = 0; k < 12; ++k) {
      numbers.push_back(k % 4 == 3 ? pose.translation[k / 4] : pose.rotation(k / 4, k % 4));
    }
    json.push_back(std::move(numbers));
  }
  return json;
}

struct Run {
  int steps = 0;
  long replay_mismatches = 0;
  double ms = 0.0;
  Tally tally;
  SceneCounters counters;
  Scene::Memory memory;
};

class Runner {
 public:
  Runner(const Arguments& arguments, Json json)
      : arguments_(arguments),
        source_(arguments.file.empty() ? "demo " + arguments.demo : arguments.file),
        json_(std::move(json)),
        spec_(ParseScene(json_, source_)),
        scene_(ParseOptions(arguments)) {
    if (arguments.steps >= 0) {
      spec_.steps =
          spec_.recorded_poses.empty() ? arguments.steps : std::min(arguments.steps, spec_.steps);
    }
    if (arguments.check) checker_.emplace(spec_);
    Open("--csv", arguments.csv, &csv_);
    Open("--numbers", arguments.numbers, &numbers_);
    Open("--record", arguments.record, &record_);
    if (numbers_.is_open()) numbers_ << kNumbersHead;
  }

  int Go() {
    const bool print_csv = arguments_.csv.empty() && !arguments_.json;
    std::ostream& csv = print_csv ? std::cout : csv_;
    if (print_csv || csv_.is_open()) csv << kCsvHead;
    const std::vector<WorldPose> start = PosesAt(spec_, spec_.recorded_poses.empty() ? 0 : 1);
    const std::vector<BodyHandle> bodies = Fill(spec_, start, source_, &scene_);
    Json poses_record = Json::array(), events_record = Json::array();
    for (int step = 1; step <= spec_.steps; ++step) {
      const std::vector<WorldPose> poses = PosesAt(spec_, step);
      const auto begin = std::chrono::steady_clock::now();
      for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (const Status s = scene_.Move(bodies[i], poses[i]); !s.ok()) {
          throw BadInput{source_ + ": bodies[" + std::to_string(i) + "], step " +
                         std::to_string(step) + ": " + s.ToString()};
        }
      }
      const SceneStep found = scene_.Step();
      const std::chrono::duration<double, std::milli> time =
          std::chrono::steady_clock::now() - begin;
      run_.ms += time.count();
      ++run_.steps;
      const Tally tally = Count(found);
      run_.tally.begin += tally.begin;
      run_.tally.persist += tally.persist;
      run_.tally.end += tally.end;
      run_.counters.Add(found.counters);
      if (print_csv || csv_.is_open()) WriteCsv(csv, step, time.count(), found);
      if (numbers_.is_open()) WriteNumbers(numbers_, step, found);
      Json events = Json::array();
      for (const SceneEvent& event : found.events) events.push_back(Text(event));
      CompareWithRecord(step, events);
      if (checker_) checker_->Check(step, poses, found);
      if (arguments_.record.empty()) continue;
      poses_record.push_back(PosesJson(poses));
      events_record.push_back(std::move(events));
    }
    run_.memory = scene_.memory();
    if (!arguments_.record.empty()) Record(std::move(poses_record), std::move(events_record));
    Report(print_csv ? std::cerr : std::cout);
    const bool bad = run_.replay_mismatches > 0 ||
                     (checker_ && (checker_->mismatches() > 0 || checker_->findings() > 0));
    return bad ? kFindings : kFine;
  }

 private:
  static void Open(const char* option, const std::string& path, std::ofstream* out) {
    if (path.empty()) return;
    out->open(path);
    if (!*out) throw BadInput{std::string(option) + ": " + path + " cannot be written"};
  }

  void CompareWithRecord(int step, const Json& events) {
    if (spec_.recorded_events.empty()) return;
    const std::vector<std::string>& recorded = spec_.recorded_events[step - 1];
    const std::size_t count = std::max(recorded.size(), events.size());
    for (std::size_t k = 0; k < count; ++k) {
      if (k < recorded.size() && k < events.size() && events[k] == recorded[k]) continue;
      ++run_.replay_mismatches;
    }
  }

  void Record(Json poses, Json events) {
    json_["recorded"] = {{"poses", std::move(poses)}, {"events", std::move(events)}};
    record_ << json_.dump() << '\n';
    if (!record_) throw BadInput{"--record: " + arguments_.record + " cannot be written"};
  }

  void Report(std::ostream& text) const {
    const SceneCounters& c = run_.counters;
    const long bytes = static_cast<long>(run_.memory.total());
    if (arguments_.json) {
      Json json = {{"scene", source_},
                   {"bodies", spec_.bodies.size()},
                   {"ms_per_step", run_.ms / std::max(1, run_.steps)},
                   {"bytes", bytes},
                   {"begin", run_.tally.begin},
                   {"persist", run_.tally.persist},
                   {"end", run_.tally.end},
                   {"work",
                    {{"pairs_possible", c.pairs_possible},
                     {"pairs", c.pairs},
                     {"by_rest", c.by_rest},
                     {"by_margin", c.by_margin},
                     {"looked_at", c.looked_at},
                     {"by_box", c.by_box},
                     {"by_balls", c.by_balls},
                     {"by_guess", c.by_guess},
                     {"queries", c.queries},
                     {"exact_queries", c.exact_queries},
                     {"meshes_apart", c.meshes_apart},
                     {"meshes_placed", c.meshes_placed},
                     {"mesh_nodes", c.mesh_nodes},
                     {"distances", c.distances},
                     {"depths", c.depths},
                     {"continuous_depths", c.continuous_depths},
                     {"travels", c.travels},
                     {"numbers_kept", c.numbers_kept}}}};
      if (!spec_.recorded_events.empty()) json["replay_mismatches"] = run_.replay_mismatches;
      if (checker_) {
        json["pairs_checked"] = checker_->pairs_checked();
        json["pairs_judged"] = checker_->pairs_judged();
        const JudgedNumbers& judged = checker_->numbers().judged();
        json["numbers_checked"] = checker_->numbers().checked();
        json["numbers_judged"] = {{"distances", judged.distances},
                                  {"depths", judged.depths},
                                  {"continuous_depths", judged.continuous_depths},
                                  {"travels", judged.travels}};
        json["details"] = checker_->details();
      }
      json["steps"] = run_.steps;
      if (checker_) {
        json["mismatches"] = checker_->mismatches();
        json["findings"] = checker_->findings();
      }
      std::cout << json.dump(2) << '\n';
      return;
    }
    Table table;
    table.Row({"scene", source_ + ", " + std::to_string(spec_.bodies.size()) + " bodies, " +
                            std::to_string(run_.steps) + " steps"});
    table.Row({"time", Fixed(run_.ms / std::max(1, run_.steps), 4) + " ms a step"});
    table.Row({"events", std::to_string(run_.tally.begin) + " begin, " +
                             std::to_string(run_.tally.persist) + " persist, " +
                             std::to_string(run_.tally.end) + " end"});
    table.Row({"pairs", std::to_string(c.pairs_possible) + " possible, " + std::to_string(c.pairs) +
                            " near, " + std::to_string(c.looked_at) + " looked at, " +
                            std::to_string(c.queries) + " asked, " +
                            std::to_string(c.exact_queries) + " with big numbers"});
    table.Row({"memory", std::to_string(bytes) + " bytes"});
    if (!spec_.recorded_events.empty()) {
      table.Row({"replay", std::to_string(run_.replay_mismatches) + " events differ"});
    }
    if (checker_) {
      const JudgedNumbers& judged = checker_->numbers().judged();
      table.Row({"check", std::to_string(checker_->pairs_checked()) + " pairs, " +
                              std::to_string(checker_->numbers().checked()) + " numbers, " +
                              std::to_string(checker_->mismatches()) + " mismatches"});
      table.Row({"judge", std::to_string(checker_->pairs_judged()) + " pairs, " +
                              std::to_string(judged.distances) + " distances, " +
                              std::to_string(judged.depths) + " depths, " +
                              std::to_string(judged.continuous_depths) + " continuous depths, " +
                              std::to_string(judged.travels) + " travels, " +
                              std::to_string(checker_->findings()) + " findings"});
    }
    table.Print(text);
    if (!checker_) return;
    for (const std::string& detail : checker_->details()) text << detail << '\n';
  }

  const Arguments& arguments_;
  std::string source_;
  Json json_;
  SceneSpec spec_;
  Scene scene_;
  std::optional<SceneChecker> checker_;
  std::ofstream csv_, numbers_, record_;
  Run run_;
};

int RunSceneCommand(const Arguments& arguments) {
  Json json = LoadJson(arguments);
  if (!arguments.save.empty()) {
    std::ofstream out(arguments.save);
    out << json.dump(2) << '\n';
    if (!out) throw BadInput{"--save: " + arguments.save + " cannot be written"};
  }
  return Runner(arguments, std::move(json)).Go();
}

}  // namespace

void AddScene(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("scene", "Step a scene of many moving bodies");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("FILE", arguments->file, "a scene as JSON (tools/README.md)");
  command->add_option("--demo", arguments->demo,
                      "instead: box-stack, hull-rain, gears, robot-arm or tori");
  command->add_option("--steps", arguments->steps, "instead of the scene's own number")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--csv", arguments->csv, "the table of the steps into this file");
  command->add_option("--numbers", arguments->numbers,
                      "distances, depths and travels of all steps into this file, as CSV");
  command->add_option("--without", arguments->without,
                      "a rule to switch off: broad_phase, tree, margins, rest, balls, guesses, "
                      "lazy_meshes, verdict_alone, doubles_first, all");
  command->add_flag("--threads", arguments->threads, "all threads there are");
  command->add_flag("--check", arguments->check,
                    "compare every step with all pairs of bodies, and with the exact judge");
  command->add_option("--record", arguments->record,
                      "write the scene with all poses and events, to be replayed as FILE");
  command->add_option("--save", arguments->save, "write a demo's scene as a file to begin with");
  command->add_flag("--json", arguments->json, "print JSON instead of the table of the steps");
  command->footer("Exit code 1 for mismatches, findings, or a replay that differs.");
  command->callback([arguments, &exit_code] { exit_code = RunSceneCommand(*arguments); });
}

}  // namespace touchstone
