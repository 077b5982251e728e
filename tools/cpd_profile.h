// SPDX-License-Identifier: MIT
//
// What depths cost beside the time of a frame: for `touchstone bench cpd --profile`.
#ifndef TOUCHSTONE_TOOLS_CPD_PROFILE_H_
#define TOUCHSTONE_TOOLS_CPD_PROFILE_H_

#include <string>
#include <vector>

#include "touchstone/tools/bench/heap_use.h"
#include "touchstone/tools/shapes/paper_scenes.h"

namespace touchstone {

// What a solver of a scene holds, and what membership costs there: medians.
struct CpdProfile {
  std::string scene;
  double solver_mb = 0.0;  // as the heap has it, after some frames; 0 without a meter
  double overlapping_us = 0.0, separate_us = 0.0, near_touch_us = 0.0, witness_ns = 0.0;
};
CpdProfile ProfileCpd(const PaperScene& scene, HeapMeter heap);

// Tori of so many faces in the motion of torus-torus: making what one of them brings along, and the
// medians of depths at twenty moments, cold, and in steps of 0.1 degrees.
struct DepthGrowthRow {
  int faces;
  double body_ms, cold_ms, coherent_ms;
};
DepthGrowthRow MeasureDepthGrowth(int faces);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_CPD_PROFILE_H_
