// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop
#include "flyball/mcap/onboard_record.h"

#include "flyball/simulation/realtime_flight.h"

#include "mcap_reader.h"
#include "scratch_folder.h"
#include <algorithm>
#include <set>
#include <variant>

#include <gtest/gtest.h>

namespace flyball {
namespace {

struct OnboardRecordTest : testing::Test {
  /// A delivery of so many seconds with a camera without noise; recorded where `name` is not empty.
  MissionRecord flown(const std::string& name, int seconds, bool in_time = false) {
    auto found =
        load_scenario("delivery_forest", {"mission.time_limit_s=" + std::to_string(seconds),
                                          "governor.policy=mission_energy", "platform.cores=2",
                                          "camera.rgbd_noise=false"});
    EXPECT_TRUE(std::holds_alternative<LoadedScenario>(found));
    std::unique_ptr<OnboardRecord> record;
    MissionHooks hooks;
    if (!name.empty()) {
      auto opened =
          OnboardRecord::open(folder.path(name), in_time ? WhenFull::drop : WhenFull::wait,
                              {{"flyball.mission", {{"seed", "1"}}}});
      EXPECT_TRUE(opened) << opened.error().message;
      record = std::move(*opened);
      hooks.onboard_record = record.get();
    }
    if (in_time) {
      hooks.executor = in_real_time({});
    }
    auto mission = fly(std::get<LoadedScenario>(found).scenario, hooks);
    EXPECT_TRUE(mission) << mission.error().message;
    if (record) {
      const Status closed = record->close();
      EXPECT_TRUE(closed) << closed.error().message;
      counts = record->counts();
    }
    return std::move(*mission);
  }
  ScratchFolder folder{};
  RecordCounts counts{};
};

std::string all_faults(const McapReader& file) {
  std::string all;
  for (const std::string& one : file.faults) {
    all += one + "\n";
  }
  return all;
}

TEST_F(OnboardRecordTest, changes_nothing_in_a_simulated_flight_and_has_the_same_bytes_each_time) {
  const MissionRecord plain = flown("", 12);
  const MissionRecord first = flown("a.mcap", 12);
  const MissionRecord second = flown("b.mcap", 12);
  EXPECT_EQ(first.summary.trace_hash, plain.summary.trace_hash);
  EXPECT_EQ(second.summary.trace_hash, plain.summary.trace_hash);
  EXPECT_EQ(folder.content("a.mcap"), folder.content("b.mcap"));
  EXPECT_GT(folder.content("a.mcap").size(), 10'000U);
}

TEST_F(OnboardRecordTest, has_what_happened_on_board_in_messages_that_decode) {
  const MissionRecord mission = flown("a.mcap", 25);
  const McapReader file{folder.path("a.mcap")};
  EXPECT_EQ(all_faults(file), "");
  EXPECT_EQ(counts.written, file.messages().size());
  EXPECT_EQ(counts.dropped, 0U);
  std::map<std::string, std::vector<DecodedMessage>> by_topic;
  for (const auto& [id, channel] : file.channels) {
    by_topic[channel.topic] = file.decoded(channel.topic);
    EXPECT_FALSE(by_topic[channel.topic].empty()) << channel.topic;
  }
  const auto& jobs = by_topic["/jobs"];
  const auto maps = std::count_if(jobs.begin(), jobs.end(), [](const DecodedMessage& job) {
    return job.text("node") == "map" && job.messages.count("work") > 0;
  });
  // The last ones may not have been used by a set-point yet, or never be.
  EXPECT_GE(static_cast<std::uint64_t>(maps), mission.summary.maps);
  EXPECT_LE(static_cast<std::uint64_t>(maps), mission.summary.maps + 5);
  EXPECT_EQ(by_topic["/map"].size(), static_cast<std::size_t>(maps));
  const auto rows = mission.trace->rows();
  EXPECT_EQ(by_topic["/power"].size(),
            static_cast<std::size_t>(std::count_if(
                rows.begin(), rows.end(), [](const auto& row) { return row.channel == "state"; })));
  EXPECT_EQ(by_topic["/decisions"].size(), mission.summary.knob_changes);
}

TEST_F(OnboardRecordTest, shows_obstacles_where_the_world_has_some) {
  const MissionRecord mission = flown("a.mcap", 25);
  const Clearance clearance{mission.world};
  std::size_t near = 0;
  std::size_t all = 0;
  for (const DecodedMessage& cloud : McapReader{folder.path("a.mcap")}.decoded("/map")) {
    const std::string& points = cloud.text("data");
    for (std::size_t i = 0; i < points.size(); i += 17) {
      float p[4];
      std::memcpy(p, points.data() + i, sizeof p);
      ++all;
      const Vec3 centre_W{p[0], p[1], p[2]};
      // A cell may reach half its diagonal beyond the surface that was hit.
      near += clearance.distance_m(centre_W, {}, 2.0, false) < p[3] ? 1 : 0;
    }
  }
  EXPECT_GT(all, 100U);
  EXPECT_GT(near, all * 98 / 100) << all;
}

TEST_F(OnboardRecordTest, is_written_beside_a_flight_in_real_time) {
  (void)flown("a.mcap", 4, true);
  const McapReader file{folder.path("a.mcap")};
  EXPECT_EQ(all_faults(file), "");
  EXPECT_EQ(counts.written, file.messages().size());
  EXPECT_EQ(file.metadata.at("flyball.record").at("dropped"), std::to_string(counts.dropped));
  EXPECT_GE(file.chunks.size(), 4U);
  std::set<double> cores;
  for (const DecodedMessage& job : file.decoded("/jobs")) {
    cores.insert(job.number("core"));
  }
  EXPECT_GE(*cores.begin(), 0.0);  // Here a job runs on a core that has a number.
}

}  // namespace
}  // namespace flyball
