// SPDX-License-Identifier: MIT
//
// An engine of others, judged by its verdict, under its own convention of touch, and on a sample by
// its distance and depth.
#include <algorithm>
#include <cmath>

#include "touchstone/exact/convert.h"
#include "touchstone/exact/decide.h"
#include "touchstone/exact/nearest_facet.h"
#include "touchstone/exact/nearest_point.h"
#include "touchstone/tools/campaign/contestant.h"
#include "touchstone/tools/campaign/single_precision.h"
#include "touchstone/tools/numbers.h"

namespace touchstone {
namespace {

// A value further off than this part of the size is a finding: no documented tolerance comes near.
constexpr double kFarOff = 1e-3;
// The exact depth takes O(mn).
constexpr long kLargestDepth = 40'000;

std::string KindOf(Verdict answer, Verdict truth) {
  if (truth == Verdict::kOverlap)
    return answer == Verdict::kTouch ? "overlap_called_touch" : "missed_overlap";
  if (truth == Verdict::kSeparate)
    return answer == Verdict::kTouch ? "separate_called_touch" : "false_overlap";
  return "missed_touch";
}

double ExactValue(const CampaignQuery& query, const PlacedPair& pair, Quantity quantity) {
  const exact::ExactBody p = query.bodies().Get(pair.p);
  const exact::ExactBody q = query.bodies().Get(pair.q);
  const exact::PlacedPair placed(p.data(), q.data(), pair.pose, 0, 0);
  if (quantity == Quantity::kDistance) {
    const auto nearest = exact::FindNearest(placed);
    return nearest ? exact::LengthOf(placed, *nearest).ToDouble() : 0.0;
  }
  const auto facet = exact::NearestFacet(placed);
  return facet ? exact::DistanceOf(placed, *facet).ToDouble() : 0.0;
}

class JudgedEngine : public Contestant {
 public:
  JudgedEngine(const std::string& name, const EngineDescription& description, double tolerance,
               bool held)
      : Contestant(name, description.proven),
        touch_(description.touch),
        floats_(description.single_precision),
        held_(held),
        engine_(description.make(tolerance)) {}

  std::vector<NamedFinding> Ask(const CampaignQuery& query, EngineTally& tally) override {
    if (floats_ && !IsInReachOfFloats(query.pair())) {
      tally.Count("out of reach of floats");
      return {};
    }
    if (!held_) return AskPair(query, query.pair(), query.truth(), tally);
    const std::optional<PlacedPair> rounded = rounded_.Round(query.pair());
    if (!rounded) {
      tally.Count("not held by floats");
      return {};
    }
    return AskPair(
        query, *rounded,
        exact::Decide(query.bodies().Get(rounded->p), query.bodies().Get(rounded->q), rounded->pose)
            .verdict,
        tally);
  }

 private:
  const EngineShape& ShapeOf(const ConvexPolyhedron& body) {
    return *shapes_.Get(body, [&](const ConvexPolyhedron& b) {
      return std::shared_ptr<const EngineShape>(engine_->Prepare(b));
    });
  }

  std::vector<NamedFinding> AskPair(const CampaignQuery& query, const PlacedPair& pair,
                                    Verdict truth, EngineTally& tally) {
    std::vector<NamedFinding> findings;
    const std::unique_ptr<EnginePair> placed =
        engine_->Place(ShapeOf(pair.p), ShapeOf(pair.q), pair.pose);
    const Verdict answer = placed->Ask(nullptr);
    const bool wrong = IsWrong(touch_, answer, truth);
    const std::string travel_class = TravelClass(query.travel());
    const std::string scale_class = ScaleClass(query.size());
    tally.Count(std::string(keys::kTravel) + travel_class);
    tally.Count(std::string(keys::kScale) + scale_class);
    if (wrong) {
      tally.Count(std::string(keys::kWrongTravel) + travel_class);
      tally.Count(std::string(keys::kWrongScale) + scale_class);
      findings.push_back({KindOf(answer, truth), "says " + std::string(ToString(answer)) + ", is " +
                                                     std::string(ToString(truth))});
    }
    if (answer == Verdict::kUndecided) {
      tally.Count(keys::kUnresolved);
      findings.push_back({"gave_up", "stopped at its bound on iterations"});
    }
    // A value without the right verdict is a value of another question.
    if (answer == truth && query.Sampled(query.rates().values, 5))
      JudgeValue(query, pair, *placed, truth, tally, findings);
    return findings;
  }

  void JudgeValue(const CampaignQuery& query, const PlacedPair& pair, const EnginePair& placed,
                  Verdict truth, EngineTally& tally, std::vector<NamedFinding>& findings) {
    if (truth == Verdict::kTouch) return;
    const Quantity quantity = truth == Verdict::kSeparate ? Quantity::kDistance : Quantity::kDepth;
    const long product = static_cast<long>(pair.p.vertex_count()) * pair.q.vertex_count();
    if (quantity == Quantity::kDepth && product > kLargestDepth) return;
    const std::optional<EngineValue> value = placed.Measure(quantity);
    const std::string name(ToString(quantity));
    if (!value) {
      tally.Count("absent " + name);
      return;
    }
    const double exact = ExactValue(query, pair, quantity);
    const double aspect = std::max(AspectOfBody(pair.p), AspectOfBody(pair.q));
    tally.Count(std::string(keys::kError) + name + ' ' + ScaleClass(query.size()) + ' ' +
                AspectClass(aspect) + ' ' + ErrorClass(value->value, exact));
    const std::string said =
        "says " + name + ' ' + ShortDouble(value->value) + ", is " + ShortDouble(exact);
    if (std::isnan(value->value)) {
      findings.push_back({"nan", said});
    } else if (!(std::fabs(value->value - exact) <= kFarOff * query.size())) {
      findings.push_back({name + "_far_off", said});
    }
  }

  double AspectOfBody(const ConvexPolyhedron& body) { return aspects_.Get(body, AspectOf); }

  TouchConvention touch_;
  bool floats_, held_;
  std::unique_ptr<Engine> engine_;
  PerBody<std::shared_ptr<const EngineShape>> shapes_;
  PerBody<double> aspects_;
  RoundedPairs rounded_;
};

}  // namespace

std::vector<std::unique_ptr<Contestant>> MakeJudgedEngines(const EngineDescription& description) {
  std::vector<std::unique_ptr<Contestant>> forms;
  const auto add = [&](const std::string& suffix, double tolerance, bool held) {
    forms.push_back(
        std::make_unique<JudgedEngine>(description.name + suffix, description, tolerance, held));
  };
  add("", description.best_tolerance, false);
  if (description.default_tolerance != description.best_tolerance)
    add(":default", description.default_tolerance, false);
  if (description.single_precision) add(":held", description.best_tolerance, true);
  return forms;
}

}  // namespace touchstone
