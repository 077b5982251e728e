// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/contact_space_projection.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "touchstone/core/mesh/membership.h"

namespace touchstone {
namespace {

using Eigen::Vector3d;

struct HalfSpace {  // normal . x >= offset
  Vector3d normal;
  double offset;
};

// The point of all half-spaces nearest to the origin: the feet on each, on each two and each three,
// the nearest that is in all. Nothing if there is none.
std::optional<Vector3d> NearestIn(const std::vector<HalfSpace>& spaces, double slack) {
  std::optional<Vector3d> best;
  const auto offer = [&](const Vector3d& x) {
    if (!x.allFinite() || (best && best->squaredNorm() <= x.squaredNorm())) return;
    for (const HalfSpace& space : spaces) {
      if (space.normal.dot(x) < space.offset - slack) return;
    }
    best = x;
  };
  for (std::size_t i = 0; i < spaces.size(); ++i) {
    const auto& [p, x] = spaces[i];
    offer(x * p);
    for (std::size_t j = 0; j < i; ++j) {
      const auto& [q, y] = spaces[j];
      const double cosine = p.dot(q), rest = 1.0 - cosine * cosine;
      if (rest > 1e-12) offer(((x - y * cosine) * p + (y - x * cosine) * q) / rest);
      for (std::size_t k = 0; k < j; ++k) {
        const auto& [r, z] = spaces[k];
        const double determinant = p.dot(q.cross(r));
        if (std::abs(determinant) > 1e-9) {
          offer((x * q.cross(r) + y * r.cross(p) + z * p.cross(q)) / determinant);
        }
      }
    }
  }
  return best;
}

class Projection {
 public:
  Projection(const MeshPair& pair, const ContactSpaceOptions& options, ContactSpaceCache* cache,
             ContactSpaceResult* result)
      : pair_(pair), options_(options), cache_(*cache), result_(*result) {}

  void Run() {
    if (!Overlaps(Vector3d::Zero())) {
      result_.is_separate = true;
      cache_.last.reset();
      return;
    }
    Vector3d free = Begin();
    result_.translation = free;
    while (result_.iterations < options_.iteration_limit) {
      const auto contact = MoveTo(&free, Vector3d::Zero());
      if (!Improve(&free, contact)) {
        cache_.last = result_.translation;
        return;
      }
    }
    result_.reached_limit = true;
    cache_.last = result_.translation;
  }

 private:
  bool Overlaps(const Vector3d& x) {
    return Membership(pair_, x, {}, &cache_.collision.membership).verdict == Verdict::kOverlap;
  }

  Vector3d Begin() {
    const Vector3d beside = BesideBox();
    if (!cache_.last || !cache_.last->allFinite()) return beside;
    double step = 1e-6;
    for (Vector3d x = *cache_.last; x.norm() < beside.norm(); x *= 1.0 + step, step *= 2.0) {
      if (!Overlaps(x)) return x;
    }
    return beside;
  }

  Vector3d BesideBox() const {
    const Vector3d low_a = pair_.a().tree.low(), high_a = pair_.a().tree.high(),
                   low_b = pair_.b().tree.low(), high_b = pair_.b().tree.high();
    Vector3d best = Vector3d::Constant(4.0);
    for (int axis = 0; axis < 3; ++axis) {
      for (const double step : {high_a[axis] - low_b[axis], low_a[axis] - high_b[axis]}) {
        const double length = std::copysign(std::abs(step) + 0x1p-46, step);
        if (std::abs(length) < best.norm()) best = length * Vector3d::Unit(axis);
      }
    }
    return best / pair_.scale();
  }

  // Moves as far as proven safe, and keeps the shortest placement met. The contact's half-space.
  std::optional<HalfSpace> MoveTo(Vector3d* free, const Vector3d& to) {
    ++result_.iterations;
    const TranslationalCollisionResult way =
        TranslationalCollision(pair_, *free, to, &cache_.collision);
    const Vector3d at = *free + way.fraction * (to - *free);
    *free += way.safe_fraction * (to - *free);
    if (free->norm() < result_.translation.norm()) result_.translation = *free;
    if (!way.is_hit || way.normal.isZero()) return std::nullopt;
    return HalfSpace{way.normal, way.normal.dot(at)};
  }

  // From a contact to where the contacts met so far leave the origin nearest. Whether that made the
  // answer shorter by more than rounding.
  bool Improve(Vector3d* free, const std::optional<HalfSpace>& contact) {
    const double before = result_.translation.norm(), slack = 0x1p-30 / pair_.scale();
    std::vector<HalfSpace> spaces;
    if (contact) spaces.push_back(*contact);
    for (int i = 0; i < 4 && !spaces.empty(); ++i) {
      const auto target = NearestIn(spaces, slack);
      if (!target || target->norm() >= free->norm() - slack) break;
      if (result_.iterations >= options_.iteration_limit) break;
      const auto next = MoveTo(free, *target);
      if (!next) break;  // there: the next round begins from it
      spaces.push_back(*next);
    }
    *free = result_.translation;
    return before - result_.translation.norm() > 1e-6 * before + slack;
  }

  const MeshPair& pair_;
  const ContactSpaceOptions& options_;
  ContactSpaceCache& cache_;
  ContactSpaceResult& result_;
};

}  // namespace

ContactSpaceResult ContactSpaceProjection(const MeshPair& pair, const ContactSpaceOptions& options,
                                          ContactSpaceCache* cache) {
  ContactSpaceCache own;
  ContactSpaceResult result;
  Projection(pair, options, cache != nullptr ? cache : &own, &result).Run();
  return result;
}

}  // namespace touchstone
