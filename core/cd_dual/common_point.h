// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_CORE_CD_DUAL_COMMON_POINT_H_
#define TOUCHSTONE_CORE_CD_DUAL_COMMON_POINT_H_

#include <optional>

#include "touchstone/core/cd_dual/result.h"
#include "touchstone/core/cd_dual/signs.h"

namespace touchstone {

// The point that a certificate of overlap or touch names: with o = l0 c + sum li (a_i - b_i), the
// point l0 p0 + sum li a_i of P is l0 q0 + sum li b_i of Q. In P's frame, with a bound on its
// distance from either body. Nothing for other certificates. Complexity: O(1).
std::optional<CommonPoint> FindCommonPoint(Signs* signs, const Certificate& certificate);

}  // namespace touchstone

#endif  // TOUCHSTONE_CORE_CD_DUAL_COMMON_POINT_H_
