// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <vector>

#include "touchstone/exact/judge/nearest_on_triangle.h"
#include "touchstone/exact/judge_cpd.h"
#include "touchstone/exact/mesh_membership.h"
#include "touchstone/exact/mesh_pair.h"

namespace touchstone::exact {
namespace {

using Eigen::Vector3d;

// SplitMix64.
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : state_(seed) {}
  std::uint64_t Bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  double Unit() { return static_cast<double>(Bits() >> 11) * 0x1p-53; }
  Vector3d Direction() {
    while (true) {
      const Vector3d v(2 * Unit() - 1, 2 * Unit() - 1, 2 * Unit() - 1);
      if (v.squaredNorm() <= 1.0 && v.squaredNorm() > 1e-4) return v.normalized();
    }
  }

 private:
  std::uint64_t state_;
};

// Each edge once: of the two faces that it joins, the one that runs it upward tells.
std::vector<std::array<int, 2>> EdgesOf(const TriangleMesh& mesh) {
  std::vector<std::array<int, 2>> edges;
  for (const Triangle& f : mesh.faces()) {
    for (int k = 0; k < 3; ++k) {
      if (f[k] < f[(k + 1) % 3]) edges.push_back({f[k], f[(k + 1) % 3]});
    }
  }
  return edges;
}

class DepthJudge {
 public:
  DepthJudge(const TriangleMesh& a, const TriangleMesh& b, const RelativePose& pose,
             const MeshDepthClaim& claim, const DepthJudgeOptions& options)
      : pair_(a, b, pose), claim_(claim), options_(options), numbers_(options.seed) {}

  std::vector<std::string> Run() {
    if (!claim_.translation.allFinite() || !(claim_.lower_bound >= 0.0) ||
        !(claim_.upper_bound >= claim_.lower_bound)) {
      findings_.push_back("depth: not finite, or the lower bound above the upper one");
      return findings_;
    }
    CheckUpperBound();
    if (claim_.lower_bound > 0.0) {
      Expect(Vector3d::Zero(), true);
      CheckBall();
      CheckFacets();
    }
    return findings_;
  }

 private:
  void Expect(const Vector3d& x, bool overlap) {
    if ((MeshMembership(pair_, ExactTranslation(x)) == Verdict::kOverlap) == overlap) return;
    std::ostringstream out;
    out.precision(17);
    out << "depth: B moved by (" << x[0] << ", " << x[1] << ", " << x[2] << "), "
        << (overlap ? "less than the lower bound, does not overlap" : "the translation, overlaps");
    findings_.push_back(out.str());
  }

  void CheckUpperBound() {
    const double length = claim_.translation.norm();
    // The norm is good to four roundings; a rounded point may be off by as much as it says.
    const double slack = (claim_.is_rounded ? 1e-11 : 0x1p-50) * std::max(length, pair_.size());
    if (length > claim_.upper_bound + slack) {
      findings_.push_back("depth: the translation is longer than the upper bound");
    }
    if (!claim_.is_rounded) Expect(claim_.translation, false);
  }

  // Points below the bound by a little, where it would first be wrong, in all directions and round
  // that of the answer.
  void CheckBall() {
    const Vector3d direction = claim_.translation.normalized();
    for (int i = 0; i < options_.ball_samples; ++i) {
      const Vector3d random = numbers_.Direction();
      const double spread = std::ldexp(1.0, -3 * (i % 6));
      const Vector3d toward = i % 2 == 0 ? random : (direction + spread * random).normalized();
      Expect(claim_.lower_bound * (1.0 - std::ldexp(1.0, -4 - 4 * (i % 8))) * toward, true);
    }
  }

  // Where any face of one passes over any vertex of the other, or any two edges: there M° can end.
  void CheckFacets() {
    const TriangleMesh &a = pair_.a(), &b = pair_.b();
    const auto &p = pair_.doubles_a(), &q = pair_.doubles_b();
    for (const Triangle& f : a.faces()) {
      for (const Vector3d& v : q) Consider(p[f[0]] - v, p[f[1]] - v, p[f[2]] - v);
    }
    for (const Triangle& f : b.faces()) {
      for (const Vector3d& v : p) Consider(v - q[f[0]], v - q[f[1]], v - q[f[2]]);
    }
    const std::vector<std::array<int, 2>> edges_a = EdgesOf(a), edges_b = EdgesOf(b);
    for (const auto& [tail_a, head_a] : edges_a) {
      const Vector3d &p0 = p[tail_a], &p1 = p[head_a];
      for (const auto& [tail_b, head_b] : edges_b) {
        const Vector3d &q0 = q[tail_b], &q1 = q[head_b];
        Consider(p0 - q0, p1 - q0, p1 - q1);
        Consider(p0 - q0, p1 - q1, p0 - q1);
      }
    }
    for (const Vector3d& x : chosen_) Expect(x, true);
  }

  // A reservoir of the nearest points, moved a little outward, that are still below the bound.
  void Consider(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const double bound = claim_.lower_bound;
    Vector3d x = NearestOnTriangle(a, b, c);
    if (!(x.norm() < bound)) return;
    const double u = numbers_.Unit(), v = numbers_.Unit() * (1.0 - u);
    const Vector3d other = a + u * (b - a) + v * (c - a);
    if ((numbers_.Bits() & 1) != 0 && other.norm() < bound) x = other;
    x *= 1.0 + 1e-9;
    if (!(x.norm() < bound * (1.0 - 1e-12))) return;
    ++seen_;
    const int capacity = options_.facet_samples;
    if (static_cast<int>(chosen_.size()) < capacity) {
      chosen_.push_back(x);
      return;
    }
    const std::uint64_t slot = numbers_.Bits() % seen_;
    if (slot < static_cast<std::uint64_t>(capacity)) chosen_[slot] = x;
  }

  const PlacedMeshPair pair_;
  const MeshDepthClaim& claim_;
  const DepthJudgeOptions& options_;
  Numbers numbers_;
  std::uint64_t seen_ = 0;
  std::vector<Vector3d> chosen_;
  std::vector<std::string> findings_;
};

}  // namespace

std::vector<std::string> JudgeMeshDepth(const TriangleMesh& a, const TriangleMesh& b,
                                        const RelativePose& pose, const MeshDepthClaim& claim,
                                        const DepthJudgeOptions& options) {
  return DepthJudge(a, b, pose, claim, options).Run();
}

}  // namespace touchstone::exact
