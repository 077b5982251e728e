// SPDX-License-Identifier: MIT
//
// `touchstone minkowski --ball`: the part of the boundary in a ball, for a frame or along a motion.
#ifndef TOUCHSTONE_TOOLS_TOUCHSTONE_MINKOWSKI_LOCAL_H_
#define TOUCHSTONE_TOOLS_TOUCHSTONE_MINKOWSKI_LOCAL_H_

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/core/mesh/triangle_mesh.h"

namespace touchstone {

struct LocalSumArguments {
  std::vector<std::string> ball;  // centre and radius; empty: the whole boundary was asked for
  std::string builder = "sphere-hierarchy";
  int frames = 1;
  double turn = 1.0;  // degrees a frame
  std::vector<std::string> axis, travel;
  std::string csv;
  bool judge = false;  // set by the caller
};

void AddLocalSumOptions(CLI::App* command, LocalSumArguments* arguments);

// Runs what the arguments ask for and prints it; the last frame's surface goes to the OFF file
// `out`, if one is named. Returns the exit code; throws BadInput.
int RunLocalSum(const LocalSumArguments& arguments, const TriangleMesh& a, const TriangleMesh& b,
                const RelativePose& pose, const std::string& out, bool json);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_TOUCHSTONE_MINKOWSKI_LOCAL_H_
