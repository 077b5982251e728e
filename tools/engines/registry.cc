// SPDX-License-Identifier: MIT
#include "touchstone/tools/engines/registry.h"

namespace touchstone {
namespace {

// Stands for an engine whose package was missing when the project was configured.
[[maybe_unused]] void DescribeMissing(std::vector<EngineDescription>& engines, const char* name,
                                      const char* package) {
  EngineDescription missing;
  missing.name = name;
  missing.unavailable = std::string(package) + " was not found when the project was configured";
  missing.summary = missing.unavailable;
  engines.push_back(missing);
}

}  // namespace

std::vector<EngineDescription> AllEngines() {
  std::vector<EngineDescription> engines;
  DescribeTouchstone(engines);
  DescribeEnhancedGjk(engines);
#ifdef TOUCHSTONE_HAS_LIBCCD
  DescribeLibccd(engines);
#else
  DescribeMissing(engines, "libccd-mpr", "libccd-dev");
#endif
#ifdef TOUCHSTONE_HAS_FCL
  DescribeFcl(engines);
#else
  DescribeMissing(engines, "fcl-libccd", "libfcl-dev");
#endif
#ifdef TOUCHSTONE_HAS_BULLET_F64
  DescribeBulletF64(engines);
#else
  DescribeMissing(engines, "bullet-f64", "libbullet-dev");
#endif
#ifdef TOUCHSTONE_HAS_BULLET_F32
  DescribeBulletF32(engines);
#else
  DescribeMissing(engines, "bullet-f32", "libbullet-dev");
#endif
#ifdef TOUCHSTONE_HAS_ODE
  DescribeOde(engines);
#else
  DescribeMissing(engines, "ode", "libode-dev");
#endif
  return engines;
}

std::string_view ToString(Quantity quantity) {
  switch (quantity) {
    case Quantity::kDistance:
      return "distance";
    case Quantity::kDepth:
      return "depth";
    case Quantity::kExitTravel:
      return "exit_travel";
  }
  return "";
}

bool IsWrong(TouchConvention convention, Verdict answer, Verdict truth) {
  if (answer == Verdict::kUndecided || answer == truth) return false;
  if (truth != Verdict::kTouch) return true;
  switch (convention) {
    case TouchConvention::kThreeWay:
      return true;
    case TouchConvention::kOverlap:
      return answer != Verdict::kOverlap;
    case TouchConvention::kEither:
      return false;
  }
  return true;
}

}  // namespace touchstone
