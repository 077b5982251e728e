// SPDX-License-Identifier: MIT
//
//   here        meaning
//   travel      l: the signed travel from contact along the ray from c through o, positive apart;
//               its size bounds the gap, and the depth, from above
//   size        the larger of the bodies' largest coordinates
#ifndef TOUCHSTONE_TOOLS_CAMPAIGN_CONTESTANT_H_
#define TOUCHSTONE_TOOLS_CAMPAIGN_CONTESTANT_H_

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "touchstone/tools/campaign/batch.h"
#include "touchstone/tools/engines/engine.h"
#include "touchstone/tools/judged_query.h"
#include "touchstone/tools/suites/suite.h"

namespace touchstone {

// How much of a campaign is looked at closely: one query in so many. Verdict, certificate, face and
// values are judged at every query.
struct SamplingRates {
  std::uint64_t maxima = 16;  // the phase maxima, O(mn)
  std::uint64_t construct =
      256;                       // M built whole, where the product of vertex counts is at most 400
  std::uint64_t warm = 4;        // asked again from the cache of a frame before
  std::uint64_t early_exit = 4;  // asked for an early exit
  std::uint64_t values = 16;     // engines: distance and depth beside the exact ones
};

// The last few values made for a body; copies of a body share its vertices, and the one kept here
// holds them alive.
template <class Value>
class PerBody {
 public:
  template <class Make>
  const Value& Get(const ConvexPolyhedron& body, Make make) {
    for (const std::optional<Entry>& entry : recent_) {
      if (entry && entry->body.vertices().data() == body.vertices().data()) return entry->value;
    }
    std::optional<Entry>& slot = recent_[next_++ % recent_.size()];
    slot.reset();
    slot.emplace(Entry{body, make(body)});
    return slot->value;
  }

 private:
  struct Entry {
    ConvexPolyhedron body;
    Value value;
  };
  std::array<std::optional<Entry>, 8> recent_;
  std::size_t next_ = 0;
};

// What one contestant is counted under.
class EngineTally {
 public:
  void Count(std::string_view key, std::uint64_t times = 1);
  // The combination of class, phase, verdict, termination and tier.
  void CountCoverage(const CollideResult& result);
  // Adds everything to `tally` under `engine`, and starts again from nothing.
  void MoveTo(Tally& tally, const std::string& engine);

 private:
  Tally counts_;
  std::vector<std::uint64_t> coverage_;
};

// A placed pair with its truth, computed when first asked for and shared by all contestants.
class CampaignQuery {
 public:
  CampaignQuery(const PlacedPair& pair, std::uint64_t index, const SamplingRates& rates,
                ExactBodies& bodies)
      : pair_(pair), index_(index), rates_(rates), bodies_(bodies) {}

  const PlacedPair& pair() const { return pair_; }
  std::uint64_t index() const { return index_; }
  const SamplingRates& rates() const { return rates_; }
  ExactBodies& bodies() const { return bodies_; }
  double size() const;
  // Whether this is one of the queries that are sampled at one in `rate`; 0: never. The draws move
  // along with the rounds of placements, which have 20 steps.
  bool Sampled(std::uint64_t rate, std::uint64_t draw) const;

  // The exact verdict: the portal search's where the judge finds its proof good, or else the exact
  // half's own decision.
  Verdict truth() const;
  // Signed travel over size; nothing for c = o.
  std::optional<double> travel() const;

 private:
  void Decide() const;

  const PlacedPair& pair_;
  std::uint64_t index_;
  const SamplingRates& rates_;
  ExactBodies& bodies_;
  mutable std::optional<Verdict> truth_;
  mutable std::optional<double> travel_;
};

// One who is asked every query of a campaign: a search of ours, judged whole, or an engine, judged
// by its verdict and its values.
class Contestant {
 public:
  Contestant(std::string name, bool proven) : name_(std::move(name)), proven_(proven) {}
  virtual ~Contestant() = default;

  const std::string& name() const { return name_; }
  // Whether a finding is a bug of this project.
  bool proven() const { return proven_; }

  // Asks and judges. Counts in `tally`, and returns what is wrong. May crash or never return: it
  // runs in a process of its own.
  virtual std::vector<NamedFinding> Ask(const CampaignQuery& query, EngineTally& tally) = 0;

 private:
  std::string name_;
  bool proven_;
};

// Contestants by name, in the order given. "portal", "phased", "portal-float", "published" are our
// searches; other names are engines: NAME at its best tolerance, NAME:default at its default where
// that differs, NAME:held, for single precision, on the query rounded to what floats hold.
// "corrupted" is our portal search with a planted error in its result, to see that the judge finds
// it. "ours", "others" and "all" stand for several, in every form. Throws BadInput for an unknown
// or unavailable name, and for one named twice.
std::vector<std::unique_ptr<Contestant>> MakeContestants(const std::vector<std::string>& names);

// Makers, a file each.
std::unique_ptr<Contestant> MakeJudgedSearch(const std::string& name);  // null: none of ours
std::vector<std::unique_ptr<Contestant>> MakeJudgedEngines(const EngineDescription& description);
std::unique_ptr<Contestant> MakeCorrupted();

// The keys that every contestant counts under.
namespace keys {
inline constexpr std::string_view kQueries = "queries";
inline constexpr std::string_view kWrong = "wrong";            // verdicts
inline constexpr std::string_view kUnresolved = "unresolved";  // undecided, given up
inline constexpr std::string_view kFindings = "findings";
inline constexpr std::string_view kFinding = "finding ";    // + kind
inline constexpr std::string_view kCoverage = "coverage ";  // + class phase verdict ...
inline constexpr std::string_view kTravel = "travel ";      // + class of travel: queries
inline constexpr std::string_view kWrongTravel = "wrong ";  // + class of travel: wrong verdicts
inline constexpr std::string_view kError = "error ";        // + quantity scale aspect decade
inline constexpr std::string_view kScale = "scale ";        // + class of scale: queries
inline constexpr std::string_view kWrongScale = "wrong-scale ";
}  // namespace keys

// Classes of travel, of relative errors, of sizes and of aspects, in the order of the tables.
std::string TravelClass(std::optional<double> travel);
std::string ErrorClass(double value, double exact);
std::string ScaleClass(double size);
std::string AspectClass(double aspect);
// The ratio of a body's largest to its smallest standard deviation over its vertices.
double AspectOf(const ConvexPolyhedron& body);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_CAMPAIGN_CONTESTANT_H_
