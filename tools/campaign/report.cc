// SPDX-License-Identifier: MIT
#include "touchstone/tools/campaign/report.h"

#include <algorithm>
#include <ostream>
#include <set>

#include "touchstone/tools/campaign/reachable.h"
#include "touchstone/tools/engines/registry.h"
#include "touchstone/tools/table.h"

namespace touchstone {
namespace {

std::uint64_t At(const Tally& tally, const std::string& engine, std::string_view key) {
  const auto found = tally.find(engine + '\t' + std::string(key));
  return found == tally.end() ? 0 : found->second;
}

// The engines that are counted, in the order in which they are registered, others after those.
std::vector<std::string> EnginesOf(const std::vector<std::pair<std::string, Tally>>& by_suite) {
  std::set<std::string> names;
  for (const auto& [suite, tally] : by_suite) {
    for (const auto& [name, count] : tally) names.insert(name.substr(0, name.find('\t')));
  }
  std::vector<std::string> engines;
  for (const EngineDescription& description : AllEngines()) {
    for (const char* form : {"", ":default", ":held"}) {
      if (const auto node = names.extract(description.name + form)) engines.push_back(node.value());
    }
  }
  engines.insert(engines.end(), names.begin(), names.end());
  return engines;
}

bool IsProven(const std::string& engine) {
  return engine == "portal" || engine == "phased" || engine == "portal-float" ||
         engine == "corrupted" || engine == "judge";
}

}  // namespace

CampaignTotals::CampaignTotals(const CampaignStore& store)
    : by_suite_(store.Tallies()), engines_(EnginesOf(by_suite_)) {
  for (const std::string& engine : engines_) {
    for (const auto& [suite, tally] : by_suite_) {
      Row row{engine,
              suite,
              At(tally, engine, keys::kQueries),
              At(tally, engine, keys::kWrong),
              At(tally, engine, keys::kUnresolved),
              At(tally, engine, keys::kFindings)};
      if (row.queries + row.findings > 0) rows_.push_back(std::move(row));
    }
  }
}

std::uint64_t CampaignTotals::Of(const std::string& engine, std::string_view key) const {
  std::uint64_t sum = 0;
  for (const auto& [suite, tally] : by_suite_) sum += At(tally, engine, key);
  return sum;
}

Tally CampaignTotals::WithPrefix(const std::string& engine, std::string_view prefix) const {
  const std::string start = engine + '\t' + std::string(prefix);
  Tally sums;
  for (const auto& [suite, tally] : by_suite_) {
    for (auto it = tally.lower_bound(start); it != tally.end() && it->first.starts_with(start);
         ++it)
      sums[it->first.substr(start.size())] += it->second;
  }
  return sums;
}

std::uint64_t CampaignTotals::ProvenFindings() const {
  std::uint64_t sum = 0;
  for (const std::string& engine : engines_) {
    if (IsProven(engine)) sum += Of(engine, keys::kFindings);
  }
  return sum;
}

Json CampaignTotals::ToJson() const {
  Json json = {{"results", Json::array()}, {"engines", Json::array()}};
  std::uint64_t queries = 0, wrong = 0, unresolved = 0, findings = 0;
  for (const Row& row : rows_) {
    json["results"].push_back({{"engine", row.engine},
                               {"suite", row.suite},
                               {"queries", row.queries},
                               {"wrong", row.wrong},
                               {"unresolved", row.unresolved},
                               {"findings", row.findings}});
    queries += row.queries;
    wrong += row.wrong;
    unresolved += row.unresolved;
    findings += row.findings;
  }
  for (const std::string& engine : engines_) {
    Json object = {{"engine", engine}, {"counts", Json::object()}};
    for (const auto& [key, count] : WithPrefix(engine, "")) object["counts"][key] = count;
    json["engines"].push_back(std::move(object));
  }
  json["total"] = {{"queries", queries},
                   {"wrong", wrong},
                   {"unresolved", unresolved},
                   {"findings", findings},
                   {"proven_findings", ProvenFindings()}};
  json["targets"] = Json::array();
  for (const CampaignTarget& target : FindTargets(*this)) {
    json["targets"].push_back({{"target", target.name},
                               {"have", target.have},
                               {"needed", target.needed},
                               {"met", target.met}});
  }
  return json;
}

void CampaignTotals::Print(std::ostream& out) const {
  Table table;
  table.Row({"engine", "suite", "queries", "wrong", "unresolved", "findings"});
  const auto add = [&](const std::string& engine, const std::string& suite, std::uint64_t queries,
                       std::uint64_t wrong, std::uint64_t unresolved, std::uint64_t findings) {
    table.Row({engine, suite, std::to_string(queries), std::to_string(wrong),
               std::to_string(unresolved), std::to_string(findings)});
  };
  for (const Row& row : rows_)
    add(row.engine, row.suite, row.queries, row.wrong, row.unresolved, row.findings);
  for (const std::string& engine : engines_) {
    add(engine, "all", Of(engine, keys::kQueries), Of(engine, keys::kWrong),
        Of(engine, keys::kUnresolved), Of(engine, keys::kFindings));
  }
  table.Print(out);
  for (const std::string& engine : engines_) {
    for (const auto& [kind, count] : WithPrefix(engine, keys::kFinding))
      out << engine << ": " << kind << ' ' << count << '\n';
  }
}

std::vector<CampaignTarget> FindTargets(const CampaignTotals& totals) {
  const auto of = [&](std::string_view key) {
    return totals.Of("portal", key) + totals.Of("phased", key);
  };
  const std::uint64_t queries = of(keys::kQueries);
  std::vector<CampaignTarget> targets;
  const auto at_least = [&](const char* name, std::uint64_t have, std::uint64_t needed) {
    targets.push_back({name, have, needed, have >= needed});
  };
  const auto none = [&](const char* name, std::uint64_t have) {
    targets.push_back({name, have, 0, have == 0});
  };
  at_least("judged queries", queries, 100'000'000);
  at_least("of them with n >= 100 (a tenth)", of("n >= 100"), (queries + 9) / 10);
  at_least("of them with n >= 1000 (a hundredth)", of("n >= 1000"), (queries + 99) / 100);
  at_least("gap below 1e-12 of the size, no touch", of("gap < 1e-12"), 1'000'000);
  at_least("exact touches", of("exact touch"), 1'000'000);
  at_least("phase maxima checked", of("phase maxima checked"), 1'000'000);
  at_least("M built whole", of("constructed"), 100'000);
  std::uint64_t reachable = 0, short_of = 0, unlisted = 0;
  for (const char* engine : {"portal", "phased"}) {
    const CoverageGaps gaps = FindCoverageGaps(totals, engine, kCoverageFloor);
    reachable += ReachableCombinations(engine).size();
    short_of += gaps.too_few.size();
    unlisted += gaps.unlisted.size();
  }
  at_least("reachable combinations met 1000 times", reachable - short_of, reachable);
  none("combinations not listed as reachable", unlisted);
  none("wrong verdicts", of(keys::kWrong));
  none("unresolved", of(keys::kUnresolved));
  none("findings", of(keys::kFindings));
  return targets;
}

void PrintTargets(const std::vector<CampaignTarget>& targets, std::ostream& out) {
  Table table;
  table.Row({"proven searches together", "have", "needed", ""});
  for (const CampaignTarget& target : targets) {
    table.Row({target.name, std::to_string(target.have), std::to_string(target.needed),
               target.met ? "met" : "not met"});
  }
  table.Print(out);
}

CoverageGaps FindCoverageGaps(const CampaignTotals& totals, const std::string& engine,
                              std::uint64_t floor) {
  CoverageGaps gaps;
  const std::vector<std::string>& reachable = ReachableCombinations(engine);
  if (reachable.empty()) return gaps;
  const Tally hit = totals.WithPrefix(engine, keys::kCoverage);
  for (const std::string& combination : reachable) {
    const auto found = hit.find(combination);
    const std::uint64_t count = found == hit.end() ? 0 : found->second;
    if (count < floor) gaps.too_few.emplace_back(combination, count);
  }
  for (const auto& [combination, count] : hit) {
    if (std::find(reachable.begin(), reachable.end(), combination) == reachable.end())
      gaps.unlisted.emplace_back(combination, count);
  }
  return gaps;
}

}  // namespace touchstone
