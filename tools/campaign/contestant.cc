// SPDX-License-Identifier: MIT
#include "touchstone/tools/campaign/contestant.h"

#include <algorithm>

#include "touchstone/exact/decide.h"
#include "touchstone/tools/bad_input.h"
#include "touchstone/tools/engines/registry.h"

namespace touchstone {
namespace {

// A code for class (6 is none), phase, verdict, termination and tier.
constexpr std::size_t kClasses = 7, kVerdicts = 4, kTerminations = 4, kTiers = 4;
constexpr std::size_t kCodes = kClasses * kPhaseCount * kVerdicts * kTerminations * kTiers;

std::string CoverageWords(std::size_t code) {
  const auto tier = static_cast<Tier>(code % kTiers);
  code /= kTiers;
  const auto termination = static_cast<Termination>(code % kTerminations);
  code /= kTerminations;
  const auto verdict = static_cast<Verdict>(code % kVerdicts);
  code /= kVerdicts;
  const auto phase = static_cast<Phase>(code % kPhaseCount);
  code /= kPhaseCount;
  const std::string face_class =
      code == kClasses - 1 ? "none" : std::string(ToString(static_cast<FaceClass>(code)));
  return face_class + ' ' + std::string(ToString(phase)) + ' ' + std::string(ToString(verdict)) +
         ' ' + std::string(ToString(termination)) + ' ' + std::string(ToString(tier));
}

void AddOne(const std::string& name, std::vector<std::unique_ptr<Contestant>>& contestants) {
  if (name == "corrupted") {
    contestants.push_back(MakeCorrupted());
    return;
  }
  if (auto search = MakeJudgedSearch(name)) {
    contestants.push_back(std::move(search));
    return;
  }
  const std::string base = name.substr(0, name.find(':'));
  for (const EngineDescription& description : AllEngines()) {
    if (description.name != base) continue;
    if (!description.unavailable.empty())
      throw BadInput{"--engines: " + base + " is unavailable: " + description.unavailable};
    std::vector<std::unique_ptr<Contestant>> forms = MakeJudgedEngines(description);
    std::erase_if(forms, [&](const auto& form) { return form->name() != name; });
    if (forms.empty()) break;
    std::move(forms.begin(), forms.end(), std::back_inserter(contestants));
    return;
  }
  throw BadInput{"--engines: there is no engine '" + name + "'; see touchstone engines"};
}

std::vector<std::string> Ours() { return {"portal", "phased", "portal-float"}; }

std::vector<std::string> Others() {
  std::vector<std::string> names;
  for (const EngineDescription& description : AllEngines()) {
    if (!description.unavailable.empty() || MakeJudgedSearch(description.name) != nullptr) continue;
    for (const auto& form : MakeJudgedEngines(description)) names.push_back(form->name());
  }
  return names;
}

}  // namespace

void EngineTally::Count(std::string_view key, std::uint64_t times) {
  const auto found = counts_.find(key);
  if (found != counts_.end()) {
    found->second += times;
  } else {
    counts_.emplace(key, times);
  }
}

void EngineTally::CountCoverage(const CollideResult& result) {
  if (coverage_.empty()) coverage_.resize(kCodes);
  std::size_t code = result.face ? static_cast<std::size_t>(result.face->face_class) : kClasses - 1;
  code = code * kPhaseCount + static_cast<std::size_t>(result.phase);
  code = code * kVerdicts + static_cast<std::size_t>(result.verdict);
  code = code * kTerminations + static_cast<std::size_t>(result.termination);
  code = code * kTiers + static_cast<std::size_t>(result.tier);
  ++coverage_[code];
}

void EngineTally::MoveTo(Tally& tally, const std::string& engine) {
  for (std::size_t code = 0; code < coverage_.size(); ++code) {
    if (coverage_[code] > 0) {
      Count(std::string(keys::kCoverage) + CoverageWords(code), coverage_[code]);
    }
  }
  for (const auto& [key, count] : counts_) tally[engine + '\t' + key] += count;
  counts_.clear();
  coverage_.clear();
}

double CampaignQuery::size() const {
  return std::max(pair_.p.max_coordinate(), pair_.q.max_coordinate());
}

bool CampaignQuery::Sampled(std::uint64_t rate, std::uint64_t draw) const {
  return rate > 0 && (index_ + index_ / 20) % rate == draw % rate;
}

void CampaignQuery::Decide() const {
  if (truth_) return;
  const CollideResult result = Collide(pair_.p, pair_.q, pair_.pose);
  const exact::ExactBody p = bodies_.Get(pair_.p);
  const exact::ExactBody q = bodies_.Get(pair_.q);
  const bool stands = exact::Judge(p, q, pair_.pose, result, {.check_phase_maxima = false}).empty();
  if (stands) {
    truth_ = result.verdict;
    if (result.exit_travel) travel_ = result.exit_travel->value / size();
    return;
  }
  const exact::ExactDecision decision = exact::Decide(p, q, pair_.pose);
  truth_ = decision.verdict;
  if (decision.exit) travel_ = decision.exit->exit_travel / size();
}

Verdict CampaignQuery::truth() const {
  Decide();
  return *truth_;
}

std::optional<double> CampaignQuery::travel() const {
  Decide();
  return travel_;
}

std::vector<std::unique_ptr<Contestant>> MakeContestants(const std::vector<std::string>& names) {
  std::vector<std::unique_ptr<Contestant>> contestants;
  const auto add_all = [&](const std::vector<std::string>& all) {
    for (const std::string& name : all) AddOne(name, contestants);
  };
  for (const std::string& name : names) {
    if (name == "ours" || name == "all") add_all(Ours());
    if (name == "others" || name == "all") add_all(Others());
    if (name != "ours" && name != "others" && name != "all") AddOne(name, contestants);
  }
  for (std::size_t i = 0; i < contestants.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (contestants[i]->name() == contestants[j]->name())
        throw BadInput{"--engines: " + contestants[i]->name() + " is named twice"};
    }
  }
  return contestants;
}

}  // namespace touchstone
