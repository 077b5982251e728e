// SPDX-License-Identifier: MIT
//
// Ten million signs of nearly flat determinants and nearly level edges, at scales from 2^-300 to
// 2^300: where doubles decide, integers agree. The integers are 128 bits wide and share nothing
// with the core's own big numbers.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "touchstone/core/cd_dual/signs.h"
#include "touchstone/tests/cd_dual/placements.h"
#include "touchstone/tests/testing/shapes.h"

namespace touchstone::testing {
namespace {

#ifdef TOUCHSTONE_SANITIZED
constexpr long kSigns = 200'000;  // slow builds look for other faults
#else
constexpr long kSigns = 10'000'000;
#endif

__extension__ typedef __int128 Wide;  // NOLINT(modernize-use-using)
using Point = std::array<std::int64_t, 3>;

Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

// (a x b) . c; entries below 2^26 keep it below 2^81.
int SignOfTriple(const Point& a, const Point& b, const Point& c) {
  const auto w = [](std::int64_t x) { return static_cast<Wide>(x); };
  const Wide value = w(c[0]) * (w(a[1]) * b[2] - w(a[2]) * b[1]) +
                     w(c[1]) * (w(a[2]) * b[0] - w(a[0]) * b[2]) +
                     w(c[2]) * (w(a[0]) * b[1] - w(a[1]) * b[0]);
  return (value > 0) - (value < 0);
}

// A tetrahedron on a coarse lattice, each coordinate off by up to `noise`: small beside the
// lattice's 2^20, so that everything is nearly flat, parallel, coincident.
struct Tetra {
  std::array<Point, 4> corners;

  Tetra(Random* random, int noise) {
    do {
      for (Point& corner : corners) {
        for (std::int64_t& x : corner) {
          x = (std::int64_t{random->Int(-2, 2)} << 20) + random->Int(-noise, noise);
        }
      }
    } while (Orientation() == 0);
    if (Orientation() < 0) std::swap(corners[0], corners[1]);
  }

  int Orientation() const {
    return SignOfTriple(corners[1] - corners[0], corners[2] - corners[0], corners[3] - corners[0]);
  }

  // Nothing when the body is too thin to have an interior point among the doubles.
  StatusOr<ConvexPolyhedron> Build(double scale) const {
    std::vector<Eigen::Vector3d> vertices;
    for (const Point& c : corners) {
      vertices.push_back(scale * Eigen::Vector3d(static_cast<double>(c[0]),
                                                 static_cast<double>(c[1]),
                                                 static_cast<double>(c[2])));
    }
    const std::vector<std::vector<int>> faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return ConvexPolyhedron::Build(vertices, faces);
  }
};

struct Tally {
  long asked = 0, decided = 0, zeros = 0;

  void Check(std::optional<int> claimed, int truth) {
    ++asked;
    zeros += truth == 0;
    if (!claimed) return;
    ++decided;
    ASSERT_EQ(*claimed, truth);
  }
};

TEST(Filters, NeverContradictExactSigns) {
  Random random(1);
  Tally determinants, normals;
  while (determinants.asked + normals.asked < kSigns) {
    const int noise = random.Int(0, 9) == 0 ? 0 : 1 << random.Int(0, 12);
    const double scale = std::ldexp(1.0, random.Int(-300, 300));
    const Tetra tp(&random, noise), tq(&random, noise);
    const auto p = tp.Build(scale), q = tq.Build(scale);
    if (!p.ok() || !q.ok()) continue;
    // The same quarter turn for both kinds of number.
    const Point shift = {std::int64_t{random.Int(-2, 2)} << 20, random.Int(-noise, noise), 0};
    const RelativePose pose = MustPose(
        (Eigen::Matrix3d() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished(),
        scale * Eigen::Vector3d(static_cast<double>(shift[0]), static_cast<double>(shift[1]), 0.0));
    const auto turned = [](const Point& x) { return Point{-x[1], x[0], x[2]}; };
    const auto point = [&](VertexPair v) {
      return (tp.corners[v.p] - turned(tq.corners[v.q])) - shift;
    };
    const MinkowskiDifference m(*p, *q, pose);
    Signs signs(m, Certainty::kFloat);
    std::array<VertexPair, 16> pairs;
    for (int i = 0; i < 16; ++i) pairs[i] = {i / 4, i % 4};
    for (int i = 0; i < 16; ++i) {
      for (int j = i + 1; j < 16; ++j) {
        for (int k = j + 1; k < 16; ++k) {
          const Point a = point(pairs[i]), b = point(pairs[j]), c = point(pairs[k]);
          determinants.Check(signs.Determinant(pairs[i], pairs[j], pairs[k]),
                             SignOfTriple(a, b, c));
          FacetPlane plane = signs.Plane({pairs[i], pairs[j], pairs[k]});
          const int from = (i + k) % 4, to = (from + 1 + j % 3) % 4;
          normals.Check(signs.AlongNormal(&plane, Body::kP, to, from),
                        SignOfTriple(b - a, c - a, tp.corners[to] - tp.corners[from]));
          normals.Check(
              signs.AlongNormal(&plane, Body::kQ, to, from),
              SignOfTriple(b - a, c - a, turned(tq.corners[from]) - turned(tq.corners[to])));
        }
      }
    }
    if (HasFatalFailure()) return;
  }
  for (const Tally& tally : {determinants, normals}) {
    EXPECT_GT(tally.zeros, tally.asked / 400);                  // exact zeros were among them,
    EXPECT_LE(tally.decided, tally.asked - tally.zeros);        // no filter decides those,
    EXPECT_GT(tally.decided, (tally.asked - tally.zeros) / 2);  // and most others it does
  }
}

}  // namespace
}  // namespace touchstone::testing
