// SPDX-License-Identifier: MIT
#include "touchstone/tools/campaign/shrunk_case.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "touchstone/tools/bad_input.h"
#include "touchstone/tools/case_file.h"

namespace touchstone {
namespace {

const Suite* Find(const CampaignPlan& plan, const std::string& name) {
  for (const Suite* suite : plan.suites) {
    if (suite->name() == name) return suite;
  }
  return nullptr;
}

std::string DetailOf(const std::string& engine, const std::string& kind, const PlacedPair& pair,
                     double hang_seconds) {
  for (const NamedFinding& finding : AskApart(engine, pair, hang_seconds)) {
    if (finding.kind == kind) return finding.detail;
  }
  return "not at every try";
}

std::string Sizes(const PlacedPair& pair) {
  return std::to_string(pair.p.vertex_count()) + " and " + std::to_string(pair.q.vertex_count()) +
         " vertices";
}

}  // namespace

std::string WriteShrunkCase(const StoredFinding& finding, const CampaignPlan& plan,
                            const std::string& folder, const ShrinkOptions& options) {
  const Suite* suite = Find(plan, finding.suite);
  if (suite == nullptr) return "";
  const PlacedPair whole = suite->Generate(plan.seed, finding.index);
  const std::optional<PlacedPair> small = Shrink(finding.engine, finding.kind, whole, options);
  if (!small) return "";
  const CaseFile query{
      .suite = finding.suite,
      .seed = plan.seed,
      .index = finding.index,
      .finding = finding.kind,
      .detail = DetailOf(finding.engine, finding.kind, *small, options.hang_seconds),
      .pair = *small,
      .engine = finding.engine,
      .caption = {"Shrunk from " + Sizes(whole) + " to " + Sizes(*small) + "."}};

  std::string name = finding.engine + '-' + finding.kind + ".case";
  std::replace(name.begin(), name.end(), ':', '-');
  const std::filesystem::path path = std::filesystem::path(folder) / "cases" / name;
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  std::ofstream out(path);
  WriteCase(out, query);
  out.flush();
  if (!out) throw BadInput{path.string() + ": cannot be written"};
  return "cases/" + name;
}

}  // namespace touchstone
