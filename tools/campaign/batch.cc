// SPDX-License-Identifier: MIT
#include "touchstone/tools/campaign/batch.h"

#include <cassert>
#include <sstream>

#include "touchstone/tools/numbers.h"

namespace touchstone {
namespace {

// One line, no tabs: fields are separated by tabs, records by ends of lines.
std::string Field(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
  }
  return text;
}

std::vector<std::string_view> Split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::uint64_t Number(std::string_view word) {
  const auto value = ParseInteger<std::uint64_t>(word);
  assert(value);
  return value.value_or(0);
}

void PutBatch(std::ostream& out, const Batch& batch) {
  out << batch.suite << '\t' << batch.first << '\t' << batch.end;
}

Batch GetBatch(const std::vector<std::string_view>& fields) {
  return {static_cast<std::size_t>(Number(fields[1])), Number(fields[2]), Number(fields[3])};
}

}  // namespace

void Merge(Tally& into, const Tally& from) {
  for (const auto& [key, count] : from) into[key] += count;
}

std::string ToText(const BatchResult& result) {
  std::ostringstream out;
  out << "b\t";
  PutBatch(out, result.batch);
  out << '\t' << ShortDouble(result.seconds) << '\n';
  for (const auto& [key, count] : result.tally) out << "t\t" << key << '\t' << count << '\n';
  for (const CampaignFinding& finding : result.findings) {
    out << "f\t" << finding.engine << '\t' << finding.index << '\t' << Field(finding.kind) << '\t'
        << Field(finding.detail) << '\n';
  }
  return out.str();
}

BatchResult BatchResultFromText(std::string_view text) {
  BatchResult result;
  for (const std::string_view line : Split(text, '\n')) {
    const std::vector<std::string_view> fields = Split(line, '\t');
    if (fields[0] == "b") {
      result.batch = GetBatch(fields);
      result.seconds = ParseDouble(fields[4]).value_or(0.0);
    } else if (fields[0] == "t") {
      result.tally[std::string(fields[1]) + '\t' + std::string(fields[2])] = Number(fields[3]);
    } else if (fields[0] == "f") {
      result.findings.push_back({std::string(fields[1]), Number(fields[2]), std::string(fields[3]),
                                 std::string(fields[4])});
    }
  }
  return result;
}

std::string ToText(const Batch& batch, const std::vector<FatalQuery>& fatal) {
  std::ostringstream out;
  out << "b\t";
  PutBatch(out, batch);
  out << '\n';
  for (const FatalQuery& query : fatal) {
    // One more than the number, since -1 stands for the suite or the judge.
    out << "x\t" << query.index << '\t' << query.contestant + 1 << '\t' << Field(query.kind) << '\t'
        << Field(query.detail) << '\n';
  }
  return out.str();
}

void FromText(std::string_view text, Batch& batch, std::vector<FatalQuery>& fatal) {
  fatal.clear();
  for (const std::string_view line : Split(text, '\n')) {
    const std::vector<std::string_view> fields = Split(line, '\t');
    if (fields[0] == "b") {
      batch = GetBatch(fields);
    } else if (fields[0] == "x") {
      fatal.push_back({Number(fields[1]), static_cast<int>(Number(fields[2])) - 1,
                       std::string(fields[3]), std::string(fields[4])});
    }
  }
}

}  // namespace touchstone
