// SPDX-License-Identifier: MIT
//
// Contacts that are exact: bodies with small integer coordinates, rotated by axis rotations, have
// exact images, exact normals and exact dot products in doubles. A point a of P and a point b of R
// Q, both extreme along the same direction, coincide when Q is moved by a - b, and the plane
// between holds the interiors apart: a touch, with nothing rounded.
#ifndef TOUCHSTONE_TOOLS_SUITES_CONTACT_H_
#define TOUCHSTONE_TOOLS_SUITES_CONTACT_H_

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "touchstone/core/convex/convex_polyhedron.h"
#include "touchstone/tools/suites/random.h"
#include "touchstone/tools/suites/suite.h"

namespace touchstone {

// The vertices of one body that are extreme along a direction, and the dimension of their hull.
struct ExtremeFeature {
  std::vector<int> vertices;
  int dimension = 0;
};
ExtremeFeature FindExtreme(const ConvexPolyhedron& body, const Eigen::Vector3d& direction);

// The features by which P and Q, rotated, can touch: P's along `normal`, Q's against it (in P's
// frame).
struct ContactFeatures {
  Eigen::Vector3d normal;
  ExtremeFeature p, q;
};

// Which pairs of dimensions (of P's feature, of Q's) a suite wants.
using WantedDimensions = std::function<bool(int, int)>;

// Draws directions (face normals of either body, cross products of edges, sums of those, vertices)
// until the dimensions are wanted, or, after 200 draws, takes the last one.
// Requires integer coordinates below 2^12 and an axis rotation.
ContactFeatures DrawContact(Random& random, const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                            const Eigen::Matrix3d& rotation, const WantedDimensions& wanted);

// The offsets from an exact contact that contact suites go through: exact touches half the time;
// otherwise one ulp, 1e-12, 1e-9 of the size on either side, visible gaps and depths, deep and far.
inline constexpr int kContactOffsetCount = 20;

// Q placed so that random points of the two features coincide (dyadic mixtures of their vertices),
// then moved by offset number `offset`: apart along the axis where `contact.normal` is longest, in
// towards the middle of M. The verdict is expected to be touch or separate where the construction
// makes it so.
PlacedPair PlaceAtContact(Random& random, const ConvexPolyhedron& p, const ConvexPolyhedron& q,
                          const Eigen::Matrix3d& rotation, const ContactFeatures& contact,
                          int offset);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_SUITES_CONTACT_H_
