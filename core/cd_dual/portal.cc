// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/portal.h"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

namespace touchstone {
namespace {

constexpr int kMaxRounds = 128;

struct PortalPoint {
  VertexPair pair;
  Eigen::Vector3d w;       // scaled point of M
  Eigen::Vector3d from_c;  // w - c
};

class PortalSearch {
 public:
  PortalSearch(const MinkowskiDifference& m, bool early_exit, PhaseCounts* counts)
      : m_(m), early_exit_(early_exit), counts_(counts), to_origin_(-m.c()) {}

  Proposal Run() {
    if (!FindPortal()) return std::move(proposal_);
    Refine();
    return std::move(proposal_);
  }

 private:
  // The support along `direction`; true if it shows o outside.
  bool Probe(const Eigen::Vector3d& direction, PortalPoint* out) {
    const VertexPair hint = out->pair;
    out->pair = m_.Support(direction, hint, counts_);
    out->w = m_.Point(out->pair);
    out->from_c = out->w - m_.c();
    // Only worth a proof when the distance stands out from the rounding of the point.
    if (early_exit_ && direction.dot(out->w) < -4.0 * m_.coordinate_error() * direction.lpNorm<1>()) {
      proposal_.kind = Proposal::Kind::kSeparatingDirection;
      proposal_.direction = direction;
      proposal_.support = out->pair;
      return true;
    }
    return false;
  }

  // det[a b r].
  double Side(const PortalPoint& a, const PortalPoint& b) const {
    return a.from_c.cross(b.from_c).dot(to_origin_);
  }

  // Finds a triangle that the ray crosses, or a separating direction (then false).
  bool FindPortal() {
    if (Probe(to_origin_, &x_[0])) return false;
    Eigen::Vector3d n = x_[0].from_c.cross(to_origin_);
    const double length = n.norm();
    if (!(length > 1e-14 * to_origin_.norm() * x_[0].from_c.norm())) {
      // The ray meets the first vertex itself: any direction across the ray will do.
      Eigen::Index smallest;
      to_origin_.cwiseAbs().minCoeff(&smallest);
      n = to_origin_.cross(Eigen::Vector3d::Unit(smallest));
    }
    x_[1].pair = x_[0].pair;
    if (Probe(n, &x_[1])) return false;
    if (Side(x_[0], x_[1]) < 0.0) std::swap(x_[0], x_[1]);
    x_[2].pair = x_[0].pair;
    for (int round = 0; round < kMaxRounds; ++round) {
      // r lies on the inner side of the plane through c, x0, x1; look for M on that side.
      n = x_[0].from_c.cross(x_[1].from_c);
      if (Probe(n, &x_[2])) return false;
      if (Side(x_[2], x_[0]) < 0.0) {
        x_[1] = x_[2];
      } else if (Side(x_[1], x_[2]) < 0.0) {
        x_[0] = x_[2];
      } else {
        return true;
      }
    }
    proposal_.kind = Proposal::Kind::kStuck;
    return false;
  }

  void Refine() {
    for (int round = 0; round < kMaxRounds; ++round) {
      ++counts_->faces_visited;
      const Eigen::Vector3d n = (x_[1].w - x_[0].w).cross(x_[2].w - x_[0].w);
      proposal_.triangle = {x_[0].pair, x_[1].pair, x_[2].pair};
      const double tolerance = 4.0 * m_.coordinate_error() * n.lpNorm<1>();
      if (early_exit_ && n.dot(x_[0].w) > tolerance) {
        proposal_.kind = Proposal::Kind::kEnclosed;
        return;
      }
      PortalPoint beyond;
      beyond.pair = x_[round % 3].pair;
      if (Probe(n, &beyond)) return;
      // Nothing further out than rounding can see: the facet is found, up to a proof.
      if (beyond.pair == x_[0].pair || beyond.pair == x_[1].pair || beyond.pair == x_[2].pair ||
          !(n.dot(beyond.w - x_[0].w) > 0.0)) {
        break;
      }
      const double s0 = Side(beyond, x_[0]), s1 = Side(beyond, x_[1]), s2 = Side(beyond, x_[2]);
      if (s0 >= 0.0) {
        x_[s1 <= 0.0 ? 2 : 0] = beyond;
      } else {
        x_[s2 >= 0.0 ? 1 : 0] = beyond;
      }
    }
    proposal_.kind = Proposal::Kind::kExitFacet;
  }

  const MinkowskiDifference& m_;
  const bool early_exit_;
  PhaseCounts* counts_;
  const Eigen::Vector3d to_origin_;  // r = o - c
  std::array<PortalPoint, 3> x_;
  Proposal proposal_;
};

}  // namespace

Proposal SearchPortal(const MinkowskiDifference& m, bool early_exit, PhaseCounts* counts) {
  return PortalSearch(m, early_exit, counts).Run();
}

}  // namespace touchstone
