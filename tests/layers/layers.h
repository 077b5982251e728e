// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TESTS_LAYERS_LAYERS_H_
#define TOUCHSTONE_TESTS_LAYERS_LAYERS_H_

#include <filesystem>
#include <string>
#include <vector>

namespace touchstone {

// Every include line under `root` (the folder that holds core/, exact/, tools/, tests/) that breaks
// the layers, as "file:line: what is wrong", in order:
//
//   tools, tests -> exact -> core
//   in core: scene -> cpd -> minkowski -> mesh -> base, scene -> cd_dual -> convex -> base, and
//            proximity may use cd_dual, convex, base
//   exact reads vertices, faces, poses, statuses and results of the core, and no other header of it
//   core includes no CGAL, GMP or MPFR
//   *_internal.h stays in its folder, but for tests
//   the project's own headers are included as "touchstone/..."
std::vector<std::string> FindLayerViolations(const std::filesystem::path& root);

}  // namespace touchstone

#endif  // TOUCHSTONE_TESTS_LAYERS_LAYERS_H_
