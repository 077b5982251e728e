// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/phong_projection.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "touchstone/core/cpd/phong_search_internal.h"

namespace touchstone {
namespace {

using Basis = TangentBasis::Basis;
using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using internal::AtCorner;
using internal::FindZeros;
using internal::Quartics;
using internal::QuarticZero;
using internal::QuarticZeros;

Vector3d Middle() { return Vector3d::Constant(1.0 / 3.0); }

// λ may be below zero by as much as roundings leave it on a side of two triangles: each finds it.
constexpr double kOnSide = 1e-9;
// Newton converges quadratically: a residual below this is followed by one of rounding.
constexpr double kConverged = 1e-13;
// Solutions nearer to each other than this in λ are one.
constexpr double kSame = 1e-7;
// And two nearer than this, where F bends from one to the other, are a double one: less than
// FindZeros tells apart, more than Newton leaves of a residual of kConverged where J vanishes.
constexpr double kTogether = 0x1p-20;
// Of J's singular values, the less over the larger: above, nothing of the kind is near.
constexpr double kRegular = 1e-4;
// Below, J vanishes up to roundings.
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

  PhongCount Find(std::vector<PhongPoint>* points) {
    // An area that is not finite, or of none.
    if (!is_outward_) return {0, true};
    begin_ = points->size();
    points_ = points;
    bool is_complete = false;
    if (options_.find_all) {
      is_complete = FindAll();
    } else {
      if (options_.begin_at) Begin(*options_.begin_at);
      Begin(Middle());
    }
    return {static_cast<int>(points->size() - begin_), is_complete};
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

  // The solution that Newton comes to from λ, if any.
  bool Newton(Vector3d* at, Linearised* here) const {
    for (int i = 0; i < options_.newton_limit; ++i) {
      *here = At(*at);
      if (!here->value.allFinite() || !here->jacobian.allFinite()) return false;
      if (SineTo(here->basis, here->position) < kConverged) return true;
      const double determinant = here->jacobian.determinant();
      if (determinant == 0.0) return false;
      Matrix2d adjugate;
      adjugate << here->jacobian(1, 1), -here->jacobian(0, 1), -here->jacobian(1, 0),
          here->jacobian(0, 0);
      Vector2d step = -(adjugate * here->value) / determinant;
      // No further than a triangle's size, so that the way back stays open.
      const double length = step.norm();
      if (!(length < 1e6)) return false;
      if (length > 0.5) step *= 0.5 / length;
      (*at)[0] += step[0];
      (*at)[1] += step[1];
      (*at)[2] = 1.0 - (*at)[0] - (*at)[1];
      if (at->minCoeff() < -1.0) return false;  // the extended plane has its own solutions
    }
    return false;
  }

  void Begin(Vector3d at) {
    Linearised here;
    if (!Newton(&at, &here)) return;
    for (std::size_t i = begin_; i < points_->size(); ++i) {
      const PhongPoint& point = (*points_)[i];
      if ((point.at - at).norm() < (point.multiplicity == 2 ? kTogether : kSame)) return;
    }
    Add(at, here);
  }

  bool FindAll() {
    const double size = corners_.colwise().stableNorm().maxCoeff();
    std::array<AtCorner, 3> at_corners = {};
    Quartics quartics;
    if (options_.interpolation == PhongInterpolation::kNormals) {
      quartics = OfNormals(size);
    } else {
      quartics = OfBases(size);
      for (int k = 0; k < 3; ++k) {
        at_corners[k] = AtCorner::kVanishes;
        if (!(SineTo(basis_.OnSide(k, 0), corners_.col(k)) < kConverged)) continue;
        at_corners[k] = AtCorner::kVanishesTwice;
        AddCorner(k);
      }
    }
    const QuarticZeros zeros = FindZeros(quartics, at_corners);
    bool is_complete = zeros.is_complete;
    for (int i = 0; i < zeros.count; ++i) {
      const QuarticZero& zero = zeros.zeros[i];
      Vector3d at = zero.at;
      if (!zero.is_simple) {
        Begin(at);
        continue;
      }
      Linearised here;
      // The blended rows may be no basis there, or one so slanted that roundings decide.
      if (Newton(&at, &here) && (at - zero.at).norm() < kSame) {
        Add(at, here);
      } else {
        is_complete = false;
      }
    }
    if (!is_complete) BeginEverywhere();
    return is_complete;
  }

  // From the barycentres of the 16 triangles with corners at multiples of 1/4, and on the sides.
  void BeginEverywhere() {
    Begin(Middle());
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; i + j < 4; ++j) {
        Begin(Vector3d(3 * i + 1, 3 * j + 1, 12 - 3 * i - 3 * j - 2) / 12.0);
        if (i + j < 3) Begin(Vector3d(3 * i + 2, 3 * j + 2, 12 - 3 * i - 3 * j - 4) / 12.0);
      }
    }
    for (int k = 0; k < 3; ++k) {
      for (int i = 1; i < 4; ++i) {
        Begin(0.25 * i * Vector3d::Unit(k) + (1.0 - 0.25 * i) * Vector3d::Unit((k + 1) % 3));
      }
    }
  }

  // Σ_k λ_k λ_k+1 Ψ(λ) q(λ) / size, with Ψ as in TangentBasis::At. A coefficient is at most 1/2,
  // and off by 2^-51: two inner products of 3 roundings each, their sum, and two quotients.
  Quartics OfBases(double size) const {
    Quartics quartics;
    const auto set = [&](const std::array<int, 3>& powers, const Vector2d& value) {
      quartics.Set(powers[0], powers[2], value / size);
    };
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3, m = (k + 2) % 3;
      const auto q = [&](int corner) -> Vector3d { return corners_.col(corner); };
      const Basis &near = basis_.OnSide(k, 0), &far = basis_.OnSide(k, 1);
      std::array<int, 3> powers = {};
      powers[k] = 4;
      set(powers, Vector2d::Zero());
      powers[k] = 3, powers[l] = 1;
      set(powers, near * q(k) / 4.0);
      powers[k] = 2, powers[l] = 2;
      set(powers, (far * q(k) + near * q(l)) / 6.0);
      powers[k] = 1, powers[l] = 3;
      set(powers, far * q(l) / 4.0);
      powers[k] = 2, powers[l] = 1, powers[m] = 1;
      set(powers, (near * q(m) + basis_.OnSide(m, 1) * q(l)) / 12.0);
    }
    return quartics;
  }

  // n(λ) x q(λ) / size along the triangle's plane: it is across q, which is not, so all of it is
  // zero where that is. Of degree 2, times (Σ λ_k)².
  Quartics OfNormals(double size) const {
    Basis along;
    const Vector3d up = face_normal_.stableNormalized();
    along.row(0) = (corners_.col(1) - corners_.col(0)).stableNormalized();
    along.row(1) = up.cross(along.row(0).transpose());
    std::array<std::array<Vector2d, 3>, 3> products;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const Vector3d q = corners_.col(j) / size;
        products[i][j] = along * basis_.NormalAt(i).cross(q);
      }
    }
    Quartics quartics;
    for (int i = 0; i <= 4; ++i) {
      for (int k = 0; i + k <= 4; ++k) {
        // A mean over the ordered pairs of different ones of the four factors λ_i λ_i.. λ_k λ_k..
        const std::array<int, 3> powers = {i, 4 - i - k, k};
        Vector2d sum = Vector2d::Zero();
        for (int p = 0; p < 3; ++p) {
          for (int q = 0; q < 3; ++q) {
            sum += static_cast<double>(powers[p] * (powers[q] - (p == q))) * products[p][q];
          }
        }
        quartics.Set(i, k, sum / 12.0);
      }
    }
    return quartics;
  }

  PhongPoint PointAt(const Vector3d& at, const Basis& basis) const {
    PhongPoint point;
    point.triangle = triangle_;
    point.at = at.cwiseMax(0.0);
    point.at /= point.at.sum();
    point.position = corners_ * point.at;
    point.residual = SineTo(basis, point.position);
    return point;
  }

  void AddCorner(int k) {
    PhongPoint point = PointAt(Vector3d::Unit(k), basis_.OnSide(k, 0));
    point.multiplicity = 0;
    if (face_normal_.dot(point.position) > 0.0) points_->push_back(point);
  }

  void Add(const Vector3d& at, const Linearised& here) {
    if (at.minCoeff() < -kOnSide || !(face_normal_.dot(here.position) > 0.0)) return;
    PhongPoint point = PointAt(at, here.basis);
    point.multiplicity = MultiplicityAt(at, here.jacobian);
    if (point.multiplicity == 1) {
      // F(λ, o) = Ψ(λ)(q(λ) - o): dλ = J^-1 Ψ do.
      Eigen::Matrix<double, 3, 2> sides;
      sides.col(0) = corners_.col(0) - corners_.col(2);
      sides.col(1) = corners_.col(1) - corners_.col(2);
      point.rate = sides * (here.jacobian.inverse() * here.basis);
      // Of J^-1 Ψ on the plane: Ψ's determinant there has the sign of its rows' product along q.
      const Vector3d normal = here.basis.row(0).transpose().cross(here.basis.row(1).transpose());
      point.index =
          (here.jacobian.determinant() > 0.0) == (normal.dot(here.position) > 0.0) ? 1 : -1;
    }
    points_->push_back(point);
  }

  // Where J is all but singular, J r = σ l, the zeros beside λ are those of l·F along r (Lyapunov
  // and Schmidt): of σ s + s² l·F''(r, r) / 2.
  int MultiplicityAt(const Vector3d& at, const Matrix2d& jacobian) const {
    if (std::abs(jacobian.determinant()) > kRegular * jacobian.squaredNorm()) return 1;
    const Eigen::JacobiSVD<Matrix2d> svd(jacobian, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const double largest = svd.singularValues()[0], sigma = svd.singularValues()[1];
    const Vector2d l = svd.matrixU().col(1), r = svd.matrixV().col(1);
    constexpr double kStep = 0x1p-12;
    const Vector3d step = kStep * Vector3d(r[0], r[1], -r[0] - r[1]);
    const Matrix2d change = At(at + step).jacobian - At(at - step).jacobian;
    const double bend = std::abs(l.dot(change * r)) / (2.0 * kStep);
    if (bend > kSingular * largest) return 2.0 * sigma < kTogether * bend ? 2 : 1;
    return sigma > kSingular * largest ? 1 : 0;
  }

  const int triangle_;
  const PhongOptions& options_;
  const TangentBasis basis_;
  Matrix3d corners_;
  Vector3d face_normal_;
  bool is_outward_;
  std::vector<PhongPoint>* points_ = nullptr;
  std::size_t begin_ = 0;  // where this triangle's begin
};

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

PhongCount ProjectOntoTriangle(const PhongSurface& surface, int triangle,
                               const PhongOptions& options, std::vector<PhongPoint>* points) {
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
    if (ProjectOntoTriangle(surface, queue[head], options, &points).points > 0) return points;
    for (const int next : surface.neighbors[queue[head]]) {
      if (next < 0 || is_seen[next] != 0) continue;
      is_seen[next] = 1;
      queue.push_back(next);
    }
  }
  return points;
}

}  // namespace touchstone
