// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TOOLS_BAD_INPUT_H_
#define TOUCHSTONE_TOOLS_BAD_INPUT_H_

#include <string>

namespace touchstone {

// Thrown by a subcommand for bad usage or data: one line for stderr.
struct BadInput {
  std::string message;
};

}  // namespace touchstone

#endif  // TOUCHSTONE_TOOLS_BAD_INPUT_H_
