// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/mcap/record_thread.h"

#include "flyball/mcap/mcap_recovery.h"

#include "counting_new.h"
#include "made_rows.h"
#include "scratch_folder.h"
#include <atomic>
#include <csignal>
#include <thread>

#include <gtest/gtest.h>
#include <sys/resource.h>

namespace flyball {
namespace {

RecordThreadSettings settings_of(WhenFull when_full, std::size_t queue_bytes) {
  RecordThreadSettings settings;
  settings.file = made_settings();
  settings.when_full = when_full;
  settings.queue_bytes = queue_bytes;
  return settings;
}

/// The writing thread stands still until `release`.
struct Held {
  std::atomic<bool> stands{};
  std::atomic<bool> may_go{};
  std::string operator()() {
    stands = true;
    while (!may_go) {
      std::this_thread::yield();
    }
    return Protobuf{}.real(1, 1.0).bytes();
  }
};

struct RecordThreadTest : testing::Test {
  [[nodiscard]] std::unique_ptr<RecordThread> open(const RecordThreadSettings& settings,
                                                   const std::string& name = "a.mcap") const {
    auto record = RecordThread::open(folder.path(name), settings, {{"made", {{"seed", "1"}}}});
    EXPECT_TRUE(record) << record.error().message;
    return std::move(*record);
  }
  /// All rows in order, whatever their sequence numbers.
  static void add(RecordThread& record, const std::vector<MadeRow>& rows) {
    for (const MadeRow& row : rows) {
      record.add(row.channel, row.at, row.bytes);
    }
  }
  ScratchFolder folder{};
};

TEST_F(RecordThreadTest, loses_nothing_where_it_may_wait) {
  const std::vector<MadeRow> rows = made_rows(3000, 7, 400);
  const auto record = open(settings_of(WhenFull::wait, 2048));  // Room for four rows.
  add(*record, rows);
  ASSERT_TRUE(record->close());
  const McapReader file{folder.path("a.mcap")};
  EXPECT_EQ(listed(file.faults), "");
  EXPECT_EQ(file.messages(), as_read(rows));
  EXPECT_EQ(record->counts().written, rows.size());
  EXPECT_EQ(record->counts().dropped, 0U);
  EXPECT_EQ(file.metadata.at("flyball.record").at("messages"), "3000");
  EXPECT_EQ(file.metadata.at("flyball.record").at("dropped"), "0");
  EXPECT_EQ(file.metadata.at("made").at("seed"), "1");
}

TEST_F(RecordThreadTest, writes_bytes_that_do_not_depend_on_its_speed_where_it_may_wait) {
  const std::vector<MadeRow> rows = made_rows(2000, 7, 400);
  for (const std::size_t queue_bytes : {std::size_t{1024}, std::size_t{1} << 22U}) {
    const auto record =
        open(settings_of(WhenFull::wait, queue_bytes), std::to_string(queue_bytes) + ".mcap");
    for (const MadeRow& row : rows) {
      record->add(row.channel, row.at, row.bytes);
      if (row.sequence % 100 == 0) {
        record->add_later(2, row.at, [bytes = row.bytes] { return bytes; });
      }
    }
    ASSERT_TRUE(record->close());
  }
  EXPECT_EQ(folder.content("1024.mcap"), folder.content("4194304.mcap"));
  EXPECT_EQ(McapReader{folder.path("1024.mcap")}.messages("/silent").size(), 20U);
}

TEST_F(RecordThreadTest, drops_and_counts_what_finds_no_room_in_real_time) {
  const auto record = open(settings_of(WhenFull::drop, 1024));
  Held held;
  ASSERT_TRUE(record->add_later(1, MissionTime{}, [&held] { return held(); }));
  while (!held.stands) {
    std::this_thread::yield();
  }
  const std::string row = Protobuf{}.text(2, std::string(72, 'x')).bytes();
  const std::size_t room = 1024 / (row.size() + 24);  // 24: head of a row in the queue.
  std::size_t taken = 0;
  for (int i = 0; i < 100; ++i) {
    taken += record->add(0, MissionTime{std::chrono::milliseconds{i}}, row) ? 1 : 0;
  }
  EXPECT_EQ(taken, room);
  EXPECT_EQ(record->counts().dropped, 100 - room);
  held.may_go = true;
  ASSERT_TRUE(record->close());
  EXPECT_FALSE(record->add(0, MissionTime{}, row));
  const McapReader file{folder.path("a.mcap")};
  EXPECT_EQ(listed(file.faults), "");
  EXPECT_EQ(file.messages("/rows").size(), room);
  EXPECT_EQ(file.messages("/places").size(), 1U);
  EXPECT_EQ(file.metadata.at("flyball.record").at("dropped /rows"), std::to_string(100 - room));
}

TEST_F(RecordThreadTest, shows_what_was_dropped_as_a_gap_in_the_sequence) {
  const auto record = open(settings_of(WhenFull::drop, 1024));
  const std::string small = Protobuf{}.text(2, "small").bytes();
  record->add(0, MissionTime{}, small);
  EXPECT_FALSE(record->add(0, MissionTime{}, std::string(2000, 'x')));  // It could never fit.
  record->add(0, MissionTime{}, small);
  ASSERT_TRUE(record->close());
  const auto rows = McapReader{folder.path("a.mcap")}.messages("/rows");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[1].sequence, 2U);
  const auto done = recover_mcap(folder.path("a.mcap"), folder.path("b.mcap"));
  ASSERT_TRUE(done);
  EXPECT_EQ(done->missing_rows, 1U);
}

TEST_F(RecordThreadTest, lets_few_rows_wait_that_are_still_to_be_made) {
  const auto record = open(settings_of(WhenFull::drop, 4096));
  Held held;
  ASSERT_TRUE(record->add_later(1, MissionTime{}, [&held] { return held(); }));
  while (!held.stands) {
    std::this_thread::yield();
  }
  const auto kept = std::make_shared<int>();
  const auto make = [kept] { return Protobuf{}.real(2, *kept).bytes(); };
  int taken = 0;
  for (int i = 0; i < 10; ++i) {
    taken += record->add_later(1, MissionTime{}, make) ? 1 : 0;
  }
  EXPECT_EQ(taken, 3);  // And the one that is being made.
  held.may_go = true;
  ASSERT_TRUE(record->close());
  EXPECT_EQ(kept.use_count(), 2);  // This and `make`: the record holds nothing on to it.
  EXPECT_EQ(McapReader{folder.path("a.mcap")}.messages().size(), 4U);
}

TEST_F(RecordThreadTest, takes_rows_without_asking_for_memory) {
  const auto record = open(settings_of(WhenFull::drop, std::size_t{1} << 20U));
  const std::string row = Protobuf{}.text(2, std::string(500, 'x')).bytes();
  const std::size_t before = allocation_count();
  for (int i = 0; i < 5000; ++i) {
    record->add(0, MissionTime{std::chrono::milliseconds{i}}, row);
  }
  EXPECT_EQ(allocation_count(), before);
}

TEST_F(RecordThreadTest, closes_a_chunk_in_real_time_though_no_further_row_comes) {
  RecordThreadSettings settings = settings_of(WhenFull::drop, 4096);
  settings.file.chunk_time = std::chrono::milliseconds{20};
  const auto record = open(settings);
  record->add(1, MissionTime{}, Protobuf{}.real(1, 3.0).bytes());
  // Ends when the chunk has come; if it never did, the test would be ended by its time limit.
  while (!recover_mcap(folder.path("a.mcap"), folder.path("b.mcap"))) {
    std::this_thread::yield();
  }
  EXPECT_EQ(McapReader{folder.path("b.mcap")}.decoded("/places").at(0).number("x"), 3.0);
}

TEST_F(RecordThreadTest, lets_each_chunk_be_open_for_its_own_time) {
  using Clock = std::chrono::steady_clock;
  RecordThreadSettings settings = settings_of(WhenFull::drop, 4096);
  settings.file.chunk_time = std::chrono::milliseconds{400};
  const std::string row = Protobuf{}.real(1, 3.0).bytes();
  Clock::duration open_for{};
  // A trial in which the machine was so slow that the second chunk became old says nothing.
  do {
    const auto record = open(settings);
    record->add(1, MissionTime{}, row);
    std::this_thread::sleep_for(std::chrono::milliseconds{300});
    const auto begin = Clock::now();
    record->add(1, MissionTime{std::chrono::milliseconds{400}}, row);
    std::this_thread::sleep_for(std::chrono::milliseconds{200});
    record->add(1, MissionTime{std::chrono::milliseconds{500}}, row);
    ASSERT_TRUE(record->close());
    open_for = Clock::now() - begin;
  } while (open_for >= settings.file.chunk_time);
  const McapReader file{folder.path("a.mcap")};
  ASSERT_EQ(file.chunks.size(), 2U);
  EXPECT_EQ(file.chunks[1].messages.size(), 2U);
}

TEST_F(RecordThreadTest, ends_the_file_when_nobody_else_does) {
  open(settings_of(WhenFull::drop, 4096))->add(1, MissionTime{}, Protobuf{}.real(1, 3.0).bytes());
  const McapReader file{folder.path("a.mcap")};
  EXPECT_EQ(listed(file.faults), "");
  EXPECT_EQ(file.messages().size(), 1U);
}

TEST_F(RecordThreadTest, goes_on_counting_when_the_disk_takes_no_more) {
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto ignored = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{100'000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const auto record = open(settings_of(WhenFull::wait, 4096));
  const std::vector<MadeRow> rows = made_rows(1000, 13, 800);
  add(*record, rows);
  const Status closed = record->close();
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, ignored);
  ASSERT_FALSE(closed);
  EXPECT_NE(closed.error().message.find("a.mcap\" cannot be written on: File too large"),
            std::string::npos)
      << closed.error().message;
  const RecordCounts counts = record->counts();
  EXPECT_EQ(counts.written + counts.dropped, rows.size());
  EXPECT_GT(counts.dropped, 0U);
  const auto done = recover_mcap(folder.path("a.mcap"), folder.path("b.mcap"));
  ASSERT_TRUE(done) << done.error().message;
  EXPECT_GE(done->chunks, 2U);
  EXPECT_EQ(McapReader{folder.path("b.mcap")}.messages().size(), counts.written)
      << "what went with the chunk that did not fit is no part of the file";
}

}  // namespace
}  // namespace flyball
