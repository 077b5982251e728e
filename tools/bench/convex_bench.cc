// SPDX-License-Identifier: MIT
#include "touchstone/tools/bench/convex_bench.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "touchstone/tools/bench/times.h"
#include "touchstone/tools/bench/workload.h"

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;

// How often each batch is timed; the middle one counts.
constexpr int kTurns = 3;
// A batch of repeats is cut short after this long: slow engines need fewer repeats for the same
// precision.
constexpr double kLongestBatchNs = 1e6;
constexpr int kMixedBatch = 32;
constexpr double kDegrees = 0.1, kDegreesFast = 1.0;

double NsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
}

double MiddleOf(std::array<double, kTurns> turns) {
  std::sort(turns.begin(), turns.end());
  return turns[kTurns / 2];
}

// One engine within one cell: its pairs, what it answered, and its times.
struct Lane {
  const EngineDescription* description = nullptr;
  const Engine* engine = nullptr;
  std::vector<std::unique_ptr<EnginePair>> pairs;
  std::vector<Verdict> answers;  // to the pairs asked: a prefix of all
  std::vector<double> samples;
  double ns_left = 0.0;
  bool warm = false;
  long changed_answers = 0;

  std::unique_ptr<EngineCache> MakeCache() const { return engine->MakeCache(); }

  // The next `count` pairs, for the first time; none when the time is up.
  void Judge(std::size_t count) {
    if (ns_left < 0.0) return;
    const Clock::time_point start = Clock::now();
    const std::unique_ptr<EngineCache> cache = warm ? MakeCache() : nullptr;
    for (std::size_t k = 0; k < count; ++k)
      answers.push_back(pairs[answers.size()]->Ask(cache.get()));
    ns_left -= NsSince(start);
  }

  // Asks pairs [begin, end) in order, `repeats` times over; returns ns a query. Answers must be
  // those that were judged.
  double Time(std::size_t begin, std::size_t end, int repeats, EngineCache* cache) {
    long expected = 0, got = 0;
    for (std::size_t i = begin; i < end; ++i) expected += static_cast<long>(answers[i]);
    const Clock::time_point start = Clock::now();
    for (int k = 0; k < repeats; ++k) {
      for (std::size_t i = begin; i < end; ++i) got += static_cast<long>(pairs[i]->Ask(cache));
    }
    const double ns = NsSince(start);
    ns_left -= ns;
    if (got != expected * repeats) ++changed_answers;
    return ns / (static_cast<double>(end - begin) * repeats);
  }
};

// A workload with every engine's own copy of its bodies.
class PreparedWorkload {
 public:
  PreparedWorkload(Workload workload, const std::vector<EngineDescription>& engines,
                   const std::vector<std::unique_ptr<Engine>>& made)
      : workload_(std::move(workload)), descriptions_(engines), engines_(made) {
    for (const auto& engine : engines_) {
      std::vector<std::unique_ptr<EngineShape>>& shapes = shapes_.emplace_back();
      for (const ConvexPolyhedron& body : workload_.bodies) shapes.push_back(engine->Prepare(body));
    }
  }

  const Workload& workload() const { return workload_; }

  std::vector<Lane> Place(const std::vector<RelativePose>& poses, double seconds, bool warm) const {
    std::vector<Lane> lanes(engines_.size());
    for (std::size_t e = 0; e < lanes.size(); ++e) {
      lanes[e].description = &descriptions_[e];
      lanes[e].engine = engines_[e].get();
      lanes[e].ns_left = seconds * 1e9;
      lanes[e].warm = warm;
      for (std::size_t i = 0; i < poses.size(); ++i) {
        const BenchLine& line = workload_.lines[i];
        lanes[e].pairs.push_back(
            engines_[e]->Place(*shapes_[e][line.p], *shapes_[e][line.q], poses[i]));
      }
    }
    return lanes;
  }

 private:
  Workload workload_;
  const std::vector<EngineDescription>& descriptions_;
  const std::vector<std::unique_ptr<Engine>>& engines_;
  std::vector<std::vector<std::unique_ptr<EngineShape>>> shapes_;  // by engine, then body
};

// At each orientation the engines take turns; each query is asked `repeats` times in all.
void RunRepeat(std::vector<Lane>& lanes, std::size_t count, int repeats) {
  const int per_turn = std::max(1, repeats / kTurns);
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<std::array<double, kTurns>> turns(lanes.size());
    std::vector<int> batch(lanes.size(), 0);
    for (std::size_t e = 0; e < lanes.size(); ++e) {
      lanes[e].Judge(1);
      if (lanes[e].answers.size() <= i) continue;
      const double once = lanes[e].Time(i, i + 1, 1, nullptr);
      batch[e] = std::clamp(static_cast<int>(kLongestBatchNs / std::max(once, 1.0)), 1, per_turn);
    }
    for (int t = 0; t < kTurns; ++t) {
      for (std::size_t e = 0; e < lanes.size(); ++e) {
        if (batch[e] == 0) continue;
        lanes[e].pairs[i]->Ask(nullptr);  // brings back what the engine before has driven out
        turns[e][t] = lanes[e].Time(i, i + 1, batch[e], nullptr);
      }
    }
    for (std::size_t e = 0; e < lanes.size(); ++e) {
      if (batch[e] > 0) lanes[e].samples.push_back(MiddleOf(turns[e]));
    }
  }
}

// Batches of different pairs. At any time the engines are at places far apart, so that none finds
// what another has just read.
void RunMixed(std::vector<Lane>& lanes, std::size_t count) {
  const std::size_t batches = count / kMixedBatch;
  const std::size_t stride = std::max<std::size_t>(1, batches / lanes.size());
  for (Lane& lane : lanes) {
    // The turns ask each pair again.
    lane.ns_left /= 1.0 + kTurns;
    for (std::size_t b = 0; b < batches; ++b) lane.Judge(kMixedBatch);
  }
  std::vector<std::vector<std::array<double, kTurns>>> turns(
      lanes.size(), std::vector<std::array<double, kTurns>>(batches));
  for (int t = 0; t < kTurns; ++t) {
    for (std::size_t b = 0; b < batches; ++b) {
      for (std::size_t e = 0; e < lanes.size(); ++e) {
        const std::size_t mine = (b + e * stride) % batches;
        const std::size_t begin = mine * kMixedBatch;
        if (begin + kMixedBatch > lanes[e].answers.size()) continue;
        turns[e][mine][t] = lanes[e].Time(begin, begin + kMixedBatch, 1, nullptr);
      }
    }
  }
  for (std::size_t e = 0; e < lanes.size(); ++e) {
    turns[e].resize(lanes[e].answers.size() / kMixedBatch);
    for (const auto& batch : turns[e]) lanes[e].samples.push_back(MiddleOf(batch));
  }
}

// Motions of `frames` consecutive pairs. The first quarter is not timed: it fills the engine's
// cache and, after the turns of the others, the processor's.
void RunWarm(std::vector<Lane>& lanes, std::size_t count, std::size_t frames) {
  for (std::size_t begin = 0; begin + frames <= count; begin += frames) {
    for (Lane& lane : lanes) lane.Judge(frames);
    std::vector<std::array<double, kTurns>> turns(lanes.size());
    for (int t = 0; t < kTurns; ++t) {
      for (std::size_t e = 0; e < lanes.size(); ++e) {
        if (lanes[e].answers.size() <= begin) continue;
        const std::unique_ptr<EngineCache> cache = lanes[e].MakeCache();
        for (std::size_t i = begin + frames; i > begin; --i)
          lanes[e].pairs[i - 1]->Ask(cache.get());
        turns[e][t] = lanes[e].Time(begin + 1, begin + frames, 1, cache.get());
      }
    }
    for (std::size_t e = 0; e < lanes.size(); ++e) {
      if (lanes[e].answers.size() > begin) lanes[e].samples.push_back(MiddleOf(turns[e]));
    }
  }
}

Workload MakeWorkload(const ConvexBenchOptions& options, const WorkloadKey& key, BenchMode mode) {
  switch (mode) {
    case BenchMode::kRepeat:
      return MakeRepeatWorkload(key, options.orientations);
    case BenchMode::kMixed:
      return MakeMixedWorkload(key, options.mixed_pairs, options.mixed_vertices);
    case BenchMode::kWarm:
      return MakeWarmWorkload(key, options.motions, options.frames, kDegrees);
    case BenchMode::kWarmOneDegree:
      return MakeWarmWorkload(key, options.motions, options.frames, kDegreesFast);
  }
  return {};
}

void RunCell(const ConvexBenchOptions& options, const ConvexBenchCell& cell,
             const PreparedWorkload& prepared, double gap, std::vector<ConvexBenchRow>* rows) {
  const BenchMode mode = cell.mode;
  const bool warm = mode == BenchMode::kWarm || mode == BenchMode::kWarmOneDegree;
  const std::vector<RelativePose> poses = PlaceAtGap(prepared.workload(), gap);
  const std::vector<Verdict> truth = ExactVerdicts(prepared.workload(), poses);
  std::vector<Lane> lanes = prepared.Place(poses, options.seconds_per_row, warm);
  if (mode == BenchMode::kRepeat) {
    RunRepeat(lanes, poses.size(), options.repeats);
  } else if (mode == BenchMode::kMixed) {
    RunMixed(lanes, poses.size());
  } else {
    RunWarm(lanes, poses.size(), static_cast<std::size_t>(options.frames));
  }
  for (Lane& lane : lanes) {
    ConvexBenchRow row;
    row.engine = lane.description->name;
    row.shape = cell.shape;
    row.n = cell.n;
    row.gap = gap;
    row.mode = mode;
    row.median_ns = Quantile(lane.samples, 0.5);
    for (std::size_t i = 0; i < lane.answers.size(); ++i) {
      ++row.queries;
      if (lane.answers[i] == Verdict::kUndecided) ++row.undecided;
      if (IsWrong(lane.description->touch, lane.answers[i], truth[i])) ++row.wrong;
    }
    // An engine that answers the same question in two ways is wrong in one of them.
    row.wrong += lane.changed_answers;
    rows->push_back(row);
  }
}

}  // namespace

std::string_view ToString(BenchMode mode) {
  switch (mode) {
    case BenchMode::kRepeat:
      return "repeat";
    case BenchMode::kMixed:
      return "mixed";
    case BenchMode::kWarm:
      return "warm";
    case BenchMode::kWarmOneDegree:
      return "warm-1deg";
  }
  return "";
}

std::vector<ConvexBenchRow> RunConvexBench(const ConvexBenchOptions& options,
                                           const std::function<void(double)>& report) {
  std::vector<std::unique_ptr<Engine>> engines;
  for (const EngineDescription& engine : options.engines)
    engines.push_back(engine.make(engine.best_tolerance));
  const double count = static_cast<double>(options.cells.size() * options.gaps.size());
  double done = 0.0;
  std::vector<ConvexBenchRow> rows;
  for (const ConvexBenchCell& cell : options.cells) {
    const WorkloadKey key{cell.shape, cell.n, options.seed, options.meshes_dir};
    const PreparedWorkload prepared(MakeWorkload(options, key, cell.mode), options.engines,
                                    engines);
    for (const double gap : options.gaps) {
      if (report) report(done / count);
      if (!prepared.workload().lines.empty()) RunCell(options, cell, prepared, gap, &rows);
      done += 1.0;
    }
  }
  return rows;
}

}  // namespace touchstone
