// SPDX-License-Identifier: MIT
#include "touchstone/tools/bench/convex_report.h"

#include <algorithm>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include "touchstone/tools/numbers.h"
#include "touchstone/tools/table.h"

namespace touchstone {
namespace {

// Three significant digits: times vary more than that from run to run.
std::string Nanoseconds(double ns) { return Fixed(ns, ns < 10.0 ? 1 : 0); }

template <class T>
void AddOnce(std::vector<T>& items, const T& item) {
  if (std::find(items.begin(), items.end(), item) == items.end()) items.push_back(item);
}

void Print(std::ostream& out, const Table& table, TableStyle style) {
  style == TableStyle::kText ? table.Print(out) : table.PrintMarkdown(out);
  out << '\n';
}

// The rows of one shape, n and mode.
void PrintBlock(std::ostream& out, std::span<const ConvexBenchRow> rows, TableStyle style) {
  std::vector<std::string> engines;
  std::vector<double> gaps;
  for (const ConvexBenchRow& row : rows) {
    AddOnce(engines, row.engine);
    AddOnce(gaps, row.gap);
  }
  Table table;
  std::vector<std::string> head = {rows[0].shape + ", n = " + std::to_string(rows[0].n) + ", " +
                                   std::string(ToString(rows[0].mode)) + ", ns at gap"};
  for (const double gap : gaps) head.push_back(ShortDouble(gap));
  head.insert(head.end(), {"queries", "wrong", "undecided"});
  table.Row(head);
  for (const std::string& engine : engines) {
    std::vector<std::string> cells = {engine};
    long queries = 0, wrong = 0, undecided = 0;
    for (const double gap : gaps) {
      const auto row = std::find_if(rows.begin(), rows.end(), [&](const ConvexBenchRow& r) {
        return r.engine == engine && r.gap == gap;
      });
      cells.push_back(row == rows.end() ? "-" : Nanoseconds(row->median_ns));
      if (row == rows.end()) continue;
      queries += row->queries;
      wrong += row->wrong;
      undecided += row->undecided;
    }
    cells.insert(cells.end(),
                 {std::to_string(queries), std::to_string(wrong), std::to_string(undecided)});
    table.Row(cells);
  }
  Print(out, table, style);
}

}  // namespace

Json ConvexBenchJson(std::span<const ConvexBenchRow> rows) {
  Json json = Json::array();
  for (const ConvexBenchRow& row : rows) {
    if (row.mode == BenchMode::kWarmOneDegree) continue;
    json.push_back({{"engine", row.engine},
                    {"shape", row.shape},
                    {"n", row.n},
                    {"gap", row.gap},
                    {"mode", ToString(row.mode)},
                    {"median_ns", row.median_ns},
                    {"queries", row.queries},
                    {"wrong", row.wrong},
                    {"undecided", row.undecided}});
  }
  return json;
}

void WriteConvexBenchCsv(std::ostream& out, std::span<const ConvexBenchRow> rows) {
  out << "engine,shape,n,gap,mode,median_ns,queries,wrong,undecided\n";
  for (const ConvexBenchRow& row : rows) {
    out << row.engine << ',' << row.shape << ',' << row.n << ',' << ShortDouble(row.gap) << ','
        << ToString(row.mode) << ',' << ShortDouble(row.median_ns) << ',' << row.queries << ','
        << row.wrong << ',' << row.undecided << '\n';
  }
}

void PrintConvexBench(std::ostream& out, std::span<const ConvexBenchRow> rows, TableStyle style) {
  const auto block = [](const ConvexBenchRow& row) { return std::tie(row.shape, row.n, row.mode); };
  for (std::size_t begin = 0; begin < rows.size();) {
    std::size_t end = begin;
    while (end < rows.size() && block(rows[end]) == block(rows[begin])) ++end;
    PrintBlock(out, rows.subspan(begin, end - begin), style);
    begin = end;
  }
}

void PrintSummary(std::ostream& out, std::span<const ConvexBenchRow> rows, TableStyle style) {
  std::vector<double> gaps;
  std::vector<std::pair<BenchMode, int>> lines;
  for (const ConvexBenchRow& row : rows) {
    if (row.shape != "ellipsoid-2" || row.engine != kDefaultEngine) continue;
    AddOnce(gaps, row.gap);
    AddOnce(lines, {row.mode, row.n});
  }
  std::stable_sort(lines.begin(), lines.end());
  Table table;
  std::vector<std::string> head = {"ns, ours / best other, at gap", "n"};
  for (const double gap : gaps) head.push_back(ShortDouble(gap));
  table.Row(head);
  for (const auto& [mode, n] : lines) {
    std::vector<std::string> cells = {std::string(ToString(mode)), std::to_string(n)};
    for (const double gap : gaps) {
      const ConvexBenchRow* ours = FindRow(rows, {kDefaultEngine, "ellipsoid-2", n, gap, mode});
      const ConvexBenchRow* other = FindBestOther(rows, "ellipsoid-2", n, gap, mode);
      cells.push_back((ours == nullptr ? "-" : Nanoseconds(ours->median_ns)) + " / " +
                      (other == nullptr ? "-" : Nanoseconds(other->median_ns)));
    }
    table.Row(cells);
  }
  Print(out, table, style);
}

void PrintTargets(std::ostream& out, std::span<const Target> targets, TableStyle style) {
  Table table;
  table.Row({"measure", "target", "measured", "met"});
  for (const Target& target : targets)
    table.Row({target.measure, target.target, target.measured, target.met ? "yes" : "no"});
  Print(out, table, style);
}

}  // namespace touchstone
