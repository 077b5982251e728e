// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_ENGINES_REGISTRY_H_
#define TOUCHSTONE_TOOLS_ENGINES_REGISTRY_H_

#include <vector>

#include "touchstone/tools/engines/engine.h"

namespace touchstone {

// Every engine, ours first, in the order in which tables list them; those whose package was missing
// at configuration say so in `unavailable`.
std::vector<EngineDescription> AllEngines();

// One function a file: appends what it describes.
void DescribeTouchstone(std::vector<EngineDescription>& engines);
void DescribeEnhancedGjk(std::vector<EngineDescription>& engines);
void DescribeLibccd(std::vector<EngineDescription>& engines);
void DescribeFcl(std::vector<EngineDescription>& engines);
void DescribeBulletF64(std::vector<EngineDescription>& engines);
void DescribeBulletF32(std::vector<EngineDescription>& engines);
void DescribeOde(std::vector<EngineDescription>& engines);

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_ENGINES_REGISTRY_H_
