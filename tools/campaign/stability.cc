// SPDX-License-Identifier: MIT
#include "touchstone/tools/campaign/stability.h"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <set>
#include <vector>

#include "touchstone/tools/bad_input.h"
#include "touchstone/tools/table.h"

namespace touchstone {
namespace {

// The classes of classes.cc, in order.
constexpr std::array kTravels = {"-deep",   "->=1e-1", "-<1e-1", "-<1e-3",  "-<1e-6",  "-<1e-9",
                                 "-<1e-12", "-<1e-15", "0",      "+<1e-15", "+<1e-12", "+<1e-9",
                                 "+<1e-6",  "+<1e-3",  "+<1e-1", "+>=1e-1"};
constexpr std::array kScales = {"<1e-30", "<1e-6", "<1e-1", "<1e3", "<1e7", "<1e30", ">=1e30"};
constexpr std::array kAspects = {"<3", "<30", "<1e3", "<1e5", ">=1e5"};
constexpr std::array kErrors = {"<1e-15", "<1e-12", "<1e-9", "<1e-6", "<1e-3", "<1", ">=1", "nan"};

// A table on the screen and a file for other programs.
class Section {
 public:
  Section(const std::string& title, std::vector<std::string> head) : title_(title) {
    rows_.push_back(std::move(head));
  }
  void Row(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }

  void Print(std::ostream& out, bool markdown) const {
    Table table;
    for (const std::vector<std::string>& row : rows_) table.Row(row);
    out << '\n' << title_ << "\n\n";
    markdown ? table.PrintMarkdown(out) : table.Print(out);
  }
  void Write(const std::filesystem::path& path) const {
    std::ofstream out(path);
    for (const std::vector<std::string>& row : rows_) {
      for (std::size_t k = 0; k < row.size(); ++k) out << (k == 0 ? "" : ",") << row[k];
      out << '\n';
    }
    out.flush();
    if (!out) throw BadInput{path.string() + ": cannot be written"};
  }

 private:
  std::string title_;
  std::vector<std::vector<std::string>> rows_;
};

std::uint64_t At(const Tally& tally, const std::string& key) {
  const auto found = tally.find(key);
  return found == tally.end() ? 0 : found->second;
}

std::string Share(std::uint64_t part, std::uint64_t whole) {
  if (whole == 0) return "-";
  return std::to_string(part) + " of " + std::to_string(whole);
}

Section ByKind(const CampaignTotals& totals) {
  std::set<std::string> kinds;
  for (const std::string& engine : totals.engines()) {
    for (const auto& [kind, count] : totals.WithPrefix(engine, keys::kFinding)) kinds.insert(kind);
  }
  std::vector<std::string> head = {"engine", "queries"};
  head.insert(head.end(), kinds.begin(), kinds.end());
  Section section("Findings by kind", head);
  for (const std::string& engine : totals.engines()) {
    const Tally findings = totals.WithPrefix(engine, keys::kFinding);
    std::vector<std::string> row = {engine, std::to_string(totals.Of(engine, keys::kQueries))};
    for (const std::string& kind : kinds) row.push_back(std::to_string(At(findings, kind)));
    section.Row(row);
  }
  return section;
}

// What was counted of portal and phased together under `key`, a suite or all.
std::uint64_t OfProven(const Tally& tally, std::string_view key) {
  std::uint64_t sum = 0;
  for (const char* engine : {"portal\t", "phased\t"}) sum += At(tally, engine + std::string(key));
  return sum;
}

// The same over the combinations whose last word, the tier, is `tier`.
std::uint64_t OfTier(const Tally& tally, const std::string& tier) {
  std::uint64_t sum = 0;
  for (const char* engine : {"portal\t", "phased\t"}) {
    const std::string start = engine + std::string(keys::kCoverage);
    for (auto it = tally.lower_bound(start); it != tally.end() && it->first.starts_with(start);
         ++it) {
      if (it->first.ends_with(' ' + tier)) sum += it->second;
    }
  }
  return sum;
}

Section Judged(const CampaignTotals& totals) {
  static constexpr std::array<std::string_view, 7> kAsked = {
      keys::kQueries, "exact touch",          "gap < 1e-12", "n >= 100",
      "n >= 1000",    "phase maxima checked", "constructed"};
  Section section("Judged in the proven searches by suite",
                  {"suite", "queries", "touch", "gap < 1e-12", "n >= 100", "n >= 1000", "maxima",
                   "M whole", "by bound", "by scan", "exact", "wrong", "unresolved", "findings"});
  const auto add = [&](const std::string& suite, const Tally& tally) {
    std::vector<std::string> row = {suite};
    for (const std::string_view key : kAsked) row.push_back(std::to_string(OfProven(tally, key)));
    for (const char* tier : {"bound", "scan", "exact"})
      row.push_back(std::to_string(OfTier(tally, tier)));
    for (const std::string_view key : {keys::kWrong, keys::kUnresolved, keys::kFindings})
      row.push_back(std::to_string(OfProven(tally, key)));
    section.Row(row);
  };
  Tally all;
  for (const auto& [suite, tally] : totals.by_suite()) {
    if (OfProven(tally, keys::kQueries) == 0) continue;
    add(suite, tally);
    for (const auto& [key, count] : tally) all[key] += count;
  }
  if (!all.empty()) add("all", all);
  return section;
}

Section BySuite(const CampaignTotals& totals) {
  Section section("Wrong verdicts by suite",
                  {"engine", "suite", "queries", "wrong", "unresolved", "findings"});
  for (const CampaignTotals::Row& row : totals.rows()) {
    section.Row({row.engine, row.suite, std::to_string(row.queries), std::to_string(row.wrong),
                 std::to_string(row.unresolved), std::to_string(row.findings)});
  }
  return section;
}

template <std::size_t N>
Section ByClass(const CampaignTotals& totals, const std::string& title,
                const std::array<const char*, N>& classes, std::string_view asked,
                std::string_view wrong) {
  std::vector<std::string> head = {"engine"};
  head.insert(head.end(), classes.begin(), classes.end());
  Section section(title, head);
  for (const std::string& engine : totals.engines()) {
    const Tally queries = totals.WithPrefix(engine, asked);
    if (queries.empty()) continue;
    const Tally wrongs = totals.WithPrefix(engine, wrong);
    std::vector<std::string> row = {engine};
    for (const char* name : classes) row.push_back(Share(At(wrongs, name), At(queries, name)));
    section.Row(row);
  }
  return section;
}

Section Errors(const CampaignTotals& totals) {
  std::vector<std::string> head = {"engine", "quantity", "scale", "aspect"};
  head.insert(head.end(), kErrors.begin(), kErrors.end());
  Section section("Values by relative error", head);
  for (const std::string& engine : totals.engines()) {
    const Tally errors = totals.WithPrefix(engine, keys::kError);
    for (const char* quantity : {"exit_travel", "distance", "depth"}) {
      for (const char* scale : kScales) {
        for (const char* aspect : kAspects) {
          const std::string key = std::string(quantity) + ' ' + scale + ' ' + aspect + ' ';
          std::vector<std::string> row = {engine, quantity, scale, aspect};
          std::uint64_t sum = 0;
          for (const char* error : kErrors) {
            sum += At(errors, key + error);
            row.push_back(std::to_string(At(errors, key + error)));
          }
          if (sum > 0) section.Row(row);
        }
      }
    }
  }
  return section;
}

}  // namespace

void ReportStability(const CampaignTotals& totals, const std::string& folder, bool markdown,
                     std::ostream& out) {
  const std::filesystem::path directory = std::filesystem::path(folder) / "report";
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  const std::vector<std::pair<std::string, Section>> sections = {
      {"judged", Judged(totals)},
      {"kinds", ByKind(totals)},
      {"suites", BySuite(totals)},
      {"travel", ByClass(totals, "Wrong verdicts by signed travel from contact, over the size",
                         kTravels, keys::kTravel, keys::kWrongTravel)},
      {"scale",
       ByClass(totals, "Wrong verdicts by size", kScales, keys::kScale, keys::kWrongScale)},
      {"errors", Errors(totals)}};
  for (const auto& [name, section] : sections) {
    section.Write(directory / (name + ".csv"));
    section.Print(out, markdown);
  }
  const std::string command = "/usr/bin/python3 '" TOUCHSTONE_CAMPAIGN_PLOT "' '" +
                              directory.string() + "' >/dev/null 2>&1";
  if (std::system(command.c_str()) != 0)
    out << "\nno plot: it needs python3-matplotlib; the CSV files are in " << directory.string()
        << '\n';
}

}  // namespace touchstone
