// SPDX-License-Identifier: MIT
#include "touchstone/tools/bench/value_bench.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "touchstone/exact/convert.h"
#include "touchstone/exact/decide.h"
#include "touchstone/exact/nearest_facet.h"
#include "touchstone/exact/nearest_point.h"
#include "touchstone/tools/bench/workload.h"

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kTurns = 5;

// The exact values of one placed pair, each computed when first asked for.
class ExactValues {
 public:
  ExactValues(const exact::ExactBody& p, const exact::ExactBody& q, const RelativePose& pose)
      : p_(p), q_(q), pose_(pose) {}

  double Of(Quantity quantity, const EngineValue& value) {
    const int key = quantity == Quantity::kExitTravel ? 2 * value.interior_p + value.interior_q : 0;
    const auto [entry, is_new] = known_.try_emplace(key, 0.0);
    if (is_new) entry->second = Compute(quantity, value);
    return entry->second;
  }

 private:
  double Compute(Quantity quantity, const EngineValue& value) const {
    const exact::PlacedPair pair(p_.data(), q_.data(), pose_, value.interior_p, value.interior_q);
    switch (quantity) {
      case Quantity::kDistance: {
        const auto nearest = exact::FindNearest(pair);
        return nearest ? exact::LengthOf(pair, *nearest).ToDouble() : 0.0;
      }
      case Quantity::kDepth: {
        const auto facet = exact::NearestFacet(pair);
        return facet ? exact::DistanceOf(pair, *facet).ToDouble() : 0.0;
      }
      case Quantity::kExitTravel: {
        const exact::ExactDecision decision =
            exact::Decide(p_, q_, pose_, value.interior_p, value.interior_q);
        return decision.exit ? decision.exit->exit_travel : 0.0;
      }
    }
    return 0.0;
  }

  const exact::ExactBody& p_;
  const exact::ExactBody& q_;
  const RelativePose& pose_;
  std::map<int, double> known_;
};

struct Lane {
  const EngineDescription* description = nullptr;
  double tolerance = 0.0;
  std::unique_ptr<Engine> engine;
  std::vector<std::unique_ptr<EngineShape>> shapes;
};

std::vector<Lane> MakeLanes(const ValueBenchOptions& options, const Workload& workload) {
  std::vector<Lane> lanes;
  for (const EngineDescription& description : options.engines) {
    std::vector<double> tolerances = description.tolerances;
    if (tolerances.empty()) tolerances = {description.best_tolerance};
    for (const double tolerance : tolerances) {
      Lane& lane = lanes.emplace_back();
      lane.description = &description;
      lane.tolerance = tolerance;
      lane.engine = description.make(tolerance);
      for (const ConvexPolyhedron& body : workload.bodies)
        lane.shapes.push_back(lane.engine->Prepare(body));
    }
  }
  return lanes;
}

double MiddleOf(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double TimeOnce(const EnginePair& pair, Quantity quantity) {
  const Clock::time_point start = Clock::now();
  const auto value = pair.Measure(quantity);
  const double ns = std::chrono::duration<double, std::nano>(Clock::now() - start).count();
  // Uses the value, so that it is computed.
  return value && std::isnan(value->value) ? ns + 0.0 : ns;
}

// What one lane leaves behind at one gap.
struct Samples {
  std::vector<double> times, errors;
  long queries = 0, absent = 0, not_finite = 0;

  void Add(const std::optional<EngineValue>& value, double exact) {
    ++queries;
    if (!value) {
      ++absent;
    } else if (!std::isfinite(value->value)) {
      ++not_finite;
    } else {
      errors.push_back(std::fabs(value->value - exact) / std::fabs(exact));
    }
  }
};

std::vector<Samples> RunGap(const Workload& workload, const std::vector<Lane>& lanes,
                            Quantity quantity, double gap) {
  std::vector<Samples> samples(lanes.size());
  const std::vector<RelativePose> poses = PlaceAtGap(workload, gap);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const BenchLine& line = workload.lines[i];
    ExactValues exact(workload.exact_bodies[line.p], workload.exact_bodies[line.q], poses[i]);
    std::vector<std::unique_ptr<EnginePair>> pairs;
    for (std::size_t e = 0; e < lanes.size(); ++e) {
      pairs.push_back(
          lanes[e].engine->Place(*lanes[e].shapes[line.p], *lanes[e].shapes[line.q], poses[i]));
      const std::optional<EngineValue> value = pairs[e]->Measure(quantity);
      samples[e].Add(value, value ? exact.Of(quantity, *value) : 1.0);
    }
    std::vector<std::vector<double>> turns(lanes.size());
    for (int t = 0; t < kTurns; ++t) {
      for (std::size_t e = 0; e < lanes.size(); ++e)
        turns[e].push_back(TimeOnce(*pairs[e], quantity));
    }
    for (std::size_t e = 0; e < lanes.size(); ++e) samples[e].times.push_back(MiddleOf(turns[e]));
  }
  return samples;
}

std::vector<double> GapsOf(Quantity quantity, const std::vector<double>& sizes) {
  std::vector<double> gaps;
  for (const double size : sizes) {
    if (quantity != Quantity::kDistance) gaps.push_back(-size);
    if (quantity != Quantity::kDepth) gaps.push_back(size);
  }
  return gaps;
}

}  // namespace

std::vector<ValueBenchRow> RunValueBench(const ValueBenchOptions& options,
                                         const std::function<void(double)>& report) {
  const Workload workload =
      MakeRepeatWorkload({options.shape, options.n, options.seed, ""}, options.orientations);
  const std::vector<Lane> lanes = MakeLanes(options, workload);
  std::vector<ValueBenchRow> rows;
  double done = 0.0;
  for (const Quantity quantity : kAllQuantities) {
    for (const double gap : GapsOf(quantity, options.sizes)) {
      if (report) report(done++ / (4.0 * static_cast<double>(options.sizes.size())));
      const std::vector<Samples> samples = RunGap(workload, lanes, quantity, gap);
      for (std::size_t e = 0; e < lanes.size(); ++e) {
        // An engine without such a query is no row.
        if (samples[e].absent == samples[e].queries) continue;
        ValueBenchRow& row = rows.emplace_back();
        row.engine = lanes[e].description->name;
        row.tolerance = lanes[e].tolerance;
        row.has_tolerance = !lanes[e].description->tolerances.empty();
        row.quantity = quantity;
        row.gap = gap;
        row.median_ns = MiddleOf(samples[e].times);
        row.queries = samples[e].queries;
        row.absent = samples[e].absent;
        row.not_finite = samples[e].not_finite;
        row.median_error = MiddleOf(samples[e].errors);
        for (const double error : samples[e].errors)
          row.greatest_error = std::max(row.greatest_error, error);
      }
    }
  }
  return rows;
}

}  // namespace touchstone
