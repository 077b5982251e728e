// SPDX-License-Identifier: MIT
#include "touchstone/tests/layers/layers.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <string_view>

namespace touchstone {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

// What each half may include.
const std::map<std::string, Names>& AllowedHalves() {
  static const std::map<std::string, Names> kAllowed = {
      {"core", {"core"}},
      {"exact", {"core", "exact"}},
      {"tools", {"core", "exact", "tools"}},
      {"tests", {"core", "exact", "tools", "tests"}}};
  return kAllowed;
}

// What each folder of core may include.
const std::map<std::string, Names>& AllowedFolders() {
  static const std::map<std::string, Names> kAllowed = {
      {"base", {"base"}},
      {"convex", {"convex", "base"}},
      {"cd_dual", {"cd_dual", "convex", "base"}},
      {"proximity", {"proximity", "cd_dual", "convex", "base"}},
      {"mesh", {"mesh", "base"}},
      {"minkowski", {"minkowski", "mesh", "base"}},
      {"cpd", {"cpd", "minkowski", "mesh", "base"}},
      {"scene", {"scene", "cpd", "minkowski", "mesh", "proximity", "cd_dual", "convex", "base"}}};
  return kAllowed;
}

// All that the judge may read of what it judges.
const Names& CoreHeadersForExact() {
  static const Names kAllowed = {"core/base/status.h",        "core/base/relative_pose.h",
                                 "core/base/verdict.h",       "core/convex/convex_polyhedron.h",
                                 "core/mesh/triangle_mesh.h", "core/cd_dual/result.h",
                                 "core/proximity/result.h",   "core/minkowski/sum_boundary.h"};
  return kAllowed;
}

std::vector<std::string> Parts(const std::string& path) {
  std::vector<std::string> parts;
  for (const fs::path& part : fs::path(path)) parts.push_back(part.string());
  return parts;
}

// What is wrong with the file at `from` (relative to the root) including `header`; empty when
// nothing is.
std::string Check(const std::string& from, const std::string& header, bool quoted) {
  const std::vector<std::string> source = Parts(from);
  const std::string& half = source.front();
  const std::string prefix = "touchstone/";
  if (!header.starts_with(prefix)) {
    if (quoted) return "own headers are included as \"touchstone/...\"";
    const bool oracle =
        header.starts_with("CGAL/") || header.starts_with("gmp") || header.starts_with("mpfr");
    return half == "core" && oracle ? "core includes no oracle code" : "";
  }
  const std::string path = header.substr(prefix.size());
  const std::vector<std::string> target = Parts(path);
  if (!AllowedHalves().at(half).contains(target.front()))
    return half + " may not include " + target.front();
  if (half == "core" && source.size() > 2 && target.size() > 2) {
    const auto allowed = AllowedFolders().find(source[1]);
    if (allowed == AllowedFolders().end())
      return "core/" + source[1] + " has no place among the layers";
    if (!allowed->second.contains(target[1]))
      return "core/" + source[1] + " may not include core/" + target[1];
  }
  if (half == "exact" && target.front() == "core" && !CoreHeadersForExact().contains(path)) {
    return "the judge may not read " + path;
  }
  if (half != "tests" && path.ends_with("_internal.h") &&
      fs::path(from).parent_path() != fs::path(path).parent_path()) {
    return path + " is private to its folder";
  }
  return "";
}

// What an include line names, and whether in quotes.
struct Include {
  std::string header;
  bool quoted;
};

std::optional<Include> ParseInclude(std::string_view line) {
  const auto skip = [&](std::string_view token) {
    line.remove_prefix(std::min(line.size(), line.find_first_not_of(" \t")));
    const bool found = line.starts_with(token);
    if (found) line.remove_prefix(token.size());
    return found;
  };
  if (!skip("#") || !skip("include")) return std::nullopt;
  const bool quoted = skip("\"");
  if (!quoted && !skip("<")) return std::nullopt;
  return Include{std::string(line.substr(0, line.find(quoted ? '"' : '>'))), quoted};
}

void CheckFile(const fs::path& root, const fs::path& file, std::vector<std::string>& violations) {
  const std::string from = fs::relative(file, root).generic_string();
  std::ifstream in(file);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    const std::optional<Include> include = ParseInclude(line);
    if (!include) continue;
    const std::string wrong = Check(from, include->header, include->quoted);
    if (!wrong.empty()) violations.push_back(from + ":" + std::to_string(number) + ": " + wrong);
  }
}

}  // namespace

std::vector<std::string> FindLayerViolations(const fs::path& root) {
  std::vector<fs::path> files;
  for (const auto& [half, allowed] : AllowedHalves()) {
    if (!fs::is_directory(root / half)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / half)) {
      const std::string extension = entry.path().extension().string();
      if (extension == ".h" || extension == ".cc") files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  std::vector<std::string> violations;
  for (const fs::path& file : files) CheckFile(root, file, violations);
  return violations;
}

}  // namespace touchstone
