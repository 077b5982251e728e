// SPDX-License-Identifier: MIT
#include "touchstone/core/mesh/link.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <vector>

#include "touchstone/tests/testing/random.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

Link LinkOf(const std::vector<Vector3d>& corners) {
  Link link;
  for (const Vector3d& corner : corners) link.push_back(MakeLinkDirection(ToDyadic(corner)));
  return link;
}

Link Complement(Link link) {
  std::reverse(link.begin(), link.end());
  return link;
}

const std::vector<Vector3d> kOctant = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

TEST(LinkOverlap, OctantsMeetTheirOwnAndTouchTheOthers) {
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) {
      const auto octant = [](int signs) {
        std::vector<Vector3d> corners = kOctant;
        for (int k = 0; k < 3; ++k) corners[k][k] = signs >> k & 1 ? -1 : 1;
        if (std::popcount(static_cast<unsigned>(signs)) % 2 == 1) std::swap(corners[0], corners[1]);
        return LinkOf(corners);
      };
      EXPECT_EQ(LinksOverlap(octant(i), octant(j)), i == j) << i << ' ' << j;
      EXPECT_EQ(LinksOverlap(octant(i), Complement(octant(j))), i != j) << i << ' ' << j;
    }
  }
}

// Hemispheres as three, four or five corners on their great circle.
TEST(LinkOverlap, Hemispheres) {
  const auto hemisphere = [](int corners, double sign) {
    const std::vector<Vector3d> all = {{1, 0, 0}, {1, 2, 0}, {-1, 1, 0}, {-2, -1, 0}, {1, -3, 0}};
    std::vector<Vector3d> some;
    for (int k = 0; k < corners; ++k) {
      const Vector3d& c = corners == 3 ? all[std::vector<int>{0, 2, 3}[k]] : all[k];
      some.emplace_back(c[0], sign * c[1], 0);
    }
    return LinkOf(some);
  };
  for (int m = 3; m <= 5; ++m) {
    for (int n = 3; n <= 5; ++n) {
      if (m == 4 || n == 4) continue;  // four of these span no full circle
      EXPECT_TRUE(LinksOverlap(hemisphere(m, 1), hemisphere(n, 1)));
      EXPECT_FALSE(LinksOverlap(hemisphere(m, 1), hemisphere(n, -1)));
    }
  }
}

TEST(LinkOverlap, InsideAndAround) {
  const Link octant = LinkOf(kOctant);
  const Link small = LinkOf({{3, 2, 2}, {2, 3, 2}, {2, 2, 3}});
  EXPECT_TRUE(LinksOverlap(octant, small));
  EXPECT_TRUE(LinksOverlap(small, octant));
  EXPECT_FALSE(LinksOverlap(Complement(octant), small));
  EXPECT_FALSE(LinksOverlap(small, Complement(octant)));
  EXPECT_TRUE(LinksOverlap(octant, Complement(small)));
  EXPECT_TRUE(LinksOverlap(Complement(octant), Complement(small)));
  // The antipode of a link is elsewhere.
  const Link opposite = LinkOf({{-3, -2, -2}, {-2, -2, -3}, {-2, -3, -2}});
  EXPECT_FALSE(LinksOverlap(octant, opposite));
  EXPECT_TRUE(LinksOverlap(Complement(octant), opposite));
}

// A corner on a side, and a corner on a corner, by the smallest steps.
TEST(LinkOverlap, CornersOnSides) {
  const Link octant = LinkOf(kOctant);
  for (const double step : {0.0, 1e-300, -1e-300}) {
    // A triangle below the side from x to y with a corner on it, moved up by `step`.
    const Link below = LinkOf({{1, 1, step}, {2, 1, -1}, {1, 2, -1}});
    EXPECT_EQ(LinksOverlap(octant, below), step > 0) << step;
    EXPECT_EQ(LinksOverlap(below, octant), step > 0) << step;
    // The same at the octant's own corner.
    const Link at_corner = LinkOf({{1, step, step}, {2, -1, 0.5}, {2, 0.5, -1}});
    EXPECT_EQ(
        LinksOverlap(octant, Complement(LinkOf({{1, step, step}, {2, 0.5, -1}, {2, -1, 0.5}}))),
        LinksOverlap(octant, at_corner));
  }
  // Sectors that share a side from the corner x on: on top of each other, or side by side.
  EXPECT_TRUE(LinksOverlap(octant, LinkOf({{1, 0, 0}, {1, 1, 0}, {4, 1, 1}})));
  EXPECT_FALSE(LinksOverlap(octant, LinkOf({{1, 0, 0}, {4, 1, -1}, {1, 1, 0}})));
}

// Against a count of random directions in both.
TEST(LinkOverlap, AgreesWithSampling) {
  testing::Random random(11);
  int overlaps = 0, disjoint = 0;
  for (int i = 0; i < 400; ++i) {
    const auto triangle = [&] {
      while (true) {
        const Vector3d middle = random.Direction();
        std::vector<Vector3d> corners;
        for (int k = 0; k < 3; ++k) corners.push_back(middle + 0.8 * random.Direction());
        const Vector3d normal = corners[1].cross(corners[2]);
        if (corners[0].dot(normal) < 0.02) continue;
        return corners;
      }
    };
    const std::vector<Vector3d> p = triangle(), q = triangle();
    const auto holds = [](const std::vector<Vector3d>& t, const Vector3d& d) {
      return t[0].cross(t[1]).dot(d) > 0 && t[1].cross(t[2]).dot(d) > 0 &&
             t[2].cross(t[0]).dot(d) > 0;
    };
    bool found = false;
    for (int k = 0; k < 20000 && !found; ++k) {
      const Vector3d d = random.Unit() * p[0] + random.Unit() * p[1] + random.Unit() * p[2];
      found = holds(q, d);
    }
    const bool overlap = LinksOverlap(LinkOf(p), LinkOf(q));
    EXPECT_TRUE(overlap || !found);
    EXPECT_EQ(overlap, LinksOverlap(LinkOf(q), LinkOf(p)));
    EXPECT_TRUE(LinksOverlap(LinkOf(p), Complement(LinkOf(q))) || found);
    overlaps += found;
    disjoint += !overlap;
  }
  EXPECT_GT(overlaps, 30);
  EXPECT_GT(disjoint, 30);
}

}  // namespace
}  // namespace touchstone
