// SPDX-License-Identifier: MIT
#include "touchstone/tools/bench/phase_bench.h"

#include <algorithm>
#include <chrono>
#include <optional>

#include "touchstone/core/cd_dual/edge_edge.h"
#include "touchstone/core/cd_dual/face_vertex.h"
#include "touchstone/core/cd_dual/vertex_face.h"
#include "touchstone/tools/bench/workload.h"

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kTurns = 3;

volatile double sink;

// The steps of SearchPublished (cd_dual/published.cc) with early exit, up to the end of stage
// `last`.
void RunStages(const ConvexPolyhedron& p, const ConvexPolyhedron& q, const RelativePose& pose,
               std::size_t last) {
  std::array<PhaseCounts, kPhaseCount> counts{};
  SearchLog log{&counts, nullptr};
  MinkowskiDifference m(p, q, pose);
  ChooseInteriorDifference(&m);
  sink = m.c_norm();
  if (last == 0) return;
  const int first = HeuristicFirstFace(m);
  sink = first;
  if (last == 1) return;
  FaceOfM face = SearchFaceVertex(m, first, -1, true, &log);
  sink = face.signed_distance;
  if (last == 2 || face.signed_distance > 0.0) return;
  const auto incident = q.vertex_faces(face.corner.q);
  const FaceOfM vertex_face = SearchVertexFace(
      m, *std::min_element(incident.begin(), incident.end()), face.corner.p, true, &log);
  if (vertex_face.signed_distance > face.signed_distance) face = vertex_face;
  sink = face.signed_distance;
  if (last == 3 || face.signed_distance > 0.0) return;
  std::optional<FaceOfM> best;
  sink = SearchEdgeEdge(m, face, true, &log, &best).signed_distance;
}

double TimeStages(const ConvexPolyhedron& p, const ConvexPolyhedron& q, const RelativePose& pose,
                  std::size_t last, int repeats) {
  const Clock::time_point start = Clock::now();
  for (int k = 0; k < repeats; ++k) RunStages(p, q, pose, last);
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count() / repeats;
}

}  // namespace

std::vector<PhaseTimes> RunPhaseBench(const PhaseBenchOptions& options) {
  constexpr std::size_t kStages = kPublishedStages.size();
  const Workload workload =
      MakeRepeatWorkload({"ellipsoid-2", options.n, options.seed, ""}, options.orientations);
  const int per_turn = std::max(1, options.repeats / kTurns);
  std::vector<PhaseTimes> rows;
  for (const double gap : options.gaps) {
    PhaseTimes& row = rows.emplace_back();
    row.n = options.n;
    row.gap = gap;
    for (const BenchLine& line : workload.lines) {
      const RelativePose pose = PoseAtTravel(line.line, gap);
      const ConvexPolyhedron& p = workload.bodies[line.p];
      const ConvexPolyhedron& q = workload.bodies[line.q];
      std::array<std::array<double, kTurns>, kStages> turns;
      for (int t = 0; t < kTurns; ++t) {
        for (std::size_t s = 0; s < kStages; ++s) turns[s][t] = TimeStages(p, q, pose, s, per_turn);
      }
      double before = 0.0;
      for (std::size_t s = 0; s < kStages; ++s) {
        std::sort(turns[s].begin(), turns[s].end());
        const double until = std::max(before, turns[s][kTurns / 2]);
        row.ns[s] += (until - before) / static_cast<double>(workload.lines.size());
        before = until;
      }
    }
  }
  return rows;
}

}  // namespace touchstone
