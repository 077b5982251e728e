// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_BENCH_SCENE_BENCH_H_
#define TOUCHSTONE_TOOLS_BENCH_SCENE_BENCH_H_

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "touchstone/core/scene/scene.h"

namespace touchstone {

// How bodies move from one step to the next. The bodies are hulls of 100 random points on an
// ellipsoid 1 : 0.8 : 0.6, uniform in a cube of 16 units of volume a body, so that a body meets
// about one other, whatever their number.
enum class SceneMotion {
  kStatic,    // none moves
  kCoherent,  // each by 0.01 along its own line, turning by 0.01 radians about its own axis
  kChaotic,   // each by up to one unit along every axis, to any rotation
};
std::string_view ToString(SceneMotion);

struct SceneBenchRow {
  std::string engine;  // "touchstone", "touchstone without RULE", "touchstone threads", others
  int bodies = 0;
  SceneMotion motion = SceneMotion::kStatic;
  double median_ms_per_step = 0.0;  // processor time of the calling thread (with threads: wall)
  long pairs = 0;                   // that meet after the last step, as the engine says
  long mismatches = 0;  // pairs of which it says otherwise than is proven; a touch is either
};

struct SceneBenchOptions {
  bool quick = false;
  std::uint64_t seed = 1;
  std::function<void(double)> progress = [](double) {};
};

struct SceneBenchReport {
  std::vector<SceneBenchRow> rows;
  // Of the largest coherent scene: heap a body and a pair of parts.
  double bytes_per_body = 0.0, bytes_per_pair = 0.0;
  // Of our scene, coherent: the slope of log time over log bodies from 1,000 bodies on.
  double exponent = 0.0;
  // What each rule saved in the coherent scene of the targets: the sum over the timed steps.
  SceneCounters counters;
  int counted_steps = 0;
};

SceneBenchReport RunSceneBench(const SceneBenchOptions& options);

// The row of an engine; null where it was not timed.
const SceneBenchRow* FindRow(const SceneBenchReport& report, const std::string& engine, int bodies,
                             SceneMotion motion);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_BENCH_SCENE_BENCH_H_
