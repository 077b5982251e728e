// SPDX-License-Identifier: MIT
//
// Closed meshes by formula, for the program, its benchmarks and the tests. Lengths are of order
// one to ten.
#ifndef TOUCHSTONE_TOOLS_SHAPES_SHAPES_H_
#define TOUCHSTONE_TOOLS_SHAPES_SHAPES_H_

#include <span>
#include <string>
#include <vector>

#include "touchstone/tools/shapes/shape.h"

namespace touchstone {

// boxes.cc: made of cubes, coplanar faces and exact fits throughout.
Shape Box(const Eigen::Vector3d& low, const Eigen::Vector3d& high);
// The union of the cubes [i, i + 1] x [j, j + 1] x [k, k + 1] listed; no two may share an edge or a
// vertex alone.
Shape Cubes(const std::vector<std::array<int, 3>>& cubes);
Shape LShape();
// [0, 3] x [0, 1] x [0, 3] without the gap [1, 2] x [0, 1] x [1, 3].
Shape UShape();
// Three bars of length `length` and width 1 along the axes from a common corner: 36 faces.
Shape Axes(int length);
// [0, 5] x [0, 3] x [0, 3] with the groove [2, 3] x [0, 3] x [1, 3]: two walls and a floor.
Shape Slot();
// [0, 5] x [0, 5] x [0, 3] with the pocket [2, 3] x [2, 3] x [1, 3]: four walls and a floor.
Shape Pocket();
// [0, 1] x [0, 1] x [0, 4], which fits slot and pocket exactly.
Shape Key();
// A box with a box-shaped cavity.
Shape HollowBox();

// cone.cc: `sides` slivers from the apex (0, 0, height) and as many round the middle of the base.
Shape Cone(int sides, double radius, double height);

// torus.cc: 2 * around * tube faces.
Shape Torus(int around, int tube, double major, double minor);
// Two tori linked through each other's hole, as one body of two components.
Shape InterlockedTori(int around, int tube);

// revolved.cc: a cup with a wall, `sides` round; faces: 16 * sides.
Shape Cup(int sides);

// swept.cc: closed curves along an axis, a pole at either end; faces: 2 * sides * (stations + 1).
Shape Spoon(int stations, int sides);
Shape Fish(int stations, int sides);

// gear.cc: a spur gear about the z axis, its pitch radius a tenth of its number of teeth; a gap
// between two teeth lies on the x axis. 16 * teeth faces.
Shape Gear(int teeth);

// star.cc: a star of `points` points with an apex above and one below: 4 * points faces.
Shape Star(int points);

// dents.cc: a slab whose top has a dent, or a spike, that is a pyramid of `sides` sides.
Shape Dimpled(int sides);
Shape Spiked(int sides);

// The shape of this name with about `face_count` faces (at least what the shape needs; 0: its own
// choice). Names: ShapeNames(). Empty for an unknown name.
Shape NamedShape(const std::string& name, int face_count);
std::span<const std::string> ShapeNames();

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_SHAPES_SHAPES_H_
