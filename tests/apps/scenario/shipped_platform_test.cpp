// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/scenario/shipped_platform.h"

#include "scratch_folder.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(ShippedPlatform, is_found_by_its_name) {
  const auto model = find_platform("jetson_tx2");
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->name, "jetson_tx2");
}

TEST(ShippedPlatform, names_what_is_unknown_and_what_cannot_be_read) {
  EXPECT_EQ(find_platform("jetson_tx9").error().code, ErrorCode::not_found);
  const ScratchFolder scratch;
  const std::string file = scratch.file("mine.toml", "cores = \"many\"\n");
  EXPECT_NE(find_platform(file).error().message.find(file), std::string::npos);
}

}  // namespace
}  // namespace flyball
