// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/contact_body.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

std::set<int> ItemsOf(const FeatureTree& tree) {
  std::set<int> items;
  for (const FeatureNode& node : tree.nodes()) {
    for (int lane = 0; lane < node.lane_count; ++lane) {
      if (node.children[lane] < 0) items.insert(~node.children[lane]);
    }
  }
  return items;
}

// The most that a direction looks away from all faces round a vertex, by its sine; negative if each
// looks along one. It is as far from three of the normals, or from two, or opposite to one.
double MostRoom(std::span<const Vector3d> normals) {
  double most = -1.0;
  const auto attempt = [&](const Vector3d& way) {
    if (!(way.norm() > 1e-12) || !way.allFinite()) return;
    double room = 1.0;
    for (const Vector3d& normal : normals) room = std::min(room, -normal.dot(way.normalized()));
    most = std::max(most, room);
  };
  for (std::size_t i = 0; i < normals.size(); ++i) {
    attempt(-normals[i]);
    for (std::size_t j = 0; j < i; ++j) {
      attempt(-normals[i] - normals[j]);
      for (std::size_t k = 0; k < j; ++k) {
        const Vector3d level = (normals[i] - normals[j]).cross(normals[i] - normals[k]);
        attempt(level);
        attempt(-level);
      }
    }
  }
  return most;
}

TEST(ContactBody, VerticesThatLockHaveNoWayOut) {
  int locking = 0, free = 0;
  for (const std::string& name : ShapeNames()) {
    for (const int size : {40, 500}) {
      SCOPED_TRACE(name + " " + std::to_string(size));
      const TriangleMesh mesh = MustBuild(NamedShape(name, size));
      const std::set<int> listed = ItemsOf(ContactBody(mesh).locking_vertices());
      for (int v = 0; v < mesh.vertex_count(); ++v) {
        const auto ring = mesh.vertex_half_edges(v);
        if (ring.size() > 20) continue;  // the tips of cones
        std::vector<Vector3d> normals;
        for (const int h : ring) normals.push_back(mesh.face_normal(TriangleMesh::face_of(h)));
        const double room = MostRoom(normals);
        const bool is_listed = listed.contains(v);
        (is_listed ? locking : free) += 1;
        if (room > 0.01) {
          EXPECT_FALSE(is_listed) << v << " " << room;
        } else if (room < -1e-12) {
          EXPECT_TRUE(is_listed) << v << " " << room;
        }
      }
    }
  }
  EXPECT_GT(locking, 0);  // a corner of the spoon
  EXPECT_GT(free, 1000);
}

// A spike backs out of its dent, and the dent off its spike.
TEST(ContactBody, SpikesAndDentsDoNotLock) {
  for (const char* name : {"box", "spiked", "dimpled", "key", "slot", "torus"}) {
    EXPECT_TRUE(ContactBody(MustBuild(NamedShape(name, 60))).locking_vertices().nodes().empty())
        << name;
  }
}

}  // namespace
}  // namespace touchstone
