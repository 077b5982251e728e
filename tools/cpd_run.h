// SPDX-License-Identifier: MIT
//
// A pair of the paper's benchmarks along its motion, by each method: for `touchstone cpd --scene`
// and `touchstone bench cpd`.
#ifndef TOUCHSTONE_TOOLS_CPD_RUN_H_
#define TOUCHSTONE_TOOLS_CPD_RUN_H_

#include <Eigen/Core>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "touchstone/core/cpd/contact_space_projection.h"
#include "touchstone/core/cpd/continuous_penetration_depth.h"
#include "touchstone/core/cpd/mesh_penetration_depth.h"
#include "touchstone/tools/shapes/paper_scenes.h"

namespace touchstone {

// Options for normals by word: angle, area, uniform, interpolated (the paper's Figure 2a), mean.
inline constexpr double kMeanNormalRadius = 0.3;  // for the last: normal_radius
std::optional<ContinuousDepthOptions> NormalsFromWord(const std::string& word);

// One moment of the motion, by all three methods, each coherent.
struct CpdFrame {
  double s;  // of PaperScene::PoseAt
  ContinuousDepthResult cpd;
  MeshDepthResult depth;
  ContactSpaceResult contact_space;
};

// `frames` moments, s evenly from 0 to 1, both ends included.
std::vector<CpdFrame> RunCpdScene(const PaperScene& scene, int frames,
                                  const ContinuousDepthOptions& options = {});

// Columns: s, then status (CPD), and for each method magnitude and direction.
void WriteCpdCsv(const std::vector<CpdFrame>& frames, std::ostream& out);
// The paper's Figure 11: magnitudes over the motion above, direction cosines below.
void WriteCpdSvg(const std::string& title, const std::vector<CpdFrame>& frames, std::ostream& out);

// A translation as a function of s that may jump. `at` is asked in any order; Events counts the
// steps of an interval that keep a change of direction of a degree, or of position of 1e-3 of the
// sum's radius, through all bisections.
inline constexpr int kBisections = 30;
bool IsSmallStep(const Eigen::Vector3d& p, const Eigen::Vector3d& q);
bool HasJump(const std::function<Eigen::Vector3d(double)>& at, double from, double to);

// Whether CPD jumps between two moments: followed from the state at the first in steps that are
// halved until they are small, all the way; a step that is not small after all bisections is a
// jump. And whether the triangles round the solution changed there.
struct CpdEvent {
  bool jumps = false, by_combinatorics = false;
};
CpdEvent FindCpdEvent(const PaperScene& scene, ContinuousPenetrationDepth* solver,
                      const ContinuousDepthState& state, double from, double to);

struct CpdBenchRow {
  std::string scene, method;
  double median_ms = 0.0, p99_ms = 0.0;
  int frames = 0, events = 0, jumps = 0, findings = 0;
  int combinatorial = 0;  // of the events; they excuse nothing
};

struct CpdBenchOptions {
  int frames = 200;          // a motion
  int judged_frames = 10;    // of each scene, by the exact half
  int bisected_steps = 200;  // of each scene and method, at most; others count as events
  double seconds = 1e9;      // for bisecting and judging, each scene
};
// Rows of one scene: mink, phong, total (Table 1's columns), CPD by mean normals, the depth cold
// and coherent, and the contact-space projection cold and coherent.
std::vector<CpdBenchRow> BenchCpdScene(const PaperScene& scene, const CpdBenchOptions& options);

// Theorem 3's premise on a scene: the largest angle between the normals at the corners of a
// triangle, of all triangles of ∂M at some moments of the motion, and of those with the solutions.
struct PremiseRow {
  std::string scene;
  int moments = 0;
  long triangles = 0;
  double median_deg = 0.0, share_above_10 = 0.0;
  int solutions = 0;
  double solutions_median_deg = 0.0, solutions_above_10 = 0.0;
};
PremiseRow MeasurePremise(const PaperScene& scene, int moments, int frames);

// What the exact half finds wrong with a depth; empty when it stands.
std::vector<std::string> JudgedMeshDepth(const TriangleMesh& a, const TriangleMesh& b,
                                         const RelativePose& pose, const MeshDepthResult& result,
                                         int samples);

// What the exact half finds wrong with the solver's last answer, found with these options at this
// pose: see exact/judge_cpd.h. An answer that claims to be the nearest is, by the local sum's
// triangles. Empty when it stands, and where it is no projection and claims nothing.
std::vector<std::string> JudgedPhong(const TriangleMesh& a, const TriangleMesh& b,
                                     const RelativePose& pose,
                                     const ContinuousPenetrationDepth& solver,
                                     const ContinuousDepthOptions& options,
                                     const ContinuousDepthResult& result, double depth_lower_bound);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_CPD_RUN_H_
