// SPDX-License-Identifier: MIT
#include "touchstone/tools/proximity_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "touchstone/tools/judged_proximity.h"
#include "touchstone/tools/suites/random.h"

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kBatch = 40;
constexpr std::size_t kMaxSamples = 3;
// As in verify_run.cc: products of vertex counts, and one query in so many above them.
constexpr long kAlwaysAllFaces = 2500;
constexpr long kConstruct = 400;
constexpr std::uint64_t kSample = 16;

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Q a little further on: turned by about 0.1 degrees and moved by a ten-thousandth of the size.
std::optional<PlacedPair> Moved(const PlacedPair& pair, Random& random) {
  const Eigen::Vector3d axis = random.SpherePoint();
  constexpr double kAngle = 0.0017;
  Eigen::Matrix3d turn;
  for (int k = 0; k < 3; ++k) {
    // Rodrigues to the second order; the columns are made orthonormal below.
    const Eigen::Vector3d x = pair.pose.rotation().col(k);
    const Eigen::Vector3d across(axis[1] * x[2] - axis[2] * x[1], axis[2] * x[0] - axis[0] * x[2],
                                 axis[0] * x[1] - axis[1] * x[0]);
    turn.col(k) = x + kAngle * across;
  }
  Eigen::Vector3d a = turn.col(0), b = turn.col(1);
  a /= std::sqrt(a.squaredNorm());
  b -= a.dot(b) * a;
  b /= std::sqrt(b.squaredNorm());
  turn.col(0) = a;
  turn.col(1) = b;
  turn.col(2) << a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0];
  const double size = std::min(pair.p.diameter_bound(), pair.q.diameter_bound());
  const auto pose =
      RelativePose::Make(turn, pair.pose.translation() + 1e-4 * size * random.SpherePoint());
  if (!pose.ok()) return std::nullopt;
  return PlacedPair{pair.p, pair.q, *pose};
}

// Along an axis, a small lattice vector, the line of the translation, through a vertex of M, or
// anywhere.
Eigen::Vector3d DirectionFor(const PlacedPair& pair, Random& random) {
  const Eigen::Vector3d& t = pair.pose.translation();
  Eigen::Vector3d s = Eigen::Vector3d::Zero();
  switch (random.Integer(0, 4)) {
    case 0:
      s = Eigen::Vector3d::Unit(random.Integer(0, 2));
      break;
    case 1:
      s = {double(random.Integer(-2, 2)), double(random.Integer(-2, 2)),
           double(random.Integer(-2, 2))};
      break;
    case 2:
      s = t;
      break;
    case 3:
      s = pair.p.vertex(static_cast<int>(random.Below(pair.p.vertex_count()))) - t -
          pair.pose.rotation() *
              pair.q.vertex(static_cast<int>(random.Below(pair.q.vertex_count())));
      break;
    default:
      break;
  }
  const double length = std::hypot(s[0], s[1], s[2]);
  if (!(length >= 1e-99 && length <= 1e99)) s = random.SpherePoint();
  return random.OneIn(2) ? s : Eigen::Vector3d(-s);
}

class Worker {
 public:
  Worker(const VerifyOptions& options, const Suite& suite, SuiteProximity* out)
      : options_(options), suite_(suite), out_(*out) {}

  void Run(std::uint64_t begin, std::uint64_t end) {
    for (index_ = begin; index_ < end; ++index_) RunPair();
  }

 private:
  void RunPair() {
    const PlacedPair pair = suite_.Generate(options_.seed, index_);
    Random random(suite_.name(), options_.seed, index_ ^ 0x70726f78696d69ULL);
    const ProximityDepth depth = DepthOf(pair);
    const std::optional<PlacedPair> moved = Moved(pair, random);
    DistanceCache distance;
    Count(ProximityQuery::kDistance,
          [&] { return AskDistance(pair, options_.certainty, depth, bodies_, &distance); });
    if (moved) {
      Count(ProximityQuery::kDistanceWarm,
            [&] { return AskDistance(*moved, options_.certainty, depth, bodies_, &distance); });
    }
    penetration_.Clear();
    const PenetrationOptions penetration{.certainty = options_.certainty, .certificate = true};
    Count(ProximityQuery::kDepth,
          [&] { return AskPenetration(pair, penetration, depth, bodies_, &penetration_); });
    if (moved) {
      Count(ProximityQuery::kDepthWarm,
            [&] { return AskPenetration(*moved, penetration, depth, bodies_, &penetration_); });
    }
    const Eigen::Vector3d s = DirectionFor(pair, random);
    DirectionalResult truth;
    Count(ProximityQuery::kTravel, [&] {
      auto judged = AskDirection(pair, s, options_.certainty, depth, bodies_);
      truth = judged.result;
      return judged;
    });
    if (truth.kind == TravelKind::kUndecided) return;
    Count(ProximityQuery::kPublished, [&] { return AskPublishedDirection(pair, s, truth); });
  }

  ProximityDepth DepthOf(const PlacedPair& pair) const {
    exact::ProximityJudgeOptions how{
        .certainty = options_.certainty, .all_faces = true, .construct = true};
    if (options_.depth == Depth::kFull) return how;
    const long product = static_cast<long>(pair.p.vertex_count()) * pair.q.vertex_count();
    const std::uint64_t draw = (index_ + index_ / 20) % kSample;
    const bool sampled = options_.depth != Depth::kProof;
    how.all_faces = sampled && (product <= kAlwaysAllFaces || draw == 0);
    how.construct = sampled && product <= kConstruct && draw == 1;
    return how;
  }

  static std::string Answer(const DistanceResult& result) {
    return std::string(ToString(result.kind));
  }
  static std::string Answer(const PenetrationResult& result) {
    return std::string(ToString(result.verdict));
  }
  static std::string Answer(const DirectionalResult& result) {
    return result.grazing ? "grazing" : std::string(ToString(result.kind));
  }
  static std::string Answer(const PublishedTravel& result) {
    return std::string(ToString(result.kind));
  }
  static bool IsExact(const PublishedTravel&) { return false; }
  template <class Result>
  static bool IsExact(const Result& result) {
    return result.exact_signs > 0;
  }
  static bool IsWarm(const PenetrationResult& result) { return result.warm; }
  template <class Result>
  static bool IsWarm(const Result&) {
    return false;
  }

  template <class Ask>
  void Count(ProximityQuery query, const Ask& ask) {
    ProximityStats& stats = out_.by_query[static_cast<std::size_t>(query)];
    ++stats.queries;
    std::vector<NamedFinding> findings;
    try {
      const auto judged = ask();
      ++stats.answers[Answer(judged.result)];
      stats.exact += IsExact(judged.result);
      stats.warm += IsWarm(judged.result);
      stats.query_ns.Add(judged.query_ns);
      stats.judge_seconds += judged.judge_ns * 1e-9;
      findings = judged.findings;
    } catch (const std::exception& error) {
      findings.push_back({"exception", error.what()});
    }
    for (const NamedFinding& finding : findings) {
      ++stats.findings[finding.kind];
      if (stats.samples.size() < kMaxSamples) {
        stats.samples.push_back("index " + std::to_string(index_) + ": " + finding.kind + ": " +
                                finding.detail);
      }
    }
  }

  const VerifyOptions& options_;
  const Suite& suite_;
  SuiteProximity& out_;
  ExactBodies bodies_;
  PenetrationCache penetration_;
  std::uint64_t index_ = 0;
};

// One suite after the other; its indices in batches to all threads.
class Runner {
 public:
  Runner(const VerifyOptions& options, const std::function<void(const Progress&)>& report)
      : options_(options), report_(report) {}

  std::vector<SuiteProximity> Run() {
    std::vector<SuiteProximity> all;
    for (const Suite* suite : options_.suites) {
      all.push_back({std::string(suite->name()), {}});
      RunSuite(*suite, &all.back());
      ++suites_done_;
    }
    return all;
  }

 private:
  void RunSuite(const Suite& suite, SuiteProximity* total) {
    next_ = options_.first;
    start_ = Clock::now();
    std::vector<std::thread> threads;
    int running = options_.threads;
    std::condition_variable ended;
    for (int i = 0; i < options_.threads; ++i) {
      threads.emplace_back([&] {
        while (const auto batch = Take()) {
          SuiteProximity stats;
          Worker(options_, suite, &stats).Run(batch->first, batch->second);
          const std::lock_guard lock(mutex_);
          Add(stats, batch->second - batch->first, total);
        }
        const std::lock_guard lock(mutex_);
        --running;
        ended.notify_one();
      });
    }
    {
      std::unique_lock lock(mutex_);
      while (!ended.wait_for(lock, std::chrono::milliseconds(250), [&] { return running == 0; })) {
        if (report_) report_({Fraction(), queries_, findings_});
      }
    }
    for (std::thread& thread : threads) thread.join();
  }

  std::optional<std::pair<std::uint64_t, std::uint64_t>> Take() {
    const std::lock_guard lock(mutex_);
    const bool by_count = options_.count > 0;
    const std::uint64_t end = options_.first + options_.count;
    const double share = 60.0 * options_.minutes / static_cast<double>(options_.suites.size());
    if (by_count ? next_ >= end : SecondsSince(start_) >= share) return std::nullopt;
    const std::uint64_t begin = next_;
    next_ = by_count ? std::min(end, begin + kBatch) : begin + kBatch;
    return std::pair{begin, next_};
  }

  void Add(const SuiteProximity& stats, std::uint64_t pairs, SuiteProximity* total) {
    for (int q = 0; q < kProximityQueryCount; ++q) {
      total->by_query[q].Merge(stats.by_query[q]);
      queries_ += stats.by_query[q].queries;
      if (static_cast<ProximityQuery>(q) != ProximityQuery::kPublished)
        findings_ += stats.by_query[q].FindingCount();
    }
    pairs_done_ += pairs;
  }

  double Fraction() const {
    const auto suites = static_cast<double>(options_.suites.size());
    if (options_.count > 0)
      return std::min(
          1.0, static_cast<double>(pairs_done_) / (static_cast<double>(options_.count) * suites));
    const double share = 60.0 * options_.minutes / suites;
    return std::min(
        1.0,
        (static_cast<double>(suites_done_) + std::min(1.0, SecondsSince(start_) / share)) / suites);
  }

  const VerifyOptions& options_;
  const std::function<void(const Progress&)>& report_;
  std::mutex mutex_;
  std::uint64_t next_ = 0, queries_ = 0, findings_ = 0, pairs_done_ = 0;
  std::size_t suites_done_ = 0;
  Clock::time_point start_;
};

}  // namespace

std::string_view ToString(ProximityQuery query) {
  static constexpr std::string_view kNames[] = {"distance",   "distance-warm", "depth",
                                                "depth-warm", "travel",        "published"};
  return kNames[static_cast<std::size_t>(query)];
}

void ProximityStats::Merge(const ProximityStats& other) {
  queries += other.queries;
  for (const auto& [answer, count] : other.answers) answers[answer] += count;
  exact += other.exact;
  warm += other.warm;
  for (const auto& [kind, count] : other.findings) findings[kind] += count;
  for (const std::string& sample : other.samples) {
    if (samples.size() < kMaxSamples) samples.push_back(sample);
  }
  query_ns.Merge(other.query_ns);
  judge_seconds += other.judge_seconds;
}

std::uint64_t ProximityStats::FindingCount() const {
  std::uint64_t count = 0;
  for (const auto& [kind, n] : findings) count += n;
  return count;
}

std::vector<SuiteProximity> RunProximity(const VerifyOptions& options,
                                         const std::function<void(const Progress&)>& report) {
  return Runner(options, report).Run();
}

}  // namespace touchstone
