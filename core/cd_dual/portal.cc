// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/portal.h"

#include <Eigen/LU>
#include <cmath>
#include <utility>

#include "touchstone/core/cd_dual/ray_frame.h"

namespace touchstone {
namespace {

constexpr int kMaxRounds = 128;

class PortalSearch {
 public:
  PortalSearch(const MinkowskiDifference& m, bool early_exit, PhaseCounts* counts)
      : m_(m),
        frame_(m),
        early_exit_(early_exit),
        counts_(counts),
        tolerance_(4.0 * m.coordinate_error()) {}

  Proposal Run() {
    if (Approach() && (Surround() || Discover())) Refine();
    return std::move(proposal_);
  }

 private:
  // The support along (nx, ny, nz); false when it shows o outside, which ends an early-exit search.
  bool Probe(double nx, double ny, double nz, VertexPair hint, FramePoint* out) {
    *out = frame_.Support(nx, ny, nz, hint, counts_);
    if (!early_exit_) return true;
    // Only worth a proof when the distance stands out from the rounding of the point.
    const double height = nx * out->x + ny * out->y + nz * out->z;
    if (height >= -tolerance_ * (std::abs(nx) + std::abs(ny) + std::abs(nz))) return true;
    proposal_.kind = Proposal::Kind::kSeparatingDirection;
    proposal_.direction = frame_.Direction(nx, ny, nz);
    proposal_.support = out->pair;
    return false;
  }

  // Takes M for the sum of two ellipsoids with the bodies' second moments: goes to where that sum
  // would have its exit, then makes one Newton step with the shadow of the support there as
  // gradient. Leaves the better of the two supports in base_, its direction in (base_nx_, base_ny_)
  // and the inverse of the model's Hessian in step_.
  bool Approach() {
    const Eigen::Matrix3d sum = frame_.moments_p() + frame_.moments_q();
    Eigen::Vector2d n = -sum.topLeftCorner<2, 2>().inverse() * sum.topRightCorner<2, 1>();
    const Eigen::Vector3d normal(n[0], n[1], 1.0);
    const double reach_p = std::sqrt(normal.dot(frame_.moments_p() * normal));
    const double reach_q = std::sqrt(normal.dot(frame_.moments_q() * normal));
    const Eigen::Matrix3d hessian = frame_.moments_p() / reach_p + frame_.moments_q() / reach_q;
    step_ = hessian.topLeftCorner<2, 2>().inverse();
    if (!n.allFinite() || !step_.allFinite()) {  // bodies too flat for the model
      n.setZero();
      step_.setIdentity();
    }

    FramePoint first;
    if (!Probe(n[0], n[1], 1.0, {}, &first)) return false;
    const Eigen::Vector2d next = n - step_ * Eigen::Vector2d(first.x, first.y);
    FramePoint second;
    if (!Probe(next[0], next[1], 1.0, {}, &second)) return false;
    const bool improved = Squared(second) < Squared(first);
    base_ = improved ? second : first;
    base_n_ = improved ? next : n;
    return true;
  }

  static double Squared(const FramePoint& w) { return w.x * w.x + w.y * w.y; }

  // Two side supports, meant to fall where the base's shadow would after a third of a turn either
  // way: together a triangle around the axis, as small as the base is near.
  bool Surround() {
    const double kCos = -0.5, kSin = 0.8660254037844386;
    const Eigen::Vector2d g(base_.x, base_.y);
    const Eigen::Vector2d left(kCos * g[0] - kSin * g[1], kSin * g[0] + kCos * g[1]);
    const Eigen::Vector2d right(kCos * g[0] + kSin * g[1], -kSin * g[0] + kCos * g[1]);
    const Eigen::Vector2d n1 = base_n_ + step_ * (left - g), n2 = base_n_ + step_ * (right - g);
    x_[0] = base_;
    if (!Probe(n1[0], n1[1], 1.0, {}, &x_[1])) return stopped_ = true, false;
    if (!Probe(n2[0], n2[1], 1.0, {}, &x_[2])) return stopped_ = true, false;
    return Turn(x_[0], x_[1]) > 0.0 && Turn(x_[1], x_[2]) > 0.0 && Turn(x_[2], x_[0]) > 0.0;
  }

  // Finds a triangle around the axis from any base: two points with the axis to their left, then
  // the support along the plane through them and c, on the axis's side. c is strictly inside M, so
  // each support lies beyond that plane.
  bool Discover() {
    if (stopped_) return false;
    const double turn1 = Turn(base_, x_[1]), turn2 = Turn(x_[2], base_);
    if (turn1 > 0.0) {
      x_[0] = base_;
    } else if (turn2 > 0.0) {
      x_[0] = x_[2];
      x_[1] = base_;
    } else if (!Probe(-base_.y, base_.x, 0.0, {}, &x_[1])) {
      return false;
    }
    for (int round = 0; round < kMaxRounds; ++round) {
      const double za = x_[0].z - frame_.c_height(), zb = x_[1].z - frame_.c_height();
      const double nx = x_[0].y * zb - za * x_[1].y, ny = za * x_[1].x - x_[0].x * zb;
      if (!Probe(nx, ny, Turn(x_[0], x_[1]), {}, &x_[2])) return false;
      if (Turn(x_[2], x_[0]) < 0.0) {
        x_[1] = x_[2];
      } else if (Turn(x_[1], x_[2]) < 0.0) {
        x_[0] = x_[2];
      } else {
        return true;
      }
    }
    return false;
  }

  // Pushes the triangle outward until nothing lies beyond its plane.
  void Refine() {
    for (int round = 0; round < kMaxRounds; ++round) {
      ++counts_->faces_visited;
      proposal_.triangle = {x_[0].pair, x_[1].pair, x_[2].pair};
      const double ux = x_[1].x - x_[0].x, uy = x_[1].y - x_[0].y, uz = x_[1].z - x_[0].z;
      const double vx = x_[2].x - x_[0].x, vy = x_[2].y - x_[0].y, vz = x_[2].z - x_[0].z;
      const double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
      const double height = nx * x_[0].x + ny * x_[0].y + nz * x_[0].z;
      if (early_exit_ && height > tolerance_ * (std::abs(nx) + std::abs(ny) + std::abs(nz))) {
        proposal_.kind = Proposal::Kind::kEnclosed;
        return;
      }
      FramePoint beyond;
      if (!Probe(nx, ny, nz, {}, &beyond)) return;
      // Nothing further out than rounding can see: the facet is found, up to a proof.
      if (beyond.pair == x_[0].pair || beyond.pair == x_[1].pair || beyond.pair == x_[2].pair ||
          !(nx * (beyond.x - x_[0].x) + ny * (beyond.y - x_[0].y) + nz * (beyond.z - x_[0].z) >
            0.0)) {
        break;
      }
      const double t0 = Turn(beyond, x_[0]), t1 = Turn(beyond, x_[1]), t2 = Turn(beyond, x_[2]);
      if (t0 >= 0.0) {
        x_[t1 <= 0.0 ? 2 : 0] = beyond;
      } else {
        x_[t2 >= 0.0 ? 1 : 0] = beyond;
      }
    }
    proposal_.kind = Proposal::Kind::kExitFacet;
  }

  const MinkowskiDifference& m_;
  const RayFrame frame_;
  const bool early_exit_;
  PhaseCounts* counts_;
  const double tolerance_;
  FramePoint base_;
  Eigen::Vector2d base_n_;
  Eigen::Matrix2d step_;
  std::array<FramePoint, 3> x_;
  bool stopped_ = false;
  Proposal proposal_;
};

}  // namespace

Proposal SearchPortal(const MinkowskiDifference& m, bool early_exit, PhaseCounts* counts) {
  return PortalSearch(m, early_exit, counts).Run();
}

}  // namespace touchstone
