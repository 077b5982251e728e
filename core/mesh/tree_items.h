// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_MESH_TREE_ITEMS_H_
#define TOUCHSTONE_CORE_MESH_TREE_ITEMS_H_

#include <Eigen/Core>
#include <span>

#include "touchstone/core/mesh/box_tree.h"

namespace touchstone {

// A closed box of a tree and what it holds: node `child`, or the single face ~child.
struct TreeItem {
  Eigen::Vector3d low, high;
  int child;
};

// The boxes of the node `code`, or the one round face ~code, for walks down two trees at a time: a
// face is paired with the nodes of the other tree until it meets faces. Returns how many.
int ItemsOf(const BoxTree& tree, std::span<const Eigen::Vector3d> points,
            std::span<const Triangle> faces, int code, TreeItem items[kTreeWidth]);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_MESH_TREE_ITEMS_H_
