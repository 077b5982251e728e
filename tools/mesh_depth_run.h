// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_MESH_DEPTH_RUN_H_
#define TOUCHSTONE_TOOLS_MESH_DEPTH_RUN_H_

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace touchstone {

// How B is placed.
enum class DepthPlacement {
  kAnywhere,  // overlapping A, turned anyhow; each from nothing
  kOnGrid,    // turned by a rotation of the cube, a vertex on a vertex and quarters off
  kMoving,    // along a slow motion, from what the step before left
  kLocked,    // a spike in a dent, turned and moved a little: natural vertices
};
inline constexpr int kDepthPlacementCount = 4;
std::string_view ToString(DepthPlacement placement);

struct MeshDepthStats {
  std::uint64_t placements = 0, overlapping = 0;
  std::uint64_t certain = 0;      // of those that overlap
  std::uint64_t by_boundary = 0;  // decided by the arrangement
  std::uint64_t natural_vertices = 0;
  std::uint64_t judged = 0;  // that the exact half came to an end with
  std::uint64_t late = 0;    // that it did not, in the time given
  std::uint64_t wrong = 0;
  std::vector<std::string> samples;     // of what was wrong, one line each
  std::vector<std::string> late_pairs;  // by Nef polyhedra
};

struct MeshDepthRunOptions {
  std::uint64_t seed = 1, first = 0, count = 0;
  // Small bodies against the whole boundary by Nef polyhedra, so long a placement at most, in place
  // of larger ones against samples of their bounds.
  bool nef = false;
  double nef_seconds = 30.0;
};

// Global depths of two meshes, each held against the exact half. Placement i is the same on every
// machine, whatever the range: a run can be made in pieces, and counts add up. Random pairs of all
// shapes, of up to about 200 faces; with `nef` every pair in its turn, of about 24.
std::array<MeshDepthStats, kDepthPlacementCount> RunMeshDepths(
    const MeshDepthRunOptions& options, const std::function<void(double)>& report);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_MESH_DEPTH_RUN_H_
