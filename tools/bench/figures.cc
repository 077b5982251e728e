// SPDX-License-Identifier: MIT
#include "touchstone/tools/bench/figures.h"

#include <algorithm>
#include <fstream>
#include <string_view>
#include <utility>

#include "touchstone/tools/bench/convex_report.h"
#include "touchstone/tools/bench/phase_bench.h"
#include "touchstone/tools/bench/value_bench.h"
#include "touchstone/tools/numbers.h"

namespace touchstone {
namespace {

// Denser near contact, where the curves peak.
const std::vector<double> kFigureGaps = {-100.0, -50.0, -20.0, -10.0, -5.0, -2.0,  -1.0,
                                         -0.1,   -1e-2, -1e-3, 1e-3,  1e-2, 0.1,   1.0,
                                         2.0,    5.0,   10.0,  20.0,  50.0, 100.0, 200.0};
const std::vector<double> kErrorSizes = {1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6,
                                         1e-5,  1e-4,  1e-3,  1e-2, 0.1,  1.0,  10.0};
constexpr int kErrorVertices = 100;
// A rate is what counts there, not the time to three digits.
constexpr int kErrorRepeats = 15;

// An engine at one of its tolerances.
struct Setting {
  std::string engine, tolerance;  // empty where the engine has none
  bool is_best = false;
};

bool WriteRows(const std::string& path, std::span<const ConvexBenchRow> rows) {
  if (rows.empty()) return true;
  std::ofstream out(path);
  WriteConvexBenchCsv(out, rows);
  return out.good();
}

ConvexBenchOptions MakeOptions(const FiguresOptions& options, std::vector<ConvexBenchCell> cells) {
  ConvexBenchOptions bench;
  bench.engines = options.engines;
  bench.cells = std::move(cells);
  bench.gaps = kFigureGaps;
  bench.orientations = options.orientations;
  bench.repeats = options.repeats;
  bench.seconds_per_row = options.seconds_per_row;
  bench.seed = options.seed;
  return bench;
}

bool MakeTimeFigures(const FiguresOptions& options, const std::function<void(double)>& report) {
  std::vector<ConvexBenchCell> cells;
  for (const int n : {20, 100, 1000, 20000})
    cells.push_back({"ellipsoid-2", n, BenchMode::kRepeat});
  for (const char* shape : {"ellipsoid-1", "ellipsoid-4", "ellipsoid-10"})
    cells.push_back({shape, 1000, BenchMode::kRepeat});
  return WriteTimeFigures(options.directory,
                          RunConvexBench(MakeOptions(options, std::move(cells)), report));
}

bool MakePhaseFigure(const FiguresOptions& options) {
  PhaseBenchOptions phases;
  phases.gaps = kFigureGaps;
  phases.orientations = std::min(options.orientations, 200);
  phases.repeats = std::min(options.repeats, 60);
  phases.seed = options.seed;
  std::ofstream out(options.directory + "/figure10.csv");
  out << "n,gap";
  for (const std::string_view stage : kPublishedStages) out << ',' << stage;
  out << '\n';
  for (const PhaseTimes& row : RunPhaseBench(phases)) {
    out << row.n << ',' << ShortDouble(row.gap);
    for (const double ns : row.ns) out << ',' << ShortDouble(ns);
    out << '\n';
  }
  return out.good();
}

bool MakeErrorFigure(const FiguresOptions& options, const std::function<void(double)>& report) {
  std::vector<Setting> settings;
  ConvexBenchOptions bench = MakeOptions(options, {});
  bench.engines.clear();
  for (const EngineDescription& engine : options.engines) {
    std::vector<double> tolerances = engine.tolerances;
    if (tolerances.empty()) tolerances = {engine.best_tolerance};
    for (const double tolerance : tolerances) {
      EngineDescription& at = bench.engines.emplace_back(engine);
      at.best_tolerance = tolerance;
      at.name = std::to_string(settings.size());
      settings.push_back({engine.name, engine.tolerances.empty() ? "" : ShortDouble(tolerance),
                          tolerance == engine.best_tolerance});
    }
  }
  for (const char* shape : {"ellipsoid-2", "parallel"})
    bench.cells.push_back({shape, kErrorVertices, BenchMode::kRepeat});
  bench.gaps.clear();
  for (const double size : kErrorSizes) {
    for (const double side : {-1.0, 1.0}) bench.gaps.push_back(side * size);
  }
  bench.repeats = std::min(options.repeats, kErrorRepeats);
  std::ofstream out(options.directory + "/error-verdicts.csv");
  out << "engine,tolerance,is_best,shape,n,gap,median_ns,queries,wrong,undecided\n";
  for (const ConvexBenchRow& row : RunConvexBench(bench, report)) {
    const Setting& setting = settings[static_cast<std::size_t>(std::stoi(row.engine))];
    out << setting.engine << ',' << setting.tolerance << ',' << (setting.is_best ? 1 : 0) << ','
        << row.shape << ',' << row.n << ',' << ShortDouble(row.gap) << ','
        << ShortDouble(row.median_ns) << ',' << row.queries << ',' << row.wrong << ','
        << row.undecided << '\n';
  }
  return out.good();
}

bool MakeValueFigure(const FiguresOptions& options, const std::function<void(double)>& report) {
  ValueBenchOptions values;
  values.engines = options.engines;
  values.n = kErrorVertices;
  values.sizes = {1e-9, 1e-6, 1e-3, 1.0, 20.0};
  values.orientations = std::min(options.orientations, 100);
  values.seed = options.seed;
  std::ofstream out(options.directory + "/error-values.csv");
  out << "engine,tolerance,quantity,shape,n,gap,median_ns,queries,absent,not_finite,median_error,"
         "greatest_error\n";
  for (const ValueBenchRow& row : RunValueBench(values, report)) {
    out << row.engine << ',' << (row.has_tolerance ? ShortDouble(row.tolerance) : "") << ','
        << ToString(row.quantity) << ',' << values.shape << ',' << values.n << ','
        << ShortDouble(row.gap) << ',' << ShortDouble(row.median_ns) << ',' << row.queries << ','
        << row.absent << ',' << row.not_finite << ',' << ShortDouble(row.median_error) << ','
        << ShortDouble(row.greatest_error) << '\n';
  }
  return out.good();
}

}  // namespace

bool WriteTimeFigures(const std::string& directory, std::span<const ConvexBenchRow> rows) {
  std::vector<ConvexBenchRow> by_size, by_shape;
  for (const ConvexBenchRow& row : rows) {
    if (row.mode != BenchMode::kRepeat) continue;
    if (row.shape == "ellipsoid-2") by_size.push_back(row);
    if (row.n == 1000) by_shape.push_back(row);
  }
  return WriteRows(directory + "/figure8.csv", by_size) &&
         WriteRows(directory + "/figure9.csv", by_shape);
}

bool MakeFigures(const FiguresOptions& options, const std::function<void(double)>& report) {
  return MakeTimeFigures(options, report) && MakePhaseFigure(options) &&
         MakeErrorFigure(options, report) && MakeValueFigure(options, report);
}

}  // namespace touchstone
