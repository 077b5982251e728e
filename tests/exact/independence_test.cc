// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace touchstone::exact {
namespace {

std::vector<std::filesystem::path> Sources() {
  std::vector<std::filesystem::path> sources;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(TOUCHSTONE_SOURCE_DIR "/exact")) {
    const std::string extension = entry.path().extension();
    if (extension == ".h" || extension == ".cc") sources.push_back(entry.path());
  }
  return sources;
}

std::string Read(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

// A judge that shares code with the judged is no judge: of the core, these headers and no others.
TEST(Independence, ExactIncludesOnlyTypesOfTheCore) {
  const std::set<std::string> allowed = {
      "core/base/status.h",        "core/base/relative_pose.h",
      "core/base/verdict.h",       "core/convex/convex_polyhedron.h",
      "core/mesh/triangle_mesh.h", "core/cd_dual/result.h",
      "core/proximity/result.h",   "core/minkowski/sum_boundary.h"};
  const std::regex include("#include \"([^\"]*)\"");
  ASSERT_GT(Sources().size(), 20u);
  for (const auto& path : Sources()) {
    const std::string text = Read(path);
    for (std::sregex_iterator i(text.begin(), text.end(), include), end; i != end; ++i) {
      const std::string name = (*i)[1];
      ASSERT_EQ(name.rfind("touchstone/", 0), 0u) << path << " includes " << name;
      const std::string inner = name.substr(std::string("touchstone/").size());
      EXPECT_TRUE(inner.rfind("exact/", 0) == 0 || allowed.count(inner) == 1)
          << path << " includes " << name;
    }
  }
}

// Of a body: vertices, faces and interior points; of a pose: its doubles. Nothing that was
// preprocessed and nothing that claims an error.
TEST(Independence, ExactReadsOnlyVerticesFacesAndPoses) {
  const char* const forbidden[] = {R"(\bface_edges\s*\()",
                                   R"(\bface_plane\s*\()",
                                   R"(\bface_normal\s*\()",
                                   R"(\bfacet_of_face\b)",
                                   R"(\bvertex_neighbors\b)",
                                   R"(\bvertex_edges\s*\()",
                                   R"(\bvertex_faces\s*\()",
                                   R"(\bface_across\b)",
                                   R"(\bmax_coordinate\s*\()",
                                   R"(\bdiameter_bound\b)",
                                   R"(\brotation_error\b)",
                                   R"(\btranslation_error\b)",
                                   R"(\bDyadic\w*\b)",
                                   R"(\bSupportVertex\w*\b)",
                                   R"(\bCollide\s*\()",
                                   R"(\bFindValidationError\b)",
                                   R"(\b(twin|apex|edge_of|half_edge_of|edge_kind)\s*\()",
                                   R"(\b(vertex_half_edges|box_tree|components)\s*\()",
                                   R"(\bcomponent_of_face\b)",
                                   R"(\bbody\(?\)?\.edge\w*\s*\()",
                                   R"(\bbody\(?\)?\.vertex\s*\()"};
  for (const auto& path : Sources()) {
    const std::string text = Read(path);
    for (const char* pattern : forbidden) {
      EXPECT_FALSE(std::regex_search(text, std::regex(pattern))) << path << " uses " << pattern;
    }
  }
}

}  // namespace
}  // namespace touchstone::exact
