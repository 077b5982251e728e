// SPDX-License-Identifier: MIT
#include "touchstone/tools/verify_report.h"

#include <algorithm>
#include <array>
#include <optional>
#include <ostream>
#include <string>

#include "touchstone/tools/table.h"
#include "touchstone/tools/words.h"

namespace touchstone {
namespace {

constexpr std::array kAllVerdicts = {Verdict::kSeparate, Verdict::kTouch, Verdict::kOverlap,
                                     Verdict::kUndecided};
constexpr std::array kAllTiers = {Tier::kBound, Tier::kScan, Tier::kExact, Tier::kNone};

template <class Enum>
std::uint64_t At(const std::array<std::uint64_t, 4>& counts, Enum value) {
  return counts[static_cast<std::size_t>(value)];
}

double JudgedPerSecond(const SearchStats& stats) {
  return stats.judge_seconds > 0.0 ? static_cast<double>(stats.queries) / stats.judge_seconds : 0.0;
}

SearchStats SumOver(const VerifyOptions& options, const std::vector<SuiteStats>& stats,
                    Search search) {
  SearchStats sum;
  for (const SuiteStats& suite : stats) {
    for (std::size_t s = 0; s < options.searches.size(); ++s) {
      if (options.searches[s] == search) sum.Merge(suite.by_search[s]);
    }
  }
  return sum;
}

Json CoverageJson(const SearchStats& stats) {
  Json json = {{"queries", stats.queries},
               {"touch", At(stats.verdicts, Verdict::kTouch)},
               {"n_at_least_100", stats.n_at_least_100},
               {"early_exits_asked", stats.early_exits_asked},
               {"phase_maxima_checked", stats.phase_maxima_checked},
               {"constructed", stats.constructed},
               {"twin_runs", stats.twin_runs}};
  for (const Tier tier : kAllTiers)
    json["tiers"][std::string(ToString(tier))] = At(stats.tiers, tier);
  json["combinations"] = Json::array();
  for (const auto& [key, count] : stats.coverage) {
    const auto& [search, face_class, phase, verdict] = key;
    json["combinations"].push_back({{"class", face_class},
                                    {"phase", ToString(phase)},
                                    {"verdict", ToString(verdict)},
                                    {"count", count}});
  }
  return json;
}

std::string Percent(std::uint64_t part, std::uint64_t whole) {
  if (whole == 0) return "-";
  return Fixed(100.0 * static_cast<double>(part) / static_cast<double>(whole), 1) + "%";
}

// The row's cells that do not depend on which searches ran come from any proven search, or else
// from the one there is.
const SearchStats& Representative(const VerifyOptions& options,
                                  const std::vector<SearchStats>& by_search) {
  for (std::size_t s = 0; s < by_search.size(); ++s) {
    if (options.searches[s] != Search::kPublished) return by_search[s];
  }
  return by_search.front();
}

const SearchStats* Find(const VerifyOptions& options, const std::vector<SearchStats>& by_search,
                        Search search) {
  for (std::size_t s = 0; s < by_search.size(); ++s) {
    if (options.searches[s] == search) return &by_search[s];
  }
  return nullptr;
}

std::vector<std::string> SuiteRow(const VerifyOptions& options, const std::string& name,
                                  const std::vector<SearchStats>& by_search) {
  const SearchStats& any = Representative(options, by_search);
  std::vector<std::string> row = {name,
                                  std::to_string(any.queries),
                                  Percent(any.n_at_least_100, any.queries),
                                  std::to_string(At(any.verdicts, Verdict::kSeparate)),
                                  std::to_string(At(any.verdicts, Verdict::kTouch)),
                                  std::to_string(At(any.verdicts, Verdict::kOverlap)),
                                  std::to_string(At(any.verdicts, Verdict::kUndecided))};
  for (const Search search : {Search::kPhased, Search::kPortal}) {
    const SearchStats* stats = Find(options, by_search, search);
    row.push_back(stats ? Percent(At(stats->tiers, Tier::kExact), stats->queries) : "-");
    row.push_back(stats ? Fixed(stats->search_ns.Median(), 0) : "-");
    row.push_back(stats ? std::to_string(stats->FindingCount()) : "-");
  }
  const SearchStats* published = Find(options, by_search, Search::kPublished);
  row.push_back(published ? Fixed(published->search_ns.Median(), 0) : "-");
  const auto wrong =
      published ? published->findings.find("wrong_verdict") : decltype(published->findings.end()){};
  row.push_back(
      !published ? "-" : std::to_string(wrong == published->findings.end() ? 0 : wrong->second));
  row.push_back(!published ? "-"
                           : std::to_string(published->failed_queries) + " (" +
                                 Percent(published->failed_queries, published->queries) + ")");
  return row;
}

void PrintFindings(std::ostream& out, const VerifyOptions& options,
                   const std::vector<SuiteStats>& stats) {
  for (const Search search : options.searches) {
    const SearchStats sum = SumOver(options, stats, search);
    for (const auto& [kind, count] : sum.findings)
      out << ToString(search) << ": " << kind << " " << count << '\n';
    for (const auto& [kind, count] : sum.rounding_findings) {
      out << ToString(search) << ", in doubles only: " << kind << " " << count << '\n';
    }
  }
}

}  // namespace

VerifyTotals Total(const VerifyOptions& options, const std::vector<SuiteStats>& stats) {
  VerifyTotals total;
  for (const Search search : options.searches) {
    const SearchStats sum = SumOver(options, stats, search);
    total.queries += sum.queries;
    (search == Search::kPublished ? total.published_findings : total.proven_findings) +=
        sum.FindingCount();
  }
  return total;
}

Json VerifyJson(const VerifyOptions& options, const std::vector<SuiteStats>& stats) {
  Json results = Json::array();
  for (const SuiteStats& suite : stats) {
    for (std::size_t s = 0; s < options.searches.size(); ++s) {
      const SearchStats& one = suite.by_search[s];
      Json row = {{"suite", suite.suite},
                  {"search", ToString(options.searches[s])},
                  {"seed", options.seed},
                  {"queries", one.queries}};
      for (const Verdict verdict : kAllVerdicts)
        row[std::string(ToString(verdict))] = At(one.verdicts, verdict);
      row["findings"] = Json::object();
      for (const auto& [kind, count] : one.findings) row["findings"][kind] = count;
      row["exact_fallbacks"] = At(one.tiers, Tier::kExact);
      row["median_ns"] = one.search_ns.Median();
      row["judged_per_second"] = JudgedPerSecond(one);
      row["rounding_findings"] = Json::object();
      for (const auto& [kind, count] : one.rounding_findings)
        row["rounding_findings"][kind] = count;
      row["failed_queries"] = one.failed_queries;
      row["n_at_least_100"] = one.n_at_least_100;
      row["twin_runs"] = one.twin_runs;
      results.push_back(std::move(row));
    }
  }
  Json coverage = Json::object();
  for (const Search search : options.searches) {
    coverage[std::string(ToString(search))] = CoverageJson(SumOver(options, stats, search));
  }
  const VerifyTotals total = Total(options, stats);
  return {{"results", std::move(results)},
          {"coverage", std::move(coverage)},
          {"total",
           {{"queries", total.queries},
            {"proven_findings", total.proven_findings},
            {"published_findings", total.published_findings}}}};
}

void PrintVerify(std::ostream& out, const VerifyOptions& options,
                 const std::vector<SuiteStats>& stats) {
  Table table;
  table.Row({"", "", "", "", "", "", "", "phased", "phased", "phased", "portal", "portal", "portal",
             "published", "published", "published"});
  table.Row({"suite", "pairs", "n>=100", "separate", "touch", "overlap", "undecided", "exact", "ns",
             "findings", "exact", "ns", "findings", "ns", "wrong verdict", "queries failed"});
  std::vector<SearchStats> sums(options.searches.size());
  for (const SuiteStats& suite : stats) {
    table.Row(SuiteRow(options, suite.suite, suite.by_search));
    for (std::size_t s = 0; s < sums.size(); ++s) sums[s].Merge(suite.by_search[s]);
  }
  if (stats.size() > 1) table.Row(SuiteRow(options, "all", sums));
  table.Print(out);
  out << '\n';
  PrintFindings(out, options, stats);
  const VerifyTotals total = Total(options, stats);
  out << "judged " << total.queries << " queries: " << total.proven_findings
      << " findings in the proven searches, " << total.published_findings
      << " in the published one\n";
}

void PrintCoverage(std::ostream& out, const VerifyOptions& options,
                   const std::vector<SuiteStats>& stats) {
  for (const Search search : options.searches) {
    const SearchStats sum = SumOver(options, stats, search);
    out << ToString(search) << ": " << sum.queries << " queries, "
        << At(sum.verdicts, Verdict::kTouch) << " exact touches, "
        << Percent(sum.n_at_least_100, sum.queries) << " with n >= 100, " << sum.constructed
        << " in the construction tier, " << sum.phase_maxima_checked << " with phase maxima, "
        << sum.early_exits_asked << " asked for an early exit, " << sum.twin_runs
        << " exact replays\n";
    for (const Tier tier : kAllTiers) {
      out << "  tier " << ToString(tier) << ": " << At(sum.tiers, tier) << '\n';
    }
    Table table;
    table.Row({"  class", "phase", "verdict", "count"});
    for (const auto& [key, count] : sum.coverage) {
      table.Row({"  " + std::get<1>(key), std::string(ToString(std::get<2>(key))),
                 std::string(ToString(std::get<3>(key))), std::to_string(count)});
    }
    table.Print(out);
    out << '\n';
  }
}

}  // namespace touchstone
