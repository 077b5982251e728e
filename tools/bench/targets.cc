// SPDX-License-Identifier: MIT
#include "touchstone/tools/bench/targets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>

#include "touchstone/tools/bench/machine.h"
#include "touchstone/tools/numbers.h"
#include "touchstone/tools/table.h"

namespace touchstone {
namespace {

constexpr std::string_view kOurs = kDefaultEngine;
constexpr std::string_view kOursInDoubles = "portal-float";
constexpr std::array<std::string_view, 4> kOthers = {"libccd-mpr", "libccd-mpr+support",
                                                     "fcl-libccd", "bullet-f64"};
// Contact: a gap that no eye sees, but far above the rounding of the bodies' coordinates.
constexpr double kContactGap = 1e-3;
// The certainty target holds from a gap of 1e-9 of the size on; sizes are 100 to 1000.
constexpr double kLeastCertainGap = 1e-6;

// Ratios over cells: their geometric mean, and the least and the greatest with their gaps.
class Ratios {
 public:
  void Add(double ratio, double gap) {
    log_sum_ += std::log(ratio);
    ++count_;
    if (ratio < least_) least_ = ratio, least_gap_ = gap;
    if (ratio > greatest_) greatest_ = ratio, greatest_gap_ = gap;
  }

  bool empty() const { return count_ == 0; }
  double mean() const { return std::exp(log_sum_ / count_); }
  double least() const { return least_; }
  double greatest() const { return greatest_; }

  std::string MeanAndLeast() const {
    return Fixed(mean(), 2) + " (least " + Fixed(least_, 2) + " at " + ShortDouble(least_gap_) +
           ")";
  }
  std::string MeanAndGreatest() const {
    return Fixed(mean(), 2) + " (greatest " + Fixed(greatest_, 2) + " at " +
           ShortDouble(greatest_gap_) + ")";
  }

 private:
  double log_sum_ = 0.0;
  int count_ = 0;
  double least_ = std::numeric_limits<double>::infinity(), least_gap_ = 0.0;
  double greatest_ = 0.0, greatest_gap_ = 0.0;
};

class Comparison {
 public:
  Comparison(std::span<const ConvexBenchRow> rows, const ConvexProfile* profile)
      : rows_(rows), profile_(profile) {
    for (const ConvexBenchRow& row : rows) {
      gaps_.insert(row.gap);
      sizes_.insert(row.n);
      shapes_.insert(row.shape);
    }
  }

  std::vector<Target> Run() {
    SpeedUps(BenchMode::kRepeat, 3.0, 6.0, 2.0);
    SpeedUps(BenchMode::kMixed, 3.0, 3.0, 1.5);
    FarApart();
    if (profile_ != nullptr) Profile();
    Growth();
    Shapes();
    Certainty();
    Coherence();
    WrongVerdicts();
    return targets_;
  }

  const std::set<int>& sizes() const { return sizes_; }

  using GapFilter = std::function<bool(double)>;
  Ratios SpeedUp(const std::string& shape, int n, BenchMode mode, const GapFilter& filter) const {
    Ratios ratios;
    for (const double gap : gaps_) {
      if (!filter(gap)) continue;
      const ConvexBenchRow* ours = Find(kOurs, shape, n, gap, mode);
      const ConvexBenchRow* other = FindBestOther(rows_, shape, n, gap, mode);
      if (ours != nullptr && other != nullptr) ratios.Add(other->median_ns / ours->median_ns, gap);
    }
    return ratios;
  }

 private:
  const ConvexBenchRow* Find(std::string_view engine, const std::string& shape, int n, double gap,
                             BenchMode mode) const {
    return FindRow(rows_, {engine, shape, n, gap, mode});
  }

  void Add(std::string measure, std::string target, std::string measured, bool met) {
    targets_.push_back({std::move(measure), std::move(target), std::move(measured), met});
  }

  // ℓ <= 1, ellipsoids 2:1:1.
  void SpeedUps(BenchMode mode, double small_target, double large_target, double floor) {
    for (const int n : sizes_) {
      const double target = n < 1000 ? small_target : large_target;
      const Ratios ratios = SpeedUp("ellipsoid-2", n, mode, [](double gap) { return gap <= 1.0; });
      if (ratios.empty()) continue;
      Add("times faster than the best other, " + std::string(ToString(mode)) +
              ", gap <= 1, n = " + std::to_string(n),
          ">= " + ShortDouble(target) + ", no cell below " + ShortDouble(floor),
          ratios.MeanAndLeast(), ratios.mean() >= target && ratios.least() >= floor);
    }
  }

  void FarApart() {
    for (const BenchMode mode : {BenchMode::kRepeat, BenchMode::kMixed}) {
      for (const int n : sizes_) {
        const Ratios ratios =
            SpeedUp("ellipsoid-2", n, mode, [](double gap) { return gap >= 20.0; });
        if (ratios.empty()) continue;
        Add("the same, " + std::string(ToString(mode)) + ", gap >= 20, n = " + std::to_string(n),
            ">= 1.5", ratios.MeanAndLeast(), ratios.mean() >= 1.5);
      }
    }
  }

  void Profile() {
    Tails();
    Bodies();
    if (profile_->allocating_in_doubles >= 0) {
      Add("queries that allocate", "none",
          std::to_string(profile_->allocating_in_doubles) + " decided in doubles, " +
              std::to_string(profile_->allocating_in_exact) + " in exact arithmetic",
          profile_->allocating_in_doubles + profile_->allocating_in_exact == 0);
    }
    Tiers();
    for (const DepthCost& depth : profile_->depths) {
      Add("exact penetration depth, n = " + std::to_string(depth.n) + ", gap " +
              ShortDouble(depth.gap),
          "<= 10 µs cold, <= 3 µs warm",
          Fixed(depth.cold_ns / 1000.0, 1) + " µs cold, " + Fixed(depth.warm_ns / 1000.0, 1) +
              " µs warm",
          depth.cold_ns <= 10000.0 && depth.warm_ns <= 3000.0);
    }
  }

  // By n, at the gap where it is worst.
  void Tails() {
    std::map<int, ColdTail> worst;
    const auto ratio = [](const ColdTail& t) { return t.p999_ns / t.median_ns; };
    for (const ColdTail& tail : profile_->tails) {
      const auto [entry, is_new] = worst.try_emplace(tail.n, tail);
      if (!is_new && ratio(tail) > ratio(entry->second)) entry->second = tail;
    }
    for (const auto& [n, tail] : worst) {
      Add("99.9th percentile of a cold verdict over the median, n = " + std::to_string(n), "<= 5",
          Fixed(ratio(tail), 2) + " (" + Fixed(tail.p999_ns, 0) + " / " + Fixed(tail.median_ns, 0) +
              " ns at " + ShortDouble(tail.gap) + ")",
          ratio(tail) <= 5.0);
    }
  }

  // By shape, at the n where it is worst.
  void Bodies() {
    std::map<std::string, BodyCost> worst_bytes, worst_build;
    for (const BodyCost& body : profile_->bodies) {
      BodyCost& bytes = worst_bytes.try_emplace(body.shape, body).first->second;
      if (body.bytes_per_vertex > bytes.bytes_per_vertex) bytes = body;
      BodyCost& build = worst_build.try_emplace(body.shape, body).first->second;
      if (body.build_us_per_vertex > build.build_us_per_vertex) build = body;
    }
    const auto at = [](const BodyCost& b) { return " (n = " + std::to_string(b.n) + ")"; };
    for (const auto& [shape, body] : worst_bytes) {
      if (body.bytes_per_vertex <= 0.0) continue;
      Add("bytes a vertex, " + shape, "<= 512", Fixed(body.bytes_per_vertex, 0) + at(body),
          body.bytes_per_vertex <= 512.0);
    }
    for (const auto& [shape, body] : worst_build) {
      Add("build, µs a vertex, " + shape, "<= 2", Fixed(body.build_us_per_vertex, 2) + at(body),
          body.build_us_per_vertex <= 2.0);
    }
  }

  // By gap, over all n. Closer than 1e-12 of the size nothing is promised.
  void Tiers() {
    std::map<double, TierCounts, std::greater<>> sums;
    for (const TierCounts& tier : profile_->tiers) {
      TierCounts& sum = sums[tier.relative_gap];
      sum.queries += tier.queries;
      sum.scan += tier.scan;
      sum.exact += tier.exact;
    }
    for (const auto& [gap, sum] : sums) {
      if (gap < 0.99e-12) continue;
      const double rate = static_cast<double>(sum.exact) / static_cast<double>(sum.queries);
      const bool never = gap >= 0.99e-9;
      Add("exact arithmetic reached at a gap of " + ShortDouble(gap) + " of the size",
          never ? "never" : "<= 1 %",
          std::to_string(sum.exact) + " of " + std::to_string(sum.queries) + " (scans " +
              std::to_string(sum.scan) + ")",
          never ? sum.exact == 0 : rate <= 0.01);
    }
  }

  // Our times in cell `a` over those in cell `b`.
  Ratios OursOver(const std::string& shape_a, int n_a, const std::string& shape_b, int n_b) const {
    Ratios ratios;
    for (const double gap : gaps_) {
      const ConvexBenchRow* a = Find(kOurs, shape_a, n_a, gap, BenchMode::kRepeat);
      const ConvexBenchRow* b = Find(kOurs, shape_b, n_b, gap, BenchMode::kRepeat);
      if (a != nullptr && b != nullptr) ratios.Add(a->median_ns / b->median_ns, gap);
    }
    return ratios;
  }

  void Growth() {
    const Ratios ratios = OursOver("ellipsoid-2", 20000, "ellipsoid-2", 100);
    if (ratios.empty()) return;
    Add("growth from n = 100 to 20000, repeat", "<= 1.5", ratios.MeanAndGreatest(),
        ratios.mean() <= 1.5);
  }

  void Shapes() {
    for (const std::string& shape : shapes_) {
      for (const int n : sizes_) {
        const std::string against = shape == "ellipsoid-10" ? "ellipsoid-1" : "ellipsoid-2";
        if (shape == "ellipsoid-1" || shape == against) continue;
        const Ratios ratios = OursOver(shape, n, against, n);
        if (ratios.empty()) continue;
        Add(shape + " against " + against + ", n = " + std::to_string(n), "<= 2",
            ratios.MeanAndGreatest(), ratios.mean() <= 2.0);
      }
    }
  }

  void Certainty() {
    for (const int n : sizes_) {
      Ratios ratios;
      for (const double gap : gaps_) {
        if (std::fabs(gap) < kLeastCertainGap) continue;
        const ConvexBenchRow* exact = Find(kOurs, "ellipsoid-2", n, gap, BenchMode::kRepeat);
        const ConvexBenchRow* doubles =
            Find(kOursInDoubles, "ellipsoid-2", n, gap, BenchMode::kRepeat);
        if (exact != nullptr && doubles != nullptr)
          ratios.Add(exact->median_ns / doubles->median_ns, gap);
      }
      if (ratios.empty()) continue;
      Add("always exact against doubles alone, repeat, n = " + std::to_string(n), "<= 1.10",
          ratios.MeanAndGreatest(), ratios.mean() <= 1.10);
    }
  }

  void Coherence() {
    for (const double gap : gaps_) {
      const ConvexBenchRow* ours = Find(kOurs, "ellipsoid-2", 1000, gap, BenchMode::kWarm);
      if (ours == nullptr) continue;
      const double target = std::fabs(gap) <= kContactGap ? 60.0 : 30.0;
      const ConvexBenchRow* other =
          FindBestOther(rows_, "ellipsoid-2", 1000, gap, BenchMode::kWarm);
      const double times = other == nullptr ? 0.0 : other->median_ns / ours->median_ns;
      const bool overlap = gap < 0.0;
      Add("coherent by 0.1 degrees, n = 1000, gap " + ShortDouble(gap),
          "<= " + ShortDouble(target) + " ns" + (overlap ? ", >= 20 times the best other" : ""),
          Fixed(ours->median_ns, 0) + " ns, " + Fixed(times, 1) + " times",
          ours->median_ns <= target && (!overlap || times >= 20.0));
    }
  }

  void WrongVerdicts() {
    long queries = 0, wrong = 0, undecided = 0;
    for (const ConvexBenchRow& row : rows_) {
      if (row.engine != kOurs) continue;
      queries += row.queries;
      wrong += row.wrong;
      undecided += row.undecided;
    }
    if (queries == 0) return;
    Add("wrong or undecided verdicts", "none",
        std::to_string(wrong + undecided) + " of " + std::to_string(queries),
        wrong + undecided == 0);
  }

  std::span<const ConvexBenchRow> rows_;
  const ConvexProfile* profile_;
  std::set<double> gaps_;
  std::set<int> sizes_;
  std::set<std::string> shapes_;
  std::vector<Target> targets_;
};

// The speed-up over the best other, with AVX2 at most against all.
std::vector<Target> CompareInstructionSets(const InstructionSets& sets) {
  const Comparison all(sets.all, nullptr), avx2(sets.avx2, nullptr);
  std::vector<Target> targets;
  for (const int n : all.sizes()) {
    const auto every = [](double) { return true; };
    const Ratios wide = all.SpeedUp("ellipsoid-2", n, BenchMode::kRepeat, every);
    const Ratios narrow = avx2.SpeedUp("ellipsoid-2", n, BenchMode::kRepeat, every);
    if (wide.empty() || narrow.empty()) continue;
    const double part = narrow.mean() / wide.mean();
    targets.push_back(
        {"speed-up with AVX2 only, n = " + std::to_string(n),
         ">= 0.7 of that with " + VectorClonesInUse(),
         Fixed(part, 2) + " (" + Fixed(narrow.mean(), 2) + " / " + Fixed(wide.mean(), 2) + ")",
         part >= 0.7});
  }
  return targets;
}

}  // namespace

const ConvexBenchRow* FindRow(std::span<const ConvexBenchRow> rows, const RowKey& key) {
  for (const ConvexBenchRow& row : rows) {
    if (row.engine == key.engine && row.shape == key.shape && row.n == key.n &&
        row.gap == key.gap && row.mode == key.mode && row.median_ns > 0.0) {
      return &row;
    }
  }
  return nullptr;
}

const ConvexBenchRow* FindBestOther(std::span<const ConvexBenchRow> rows, std::string_view shape,
                                    int n, double gap, BenchMode mode) {
  const ConvexBenchRow* best = nullptr;
  for (const std::string_view engine : kOthers) {
    const bool is_wrong = std::any_of(rows.begin(), rows.end(), [&](const ConvexBenchRow& row) {
      return row.engine == engine && row.wrong > 0;
    });
    const ConvexBenchRow* row = FindRow(rows, {engine, shape, n, gap, mode});
    if (!is_wrong && row != nullptr && (best == nullptr || row->median_ns < best->median_ns))
      best = row;
  }
  return best;
}

std::vector<Target> CompareWithTargets(std::span<const ConvexBenchRow> rows,
                                       const ConvexProfile* profile,
                                       const InstructionSets* instruction_sets) {
  std::vector<Target> targets = Comparison(rows, profile).Run();
  if (instruction_sets != nullptr) {
    for (Target& target : CompareInstructionSets(*instruction_sets))
      targets.push_back(std::move(target));
  }
  return targets;
}

}  // namespace touchstone
