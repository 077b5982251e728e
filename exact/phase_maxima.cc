// SPDX-License-Identifier: GPL-3.0-or-later
#include "touchstone/exact/phase_maxima.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "touchstone/exact/faces.h"
#include "touchstone/exact/support.h"

namespace touchstone::exact {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Faces whose ratio may be the largest. A ratio a / b is known from doubles with |a - exact| <=
// error_a, |b - exact| <= error_b and b > 0 exactly; quotients are widened by 2^-48 for their own
// rounding.
class Contenders {
 public:
  void Add(double a, double error_a, double b, double error_b, int i, int j = -1) {
    double low = -kInfinity, high = kInfinity;
    if (b > 2 * error_b) {
      const double top = a + error_a, bottom = a - error_a;
      high = Up(top / (top > 0 ? b - error_b : b + error_b));
      low = -Up(-(bottom / (bottom > 0 ? b + error_b : b - error_b)));
    }
    if (high < best_low_) return;
    best_low_ = std::max(best_low_, low);
    items_.push_back({high, i, j});
  }

  // The largest exact ratio; `exact` evaluates a contender.
  template <class Exact>
  std::optional<Ratio> Best(const Exact& exact) const {
    std::optional<Ratio> best;
    for (const Item& item : items_) {
      if (item.high < best_low_) continue;
      Ratio ratio = exact(item.i, item.j);
      if (!best.has_value() || Compare(ratio, *best) > 0) best = std::move(ratio);
    }
    return best;
  }

 private:
  struct Item {
    double high;
    int i, j;
  };
  static double Up(double x) { return x + std::abs(x) * 0x1p-48; }

  double best_low_ = -kInfinity;
  std::vector<Item> items_;
};

// n.c for |n_i| <= 1 with components off by 2^-43: the same derivation as PlacedPair::error.
double ErrorOfC(const PlacedPair& pair) { return 0x1p-41 * pair.c_double().cwiseAbs().maxCoeff(); }

}  // namespace

IntegerVector FaceVertexNormal(const PlacedPair& pair, int f_p) {
  return pair.p().normals().exact[f_p];
}

IntegerVector VertexFaceNormal(const PlacedPair& pair, int f_q) {
  return -pair.NormalFromQ(pair.q().normals().exact[f_q]);
}

IntegerVector EdgeEdgeNormal(const PlacedPair& pair, int e_p, int e_q) {
  const IntegerVector n = Cross(pair.p().edge_vectors().exact[e_p],
                                pair.VectorFromQ(pair.q().edge_vectors().exact[e_q]));
  const VertexPair tails{pair.p().topology().edges[e_p].tail, pair.q().topology().edges[e_q].tail};
  return DotSign(n, pair.FromC(tails)) < 0 ? -n : n;
}

// The four determinants of section 4.3 by way of the edges. Edge u between the faces with normals a
// (left) and b (right) of a convex body runs along a x b, and Q-bar's normals c = -n_left, d =
// -n_right have c x d along Q's own edge w. Hence |cba| ~ -u.c, |dba| ~ -u.d, |adc| ~ -w.a, |bdc| ~
// -w.b. Between coplanar faces the arc is a point and the determinants vanish; here w.a = w.b,
// which fails condition (2) all the same.
bool ArcsCross(const PlacedPair& pair, int e_p, int e_q) {
  const ExactEdge& edge_p = pair.p().topology().edges[e_p];
  const ExactEdge& edge_q = pair.q().topology().edges[e_q];
  const IntegerVector& u = pair.p().edge_vectors().exact[e_p];
  const IntegerVector w = pair.VectorFromQ(pair.q().edge_vectors().exact[e_q]);
  const auto& normals_p = pair.p().normals().exact;
  const auto& normals_q = pair.q().normals().exact;
  const int a = DotSign(w, normals_p[edge_p.left]), b = DotSign(w, normals_p[edge_p.right]);
  if (a * b >= 0) return false;
  const int c = -DotSign(u, pair.NormalFromQ(normals_q[edge_q.left]));
  const int d = -DotSign(u, pair.NormalFromQ(normals_q[edge_q.right]));
  return c * d < 0 && c * b > 0;
}

Ratio FaceVertexMaximum(const PlacedPair& pair) {
  Contenders contenders;
  const ExactBodyData& p = pair.p();
  const FaceNormals& normals = p.normals();
  const double error_a = ErrorOfC(pair);
  for (int f = 0; f < p.face_count; ++f) {
    const Eigen::Vector3d& n = normals.direction[f];
    const double a = -n.dot(pair.c_double());
    const double least_q = -Largest(pair.q(), -(pair.rotation().transpose() * n));
    const double h = n.dot(Vertex(p, normals.plane[f][0])) - least_q - n.dot(pair.translation());
    contenders.Add(a, error_a, h + a, 4 * pair.error(), f);
  }
  return *contenders.Best([&](int f, int) { return RatioOf(pair, normals.exact[f]); });
}

Ratio VertexFaceMaximum(const PlacedPair& pair) {
  Contenders contenders;
  const ExactBodyData& q = pair.q();
  const std::vector<Eigen::Vector3d> normals_q = NormalsOfQ(pair);
  const double error_a = ErrorOfC(pair);
  for (int f = 0; f < q.face_count; ++f) {
    const Eigen::Vector3d n = -normals_q[f];
    const double a = -n.dot(pair.c_double());
    const Eigen::Vector3d on_q =
        pair.rotation() * Vertex(q, q.normals().plane[f][0]) + pair.translation();
    contenders.Add(a, error_a, Largest(pair.p(), n) - n.dot(on_q) + a, 8 * pair.error(), f);
  }
  return *contenders.Best([&](int f, int) { return RatioOf(pair, VertexFaceNormal(pair, f)); });
}

std::optional<Ratio> EdgeEdgeMaximum(const PlacedPair& pair) {
  Contenders contenders;
  const ArcTest arcs(pair);
  const double error_a = ErrorOfC(pair), error_b = 8 * pair.error();
  const auto tails = [&](int e_p, int e_q) {
    return VertexPair{pair.p().topology().edges[e_p].tail, pair.q().topology().edges[e_q].tail};
  };
  arcs.ForEachCrossing([&](int e_p, int e_q) {
    const Eigen::Vector3d n =
        0.25 * pair.p().edge_vectors().direction[e_p].cross(arcs.direction_q(e_q));
    const VertexPair tail = tails(e_p, e_q);
    const Eigen::Vector3d x =
        Vertex(pair.p(), tail.p) - pair.rotation() * Vertex(pair.q(), tail.q) - pair.translation();
    const double a = -n.dot(pair.c_double()), b = n.dot(x) + a;
    contenders.Add(b < 0 ? -a : a, error_a, std::abs(b), error_b, e_p, e_q);
  });
  return contenders.Best([&](int e_p, int e_q) {
    return RatioOf(pair, EdgeEdgeNormal(pair, e_p, e_q), tails(e_p, e_q));
  });
}

}  // namespace touchstone::exact
