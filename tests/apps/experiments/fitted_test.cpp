// SPDX-License-Identifier: BSD-3-Clause

#include "experiments/framework/fitted.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(Fitted, has_the_scales_that_the_platform_file_has) {
  const auto all = fitted_values();
  ASSERT_TRUE(all.ok()) << all.error().message;
  const auto octomap = std::find_if(all->begin(), all->end(), [](const Fitted& fitted) {
    return fitted.what == "scale of octomap";
  });
  ASSERT_NE(octomap, all->end());
  EXPECT_EQ(octomap->value, "29.8") << "sim/platforms/jetson_tx2.toml";
  EXPECT_NE(octomap->to.find("630 ms"), std::string::npos);
}

TEST(Fitted, says_of_everything_to_what_and_where) {
  const auto all = fitted_values();
  ASSERT_TRUE(all.ok()) << all.error().message;
  for (const Fitted& fitted : *all) {
    EXPECT_FALSE(fitted.what.empty());
    EXPECT_FALSE(fitted.to.empty()) << fitted.what;
    EXPECT_FALSE(fitted.where.empty()) << fitted.what;
  }
}

}  // namespace
}  // namespace flyball
