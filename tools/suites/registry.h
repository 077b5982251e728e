// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_SUITES_REGISTRY_H_
#define TOUCHSTONE_TOOLS_SUITES_REGISTRY_H_

#include <memory>
#include <string>
#include <vector>

#include "touchstone/tools/suites/suite.h"

namespace touchstone {

// Every suite, in the order in which tables list them. `meshes_dir` is where `meshes` looks; empty
// leaves that suite unavailable.
std::vector<std::unique_ptr<Suite>> MakeSuites(const std::string& meshes_dir);

// One maker a suite; a file each.
std::unique_ptr<Suite> MakeGridSuite();
std::unique_ptr<Suite> MakeBoxesFaceSuite();
std::unique_ptr<Suite> MakeBoxesEdgeSuite();
std::unique_ptr<Suite> MakeBoxesVertexSuite();
std::unique_ptr<Suite> MakePrismsSuite();
std::unique_ptr<Suite> MakeTiesSuite();
std::unique_ptr<Suite> MakeTetrahedraSuite();
std::unique_ptr<Suite> MakeReportedSuite();
std::unique_ptr<Suite> MakeSliversSuite();
std::unique_ptr<Suite> MakeFarSuite();
std::unique_ptr<Suite> MakeScalesSuite();
std::unique_ptr<Suite> MakeCoplanarSuite();
std::unique_ptr<Suite> MakeDuplicatesSuite();
std::unique_ptr<Suite> MakeOffOrthonormalSuite();
std::unique_ptr<Suite> MakeNestedSuite();
std::unique_ptr<Suite> MakeWorldPosesSuite();
// One a class of face.
std::vector<std::unique_ptr<Suite>> MakeTouchSuites();
std::unique_ptr<Suite> MakeMeshesSuite(const std::string& meshes_dir);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_SUITES_REGISTRY_H_
