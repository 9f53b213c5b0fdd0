// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/mcap/mcap_recovery.h"

#include "made_rows.h"
#include "scratch_folder.h"
#include <algorithm>
#include <csignal>
#include <filesystem>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace flyball {
namespace {

struct McapRecoveryTest : testing::Test {
  /// 13 chunks of some 30 kB.
  McapRecoveryTest() {
    auto writer = McapWriter::open(path, made_settings());
    for (const MadeRow& row : rows) {
      (*writer)->add(row.channel, row.sequence, row.at, row.bytes);
    }
    EXPECT_TRUE((*writer)->close());
    whole = folder.content("whole.mcap");
  }
  /// What a file of these bytes gives. Old files are removed first: some file systems wait for the
  /// disk when a file is replaced.
  [[nodiscard]] Result<McapRecovery> recovered(const std::string& bytes) const {
    std::filesystem::remove(folder.path("broken.mcap"));
    std::filesystem::remove(out);
    return recover_mcap(folder.file("broken.mcap", bytes), out);
  }
  void expect_refused(const std::string& broken,
                      const std::string& to,
                      const std::string& sentence) const {
    const auto refused = recover_mcap(broken, to);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find(sentence), std::string::npos) << refused.error().message;
    EXPECT_FALSE(std::filesystem::exists(out));
    EXPECT_FALSE(std::filesystem::exists(out + ".part"));
  }

  ScratchFolder folder{};
  std::string path{folder.path("whole.mcap")};
  std::string out{folder.path("out.mcap")};
  std::vector<MadeRow> rows{made_rows(1000, 13, 800)};
  std::string whole{};
};

TEST_F(McapRecoveryTest, leaves_a_broken_file_alone_whatever_its_name_is) {
  const std::string broken = folder.file("out.mcap.part", whole.substr(0, whole.size() / 2));
  const auto done = recover_mcap(broken, out);
  ASSERT_TRUE(done) << done.error().message;
  EXPECT_EQ(folder.content("out.mcap.part"), whole.substr(0, whole.size() / 2));
}

TEST_F(McapRecoveryTest, brings_back_every_closed_chunk_wherever_the_file_is_cut) {
  const McapReader original{path};
  ASSERT_EQ(original.chunks.size(), 13U);
  const std::vector<McapReader::Message> all = as_read(rows);
  std::size_t most = 0;
  for (std::size_t cut = 4096; cut < whole.size(); cut += 4096) {
    std::size_t closed = 0;
    std::size_t messages = 0;
    for (const McapReader::Chunk& chunk : original.chunks) {
      closed += chunk.end <= cut ? 1 : 0;
      messages += chunk.end <= cut ? chunk.messages.size() : 0;
    }
    const auto done = recovered(whole.substr(0, cut));
    ASSERT_EQ(done.ok(), closed > 0) << cut;
    if (!done) {
      continue;
    }
    const McapReader file{out};
    EXPECT_EQ(listed(file.faults), "") << cut;
    EXPECT_EQ(done->chunks, closed) << cut;
    EXPECT_EQ(file.messages(),
              std::vector<McapReader::Message>(all.begin(),
                                               all.begin() + static_cast<std::ptrdiff_t>(messages)))
        << cut;
    EXPECT_EQ(done->messages, messages);
    EXPECT_EQ(done->missing_rows, 0U);
    EXPECT_FALSE(done->was_whole);
    most = std::max(most, closed);
  }
  EXPECT_GE(most, 12U);
}

TEST_F(McapRecoveryTest, writes_a_whole_file_anew) {
  const auto done = recovered(whole);
  ASSERT_TRUE(done) << done.error().message;
  EXPECT_TRUE(done->was_whole);
  EXPECT_EQ(done->lost_bytes, 0U);
  EXPECT_EQ(done->begin, MissionTime{});
  EXPECT_EQ(done->end, rows.back().at);
  EXPECT_EQ(McapReader{out}.messages(), as_read(rows));
}

TEST_F(McapRecoveryTest, leaves_out_a_damaged_chunk_and_counts_the_rows_that_miss) {
  const McapReader original{path};
  whole[original.chunks[4].end - 100] ^= 1;
  const auto done = recovered(whole);
  ASSERT_TRUE(done) << done.error().message;
  EXPECT_EQ(done->damaged_chunks, 1U);
  EXPECT_EQ(done->chunks, 12U);
  EXPECT_EQ(done->missing_rows, original.chunks[4].messages.size());
  const McapReader file{out};
  EXPECT_EQ(listed(file.faults), "");
  EXPECT_EQ(file.metadata.at("flyball.recovery").at("missing_rows"),
            std::to_string(done->missing_rows));
}

TEST_F(McapRecoveryTest, takes_zeros_behind_the_last_chunk_for_its_end) {
  const McapReader original{path};
  const auto done = recovered(whole.substr(0, original.chunks[6].end) + std::string(9000, '\0'));
  ASSERT_TRUE(done) << done.error().message;
  EXPECT_EQ(done->chunks, 7U);
  EXPECT_EQ(done->lost_bytes, 9000U);
}

TEST_F(McapRecoveryTest, never_trusts_a_damaged_byte) {
  const McapReader original{path};
  RandomStream random{1, "damage"};
  for (int trial = 0; trial < 300; ++trial) {
    std::string damaged = whole;
    // Lengths and counts stand in the first bytes of each record.
    const auto& chunk = original.chunks[static_cast<std::size_t>(trial % 13)];
    const auto place =
        static_cast<std::size_t>(chunk.begin) + static_cast<std::size_t>(random.uniform(0.0, 60.0));
    damaged[place] = static_cast<char>(random.uniform(-128.0, 127.9));
    if (const auto done = recovered(damaged)) {
      EXPECT_EQ(listed(McapReader{out}.faults), "") << trial;
    }
  }
}

TEST_F(McapRecoveryTest, says_what_is_wrong_with_its_input) {
  std::filesystem::remove(out);
  expect_refused(folder.path("missing.mcap"), out, "no file \"");
  expect_refused(folder.path(), out, "no file \"");
  expect_refused(folder.file("text.mcap", "PK\x03\x04 and so on"), out, "is no MCAP file");
  expect_refused(folder.file("empty.mcap", ""), out, "is no MCAP file");
  expect_refused(folder.file("young.mcap", whole.substr(0, 600)), out,
                 "ends before its first chunk does");
  expect_refused(path, folder.path("missing/out.mcap"), "cannot be made");
  expect_refused(path, path, "is the broken file itself");
  EXPECT_EQ(folder.content("whole.mcap"), whole);
}

TEST_F(McapRecoveryTest, loses_the_open_chunk_at_most_when_the_writer_is_killed) {
  int news[2];
  ASSERT_EQ(pipe(news), 0);
  const pid_t child = fork();
  if (child == 0) {
    auto writer = McapWriter::open(folder.path("killed.mcap"), made_settings());
    std::size_t told = 0;
    for (const MadeRow& row : rows) {
      (*writer)->add(row.channel, row.sequence, row.at, row.bytes);
      for (; told < (*writer)->chunks(); ++told) {
        (void)!write(news[1], "c", 1);
      }
    }
    pause();  // With a chunk that is open.
    _exit(0);
  }
  close(news[1]);
  char byte{};
  for (int closed = 0; closed < 12; ++closed) {
    ASSERT_EQ(read(news[0], &byte, 1), 1);
  }
  close(news[0]);
  kill(child, SIGKILL);
  int status{};
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  const auto done = recover_mcap(folder.path("killed.mcap"), out);
  ASSERT_TRUE(done) << done.error().message;
  EXPECT_EQ(done->chunks, 12U);
  const McapReader file{out};
  EXPECT_EQ(listed(file.faults), "");
  std::vector<McapReader::Message> expected = as_read(rows);
  expected.resize(file.messages().size());
  EXPECT_EQ(file.messages(), expected);
  EXPECT_GT(expected.size() + 80, rows.size());  // A second has 77 rows.
}

}  // namespace
}  // namespace flyball
