// SPDX-License-Identifier: MIT
#include "touchstone/core/proximity/nearest_point.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace touchstone {
namespace {

constexpr int kMaxRounds = 256;

struct Corner {
  VertexPair pair;
  Eigen::Vector3d point;
};

// The part of a set of corners that is nearest to o, with its nearest point at positive weights.
struct Nearest {
  std::array<int, 3> members;
  int size = 0;
  double squared = std::numeric_limits<double>::infinity();
  Eigen::Vector3d away;  // along x, any length: what the next support looks against
};

class NearestSearch {
 public:
  NearestSearch(const MinkowskiDifference& m, PhaseCounts* counts) : m_(m), counts_(counts) {}

  NearestProposal Run(const Simplex& start) {
    Begin(start);
    const double noise = 4.0 * m_.coordinate_error();
    for (int round = 0; round < kMaxRounds; ++round) {
      ++counts_->faces_visited;
      if (nearest_.squared <= noise * noise) return Propose(NearestProposal::Kind::kMeets);
      const VertexPair pair = m_.Support(-nearest_.away, {}, counts_);
      for (int i = 0; i < count_; ++i) {
        if (corners_[i].pair == pair) return Propose(NearestProposal::Kind::kNearest);
      }
      corners_[count_] = {pair, m_.Point(pair)};
      // Not further towards o than the simplex is: nothing nearer is left.
      if (!(nearest_.away.dot(corners_[count_].point - corners_[0].point) < 0.0)) {
        return Propose(NearestProposal::Kind::kNearest);
      }
      if (count_ == 3 && Encloses()) return Propose(NearestProposal::Kind::kMeets);
      const Nearest next = NearestWith(count_);
      if (!(next.squared < nearest_.squared)) return Propose(NearestProposal::Kind::kNearest);
      ++count_;
      Take(next);
    }
    return Propose(NearestProposal::Kind::kNearest);
  }

 private:
  void Begin(const Simplex& start) {
    if (start.size == 0) {
      const VertexPair pair = m_.Support(-m_.c(), {}, counts_);
      corners_[0] = {pair, m_.Point(pair)};
      count_ = 1;
    }
    for (int i = 0; i < start.size; ++i) corners_[i] = {start.points[i], m_.Point(start.points[i])};
    if (start.size > 0) count_ = start.size;
    Nearest best;
    for (int newest = 0; newest < count_; ++newest) Keep(NearestWith(newest), &best);
    Take(best);
  }

  NearestProposal Propose(NearestProposal::Kind kind) const {
    NearestProposal proposal;
    proposal.kind = kind;
    proposal.simplex.size = count_;
    for (int i = 0; i < count_; ++i) proposal.simplex.points[i] = corners_[i].pair;
    return proposal;
  }

  void Take(const Nearest& nearest) {
    std::array<Corner, 3> kept;
    for (int i = 0; i < nearest.size; ++i) kept[i] = corners_[nearest.members[i]];
    for (int i = 0; i < nearest.size; ++i) corners_[i] = kept[i];
    count_ = nearest.size;
    nearest_ = nearest;
  }

  static void Keep(const Nearest& candidate, Nearest* best) {
    if (candidate.squared < best->squared) *best = candidate;
  }

  // The part of corners 0 .. `newest` nearest to o that `newest` belongs to: as the support lies
  // nearer than all that was seen before, it is part of the new nearest simplex. Every such part is
  // tried, and counts where its plane's or line's point nearest to o has positive weights.
  Nearest NearestWith(int newest) const {
    Nearest best;
    best.members = {newest, -1, -1};
    best.size = 1;
    best.away = corners_[newest].point;
    best.squared = best.away.squaredNorm();
    for (int i = 0; i < newest; ++i) Keep(OfSegment(newest, i), &best);
    for (int i = 0; i < newest; ++i) {
      for (int j = i + 1; j < newest; ++j) Keep(OfTriangle(newest, i, j), &best);
    }
    return best;
  }

  Nearest OfSegment(int i, int j) const {
    const Eigen::Vector3d &a = corners_[i].point, along = corners_[j].point - a;
    const double rise = -along.dot(a), length = along.squaredNorm();
    Nearest nearest;
    if (!(rise > 0.0 && rise < length)) return nearest;
    nearest.members = {i, j, -1};
    nearest.size = 2;
    nearest.away = a + (rise / length) * along;
    nearest.squared = nearest.away.squaredNorm();
    return nearest;
  }

  Nearest OfTriangle(int i, int j, int k) const {
    const Eigen::Vector3d& a = corners_[i].point;
    const Eigen::Vector3d u = corners_[j].point - a, v = corners_[k].point - a;
    const Eigen::Vector3d n = u.cross(v);
    const double squared = n.squaredNorm();
    // Weights of j and k, times |n|^2.
    const double weight_j = n.dot(v.cross(a)), weight_k = n.dot(a.cross(u));
    Nearest nearest;
    if (!(weight_j > 0.0 && weight_k > 0.0 && weight_j + weight_k < squared)) return nearest;
    const double height = n.dot(a);
    nearest.members = {i, j, k};
    nearest.size = 3;
    nearest.away = height < 0.0 ? Eigen::Vector3d(-n) : n;
    nearest.squared = height * height / squared;
    return nearest;
  }

  // Whether o is inside the tetrahedron of the three corners and the newest: on the inner side of
  // the three faces that meet there. It is on the inner side of the fourth, which the newest lies
  // beyond towards o.
  bool Encloses() const {
    const Eigen::Vector3d& w = corners_[3].point;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d u = corners_[i].point - w, v = corners_[(i + 1) % 3].point - w;
      const Eigen::Vector3d n = u.cross(v);
      const double inner = n.dot(corners_[(i + 2) % 3].point - w), origin = -n.dot(w);
      if (!(inner > 0.0 ? origin > 0.0 : origin < 0.0)) return false;
    }
    return true;
  }

  const MinkowskiDifference& m_;
  PhaseCounts* counts_;
  std::array<Corner, 4> corners_;
  int count_ = 0;
  Nearest nearest_;
};

}  // namespace

NearestProposal SearchNearest(const MinkowskiDifference& m, const Simplex& start,
                              PhaseCounts* counts) {
  return NearestSearch(m, counts).Run(start);
}

}  // namespace touchstone
