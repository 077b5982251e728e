// SPDX-License-Identifier: MIT
#include "touchstone/tools/proximity_report.h"

#include <ostream>

#include "touchstone/tools/table.h"

namespace touchstone {
namespace {

constexpr bool IsPublished(int q) {
  return static_cast<ProximityQuery>(q) == ProximityQuery::kPublished;
}

std::string Name(int q) { return std::string(ToString(static_cast<ProximityQuery>(q))); }

std::string Answers(const ProximityStats& stats) {
  std::string text;
  for (const auto& [answer, count] : stats.answers)
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + answer;
  return text;
}

std::string Percent(std::uint64_t part, std::uint64_t whole) {
  if (whole == 0) return "-";
  return Fixed(100.0 * static_cast<double>(part) / static_cast<double>(whole), 1) + "%";
}

std::vector<std::string> Row(const std::string& suite, int q, const ProximityStats& stats) {
  return {suite,
          Name(q),
          std::to_string(stats.queries),
          IsPublished(q) ? "-" : Percent(stats.exact, stats.queries),
          static_cast<ProximityQuery>(q) == ProximityQuery::kDepthWarm
              ? Percent(stats.warm, stats.queries)
              : "-",
          Fixed(stats.query_ns.Median(), 0),
          std::to_string(stats.FindingCount()),
          Answers(stats)};
}

SuiteProximity SumOver(const std::vector<SuiteProximity>& suites) {
  SuiteProximity sum{"all", {}};
  for (const SuiteProximity& suite : suites) {
    for (int q = 0; q < kProximityQueryCount; ++q) sum.by_query[q].Merge(suite.by_query[q]);
  }
  return sum;
}

}  // namespace

std::uint64_t ProvenFindings(const std::vector<SuiteProximity>& suites) {
  std::uint64_t count = 0;
  for (const SuiteProximity& suite : suites) {
    for (int q = 0; q < kProximityQueryCount; ++q)
      if (!IsPublished(q)) count += suite.by_query[q].FindingCount();
  }
  return count;
}

void PrintProximity(std::ostream& out, const std::vector<SuiteProximity>& suites) {
  Table table;
  table.Row({"suite", "query", "queries", "exact", "warm", "ns", "findings", "answers"});
  std::vector<SuiteProximity> all = suites;
  all.push_back(SumOver(suites));
  for (const SuiteProximity& suite : all) {
    for (int q = 0; q < kProximityQueryCount; ++q)
      table.Row(Row(suite.suite, q, suite.by_query[q]));
  }
  table.Print(out);
  out << '\n';
  std::uint64_t queries = 0;
  for (int q = 0; q < kProximityQueryCount; ++q) {
    const ProximityStats& stats = all.back().by_query[q];
    if (!IsPublished(q)) queries += stats.queries;
    for (const auto& [kind, count] : stats.findings)
      out << Name(q) << ": " << kind << " " << count << '\n';
  }
  for (const SuiteProximity& suite : suites) {
    for (int q = 0; q < kProximityQueryCount; ++q) {
      if (IsPublished(q)) continue;
      for (const std::string& sample : suite.by_query[q].samples)
        out << suite.suite << ", " << Name(q) << ", " << sample << '\n';
    }
  }
  out << "judged " << queries << " queries: " << ProvenFindings(suites) << " findings\n";
}

Json ProximityJson(const VerifyOptions& options, const std::vector<SuiteProximity>& suites) {
  Json results = Json::array();
  std::uint64_t queries = 0;
  for (const SuiteProximity& suite : suites) {
    for (int q = 0; q < kProximityQueryCount; ++q) {
      const ProximityStats& stats = suite.by_query[q];
      if (!IsPublished(q)) queries += stats.queries;
      const double rate = stats.judge_seconds > 0.0
                              ? static_cast<double>(stats.queries) / stats.judge_seconds
                              : 0.0;
      results.push_back({{"suite", suite.suite},
                         {"query", Name(q)},
                         {"seed", options.seed},
                         {"queries", stats.queries},
                         {"answers", stats.answers},
                         {"exact_fallbacks", stats.exact},
                         {"warm", stats.warm},
                         {"findings", stats.findings},
                         {"samples", stats.samples},
                         {"median_ns", stats.query_ns.Median()},
                         {"judged_per_second", rate}});
    }
  }
  return {{"results", results},
          {"total", {{"queries", queries}, {"findings", ProvenFindings(suites)}}}};
}

}  // namespace touchstone
