// SPDX-License-Identifier: MIT
//
// The classes by which the stability report counts.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "touchstone/tools/campaign/contestant.h"

namespace touchstone {
namespace {

struct Bound {
  double below;
  const char* name;
};

// The name of the first bound that `value` is below, or `last`.
template <std::size_t N>
std::string NameBelow(const std::array<Bound, N>& bounds, double value, const char* last) {
  for (const Bound& bound : bounds) {
    if (value < bound.below) return bound.name;
  }
  return last;
}

}  // namespace

std::string TravelClass(std::optional<double> travel) {
  if (!travel) return "-deep";
  if (*travel == 0.0) return "0";
  static constexpr std::array<Bound, 6> kBounds = {{{1e-15, "<1e-15"},
                                                    {1e-12, "<1e-12"},
                                                    {1e-9, "<1e-9"},
                                                    {1e-6, "<1e-6"},
                                                    {1e-3, "<1e-3"},
                                                    {1e-1, "<1e-1"}}};
  return (*travel < 0.0 ? '-' : '+') + NameBelow(kBounds, std::fabs(*travel), ">=1e-1");
}

std::string ErrorClass(double value, double exact) {
  if (std::isnan(value)) return "nan";
  const double error = std::fabs(value - exact) / std::fabs(exact);
  static constexpr std::array<Bound, 6> kBounds = {{{1e-15, "<1e-15"},
                                                    {1e-12, "<1e-12"},
                                                    {1e-9, "<1e-9"},
                                                    {1e-6, "<1e-6"},
                                                    {1e-3, "<1e-3"},
                                                    {1.0, "<1"}}};
  return NameBelow(kBounds, error, ">=1");
}

std::string ScaleClass(double size) {
  static constexpr std::array<Bound, 6> kBounds = {{{1e-30, "<1e-30"},
                                                    {1e-6, "<1e-6"},
                                                    {1e-1, "<1e-1"},
                                                    {1e3, "<1e3"},
                                                    {1e7, "<1e7"},
                                                    {1e30, "<1e30"}}};
  return NameBelow(kBounds, size, ">=1e30");
}

std::string AspectClass(double aspect) {
  static constexpr std::array<Bound, 4> kBounds = {
      {{3.0, "<3"}, {30.0, "<30"}, {1e3, "<1e3"}, {1e5, "<1e5"}}};
  return NameBelow(kBounds, aspect, ">=1e5");
}

double AspectOf(const ConvexPolyhedron& body) {
  // Scaled, so that nothing overflows, and about the mean.
  const double scale = 1.0 / body.max_coordinate();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& v : body.vertices()) mean += scale * v;
  mean /= body.vertex_count();
  double extent = 0.0;
  for (const Eigen::Vector3d& v : body.vertices())
    extent = std::max(extent, (scale * v - mean).cwiseAbs().maxCoeff());
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& v : body.vertices()) {
    const Eigen::Vector3d x = (scale * v - mean) / extent;
    moments += x * x.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments, Eigen::EigenvaluesOnly);
  const double least = solver.eigenvalues()[0];
  const double most = solver.eigenvalues()[2];
  return least > 0.0 ? std::sqrt(most / least) : 1e9;
}

}  // namespace touchstone
