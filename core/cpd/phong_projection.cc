// SPDX-License-Identifier: MIT
#include "touchstone/core/cpd/phong_projection.h"

#include <Eigen/Geometry>
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

// |Ψ x| / |x| for the orthonormal rows that span Ψ's.
double SineTo(const Basis& basis, const Vector3d& x) {
  const Vector3d normal = basis.row(0).transpose().cross(basis.row(1).transpose());
  const double length = normal.norm() * x.norm();
  return length > 0.0 ? normal.cross(x).norm() / length : 1.0;
}

Matrix2d Adjugate(const Matrix2d& m) {
  Matrix2d adjugate;
  adjugate << m(1, 1), -m(0, 1), -m(1, 0), m(0, 0);
  return adjugate;
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
      Vector2d step = -(Adjugate(here->jacobian) * here->value) / determinant;
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
    const double determinant = std::abs(jacobian.determinant()), largest = jacobian.norm();
    if (determinant > kRegular * largest * largest) return 1;
    if (!(largest > 0.0)) return 0;
    // The adjugate is all but r l^T times the larger singular value.
    const double sigma = determinant / largest;
    const Matrix2d adjugate = Adjugate(jacobian);
    Eigen::Index column = 0, row = 0;
    adjugate.colwise().squaredNorm().maxCoeff(&column);
    adjugate.rowwise().squaredNorm().maxCoeff(&row);
    const Vector2d r = adjugate.col(column).normalized(), l = adjugate.row(row).normalized();
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
