// SPDX-License-Identifier: MIT
#include "touchstone/tools/cpd_profile.h"

#include <Eigen/Core>
#include <chrono>
#include <cmath>

#include "touchstone/core/cpd/continuous_penetration_depth.h"
#include "touchstone/core/cpd/mesh_penetration_depth.h"
#include "touchstone/core/mesh/membership.h"
#include "touchstone/tools/bench/times.h"
#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {

using Eigen::Vector3d;

CpdProfile ProfileCpd(const PaperScene& scene, HeapMeter heap) {
  CpdProfile profile;
  profile.scene = scene.name;
  const TriangleMesh a = MustBuild(scene.a), b = MustBuild(scene.b);
  const double step = scene.AtTurn(0.1) - scene.AtTurn(0.0);
  const long before = heap != nullptr ? heap().bytes : 0;
  ContinuousPenetrationDepth solver(a, b);
  for (int i = 0; i < 60; ++i) solver.Update(scene.PoseAt(0.3 + i * step));
  if (heap != nullptr) profile.solver_mb = static_cast<double>(heap().bytes - before) * 1e-6;

  const MeshPair pair(a, b, scene.PoseAt(0.3));
  const ContactBody body_a(a), body_b(b);
  const Vector3d q = MeshPenetrationDepth(pair, body_a, body_b).translation;
  MembershipCache cache;
  // Points along and round the way out: from well inside to well outside, and off the touch.
  const auto median_us = [&](const auto& point_at, int repeats) {
    std::vector<double> times;
    for (int i = 0; i < 200; ++i) {
      const Vector3d x = point_at(i);
      // By the clock: to ask for the processor's own time takes longer than some of these. What is
      // interrupted does not move the median.
      if (repeats == 1) cache.crossing = {};
      const auto begin = std::chrono::steady_clock::now();
      for (int k = 0; k < repeats; ++k) Membership(pair, x, {Certainty::kFloat}, &cache);
      const std::chrono::duration<double, std::micro> spent =
          std::chrono::steady_clock::now() - begin;
      times.push_back(spent.count() / repeats);
    }
    return Quantile(times, 0.5);
  };
  const auto wobble = [&](int i) {
    return Vector3d(1e-2 * q.norm() * Vector3d(std::sin(i), std::cos(2.0 * i), std::sin(3.0 * i)));
  };
  profile.overlapping_us = median_us([&](int i) { return Vector3d(0.3 * q + wobble(i)); }, 1);
  profile.separate_us = median_us(
      [&](int i) { return Vector3d(q + 0.1 * kPaperSumRadius * q.normalized() + wobble(i)); }, 1);
  profile.near_touch_us =
      median_us([&](int i) { return Vector3d(q * (1.0 + (i % 2 == 0 ? 1e-7 : -1e-7))); }, 1);
  profile.witness_ns = 1e3 * median_us([&](int i) { return Vector3d(0.3 * q + wobble(i)); }, 1000);
  return profile;
}

DepthGrowthRow MeasureDepthGrowth(int faces) {
  constexpr int kMoments = 20;
  const PaperScene& scene = *FindPaperScene("torus-torus");
  // The scene's tori are the shape at 2000 faces, scaled.
  const double scale = scene.a.vertices[0].norm() / NamedShape("torus", 2000).vertices[0].norm();
  const TriangleMesh mesh = MustBuild(Moved(NamedShape("torus", faces), scale, Vector3d::Zero()));
  DepthGrowthRow row{mesh.face_count(), 0.0, 0.0, 0.0};
  const double before = ProcessorMs();
  const ContactBody body(mesh);
  row.body_ms = ProcessorMs() - before;
  MeshPair pair(mesh, mesh, scene.PoseAt(0.0));
  MeshDepthCache cache;
  const auto timed_at = [&](double s) {
    pair.Place(scene.PoseAt(s));
    const double begin = ProcessorMs();
    MeshPenetrationDepth(pair, body, body, {}, &cache);
    return ProcessorMs() - begin;
  };
  std::vector<double> cold, coherent;
  for (int i = 0; i < kMoments; ++i) {
    cache.Clear();
    cold.push_back(timed_at((i + 0.5) / kMoments));
  }
  const double tenth = scene.AtTurn(0.1) - scene.AtTurn(0.0);
  timed_at(0.3);
  for (int i = 1; i <= kMoments; ++i) coherent.push_back(timed_at(0.3 + i * tenth));
  row.cold_ms = Quantile(cold, 0.5);
  row.coherent_ms = Quantile(coherent, 0.5);
  return row;
}

}  // namespace touchstone
