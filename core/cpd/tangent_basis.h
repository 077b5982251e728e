// SPDX-License-Identifier: MIT
//
//   paper   here              meaning
//   T                         a basis of the tangent plane at a vertex, two rows
//   Ψ(λ)    TangentBasis      the interpolated one
#ifndef TOUCHSTONE_CORE_CPD_TANGENT_BASIS_H_
#define TOUCHSTONE_CORE_CPD_TANGENT_BASIS_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace touchstone {

// How the surface's normals are made continuous between vertices.
enum class PhongInterpolation : std::uint8_t {
  kTangentBasis,  // bases of tangent planes, aligned along each side and blended
  // The normals themselves: the paper's Figure 2a. Vanishes where normals at the ends of a side are
  // opposite, and finds points there that no tangent plane makes.
  kNormals,
};

// The interpolated tangent plane of one triangle.
//
// Bases at the ends of a side are turned in their planes until they agree best (reflections
// allowed: a plane has no sign), and blended linearly: that is the side's basis, the same seen from
// either triangle. Inside, the three sides' bases, turned to agree with the first corner's, are
// blended with weights λ_i λ_j, which on a side leave its own. (Panozzo, Baran, Diamanti,
// Sorkine-Hornung, "Weighted averages on surfaces", 2013; the paper omits the recipe.)
class TangentBasis {
 public:
  TangentBasis(const std::array<Eigen::Vector3d, 3>& normals, PhongInterpolation interpolation);

  using Basis = Eigen::Matrix<double, 2, 3>;
  // Ψ(λ), up to a positive factor, and its derivatives with each λ_i.
  Basis At(const Eigen::Vector3d& at, std::array<Basis, 3>* derivatives) const;
  // The basis that corner k + end has on side k, from corner k to k + 1. None with kNormals.
  const Basis& OnSide(int k, int end) const { return sides_[k][end]; }
  const Eigen::Vector3d& NormalAt(int corner) const { return normals_[corner]; }

 private:
  bool by_normals_;
  std::array<Eigen::Vector3d, 3> normals_;
  std::array<std::array<Basis, 2>, 3> sides_;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CPD_TANGENT_BASIS_H_
