// SPDX-License-Identifier: MIT
#include "touchstone/tools/suites/registry.h"

#include <array>
#include <utility>

#include "touchstone/tools/suites/ellipsoid.h"
#include "touchstone/tools/suites/seldom.h"

namespace touchstone {
namespace {

constexpr std::array<int, 11> kCounts = {8, 10, 14, 20, 30, 50, 80, 100, 120, 150, 200};
constexpr std::array<int, 5> kLargeCounts = {200, 300, 450, 700, 1000};
constexpr std::array<int, 1> kCount20 = {20};
constexpr std::array<double, 1> kAspect1 = {1.0};
constexpr std::array<double, 1> kAspect2 = {2.0};
constexpr std::array<double, 1> kAspect4 = {4.0};
constexpr std::array<double, 1> kAspect10 = {10.0};
constexpr std::array<double, 4> kAspects = {1.0, 2.0, 4.0, 10.0};

// Those that stand alone.
std::vector<std::unique_ptr<Suite>> MakeGenerators() {
  std::vector<std::unique_ptr<Suite>> suites;
  suites.push_back(
      MakeEllipsoidSuite("ellipsoid-1", "hulls of 8 to 200 points on spheres", kAspect1, kCounts));
  suites.push_back(
      MakeEllipsoidSuite("ellipsoid-2", "the same on ellipsoids 2:1:1", kAspect2, kCounts));
  suites.push_back(
      MakeEllipsoidSuite("ellipsoid-4", "the same on ellipsoids 4:1:1", kAspect4, kCounts));
  suites.push_back(
      MakeEllipsoidSuite("ellipsoid-10", "the same on ellipsoids 10:1:1", kAspect10, kCounts));
  suites.push_back(MakeEllipsoidSuite("ellipsoid-n20", "the same, 20 points each, 1:1:1 to 10:1:1",
                                      kAspects, kCount20));
  suites.push_back(MakeEllipsoidSuite("large",
                                      "hulls of 200 to 1000 points on ellipsoids 1:1:1 to 10:1:1",
                                      kAspects, kLargeCounts));
  suites.push_back(MakeGridSuite());
  suites.push_back(MakeBoxesFaceSuite());
  suites.push_back(MakeBoxesEdgeSuite());
  suites.push_back(MakeBoxesVertexSuite());
  suites.push_back(MakePrismsSuite());
  suites.push_back(MakeTiesSuite());
  suites.push_back(MakeTetrahedraSuite());
  for (std::unique_ptr<Suite>& suite : MakeTouchSuites()) suites.push_back(std::move(suite));
  suites.push_back(MakeSliversSuite());
  suites.push_back(MakeFarSuite());
  suites.push_back(MakeScalesSuite());
  suites.push_back(MakeCoplanarSuite());
  suites.push_back(MakeDuplicatesSuite());
  suites.push_back(MakeOffOrthonormalSuite());
  suites.push_back(MakeNestedSuite());
  suites.push_back(MakeWorldPosesSuite());
  suites.push_back(MakeReportedSuite());
  return suites;
}

}  // namespace

std::vector<std::unique_ptr<Suite>> MakeSuites(const std::string& meshes_dir) {
  std::vector<std::unique_ptr<Suite>> suites = MakeGenerators();
  suites.push_back(MakeSeldomSuite(MakeGenerators()));
  suites.push_back(MakeMeshesSuite(meshes_dir));
  return suites;
}

}  // namespace touchstone
