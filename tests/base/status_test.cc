// SPDX-License-Identifier: MIT
#include "touchstone/core/base/status.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace touchstone {
namespace {

TEST(Status, EveryCodeHasItsOwnName) {
  std::set<std::string> names;
  for (int i = 0; i <= static_cast<int>(StatusCode::kBadRotation); ++i) {
    const std::string name(ToString(static_cast<StatusCode>(i)));
    EXPECT_NE(name, "?");
    EXPECT_TRUE(names.insert(name).second) << name;
  }
}

TEST(Status, ALineNamesCodeElementAndMessage) {
  EXPECT_EQ(Status().ToString(), "ok");
  const Status open{StatusCode::kOpen, ElementKind::kEdge, 3, 5, "one face only"};
  EXPECT_EQ(open.ToString(), "open (edge 3, 5): one face only");
  const Status flat{StatusCode::kFlat, ElementKind::kNone, -1, -1, ""};
  EXPECT_EQ(flat.ToString(), "flat");
}

TEST(StatusOr, HoldsAValueOrAStatus) {
  const StatusOr<int> value(7);
  EXPECT_TRUE(value.ok());
  EXPECT_TRUE(value.status().ok());
  EXPECT_EQ(*value, 7);
  const StatusOr<int> failure(Status{StatusCode::kFlat, ElementKind::kNone, -1, -1, ""});
  EXPECT_FALSE(failure.ok());
  EXPECT_EQ(failure.status().code, StatusCode::kFlat);
}

}  // namespace
}  // namespace touchstone
