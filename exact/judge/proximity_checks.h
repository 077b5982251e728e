// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the judges of distance, depth and travel share, and how tight they want claims to be.
//
//   S   the size: PlacedPair::size()
//   A   the amplification: how far the value moves when every coordinate moves by one, in units of
//       the coordinates: 1 for distance and depth, 1 / (|s| cosine) for a travel (travel.cc). A S
//       is the absolute condition.
//
// Of a BoundedValue (value, error, condition), how tight it is under kExact only:
//
//   |value - exact| <= error                              else value_out_of_bounds
//   condition <= 64 (1 + A S / |value|)      value != 0   else loose_bound
//   error <= 1e-12 condition |value|         value != 0   else loose_bound
//   error <= 64e-12 A S                      value == 0   else loose_bound
//
// Of a point or translation: within its error, and under kExact that error <= 64e-12 S. Of lower
// and upper: they hold, and under kExact lie within 64e-12 S of the value.
#ifndef TOUCHSTONE_EXACT_JUDGE_PROXIMITY_CHECKS_H_
#define TOUCHSTONE_EXACT_JUDGE_PROXIMITY_CHECKS_H_

#include <array>
#include <string>
#include <vector>

#include "touchstone/exact/convert.h"
#include "touchstone/exact/judge_proximity.h"
#include "touchstone/exact/support.h"

namespace touchstone::exact {

inline constexpr double kLengthTolerance = 64e-12;  // of the size

class ProximityContext {
 public:
  ProximityContext(const ExactBody& p, const ExactBody& q, const RelativePose& pose, int interior_p,
                   int interior_q, const ProximityJudgeOptions& how, std::vector<Finding>* findings)
      : options(how),
        pair(p.data(), q.data(), pose, interior_p, interior_q),
        p_(p),
        q_(q),
        pose_(pose),
        findings_(findings) {}

  void Add(FindingKind kind, std::string detail) const {
    findings_->push_back({kind, std::move(detail)});
  }

  Verdict TrueVerdict() const;
  // The certificate proves the verdict.
  void CheckVerdictCertificate(Verdict verdict, const Certificate& certificate, int interior_p,
                               int interior_q) const;

  void CheckValue(const std::string& name, const BoundedValue& stated, const Real& exact,
                  double amplification) const;
  void CheckPoint(const std::string& name, const Eigen::Vector3d& stated, double error,
                  const std::array<Real, 3>& exact) const;
  // `stated` holds as a bound from below (or from above) of `exact`.
  void CheckBound(const std::string& name, double stated, const Real& exact, bool from_below) const;
  // Not further than `tolerance` S from `exact`.
  void CheckNear(const std::string& name, double stated, const Real& exact) const;

  bool IndicesExist(const VertexPair& pair) const;
  bool FeatureExists(const Feature& feature, bool of_p) const;
  // The feature is of the supporting vertices' exact dimension and lies in them.
  void CheckFeature(const std::string& name, const Feature& feature, const ExactBodyData& body,
                    const std::vector<int>& supporting) const;
  // The facet is one of M, of the class and features named; its outward normal if so.
  std::optional<IntegerVector> CheckFacet(const std::string& name, const ContactFacet& facet) const;

  const ProximityJudgeOptions& options;
  const PlacedPair pair;

 private:
  const ExactBody& p_;
  const ExactBody& q_;
  const RelativePose& pose_;
  std::vector<Finding>* findings_;
};

std::string Number(double value);
// A direction of doubles as integers, up to a positive factor.
IntegerVector ExactDirection(const Eigen::Vector3d& direction);
// The largest n.x over M, over |n|, in true lengths.
Real HeightAlong(const PlacedPair& pair, const IntegerVector& n);

}  // namespace touchstone::exact

#endif  // TOUCHSTONE_EXACT_JUDGE_PROXIMITY_CHECKS_H_
