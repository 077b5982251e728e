// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/nearest_facet.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "touchstone/exact/faces.h"
#include "touchstone/exact/phase_maxima.h"
#include "touchstone/exact/support.h"

namespace touchstone::exact {
namespace {

// Planes that may be the nearest. Of height and |n| doubles are known with |height - exact| <=
// error and ||n| - exact| <= error_n.
class Contenders {
 public:
  void Add(double height, double error, double n, double error_n, int i, int j = -1) {
    // Quotients are widened by 2^-48 for their own rounding.
    const double low = (height - error) / (n + error_n) * (1.0 - 0x1p-48);
    if (low > best_high_) return;
    if (n > 2.0 * error_n)
      best_high_ = std::min(best_high_, (height + error) / (n - error_n) * (1.0 + 0x1p-48));
    items_.push_back({low, i, j});
  }

  template <class Visit>
  void ForEach(const Visit& visit) const {
    for (const Item& item : items_) {
      if (item.low <= best_high_) visit(item.i, item.j);
    }
  }

 private:
  struct Item {
    double low;
    int i, j;
  };
  double best_high_ = std::numeric_limits<double>::infinity();
  std::vector<Item> items_;
};

SupportingPlane PlaneAlong(const PlacedPair& pair, const IntegerVector& n) {
  return {n, Dot(n, pair.Difference(SupportingPair(pair, n)))};
}

}  // namespace

int CompareDistances(const SupportingPlane& a, const SupportingPlane& b) {
  const Integer left = a.height * a.height * Dot(b.normal, b.normal);
  const Integer right = b.height * b.height * Dot(a.normal, a.normal);
  return cmp(left, right);
}

Real DistanceOf(const PlacedPair& pair, const SupportingPlane& plane) {
  return pair.ToLength(Real(plane.height) / Sqrt(Real(Dot(plane.normal, plane.normal))));
}

std::optional<SupportingPlane> NearestFacet(const PlacedPair& pair) {
  const ExactBodyData &p = pair.p(), &q = pair.q();
  // A component of a direction is off by at most 2^-46 (faces.h), a length by twice that.
  constexpr double kNormalError = 0x1p-45;
  Contenders by_p, by_q, by_edges;
  for (int f = 0; f < p.face_count; ++f) {
    const Eigen::Vector3d& n = p.normals().direction[f];
    const double least_q = -Largest(q, -(pair.rotation().transpose() * n));
    const double height =
        n.dot(Vertex(p, p.normals().plane[f][0])) - least_q - n.dot(pair.translation());
    by_p.Add(height, 4 * pair.error(), n.norm(), kNormalError, f);
  }
  const std::vector<Eigen::Vector3d> normals_q = NormalsOfQ(pair);
  for (int f = 0; f < q.face_count; ++f) {
    const Eigen::Vector3d n = -normals_q[f];
    const Eigen::Vector3d on_q =
        pair.rotation() * Vertex(q, q.normals().plane[f][0]) + pair.translation();
    by_q.Add(Largest(p, n) - n.dot(on_q), 8 * pair.error(), n.norm(), kNormalError, f);
  }
  // The tails of two crossing edges are on the plane they span, and c tells which of its sides is
  // out. Where doubles cannot tell, the edges are nearly parallel and the plane stays a contender.
  const ArcTest arcs(pair);
  const auto tails = [&](int e_p, int e_q) {
    return VertexPair{p.topology().edges[e_p].tail, q.topology().edges[e_q].tail};
  };
  const double error = 8 * pair.error();
  arcs.ForEachCrossing([&](int e_p, int e_q) {
    const Eigen::Vector3d n = 0.25 * p.edge_vectors().direction[e_p].cross(arcs.direction_q(e_q));
    const VertexPair tail = tails(e_p, e_q);
    const Eigen::Vector3d x =
        Vertex(p, tail.p) - pair.rotation() * Vertex(q, tail.q) - pair.translation();
    const double height = n.dot(x), over_c = height - n.dot(pair.c_double());
    if (std::abs(over_c) > 2 * error) {
      by_edges.Add(over_c < 0 ? -height : height, error, n.norm(), kNormalError, e_p, e_q);
    } else {
      by_edges.Add(-std::abs(height), error, 0.0, kNormalError, e_p, e_q);
    }
  });

  std::optional<SupportingPlane> nearest;
  bool outside = false;
  const auto consider = [&](const SupportingPlane& plane) {
    outside = outside || sgn(plane.height) <= 0;
    if (!outside && (!nearest.has_value() || CompareDistances(plane, *nearest) < 0))
      nearest = plane;
  };
  by_p.ForEach([&](int f, int) { consider(PlaneAlong(pair, FaceVertexNormal(pair, f))); });
  by_q.ForEach([&](int f, int) { consider(PlaneAlong(pair, VertexFaceNormal(pair, f))); });
  by_edges.ForEach([&](int e_p, int e_q) {
    const IntegerVector n = EdgeEdgeNormal(pair, e_p, e_q);
    consider({n, Dot(n, pair.Difference(tails(e_p, e_q)))});
  });
  if (outside) return std::nullopt;
  return nearest;
}

}  // namespace touchstone::exact
