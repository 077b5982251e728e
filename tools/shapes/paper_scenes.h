// SPDX-License-Identifier: MIT
//
// The four benchmarks of the paper on penetration depth (Lee, Behar, Lien, Kim 2016, section 7.1),
// fixed here once: the paper gives neither meshes nor axes, amplitudes, frame counts or units.
#ifndef TOUCHSTONE_TOOLS_SHAPES_PAPER_SCENES_H_
#define TOUCHSTONE_TOOLS_SHAPES_PAPER_SCENES_H_

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "touchstone/core/base/relative_pose.h"
#include "touchstone/tools/shapes/shape.h"

namespace touchstone {

// B stands still at the origin; A turns steadily about a fixed line while it travels. Bodies
// overlap at every moment. Both are scaled alike, such that the radii of two spheres that hold them
// add up to kPaperSumRadius: M lies in a ball of that radius.
//
//   scene        faces        what A does
//   cone-axes    1000 x 36    the cone slides along a bar to the corner, turning about an axis near
//   y spoon-cup    1300 x 1008  the spoon stands leaning in the cup and turns about its own axis
//   fish-torus   950 x 1600   the fish stands in the hole, into the tube, and turns about its axis
//   torus-torus  2000 x 2000  one torus, linked with the other and into it, revolves round its axis
struct PaperScene {
  std::string name;
  Shape a, b;
  WorldPose start;        // of A
  Eigen::Vector3d axis;   // of unit length
  Eigen::Vector3d pivot;  // a point of the line
  Eigen::Vector3d travel;
  double turn;  // radians

  // A's placement at s, from 0 at the start to 1 at the end; any s is legal.
  WorldPose PlacementOfA(double s) const;
  // B's placement in A's frame then: the truth is in its doubles.
  RelativePose PoseAt(double s) const;
  // The s at which A has turned by so many degrees.
  double AtTurn(double degrees) const;
};

inline constexpr double kPaperSumRadius = 250.0;
// Of the ball in Table 2 and Figure 12.
inline constexpr double kPaperBallRadius = 50.0;
// From start to end.
inline constexpr int kPaperFrames = 360;

std::span<const PaperScene> AllPaperScenes();
// Null for an unknown name.
const PaperScene* FindPaperScene(const std::string& name);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_SHAPES_PAPER_SCENES_H_
