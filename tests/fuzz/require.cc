// SPDX-License-Identifier: MIT
#include <cstdio>
#include <cstdlib>

#include "touchstone/tests/fuzz/bytes.h"

namespace touchstone {

void Require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

}  // namespace touchstone
