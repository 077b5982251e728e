// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/phong_projection.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace touchstone {
namespace {

using Basis = TangentBasis::Basis;
using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// λ may be below zero by as much as roundings leave it on a side of two triangles: each finds it.
constexpr double kOnSide = 1e-9;
// Newton converges quadratically: a residual below this is followed by one of rounding.
constexpr double kConverged = 1e-13;
// Solutions nearer to each other than this in λ are one.
constexpr double kSame = 1e-7;
// |det J| over the product of its columns' lengths, below which a solution counts as multiple.
constexpr double kSingular = 1e-9;

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

// |Ψ x| / |x| for the orthonormal rows that span Ψ's.
double SineTo(const Basis& basis, const Vector3d& x) {
  const Vector3d normal = basis.row(0).transpose().cross(basis.row(1).transpose());
  const double length = normal.norm() * x.norm();
  return length > 0.0 ? normal.cross(x).norm() / length : 1.0;
}

class Projection {
 public:
  Projection(const PhongSurface& surface, int triangle, const PhongOptions& options)
      : triangle_(triangle),
        options_(options),
        basis_({surface.normals[surface.triangles[triangle][0]],
                surface.normals[surface.triangles[triangle][1]],
                surface.normals[surface.triangles[triangle][2]]},
               options.interpolation) {
    for (int k = 0; k < 3; ++k) corners_.col(k) = surface.vertices[surface.triangles[triangle][k]];
    face_normal_ = (corners_.col(1) - corners_.col(0)).cross(corners_.col(2) - corners_.col(0));
    // o on the inner side, or no point of the plane is outward.
    is_outward_ = face_normal_.dot(corners_.col(0)) > 0.0;
  }

  int Find(std::vector<PhongPoint>* points) {
    if (!is_outward_) return 0;
    const std::size_t begin = points->size();
    if (options_.begin_at) Begin(*options_.begin_at, begin, points);
    Begin({1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}, begin, points);
    if (options_.find_all) {
      // Barycentres of the triangles with corners at multiples of 1/4, upright and inverted.
      for (int i = 0; i < 4; ++i) {
        for (int j = 0; i + j < 4; ++j) {
          Begin(Vector3d(3 * i + 1, 3 * j + 1, 12 - 3 * i - 3 * j - 2) / 12.0, begin, points);
          if (i + j < 3) {
            Begin(Vector3d(3 * i + 2, 3 * j + 2, 12 - 3 * i - 3 * j - 4) / 12.0, begin, points);
          }
        }
      }
      // And on the sides: what lies next to one is overshot from within.
      for (int k = 0; k < 3; ++k) {
        for (int i = 1; i < 4; ++i) {
          Begin(0.25 * i * Vector3d::Unit(k) + (1.0 - 0.25 * i) * Vector3d::Unit((k + 1) % 3),
                begin, points);
        }
      }
    }
    return static_cast<int>(points->size() - begin);
  }

 private:
  struct Linearised {
    Vector2d value;
    Matrix2d jacobian;  // with λ_1 and λ_2, where λ_3 = 1 - λ_1 - λ_2
    Basis basis;
    Vector3d position;
  };

  Linearised At(const Vector3d& at) const {
    std::array<Basis, 3> derivatives;
    Linearised here;
    here.basis = basis_.At(at, &derivatives);
    here.position = corners_ * at;
    here.value = here.basis * here.position;
    for (int k = 0; k < 2; ++k) {
      here.jacobian.col(k) = (derivatives[k] - derivatives[2]) * here.position +
                             here.basis * (corners_.col(k) - corners_.col(2));
    }
    return here;
  }

  void Begin(Vector3d at, std::size_t begin, std::vector<PhongPoint>* points) const {
    for (int i = 0; i < options_.newton_limit; ++i) {
      const Linearised here = At(at);
      if (!here.value.allFinite() || !here.jacobian.allFinite()) return;
      const double determinant = here.jacobian.determinant();
      const double residual = SineTo(here.basis, here.position);
      const double columns = here.jacobian.col(0).norm() * here.jacobian.col(1).norm();
      const bool is_singular = !(std::abs(determinant) > kSingular * columns);
      if (residual < kConverged) {
        if (at.minCoeff() >= -kOnSide) Add(at, here, is_singular, begin, points);
        return;
      }
      if (determinant == 0.0) return;
      Matrix2d adjugate;
      adjugate << here.jacobian(1, 1), -here.jacobian(0, 1), -here.jacobian(1, 0),
          here.jacobian(0, 0);
      Vector2d step = -(adjugate * here.value) / determinant;
      // No further than a triangle's size, so that the way back stays open.
      const double length = step.norm();
      if (!(length < 1e6)) return;
      if (length > 0.5) step *= 0.5 / length;
      at[0] += step[0];
      at[1] += step[1];
      at[2] = 1.0 - at[0] - at[1];
      if (at.minCoeff() < -1.0) return;  // the extended plane has its own solutions
    }
  }

  void Add(const Vector3d& at, const Linearised& here, bool is_singular, std::size_t begin,
           std::vector<PhongPoint>* points) const {
    if (!(face_normal_.dot(here.position) > 0.0)) return;
    for (std::size_t i = begin; i < points->size(); ++i) {
      if (((*points)[i].at - at).norm() < kSame) return;
    }
    PhongPoint point;
    point.triangle = triangle_;
    point.at = at.cwiseMax(0.0);
    point.at /= point.at.sum();
    point.position = corners_ * point.at;
    point.residual = SineTo(here.basis, point.position);
    if (!is_singular) {
      // F(λ, o) = Ψ(λ)(q(λ) - o): dλ = J^-1 Ψ do.
      Eigen::Matrix<double, 3, 2> sides;
      sides.col(0) = corners_.col(0) - corners_.col(2);
      sides.col(1) = corners_.col(1) - corners_.col(2);
      point.rate = sides * (here.jacobian.inverse() * here.basis);
    }
    points->push_back(point);
  }

  const int triangle_;
  const PhongOptions& options_;
  const TangentBasis basis_;
  Matrix3d corners_;
  Vector3d face_normal_;
  bool is_outward_;
};

}  // namespace

std::vector<Vector3d> VertexNormals(std::span<const Vector3d> vertices,
                                    std::span<const std::array<int, 3>> triangles,
                                    NormalWeights weights) {
  std::vector<Vector3d> normals(vertices.size(), Vector3d::Zero());
  for (const std::array<int, 3>& triangle : triangles) {
    const Vector3d area = (vertices[triangle[1]] - vertices[triangle[0]])
                              .cross(vertices[triangle[2]] - vertices[triangle[0]]);
    const double length = area.stableNorm();
    if (!(length > 0.0)) continue;
    for (int k = 0; k < 3; ++k) {
      const Vector3d u = vertices[triangle[(k + 1) % 3]] - vertices[triangle[k]];
      const Vector3d v = vertices[triangle[(k + 2) % 3]] - vertices[triangle[k]];
      const double weight = weights == NormalWeights::kArea    ? length
                            : weights == NormalWeights::kAngle ? std::atan2(length, u.dot(v))
                                                               : 1.0;
      normals[triangle[k]] += weight / length * area;
    }
  }
  for (Vector3d& normal : normals) normal = normal.stableNormalized();
  return normals;
}

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

int ProjectOntoTriangle(const PhongSurface& surface, int triangle, const PhongOptions& options,
                        std::vector<PhongPoint>* points) {
  return Projection(surface, triangle, options).Find(points);
}

double MisfitAtBarycentre(const PhongSurface& surface, int triangle,
                          PhongInterpolation interpolation) {
  const auto& [a, b, c] = surface.triangles[triangle];
  const Vector3d middle = (surface.vertices[a] + surface.vertices[b] + surface.vertices[c]) / 3.0;
  const TangentBasis basis({surface.normals[a], surface.normals[b], surface.normals[c]},
                           interpolation);
  std::array<Basis, 3> derivatives;
  return SineTo(basis.At(Vector3d::Constant(1.0 / 3.0), &derivatives), middle);
}

double CornerAngle(const PhongSurface& surface, int triangle) {
  const auto& corners = surface.triangles[triangle];
  double largest = 0.0;
  for (int k = 0; k < 3; ++k) {
    const Vector3d &p = surface.normals[corners[k]], &q = surface.normals[corners[(k + 1) % 3]];
    largest = std::max(largest, std::atan2(p.cross(q).norm(), p.dot(q)));
  }
  return largest;
}

std::vector<PhongPoint> ProjectByBreadthFirst(const PhongSurface& surface, int from,
                                              const PhongOptions& options) {
  std::vector<PhongPoint> points;
  std::vector<char> is_seen(surface.triangles.size(), 0);
  std::vector<int> queue = {from};
  is_seen[from] = 1;
  for (std::size_t head = 0; head < queue.size(); ++head) {
    if (ProjectOntoTriangle(surface, queue[head], options, &points) > 0) return points;
    for (const int next : surface.neighbors[queue[head]]) {
      if (next < 0 || is_seen[next] != 0) continue;
      is_seen[next] = 1;
      queue.push_back(next);
    }
  }
  return points;
}

}  // namespace touchstone
