// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/mcap/mcap_writer.h"

#include "made_rows.h"
#include "scratch_folder.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// Writes the rows to a file of the folder; returns its path.
std::string written(const ScratchFolder& folder,
                    const std::string& name,
                    const McapSettings& settings,
                    const std::vector<MadeRow>& rows) {
  auto writer = McapWriter::open(folder.path(name), settings);
  EXPECT_TRUE(writer) << writer.error().message;
  (*writer)->add_metadata("made.mission", {{"seed", "3"}, {"policy", "fixed"}});
  for (const MadeRow& row : rows) {
    (*writer)->add(row.channel, row.sequence, row.at, row.bytes);
  }
  const Status closed = (*writer)->close();
  EXPECT_TRUE(closed) << closed.error().message;
  return folder.path(name);
}

TEST(McapWriter, leaves_a_file_whose_checksums_and_indexes_hold) {
  const ScratchFolder folder;
  const std::vector<MadeRow> rows = made_rows(500, 13, 700);
  const McapReader file{written(folder, "a.mcap", made_settings(), rows)};
  EXPECT_EQ(listed(file.faults), "");
  EXPECT_EQ(file.messages(), as_read(rows));
  EXPECT_EQ(file.chunks.size(), 7U);  // 6.5 s.
  EXPECT_EQ(file.channels.size(), 3U);
  EXPECT_EQ(file.metadata.at("made.mission").at("policy"), "fixed");
}

TEST(McapWriter, describes_its_messages_so_that_a_stranger_can_decode_them) {
  const ScratchFolder folder;
  const McapReader file{written(folder, "a.mcap", made_settings(), made_rows(40, 13, 30))};
  const auto rows = file.decoded("/rows");
  ASSERT_EQ(rows.size(), 20U);
  EXPECT_EQ(rows[7].text("name"), "row 14");
  EXPECT_EQ(rows[7].message("place").number("y"), -7.0);
  EXPECT_EQ(rows[7].number("kind"), 2.0);
  EXPECT_EQ(rows[7].numbers.at("counts"), (std::vector<double>{7.0, 14.0 * (1 << 20)}));
  EXPECT_EQ(file.decoded("/places").at(3).number("x"), 7.0);
  EXPECT_TRUE(file.decoded("/silent").empty());
}

TEST(McapWriter, closes_a_chunk_after_a_second) {
  const ScratchFolder folder;
  const McapReader file{written(folder, "a.mcap", made_settings(), made_rows(1001, 10, 3))};
  ASSERT_EQ(file.chunks.size(), 11U);
  EXPECT_EQ(file.chunks[3].begin_ns, 3'000'000'000U);
  EXPECT_EQ(file.chunks[3].end_ns, 3'990'000'000U);
}

TEST(McapWriter, closes_a_chunk_that_is_as_large_as_it_may_be) {
  const ScratchFolder folder;
  McapSettings settings = made_settings();
  settings.chunk_bytes = 20'000;
  const McapReader file{written(folder, "a.mcap", settings, made_rows(100, 1, 2000))};
  EXPECT_EQ(listed(file.faults), "");
  EXPECT_EQ(file.chunks.size(), 6U);  // Ten rows of some 2080 bytes, and ten of 49, in each.
  EXPECT_EQ(file.messages(), as_read(made_rows(100, 1, 2000)));
}

TEST(McapWriter, is_valid_without_a_message) {
  const ScratchFolder folder;
  const McapReader file{written(folder, "a.mcap", made_settings(), {})};
  EXPECT_EQ(listed(file.faults), "");
  EXPECT_TRUE(file.chunks.empty());
}

TEST(McapWriter, writes_the_same_bytes_for_the_same_rows) {
  const ScratchFolder folder;
  written(folder, "a.mcap", made_settings(), made_rows(300, 13, 100));
  written(folder, "b.mcap", made_settings(), made_rows(300, 13, 100));
  EXPECT_EQ(folder.content("a.mcap"), folder.content("b.mcap"));
}

TEST(McapWriter, says_where_it_cannot_write) {
  const ScratchFolder folder;
  const auto nowhere = McapWriter::open(folder.path("missing/a.mcap"), made_settings());
  ASSERT_FALSE(nowhere);
  EXPECT_NE(nowhere.error().message.find("missing/a.mcap\" cannot be made: No such file"),
            std::string::npos)
      << nowhere.error().message;
  const auto full = McapWriter::open("/dev/full", made_settings());
  ASSERT_FALSE(full);
  EXPECT_NE(full.error().message.find("No space left on device"), std::string::npos)
      << full.error().message;
}

}  // namespace
}  // namespace flyball
