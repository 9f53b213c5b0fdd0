// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/judging/tracking_score.h"

#include "flyball/runtime/modeled/virtual_executor.h"

#include "grid_map.h"
#include "mission_rig.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// A person 7 m ahead of the camera, in the middle of its image.
class Score : public testing::Test {
 protected:
  Score() {
    Person person;
    person.walk = {{0.0, {7.0, 0.0, 0.0}}};
    world.people = {person};
  }
  Target target_at(double t_s, bool on_person) {
    Target target;
    target.frame.captured = MissionTime{from_seconds(t_s)};
    target.frame.camera = ColourCameraSpec{}.intrinsics();
    target.frame.sequence = sequence++;
    Pose X_WC = camera_in_level_frame({});
    X_WC.translation().z() = 0.875;
    score.note(target.frame.sequence, X_WC);
    target.box = box_of(world.people.front(), target.frame.captured, X_WC, target.frame.camera);
    if (!on_person) {
      target.box->x_px += 100.0;
    }
    return target;
  }
  void count(double t_s, bool on_person) { score.count(target_at(t_s, on_person)); }
  kit::GridMap map = kit::corridor(10.0);
  kit::MissionRig rig{map};
  World world;
  std::uint64_t sequence{};
  EventQueue queue;
  Graph graph{"scored"};
  MissionTopics topics{add_mission_topics(graph)};
  VirtualExecutor executor{graph, *rig.platform, queue, {1, Hertz{1e9}}};
  MissionLink link{rig.brief, graph, topics, executor, queue};
  TrackingScore score{link, world.people};
};

TEST_F(Score, counts_the_time_in_which_the_box_is_on_the_person) {
  for (int i = 0; i <= 40; ++i) {
    count(1.0 + 0.05 * i, true);
  }
  EXPECT_NEAR(score.tracked_s(), 2.0, 1e-9);
  EXPECT_NEAR(score.figures().at("mean_centre_error_percent"), 0.0, 1e-6);
  EXPECT_EQ(score.figures().at("wrong_box_percent"), 0.0);
}

TEST_F(Score, does_not_count_a_box_on_something_else) {
  for (int i = 0; i <= 40; ++i) {
    count(0.05 * i, false);
  }
  EXPECT_EQ(score.tracked_s(), 0.0);
  EXPECT_EQ(score.figures().at("wrong_box_percent"), 100.0);
}

TEST_F(Score, asks_of_all_frames_where_the_person_is) {
  count(1.0, true);
  EXPECT_NEAR(score.figures().at("mean_person_error_percent"), 0.0, 1e-6);
  count(1.05, false);
  EXPECT_NEAR(score.figures().at("mean_person_error_percent"), 0.0, 1e-6);
  Target unseen = target_at(1.1, true);
  unseen.box.reset();
  score.count(unseen);
  EXPECT_NEAR(score.figures().at("mean_person_error_percent"), 0.0, 1e-6);
  Target elsewhere = target_at(1.15, true);
  elsewhere.box.reset();
  score.note(++elsewhere.frame.sequence, Pose::Identity());  // This camera looks up.
  score.count(elsewhere);
  EXPECT_NEAR(score.figures().at("mean_person_error_percent"), 25.0, 1e-6);
}

TEST_F(Score, bridges_a_short_gap_and_no_long_one) {
  count(1.0, true);
  count(1.8, true);
  EXPECT_NEAR(score.tracked_s(), 0.8, 1e-9);
  count(5.0, true);
  EXPECT_NEAR(score.tracked_s(), 0.8, 1e-9);
}

TEST_F(Score, keeps_the_first_frame_one_every_15_s_and_the_last) {
  for (int i = 0; i <= 40; ++i) {
    count(1.0 + 0.5 * i, i < 40);
  }
  const auto frames = score.frames();
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[0].caption, "at 1.0 s, on the person");
  EXPECT_EQ(frames[1].caption, "at 16.0 s, on the person");
  EXPECT_EQ(frames[2].caption, "at 21.0 s, beside the person");
}

TEST_F(Score, records_each_frame) {
  std::vector<std::string_view> channels;
  executor.subscribe<LogRow>(topics.log,
                             [&](const LogRow& row) { channels.push_back(row.channel); });
  count(1.0, true);
  ASSERT_EQ(channels.size(), 1U);
  EXPECT_EQ(channels.front(), "target");
}

}  // namespace
}  // namespace flyball
