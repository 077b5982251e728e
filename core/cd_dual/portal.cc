// SPDX-License-Identifier: MIT
#include "touchstone/core/cd_dual/portal.h"

#include <cmath>
#include <utility>

#include "touchstone/core/base/vector_clones.h"
#include "touchstone/core/cd_dual/ellipsoid_model.h"
#include "touchstone/core/cd_dual/ray_frame.h"

namespace touchstone {
namespace {

constexpr int kMaxRounds = 128;

struct Point2 {
  double x = 0.0, y = 0.0;
};

// A symmetric 2 x 2 matrix.
struct Symmetric2 {
  double xx = 1.0, xy = 0.0, yy = 1.0;
};
TOUCHSTONE_INLINE Point2 operator*(const Symmetric2& a, const Point2& v) {
  return {a.xx * v.x + a.xy * v.y, a.xy * v.x + a.yy * v.y};
}
TOUCHSTONE_INLINE Symmetric2 Inverse(const Symmetric2& a) {
  const double s = 1.0 / (a.xx * a.yy - a.xy * a.xy);
  return {s * a.yy, -s * a.xy, s * a.xx};
}

// Whether a support at this height along (nx, ny, nz) is worth a proof: only when its distance
// stands out from the rounding of the point.
TOUCHSTONE_INLINE bool IsOutside(double height, const MinkowskiDifference& m, double nx, double ny,
                                 double nz) {
  const double length = std::abs(nx) + std::abs(ny) + std::abs(nz);
  return height < -4.0 * m.coordinate_error() * length;
}

TOUCHSTONE_INLINE bool IsSame(const FramePoint& a, const FramePoint& b) {
  return a.p == b.p && a.q == b.q;
}

class PortalSearch {
 public:
  TOUCHSTONE_INLINE PortalSearch(const MinkowskiDifference& m, bool early_exit, Proposal* proposal)
      : m_(m),
        frame_(m),
        early_exit_(early_exit),
        tolerance_(4.0 * m.coordinate_error()),
        proposal_(*proposal) {}

  // `first` is the support along `normal`, where the model has its exit.
  TOUCHSTONE_INLINE void Run(const EllipsoidModel& model, const Eigen::Vector3d& normal,
                             double reach_p, double reach_q, CornerPair first,
                             PhaseCounts* counts) {
    base_ = frame_.Point(first.p, first.q);
    ++supports_;
    Aim(model, normal, reach_p, reach_q);
    if (Surround() || Discover()) Refine();
    Count(counts);
  }

  // From a triangle; false, with nothing proposed, where the ray does not cross it.
  TOUCHSTONE_INLINE bool RunFrom(const std::array<CornerPair, 3>& start, PhaseCounts* counts) {
    for (int i = 0; i < 3; ++i) x_[i] = frame_.Point(start[i].p, start[i].q);
    if (!SurroundsAxis()) return false;
    Refine();
    Count(counts);
    return true;
  }

 private:
  // The support along (nx, ny, nz), or nearly; false when it shows o outside, which ends an
  // early-exit search.
  TOUCHSTONE_INLINE bool Probe(double nx, double ny, double nz, FramePoint* out) {
    *out = frame_.Look(nx, ny, nz);
    ++supports_;
    if (!early_exit_ || !IsOutside(nx * out->x + ny * out->y + nz * out->z, m_, nx, ny, nz))
      return true;
    proposal_.kind = Proposal::Kind::kSeparatingDirection;
    proposal_.direction = frame_.Direction(nx, ny, nz);
    proposal_.support = {out->p, out->q};
    NameCorners();
    return false;
  }

  // The model's exit direction as (base_n_, 1), and the inverse of its Hessian there.
  TOUCHSTONE_INLINE void Aim(const EllipsoidModel& model, const Eigen::Vector3d& normal,
                             double reach_p, double reach_q) {
    const auto along = [&](const Eigen::Vector3d& v, int i) {
      return v[0] * frame_.in_p()(0, i) + v[1] * frame_.in_p()(1, i) + v[2] * frame_.in_p()(2, i);
    };
    const double up = 1.0 / along(normal, 2);
    Point2 n{up * along(normal, 0), up * along(normal, 1)};
    // The Hessian: second moments over reaches, seen along the ray.
    const Symmetric3 h = model.Sum(1.0 / reach_p, 1.0 / reach_q);
    const auto times = [&](int i) -> Eigen::Vector3d {
      const double x = frame_.in_p()(0, i), y = frame_.in_p()(1, i), z = frame_.in_p()(2, i);
      return {h.xx * x + h.xy * y + h.xz * z, h.xy * x + h.yy * y + h.yz * z,
              h.xz * x + h.yz * y + h.zz * z};
    };
    const Eigen::Vector3d hx = times(0), hy = times(1);
    const double unit = 1.0 / std::abs(up);  // the reaches are along a normal of this height
    step_ = Inverse({unit * along(hx, 0), unit * along(hx, 1), unit * along(hy, 1)});
    if (!(up > 0.0) ||
        !std::isfinite(n.x + n.y + step_.xx + step_.xy + step_.yy)) {  // too flat for the model
      n = {};
      step_ = {};
    }
    base_n_ = n;
  }

  // Two side supports, meant to fall where the base's shadow would after a third of a turn either
  // way and twice as far out: together a triangle around the axis, as small as the base is near.
  TOUCHSTONE_INLINE bool Surround() {
    const double kCos = -2.0, kSin = 1.7320508075688772;  // 2 cos(120 degrees) - 1, 2 sin
    const Point2 across = step_ * Point2{-kSin * base_.y, kSin * base_.x};
    const Point2 back = step_ * Point2{kCos * base_.x, kCos * base_.y};
    x_[0] = base_;
    stopped_ = !Probe(base_n_.x + back.x + across.x, base_n_.y + back.y + across.y, 1.0, &x_[1]) ||
               !Probe(base_n_.x + back.x - across.x, base_n_.y + back.y - across.y, 1.0, &x_[2]);
    return !stopped_ && SurroundsAxis();
  }

  TOUCHSTONE_INLINE bool SurroundsAxis() const {
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
    } else if (!Probe(-base_.y, base_.x, 0.0, &x_[1])) {
      return false;
    }
    for (int round = 0; round < kMaxRounds; ++round) {
      const double za = x_[0].z + m_.c_norm(), zb = x_[1].z + m_.c_norm();
      const double nx = x_[0].y * zb - za * x_[1].y, ny = za * x_[1].x - x_[0].x * zb;
      const double nz = Turn(x_[0], x_[1]);
      if (!Probe(nx, ny, nz, &x_[2])) return false;
      // One of the two lies in the plane: the look has missed what a climb finds.
      if (IsSame(x_[2], x_[0]) || IsSame(x_[2], x_[1]))
        x_[2] = frame_.Climb(nx, ny, nz, x_[2], &climb_steps_);
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
  TOUCHSTONE_INLINE void Refine() {
    for (int round = 0; round < kMaxRounds; ++round) {
      ++triangles_;
      const double ux = x_[1].x - x_[0].x, uy = x_[1].y - x_[0].y, uz = x_[1].z - x_[0].z;
      const double vx = x_[2].x - x_[0].x, vy = x_[2].y - x_[0].y, vz = x_[2].z - x_[0].z;
      const double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
      const double height = nx * x_[0].x + ny * x_[0].y + nz * x_[0].z;
      if (early_exit_ && height > tolerance_ * (std::abs(nx) + std::abs(ny) + std::abs(nz))) {
        return Propose(Proposal::Kind::kEnclosed);
      }
      FramePoint beyond;
      if (!Probe(nx, ny, nz, &beyond)) return;
      if (!IsBeyond(nx, ny, nz, beyond)) {
        // The look may have missed what a climb finds. If that lies no further out than rounding
        // can see, the facet is found, up to a proof.
        beyond = frame_.Climb(nx, ny, nz, beyond, &climb_steps_);
        if (!IsBeyond(nx, ny, nz, beyond)) break;
      }
      const double t0 = Turn(beyond, x_[0]), t1 = Turn(beyond, x_[1]), t2 = Turn(beyond, x_[2]);
      if (t0 >= 0.0) {
        x_[t1 <= 0.0 ? 2 : 0] = beyond;
      } else {
        x_[t2 >= 0.0 ? 1 : 0] = beyond;
      }
    }
    Propose(Proposal::Kind::kExitFacet);
  }

  TOUCHSTONE_INLINE bool IsBeyond(double nx, double ny, double nz, const FramePoint& w) const {
    for (const FramePoint& x : x_) {
      if (IsSame(w, x)) return false;
    }
    return nx * (w.x - x_[0].x) + ny * (w.y - x_[0].y) + nz * (w.z - x_[0].z) > 0.0;
  }

  TOUCHSTONE_INLINE void Count(PhaseCounts* counts) const {
    counts->support_calls += supports_;
    counts->climb_steps += climb_steps_;
    counts->faces_visited += triangles_;
  }

  TOUCHSTONE_INLINE void Propose(Proposal::Kind kind) {
    proposal_.kind = kind;
    NameCorners();
    for (int i = 0; i < 3; ++i) {
      proposal_.triangle[i] = m_.Vertices(proposal_.corners[i]);
      if (kind == Proposal::Kind::kEnclosed) proposal_.points[i] = m_.Point(proposal_.corners[i]);
    }
  }

  TOUCHSTONE_INLINE void NameCorners() {
    proposal_.has_triangle = triangles_ > 0;
    for (int i = 0; i < 3; ++i) proposal_.corners[i] = {x_[i].p, x_[i].q};
  }

  const MinkowskiDifference& m_;
  const RayFrame frame_;
  const bool early_exit_;
  const double tolerance_;
  Proposal& proposal_;
  FramePoint base_;
  Point2 base_n_;
  Symmetric2 step_;
  std::array<FramePoint, 3> x_;
  bool stopped_ = false;
  int supports_ = 0, triangles_ = 0, climb_steps_ = 0;
};

}  // namespace

TOUCHSTONE_VECTOR_CLONES
static void SearchCold(const MinkowskiDifference& m, bool early_exit, PhaseCounts* counts,
                       Proposal* proposal) {
  const bool is_central = m.interior_p() == 0 && m.interior_q() == 0;
  const bool bounds_serve = early_exit && is_central;
  if (bounds_serve && EllipsoidModel::BallsAreApart(m)) {
    proposal->kind = Proposal::Kind::kApartByBounds;
    proposal->direction = -m.c();
    return;
  }
  const EllipsoidModel model(m);
  const Eigen::Vector3d normal = model.ExitNormal();
  const double reach_p = model.ReachP(normal), reach_q = model.ReachQ(normal);
  if (bounds_serve && model.IsApart(normal, reach_p, reach_q)) {
    proposal->kind = Proposal::Kind::kApartByBounds;
    proposal->direction = normal;
    return;
  }
  // The first look needs no frame.
  const Eigen::Matrix3d& r = m.pose().rotation();
  const auto in_q = [&](int i) {
    return normal[0] * r(0, i) + normal[1] * r(1, i) + normal[2] * r(2, i);
  };
  const CornerPair first{m.p().support_table().Look(normal[0], normal[1], normal[2]),
                         m.q().support_table().Look(-in_q(0), -in_q(1), -in_q(2))};
  if (early_exit) {
    const Eigen::Vector3d w = m.Point(first);
    const double height = normal[0] * w[0] + normal[1] * w[1] + normal[2] * w[2];
    if (IsOutside(height, m, normal[0], normal[1], normal[2])) {
      proposal->kind = Proposal::Kind::kSeparatingDirection;
      proposal->direction = normal;
      proposal->support = first;
      ++counts->support_calls;
      return;
    }
  }
  PortalSearch(m, early_exit, proposal).Run(model, normal, reach_p, reach_q, first, counts);
}

TOUCHSTONE_VECTOR_CLONES
static bool SearchFrom(const std::array<CornerPair, 3>& start, const MinkowskiDifference& m,
                       bool early_exit, PhaseCounts* counts, Proposal* proposal) {
  return PortalSearch(m, early_exit, proposal).RunFrom(start, counts);
}

Proposal SearchPortal(const MinkowskiDifference& m, bool early_exit, PhaseCounts* counts,
                      const std::array<CornerPair, 3>* start) {
  Proposal proposal;
  if (start == nullptr || !SearchFrom(*start, m, early_exit, counts, &proposal)) {
    SearchCold(m, early_exit, counts, &proposal);
  }
  return proposal;
}

}  // namespace touchstone
