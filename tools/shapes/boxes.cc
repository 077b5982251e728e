// SPDX-License-Identifier: MIT
#include <map>
#include <set>

#include "touchstone/tools/shapes/shapes.h"

namespace touchstone {

Shape Box(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  Shape box;
  for (int i = 0; i < 8; ++i) {
    box.AddVertex((i & 1 ? high : low)[0], (i & 2 ? high : low)[1], (i & 4 ? high : low)[2]);
  }
  box.AddQuad(0, 2, 3, 1);
  box.AddQuad(4, 5, 7, 6);
  box.AddQuad(0, 1, 5, 4);
  box.AddQuad(2, 6, 7, 3);
  box.AddQuad(0, 4, 6, 2);
  box.AddQuad(1, 3, 7, 5);
  return box;
}

Shape Cubes(const std::vector<std::array<int, 3>>& cubes) {
  const std::set<std::array<int, 3>> filled(cubes.begin(), cubes.end());
  Shape shape;
  std::map<std::array<int, 3>, int> index;
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [place, added] = index.try_emplace(at, static_cast<int>(index.size()));
    if (added) shape.AddVertex(at[0], at[1], at[2]);
    return place->second;
  };
  for (const std::array<int, 3>& cube : filled) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int side = 0; side < 2; ++side) {
        std::array<int, 3> neighbor = cube;
        neighbor[axis] += side == 1 ? 1 : -1;
        if (filled.contains(neighbor)) continue;
        std::array<int, 4> corner;
        for (int k = 0; k < 4; ++k) {
          std::array<int, 3> at = cube;
          at[axis] += side;
          at[(axis + 1) % 3] += k == 1 || k == 2;
          at[(axis + 2) % 3] += k == 2 || k == 3;
          corner[side == 1 ? k : 3 - k] = vertex(at);
        }
        shape.AddQuad(corner[0], corner[1], corner[2], corner[3]);
      }
    }
  }
  return shape;
}

namespace {

// The cells of [0, size) that `keep` accepts.
template <class Keep>
Shape Cells(const std::array<int, 3>& size, const Keep& keep) {
  std::vector<std::array<int, 3>> cubes;
  for (int i = 0; i < size[0]; ++i) {
    for (int j = 0; j < size[1]; ++j) {
      for (int k = 0; k < size[2]; ++k) {
        if (keep(i, j, k)) cubes.push_back({i, j, k});
      }
    }
  }
  return Cubes(cubes);
}

}  // namespace

Shape LShape() { return Cubes({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 0, 2}}); }

Shape UShape() {
  return Cells({3, 1, 3}, [](int i, int, int k) { return i != 1 || k == 0; });
}

Shape Slot() {
  return Cells({5, 3, 3}, [](int i, int, int k) { return i != 2 || k == 0; });
}

Shape Pocket() {
  return Cells({5, 5, 3}, [](int i, int j, int k) { return i != 2 || j != 2 || k == 0; });
}

Shape Key() { return Box({0, 0, 0}, {1, 1, 4}); }

Shape HollowBox() {
  return Together(Box({0, 0, 0}, {4, 4, 4}), Reversed(Box({1, 1, 1}, {3, 2.5, 2})));
}

Shape Axes(int length) {
  // The corner cube [0, 1]^3, and a bar from its face at 1 along each axis.
  Shape axes;
  for (int i = 0; i < 8; ++i) axes.AddVertex(i & 1, (i >> 1) & 1, (i >> 2) & 1);
  axes.AddQuad(0, 2, 3, 1);
  axes.AddQuad(0, 1, 5, 4);
  axes.AddQuad(0, 4, 6, 2);
  const std::array<std::array<int, 4>, 3> mouths = {{{1, 3, 7, 5}, {2, 6, 7, 3}, {4, 5, 7, 6}}};
  for (int axis = 0; axis < 3; ++axis) {
    std::array<int, 4> end;
    for (int k = 0; k < 4; ++k) {
      Eigen::Vector3d at = axes.vertices[mouths[axis][k]];
      at[axis] = length;
      end[k] = axes.AddVertex(at[0], at[1], at[2]);
    }
    for (int k = 0; k < 4; ++k) {
      const int next = (k + 1) % 4;
      axes.AddQuad(mouths[axis][k], mouths[axis][next], end[next], end[k]);
    }
    axes.AddQuad(end[0], end[1], end[2], end[3]);
  }
  return axes;
}

}  // namespace touchstone
