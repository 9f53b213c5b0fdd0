// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/mcap/message_schema.h"

#include "made_rows.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(DescriptorSet, has_a_file_for_each_message_and_used_ones_first) {
  std::vector<std::string> names;
  const std::string set = descriptor_set(made_schemas(), "made.Row");
  for (const WireField& file : wire_fields(set)) {
    names.emplace_back(wire_fields(file.bytes).front().bytes);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"made/Vector.proto", "made/Row.proto"}));
}

TEST(DescriptorSet, leaves_out_what_a_message_does_not_use) {
  EXPECT_EQ(wire_fields(descriptor_set(made_schemas(), "made.Vector")).size(), 1U);
}

TEST(DescriptorSet, calls_timestamps_by_the_name_that_readers_know) {
  const std::string set =
      descriptor_set({{"google.protobuf.Timestamp", {{"seconds", FieldType::int64}}, {}}},
                     "google.protobuf.Timestamp");
  EXPECT_NE(set.find("google/protobuf/timestamp.proto"), std::string::npos);
}

}  // namespace
}  // namespace flyball
