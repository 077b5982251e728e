// SPDX-License-Identifier: MIT
#include "touchstone/core/minkowski/gap_pairs_internal.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "touchstone/core/minkowski/bounded_vector_internal.h"
#include "touchstone/core/minkowski/sum_geometry_internal.h"

namespace touchstone::internal {
namespace {

using Eigen::Vector3d;

// Exact poses are within 4e-6 of a rotation in every direction, those of two world poses too. A
// height over a plane then differs from that at the rotation by 2 (Da + Db) L times as much through
// the normal, of length L, and by Db L times as much through the point, at either end; and two
// rotations are as far apart as the matrices but for 2.5 times as much: 8.5 * 4e-6.
constexpr double kOffRotation = 5e-5;
// Lengths are those of another pose, off by less than 1e-5 of them, and rounded.
constexpr double kLonger = 1.001;

double Radius(std::span<const Vector3d> points, const Vector3d& center) {
  double squared = 0.0;
  for (const Vector3d& x : points) squared = std::max(squared, (x - center).squaredNorm());
  return std::sqrt(squared);
}

}  // namespace

void GapPairs::Begin(const MeshPair& pair, std::span<const GapCandidate> candidates, double spread,
                     double life) {
  pair_ = &pair;
  candidates_ = candidates;
  spread_ = spread;
  life_ = life;
  rotation_ = pair.pose().rotation();
  travel_ = 0.0;
  pairs_.clear();
  boxes_.Clear();
  items_.clear();
  placed_.assign(candidates.size(), {});
  is_listed_.assign(candidates.size(), 0);
  stamp_ = 1;
  for (int i = 0; i < static_cast<int>(candidates.size()); ++i) {
    Item& item = items_.emplace_back(ItemOf(candidates[i].facet));
    item.box = BoxOf(pair, RoundedCorners(pair, candidates[i].facet));
    boxes_.Add(item.box);
  }
}

// Two faces of one body that share a side, against one vertex of the other: surfaces do not fold,
// so neither cuts the other.
bool AreNeighbors(const MeshPair& pair, const SumFacet& x, const SumFacet& y) {
  if (!AreOfOneVertex(x, y)) return false;
  const bool is_of_a = x.kind == SumFacetKind::kFaceVertex;
  const TriangleMesh& mesh = (is_of_a ? pair.a() : pair.b()).mesh;
  const Triangle &p = mesh.face(is_of_a ? x.a : x.b), &q = mesh.face(is_of_a ? y.a : y.b);
  return std::count_if(p.begin(), p.end(),
                       [&](int v) { return std::find(q.begin(), q.end(), v) != q.end(); }) >= 2;
}

void GapPairs::List(int i, const SumFacet& facet) {
  if (is_listed_[i] != 0) return;
  is_listed_[i] = 1;
  Box3 box = items_[i].box;
  box.low -= Vector3d::Constant(spread_);
  box.high += Vector3d::Constant(spread_);
  hits_.clear();
  boxes_.Meeting(box, &hits_);
  // From now to another pose while the list lasts the rotation changes by no more than both have
  // since the beginning.
  const double last = 2.0 * travel_ + life_;
  for (const int j : hits_) {
    const SumFacet& other = candidates_[j].facet;
    if (is_listed_[j] != 0 || AreNeighbors(*pair_, facet, other)) continue;
    GapPair added{i, j, 0.0};
    IsParted(facet, other, &added);
    if (!(added.expiry > last)) pairs_.push_back(added);
  }
}

// The 2-norm of a difference of two rotations is its Frobenius norm by √2.
void GapPairs::Place(const MeshPair& pair) {
  pair_ = &pair;
  const Eigen::Matrix3d& rotation = pair.pose().rotation();
  travel_ += (rotation - rotation_).norm() / std::sqrt(2.0) * kLonger;
  rotation_ = rotation;
  if (++stamp_ == 0) {
    for (Placed& placed : placed_) placed.stamp = 0;
    stamp_ = 1;
  }
}

GapPairs::Item GapPairs::ItemOf(const SumFacet& facet) const {
  const PlacedMesh &a = pair_->a(), &b = pair_->b();
  std::array<Vector3d, 3> of_a, of_b;
  of_a.fill(Vector3d::Zero());
  of_b.fill(Vector3d::Zero());
  std::size_t count_a = 1, count_b = 1;
  const auto list_face = [](const PlacedMesh& mesh, int f, std::array<Vector3d, 3>* points) {
    for (int k = 0; k < 3; ++k) (*points)[k] = mesh.points[mesh.mesh.face(f)[k]];
    return std::size_t{3};
  };
  const auto list_edge = [](const PlacedMesh& mesh, int e, std::array<Vector3d, 3>* points) {
    const int h = mesh.mesh.half_edge_of(e);
    (*points)[0] = mesh.points[mesh.mesh.tail(h)];
    (*points)[1] = mesh.points[mesh.mesh.head(h)];
    return std::size_t{2};
  };
  Item item;
  switch (facet.kind) {
    case SumFacetKind::kFaceVertex:
      count_a = list_face(a, facet.a, &of_a);
      of_b[0] = b.points[facet.b];
      item.length = a.planes[facet.a].normal.norm();
      break;
    case SumFacetKind::kVertexFace:
      of_a[0] = a.points[facet.a];
      count_b = list_face(b, facet.b, &of_b);
      item.length = b.planes[facet.b].normal.norm();
      break;
    case SumFacetKind::kEdgeEdge:
      count_a = list_edge(a, facet.a, &of_a);
      count_b = list_edge(b, facet.b, &of_b);
      item.length = (of_a[1] - of_a[0]).norm() * (of_b[1] - of_b[0]).norm();
      break;
  }
  const auto middle = [](std::span<const Vector3d> points) {
    Vector3d sum = points[0];
    for (const Vector3d& x : points.subspan(1)) sum += x;
    return Vector3d(sum / static_cast<double>(points.size()));
  };
  const std::span<const Vector3d> points_a(of_a.data(), count_a), points_b(of_b.data(), count_b);
  item.center_a = middle(points_a);
  item.center_b = middle(points_b);
  item.radius_a = Radius(points_a, item.center_a);
  item.radius_b = Radius(points_b, item.center_b);
  return item;
}

// A height n.(x - o) off by errors and roundings as FacetTriage has it, with coordinates of one at
// most.
GapPairs::Placed& GapPairs::At(int i, const SumFacet& facet) {
  Placed& placed = placed_[i];
  if (placed.stamp == stamp_) return placed;
  placed.stamp = stamp_;
  const SumCorners corners = touchstone::CornersOf(*pair_, facet);
  placed.corners.count = corners.count;
  for (int k = 0; k < corners.count; ++k) {
    const SumVertex& x = placed.vertices[k] = corners.vertices[k];
    placed.corners.points[k] = pair_->a().points[x.a] - pair_->b().points[x.b];
  }
  placed.box = BoxOf(*pair_, placed.corners);
  const BoundedVector normal = FacetNormal(*pair_, facet);
  placed.normal = normal.value;
  placed.normal_error = normal.error;
  placed.offset = normal.value.dot(placed.corners.points[0]);
  const double sum = normal.value.cwiseAbs().sum();
  const double error = 1.01 * (pair_->a().point_error + pair_->b().point_error + 2.0 * kUnit);
  placed.bound =
      1.02 * (6.0 * normal.error * (1.0 + error) + 2.0 * error * sum + 8.1 * kUnit * sum) +
      kUnderflow;
  return placed;
}

GapPairs::Reach GapPairs::ReachOf(const GapPair& pair) const {
  const Item &x = items_[pair.i], &y = items_[pair.j];
  return {(x.center_a - y.center_a).norm() + x.radius_a + y.radius_a,
          (x.center_b - y.center_b).norm() + x.radius_b + y.radius_b};
}

// A gap in something of this size, which a turn of B shrinks by `rate` times it at most.
void GapPairs::Renew(double gap, double size, double rate, const Reach& reach,
                     GapPair* pair) const {
  const double left = gap - kOffRotation * size * (reach.a + reach.b);
  if (left > 0.0) pair->expiry = std::max(pair->expiry, travel_ + left / (kLonger * size * rate));
}

// How far all corners of the other lie off the plane, on one side of it, but for one that is in it
// by its name.
double GapPairs::ClearanceOver(const Placed& plane, const Placed& other, int skipped) const {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (int k = 0; k < other.corners.count; ++k) {
    if (k == skipped) continue;
    const double height = plane.normal.dot(other.corners.points[k]) - plane.offset;
    low = std::min(low, height);
    high = std::max(high, height);
  }
  return std::max(low, -high) - plane.bound;
}

// With o and x vertices of M, x - o = Δa - R Δb. A height over x's plane is n.Δa - n.RΔb with a
// normal of A, and RᵀΔa in place of Δa with one of B: it changes by the change of R times |n||Δb|,
// or |n||Δa|. With e_a x R e_b for n it is -R e_b.(e_a x Δa) - e_a.R(e_b x Δb): |e_a||e_b| (|Δa| +
// |Δb|).
bool GapPairs::IsPartedByPlane(const SumFacet& x, const SumFacet& y, int skipped_x, int skipped_y,
                               GapPair* pair) const {
  const Reach reach = ReachOf(*pair);
  const auto rate = [&](SumFacetKind kind) {
    return kind == SumFacetKind::kFaceVertex   ? reach.b
           : kind == SumFacetKind::kVertexFace ? reach.a
                                               : reach.a + reach.b;
  };
  const double over_x = ClearanceOver(placed_[pair->i], placed_[pair->j], skipped_y);
  const double over_y = ClearanceOver(placed_[pair->j], placed_[pair->i], skipped_x);
  if (over_x > 0.0) Renew(over_x, items_[pair->i].length, rate(x.kind), reach, pair);
  if (over_y > 0.0) Renew(over_y, items_[pair->j].length, rate(y.kind), reach, pair);
  return over_x > 0.0 || over_y > 0.0;
}

// As LieAcrossAnEdge has it, whichever way the facets are named. A normal of B turns as B does, one
// of two edges by as much of their lengths.
bool GapPairs::LieAcross(GapPair* pair) const {
  const Placed &x = placed_[pair->i], &y = placed_[pair->j];
  const int n = x.corners.count, m = y.corners.count;
  for (int k = 0; k < n; ++k) {
    for (int l = 0; l < m; ++l) {
      const SumVertex &tail = x.vertices[k], &head = x.vertices[(k + 1) % n];
      const SumVertex &from = y.vertices[l], &to = y.vertices[(l + 1) % m];
      const bool is_opposite = tail == to && head == from;
      if (!is_opposite && !(tail == from && head == to)) continue;
      const Estimate dot = HeightAlong(x.normal, x.normal_error, y.normal, y.normal_error);
      if (TriageSign(dot) != (is_opposite ? 1 : -1)) return false;
      const double size = items_[pair->i].length * items_[pair->j].length;
      Renew(std::abs(dot.value) - dot.error, size, 2.0, {1.0, 1.0}, pair);
      return true;
    }
  }
  return false;
}

bool GapPairs::IsParted(const SumFacet& of_x, const SumFacet& of_y, GapPair* pair) {
  const Placed &x = At(pair->i, of_x), &y = At(pair->j, of_y);
  const double gap =
      std::max((y.box.low - x.box.high).maxCoeff(), (x.box.low - y.box.high).maxCoeff());
  if (gap > 0.0) {
    const Reach reach = ReachOf(*pair);
    Renew(gap, 1.0, reach.b, reach, pair);
    return true;
  }
  int shared = 0, shared_x = -1, shared_y = -1;
  for (int k = 0; k < x.corners.count; ++k) {
    for (int l = 0; l < y.corners.count; ++l) {
      if (x.vertices[k] != y.vertices[l]) continue;
      ++shared;
      shared_x = k;
      shared_y = l;
    }
  }
  if (shared >= 2) return LieAcross(pair);
  return IsPartedByPlane(of_x, of_y, shared_x, shared_y, pair);
}

}  // namespace touchstone::internal
