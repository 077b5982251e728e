// SPDX-License-Identifier: MIT
//
// Two small bodies of any numbers under any pose that is one: every query ends, says no NaN, and
// says the same however it is asked.
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "touchstone/core/cd_dual/cd_dual.h"
#include "touchstone/core/proximity/distance.h"
#include "touchstone/core/proximity/penetration_depth.h"
#include "touchstone/tests/fuzz/bytes.h"

namespace touchstone {
namespace {

// A tetrahedron, or a double pyramid over a triangle, turned inside out where that is needed.
std::optional<ConvexPolyhedron> Body(Bytes& bytes) {
  const bool five = bytes.Below(3) == 0;
  std::vector<Eigen::Vector3d> vertices(five ? 5 : 4);
  for (Eigen::Vector3d& v : vertices) v = bytes.Point();
  std::vector<std::vector<int>> faces =
      five ? std::vector<std::vector<int>>{{0, 1, 3}, {1, 2, 3}, {2, 0, 3},
                                           {1, 0, 4}, {2, 1, 4}, {0, 2, 4}}
           : std::vector<std::vector<int>>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  StatusOr<ConvexPolyhedron> body = ConvexPolyhedron::Build(vertices, faces);
  if (body.ok()) return *body;
  for (std::vector<int>& face : faces) std::swap(face[0], face[1]);
  body = ConvexPolyhedron::Build(vertices, faces);
  if (body.ok()) return *body;
  return std::nullopt;
}

std::optional<RelativePose> Pose(Bytes& bytes) {
  static const std::array<Eigen::Matrix3d, 3> kRotations = [] {
    std::array<Eigen::Matrix3d, 3> all;
    all[0].setIdentity();
    all[1] << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    all[2] << 0.36, 0.48, -0.8, -0.8, 0.6, 0.0, 0.48, 0.64, 0.6;
    return all;
  }();
  Eigen::Matrix3d rotation = kRotations[static_cast<std::size_t>(bytes.Below(3))];
  for (int k = bytes.Below(4); k > 0; --k) {
    double& entry = rotation(bytes.Below(3), bytes.Below(3));
    entry = std::nextafter(entry, bytes.Below(2) == 0 ? 2.0 : -2.0);
  }
  const StatusOr<RelativePose> pose = RelativePose::Make(rotation, bytes.Point());
  if (!pose.ok()) return std::nullopt;
  return *pose;
}

bool IsSound(const BoundedValue& value) { return !std::isnan(value.value) && value.error >= 0.0; }

void CheckResult(const CollideResult& result) {
  Require(!result.signed_distance || IsSound(*result.signed_distance), "d is a number");
  Require(!result.exit_travel || IsSound(*result.exit_travel), "g is a number");
  Require(!result.exit_point || !result.exit_point->hasNaN(), "the exit point is one");
  Require(!result.certificate.direction.hasNaN(), "the direction is one");
}

void TryQueries(Bytes bytes) {
  const std::optional<ConvexPolyhedron> p = Body(bytes);
  if (!p) return;
  const std::optional<ConvexPolyhedron> q = Body(bytes);
  if (!q) return;
  const std::optional<RelativePose> pose = Pose(bytes);
  if (!pose) return;
  const CollideResult portal = Collide(*p, *q, *pose);
  CheckResult(portal);
  Require(portal.verdict != Verdict::kUndecided, "an exact query decides");
  CollideCache cache;
  for (const Search search : {Search::kPublished, Search::kPhased, Search::kPortal}) {
    for (const Certainty certainty : {Certainty::kFloat, Certainty::kExact}) {
      for (const bool early : {false, true}) {
        const CollideResult result = Collide(
            *p, *q, *pose, {.search = search, .certainty = certainty, .early_exit = early}, &cache);
        CheckResult(result);
        if (search == Search::kPublished) continue;  // its verdict is not proven
        Require(result.verdict == portal.verdict ||
                    (certainty == Certainty::kFloat && result.verdict == Verdict::kUndecided),
                "all searches agree");
      }
    }
  }
  const DistanceResult distance = Distance(*p, *q, *pose);
  Require(IsSound(distance.distance), "the distance is a number");
  Require((distance.kind == DistanceKind::kSeparate) == (portal.verdict == Verdict::kSeparate),
          "a distance where they are separate");
  const PenetrationResult depth = PenetrationDepth(*p, *q, *pose);
  Require(IsSound(depth.depth), "the depth is a number");
  Require(depth.verdict == portal.verdict, "the depth's verdict is the verdict");
}

}  // namespace
}  // namespace touchstone

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  touchstone::TryQueries(touchstone::Bytes(data, size));
  return 0;
}
