// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "touchstone/exact/exact_sum.h"
#include "touchstone/exact/judge/nearest_on_triangle.h"
#include "touchstone/exact/judge/phong_field.h"
#include "touchstone/exact/judge_cpd.h"
#include "touchstone/exact/mesh_membership.h"

namespace touchstone::exact {
namespace {

using Eigen::Vector3d;
using RealTriple = Triple<Real>;

Real ToReal(const mpq_class& x) { return Real(x.get_num()) / Real(x.get_den()); }
RealTriple ToReal(const RationalPoint& x) { return {ToReal(x[0]), ToReal(x[1]), ToReal(x[2])}; }

class PhongJudge {
 public:
  PhongJudge(const TriangleMesh& a, const TriangleMesh& b, const RelativePose& pose,
             const PhongClaim& claim)
      : pair_(a, b, pose), sum_(pair_), claim_(claim) {}

  std::vector<std::string> Run() {
    if (CheckNames() && CheckPieces() && PlacePoint()) {
      CheckFans();
      CheckRounding();
      CheckBoundary();
      CheckDepth();
      CheckResidual();
    }
    return findings_;
  }

 private:
  void Find(const std::string& what) { findings_.push_back("phong: " + what); }

  bool CheckNames() {
    const int names = static_cast<int>(claim_.names.size());
    if (claim_.triangles.empty() || claim_.triangles.size() != claim_.facet_of_triangle.size()) {
      Find("no triangle, or one without its facet");
      return false;
    }
    for (const SumFacet& facet : claim_.facets) {
      if (!sum_.IsValid(facet)) return Find("a facet is none"), false;
    }
    for (const int f : claim_.facet_of_triangle) {
      if (f < 0 || f >= std::ssize(claim_.facets)) return Find("a triangle has no facet"), false;
    }
    for (const SumPointName& name : claim_.names) {
      auto point = sum_.Point(name, claim_.facets);
      if (!point) return Find("a name stands for no one point"), false;
      corners_.push_back(std::move(*point));
    }
    for (const auto& triangle : claim_.triangles) {
      for (const int v : triangle) {
        if (v < 0 || v >= names) return Find("a triangle has no corner"), false;
      }
    }
    return true;
  }

  // Every triangle lies in its facet's plane and faces as it does, and features that cannot touch
  // have none.
  bool CheckPieces() {
    for (std::size_t t = 0; t < claim_.triangles.size(); ++t) {
      const SumFacet& facet = claim_.facets[claim_.facet_of_triangle[t]];
      if (!sum_.CanTouch(facet)) Find("a facet's features cannot touch");
      planes_.push_back(sum_.Plane(facet));
      const auto& [i, j, k] = claim_.triangles[t];
      for (const int v : {i, j, k}) {
        if (Side(planes_[t], corners_[v]) != 0) Find("a triangle leaves its facet's plane");
      }
      const RationalPoint area = Cross(corners_[j] - corners_[i], corners_[k] - corners_[i]);
      if (sgn(Facing(planes_[t], area)) < 0) Find("a triangle faces inward");
    }
    return findings_.empty();
  }

  static mpq_class Facing(const SumPlane& plane, const RationalPoint& direction) {
    return mpq_class(plane.normal[0]) * direction[0] + mpq_class(plane.normal[1]) * direction[1] +
           mpq_class(plane.normal[2]) * direction[2];
  }

  // The point that λ gives, exactly.
  bool PlacePoint() {
    if (!claim_.at.allFinite() || claim_.at.minCoeff() < 0.0 || !(claim_.at.sum() > 0.0)) {
      Find("λ is below zero, or not finite");
      return false;
    }
    mpq_class total = 0;
    for (int k = 0; k < 3; ++k) total += mpq_class(claim_.at[k]);
    for (int i = 0; i < 3; ++i) {
      point_[i] = 0;
      for (int k = 0; k < 3; ++k) {
        point_[i] += mpq_class(claim_.at[k]) * corners_[claim_.triangles[0][k]][i];
      }
      point_[i] /= total;
    }
    return true;
  }

  // No triangle is missing that the normals are made of: sides are run both ways.
  void CheckFans() {
    std::map<std::pair<int, int>, int> runs;
    for (const auto& triangle : claim_.triangles) {
      for (int k = 0; k < 3; ++k) ++runs[{triangle[k], triangle[(k + 1) % 3]}];
    }
    for (const auto& [side, count] : runs) {
      const auto other = runs.find({side.second, side.first});
      if (other != runs.end() && other->second == count) continue;
      if (IsNeeded(side.first, side.second)) return Find("a triangle is missing");
    }
  }

  bool IsNeeded(int u, int v) const {
    const auto& own = claim_.triangles[0];
    if (claim_.normals != PhongNormals::kMean) {
      return std::find(own.begin(), own.end(), u) != own.end() ||
             std::find(own.begin(), own.end(), v) != own.end();
    }
    const auto at = [&](const RationalPoint& x) {
      const RationalPoint true_x = sum_.ToTrue(x);
      return Vector3d(true_x[0].get_d(), true_x[1].get_d(), true_x[2].get_d());
    };
    const Vector3d p = at(corners_[u]) - at(point_), q = at(corners_[v]) - at(point_);
    return NearestOnTriangle(p, q, q).norm() < claim_.mean_radius * (1.0 - 1e-9);
  }

  void CheckRounding() {
    const RationalPoint exact = sum_.ToTrue(point_);
    const mpq_class rounding(claim_.rounding);
    for (int i = 0; i < 3; ++i) {
      if (!std::isfinite(claim_.translation[i]) ||
          abs(exact[i] - mpq_class(claim_.translation[i])) > rounding) {
        return Find("the translation is not the point that λ gives");
      }
    }
  }

  // The bodies touch there, overlap a step further in and not a step further out. The step is
  // taken inside the triangle: from a side, a little way to its middle.
  void CheckBoundary() {
    if (MeshMembership(pair_, sum_.ToTranslation(point_)) != Verdict::kTouch) {
      return Find("the bodies do not touch there");
    }
    RationalPoint x = point_;
    if (claim_.at.minCoeff() <= 0.0) {
      const auto& [i, j, k] = claim_.triangles[0];
      for (int c = 0; c < 3; ++c) {
        const mpq_class middle = (corners_[i][c] + corners_[j][c] + corners_[k][c]) / 3;
        x[c] += (middle - x[c]) / 1048576;
      }
    }
    const IntegerVector& normal = planes_[0].normal;
    const mpq_class step = sum_.StepBelowAnyOther(x);
    if (MeshMembership(pair_, sum_.ToTranslation(Along(x, step, normal))) == Verdict::kOverlap) {
      Find("it is buried");
    }
    if (MeshMembership(pair_, sum_.ToTranslation(Along(x, -step, normal))) != Verdict::kOverlap) {
      Find("there is no overlap on its inner side");
    }
    if (sgn(Facing(planes_[0], point_)) <= 0) Find("it faces inward, seen from the origin");
  }

  // An exact point of ∂M is no nearer than the depth.
  void CheckDepth() {
    const RationalPoint exact = sum_.ToTrue(point_);
    const mpq_class bound(std::isfinite(claim_.depth_lower_bound) ? claim_.depth_lower_bound : 0.0);
    if (!(claim_.depth_lower_bound >= 0.0)) Find("the depth's bound is no length");
    if (Dot(exact, exact) < bound * bound) Find("shorter than the depth");
  }

  void CheckResidual() {
    const std::optional<RealTriple> normal =
        claim_.normals == PhongNormals::kMean ? MeanNormal() : TangentNormal();
    const double residual =
        normal ? SineBetween(Oriented(*normal), ToReal(point_)).ToDouble() : 1.0;
    if (residual <= claim_.residual) return;
    std::ostringstream out;
    out.precision(6);
    out << "the residual is " << residual << ", above the " << claim_.residual << " claimed";
    Find(out.str());
  }

  // Tangent planes have no sign: outward is as the triangle faces, unless normals say so.
  RealTriple Oriented(const RealTriple& normal) const {
    if (claim_.normals == PhongNormals::kMean || claim_.interpolated) return normal;
    return Inner(normal, ToReal(point_)).sign() < 0 ? Times(Real(-1.0), normal) : normal;
  }

  RealTriple UnitNormal(std::size_t t) const {
    const IntegerVector& n = planes_[t].normal;
    return Unit<Real>({Real(n[0]), Real(n[1]), Real(n[2])});
  }

  Real WeightAt(std::size_t t, int k) const {
    const auto& triangle = claim_.triangles[t];
    const RationalPoint &x = corners_[triangle[k]], &y = corners_[triangle[(k + 1) % 3]],
                        &z = corners_[triangle[(k + 2) % 3]];
    const RationalPoint u = y - x, v = z - x;
    const Real area = Length(ToReal(Cross(u, v)));
    if (claim_.normals == PhongNormals::kArea) return area;
    if (claim_.normals == PhongNormals::kUniform) return Real(area.sign() > 0 ? 1.0 : 0.0);
    return Atan2(area, ToReal(Dot(u, v)));
  }

  std::optional<RealTriple> TangentNormal() const {
    std::array<RealTriple, 3> normals;
    for (int c = 0; c < 3; ++c) {
      for (std::size_t t = 0; t < claim_.triangles.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
          if (claim_.triangles[t][k] != claim_.triangles[0][c]) continue;
          normals[c] = Plus(normals[c], Times(WeightAt(t, k), UnitNormal(t)));
        }
      }
      if (Length(normals[c]).sign() == 0) return std::nullopt;
      normals[c] = Unit(normals[c]);
    }
    const RealTriple at = {Real(claim_.at[0]), Real(claim_.at[1]), Real(claim_.at[2])};
    if (!claim_.interpolated) return BlendedNormal(normals, at);
    RealTriple sum;
    for (int c = 0; c < 3; ++c) sum = Plus(sum, Times(at[c], normals[c]));
    return sum;
  }

  std::optional<RealTriple> MeanNormal() const {
    // The radius in the integers' units.
    const Real radius = ToReal(sum_.FromDoubles(Vector3d(claim_.mean_radius, 0, 0))[0]);
    const RealTriple x = ToReal(point_);
    RealTriple sum;
    for (std::size_t t = 0; t < claim_.triangles.size(); ++t) {
      const auto& [i, j, k] = claim_.triangles[t];
      sum = Plus(sum, MeanPart({ToReal(corners_[i]), ToReal(corners_[j]), ToReal(corners_[k])},
                               UnitNormal(t), x, radius));
    }
    if (Length(sum).sign() == 0) return std::nullopt;
    return sum;
  }

  const PlacedMeshPair pair_;
  const ExactSum sum_;
  const PhongClaim& claim_;
  std::vector<RationalPoint> corners_;
  std::vector<SumPlane> planes_;  // of triangles
  RationalPoint point_;
  std::vector<std::string> findings_;
};

}  // namespace

std::vector<std::string> JudgePhong(const TriangleMesh& a, const TriangleMesh& b,
                                    const RelativePose& pose, const PhongClaim& claim) {
  return PhongJudge(a, b, pose, claim).Run();
}

}  // namespace touchstone::exact
