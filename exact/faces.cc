// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "touchstone/exact/phase_maxima.h"

namespace touchstone::exact {
namespace {

// Signs of n.e for face normals of one body and edges of the other. Directions are off by 2^-46 a
// component and their sizes below 2, so that products beyond 2^-43 have the right sign.
constexpr double kArcError = 0x1p-43;

}  // namespace

double Largest(const ExactBodyData& body, const Eigen::Vector3d& n) {
  double largest = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < body.vertex_count; ++i) {
    const double value = n.x() * body.x[i] + n.y() * body.y[i] + n.z() * body.z[i];
    largest = value > largest ? value : largest;
  }
  return largest;
}

std::vector<Eigen::Vector3d> NormalsOfQ(const PlacedPair& pair) {
  const Eigen::Matrix3d& r = pair.rotation();
  Eigen::Matrix3d cofactors;
  cofactors.row(0) = 0.5 * r.row(1).cross(r.row(2));
  cofactors.row(1) = 0.5 * r.row(2).cross(r.row(0));
  cofactors.row(2) = 0.5 * r.row(0).cross(r.row(1));
  std::vector<Eigen::Vector3d> normals;
  normals.reserve(pair.q().face_count);
  for (const Eigen::Vector3d& n : pair.q().normals().direction) normals.push_back(cofactors * n);
  return normals;
}

ArcTest::ArcTest(const PlacedPair& pair)
    : pair_(pair),
      edges_p_(pair.p().topology().edges),
      edges_q_(pair.q().topology().edges),
      normals_q_(NormalsOfQ(pair)) {
  for (const Eigen::Vector3d& e : pair.q().edge_vectors().direction) {
    directions_q_.push_back(pair.rotation() * e);
  }
}

void ArcTest::ForEachCrossing(const std::function<void(int, int)>& found) const {
  std::vector<double> along(normals_q_.size());
  for (int e_p = 0; e_p < static_cast<int>(edges_p_.size()); ++e_p) {
    const Eigen::Vector3d& u_p = pair_.p().edge_vectors().direction[e_p];
    for (std::size_t f = 0; f < along.size(); ++f) along[f] = -u_p.dot(normals_q_[f]);
    for (int e_q = 0; e_q < static_cast<int>(edges_q_.size()); ++e_q) {
      const double c = along[edges_q_[e_q].left], d = along[edges_q_[e_q].right];
      if ((c > kArcError && d > kArcError) || (c < -kArcError && d < -kArcError)) continue;
      if (Crosses(e_p, e_q, c, d)) found(e_p, e_q);
    }
  }
}

bool ArcTest::Crosses(int e_p, int e_q, double c, double d) const {
  const ExactEdge& edge_p = edges_p_[e_p];
  const std::vector<Eigen::Vector3d>& normals = pair_.p().normals().direction;
  const double a = directions_q_[e_q].dot(normals[edge_p.left]);
  const double b = directions_q_[e_q].dot(normals[edge_p.right]);
  if ((a > kArcError && b > kArcError) || (a < -kArcError && b < -kArcError)) return false;
  if (std::min({std::abs(a), std::abs(b), std::abs(c), std::abs(d)}) <= kArcError) {
    return ArcsCross(pair_, e_p, e_q);
  }
  return (c > 0) == (b > 0);
}

}  // namespace touchstone::exact
