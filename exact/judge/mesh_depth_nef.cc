// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "touchstone/exact/judge/nearest_on_triangle.h"
#include "touchstone/exact/judge_cpd.h"
#include "touchstone/exact/mesh_pair.h"
#include "touchstone/exact/nef_mesh_sum.h"

namespace touchstone::exact {
namespace {

using Eigen::Vector3d;

// Of the pair's integers, in true lengths.
Vector3d InDoubles(const PlacedMeshPair& pair, const RationalPoint& x) {
  mpq_class unit(1, pair.scale());
  unit.canonicalize();
  if (pair.exponent() >= 0) {
    mpq_mul_2exp(unit.get_mpq_t(), unit.get_mpq_t(), pair.exponent());
  } else {
    mpq_div_2exp(unit.get_mpq_t(), unit.get_mpq_t(), -pair.exponent());
  }
  Vector3d out;
  for (int k = 0; k < 3; ++k) out[k] = mpq_class(x[k] * unit).get_d();
  return out;
}

}  // namespace

std::vector<std::string> JudgeMeshDepthByNef(const TriangleMesh& a, const TriangleMesh& b,
                                             const RelativePose& pose,
                                             const MeshDepthClaim& claim) {
  const PlacedMeshPair pair(a, b, pose);
  const NefMeshSum sum = MakeNefMeshSum(pair);
  std::vector<Vector3d> points;
  for (const RationalPoint& x : sum.points) points.push_back(InDoubles(pair, x));
  double distance = std::numeric_limits<double>::infinity();
  for (const auto& [i, j, k] : sum.triangles) {
    distance = std::min(distance, NearestOnTriangle(points[i], points[j], points[k]).norm());
  }
  const double slack = 1e-12 * pair.size();
  const bool has_slots = !sum.slot_samples.empty();
  for (const RationalPoint& x : sum.slot_samples) {
    distance = std::min(distance, InDoubles(pair, x).norm());
  }
  std::vector<std::string> findings;
  const auto find = [&](const char* what, double bound) {
    std::ostringstream out;
    out.precision(17);
    out << "depth: the " << what << " bound " << bound << ", but M ends at " << distance;
    findings.push_back(out.str());
  };
  if (claim.lower_bound > distance + slack) find("lower", claim.lower_bound);
  if (!has_slots && claim.upper_bound < distance - slack) find("upper", claim.upper_bound);
  return findings;
}

}  // namespace touchstone::exact
