// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/tangent_basis.h"

#include <Eigen/Geometry>
#include <cmath>

namespace touchstone {
namespace {

using Basis = TangentBasis::Basis;
using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

Basis BasisAcross(const Vector3d& normal) {
  Basis basis;
  const Vector3d u = normal.unitOrthogonal();
  basis.row(0) = u;
  basis.row(1) = normal.cross(u);
  return basis;
}

// The orthogonal R, a turn or a reflection, that brings R * from nearest to `to`: of C = to from^T
// the polar factor. A 2 x 2 matrix is a turn's multiple plus a reflection's; the longer one wins.
Basis Aligned(const Basis& from, const Basis& to) {
  const Matrix2d c = to * from.transpose();
  const Vector2d turn(c(0, 0) + c(1, 1), c(1, 0) - c(0, 1));
  const Vector2d mirror(c(0, 0) - c(1, 1), c(1, 0) + c(0, 1));
  Matrix2d r;
  if (turn.squaredNorm() >= mirror.squaredNorm()) {
    const Vector2d u = turn.stableNormalized();
    r << u[0], -u[1], u[1], u[0];
  } else {
    const Vector2d u = mirror.stableNormalized();
    r << u[0], u[1], u[1], -u[0];
  }
  return r * from;
}

}  // namespace

TangentBasis::TangentBasis(const std::array<Vector3d, 3>& normals, PhongInterpolation interpolation)
    : by_normals_(interpolation == PhongInterpolation::kNormals), normals_(normals) {
  if (by_normals_) return;
  const Basis first = BasisAcross(normals[0]);
  std::array<Basis, 3> corners = {first, Aligned(BasisAcross(normals[1]), first),
                                  Aligned(BasisAcross(normals[2]), first)};
  for (int k = 0; k < 3; ++k) {
    sides_[k][0] = corners[k];
    sides_[k][1] = Aligned(corners[(k + 1) % 3], corners[k]);
  }
}

Basis TangentBasis::At(const Vector3d& at, std::array<Basis, 3>* derivatives) const {
  if (by_normals_) {
    // A basis across n = Σ λ_i n_i: e_a x n and e_b x n for the axes that n leans to least.
    const Vector3d normal = at[0] * normals_[0] + at[1] * normals_[1] + at[2] * normals_[2];
    int most = 0;
    normal.cwiseAbs().maxCoeff(&most);
    const Vector3d a = Vector3d::Unit((most + 1) % 3), b = Vector3d::Unit((most + 2) % 3);
    const auto across = [&](const Vector3d& n) {
      Basis basis;
      basis.row(0) = a.cross(n);
      basis.row(1) = b.cross(n);
      return basis;
    };
    for (int i = 0; i < 3; ++i) (*derivatives)[i] = across(normals_[i]);
    return across(normal);
  }
  // Ψ = Σ_k w_k E_k / Σ_k w_k, w_k = λ_k λ_k+1, E_k = λ_k T_k + λ_k+1 T_k+1 as side k has them.
  Basis sum = Basis::Zero();
  std::array<Basis, 3> sums = {Basis::Zero(), Basis::Zero(), Basis::Zero()};
  double weights = 0.0;
  Vector3d rates = Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3;
    const double weight = at[k] * at[l];
    const Basis side = at[k] * sides_[k][0] + at[l] * sides_[k][1];
    weights += weight;
    rates[k] += at[l];
    rates[l] += at[k];
    sum += weight * side;
    sums[k] += at[l] * side + weight * sides_[k][0];
    sums[l] += at[k] * side + weight * sides_[k][1];
  }
  if (std::abs(weights) < 1e-12) {
    // At a corner all sides agree.
    int corner = 0;
    at.maxCoeff(&corner);
    for (int i = 0; i < 3; ++i) (*derivatives)[i] = sides_[i][0];
    return sides_[corner][0];
  }
  const Basis basis = sum / weights;
  for (int i = 0; i < 3; ++i) (*derivatives)[i] = (sums[i] - rates[i] * basis) / weights;
  return basis;
}

}  // namespace touchstone
