// SPDX-License-Identifier: MIT
#include <cassert>

#include "touchstone/tools/suites/arithmetic.h"
#include "touchstone/tools/suites/random.h"
#include "touchstone/tools/suites/registry.h"
#include "touchstone/tools/suites/reported_cases.h"
#include "touchstone/tools/suites/shapes.h"

namespace touchstone {
namespace {

struct Placed {
  ConvexPolyhedron p, q;
  WorldPose p_pose, q_pose;
};

WorldPose ToWorldPose(const std::array<double, 12>& rows) {
  WorldPose pose;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) pose.rotation(i, j) = rows[4 * i + j];
    pose.translation[i] = rows[4 * i + 3];
  }
  return pose;
}

ConvexPolyhedron Hull(std::span<const Eigen::Vector3d> points) {
  StatusOr<ConvexPolyhedron> body = HullBody(points, FacetStyle::kMerged);
  assert(body.ok());
  return *body;
}

std::vector<Placed> BuildCases() {
  std::vector<Placed> cases;
  for (const ReportedCase& reported : ReportedCases()) {
    cases.push_back({Hull(reported.p), Hull(reported.q), ToWorldPose(reported.p_pose),
                     ToWorldPose(reported.q_pose)});
  }
  return cases;
}

class ReportedSuite : public Suite {
 public:
  std::string_view name() const override { return "reported"; }
  std::string_view summary() const override {
    return "cases that users of other libraries reported, as reported, swapped, and moved by a few "
           "ulps";
  }
  std::string_view attacks() const override {
    return "what went wrong elsewhere: one ulp apart, parallel faces, slivers; poses in the world";
  }

  // The cases as they are, then swapped, then with some coordinates of the translations moved by up
  // to four ulps.
  PlacedPair Generate(std::uint64_t seed, std::uint64_t index) const override {
    static const std::vector<Placed> kCases = BuildCases();
    const std::size_t number = index % kCases.size();
    const std::uint64_t round = index / kCases.size();
    Placed placed = kCases[number];
    if (round >= 2) {
      Random random(name(), seed, index);
      Nudge(random, placed.p_pose.translation);
      Nudge(random, placed.q_pose.translation);
    }
    if (round % 2 == 1) {
      std::swap(placed.p, placed.q);
      std::swap(placed.p_pose, placed.q_pose);
    }
    StatusOr<RelativePose> pose = RelativePose::FromWorld(placed.p_pose, placed.q_pose);
    assert(pose.ok());
    PlacedPair pair{placed.p, placed.q, *pose};
    if (round < 2) pair.expected = ReportedCases()[number].verdict;
    return pair;
  }

 private:
  static void Nudge(Random& random, Eigen::Vector3d& translation) {
    for (int i = 0; i < 3; ++i) {
      const int steps = random.Integer(-4, 4);
      for (int k = 0; k < std::abs(steps); ++k)
        translation[i] = StepUlp(translation[i], steps > 0, 0.25);
    }
  }
};

}  // namespace

std::unique_ptr<Suite> MakeReportedSuite() { return std::make_unique<ReportedSuite>(); }

}  // namespace touchstone
