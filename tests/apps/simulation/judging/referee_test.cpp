// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop
#include "simulation/judging/referee.h"

#include "flyball/runtime/modeled/virtual_executor.h"

#include "grid_map.h"
#include "mission_rig.h"
#include "short_delivery.h"
#include "simulation/judging/delivery_judge.h"
#include "simulation/judging/picture_judge.h"
#include "simulation/judging/sighting_judge.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

/// A graph that nobody computes on, so that a test can publish what a vehicle would.
class Judged : public testing::Test {
 protected:
  kit::GridMap map = kit::corridor(10.0);
  kit::MissionRig rig{map};
  EventQueue queue;
  Graph graph{"judged"};
  MissionTopics topics{add_mission_topics(graph)};
};

class Delivered : public Judged {
 protected:
  void command(FlightCommand::Kind kind) { executor.publish(commands, FlightCommand{kind, 0.0}); }

  Vec3 where_W{Vec3::Zero()};
  Topic<FlightCommand> commands{graph.topic<FlightCommand>("command", 8)};
  VirtualExecutor executor{graph, *rig.platform, queue, {1, Hertz{1e9}}};
  DeliveryJudge judge{executor, commands, {10.0, 0.0, 2.0}, [this] { return where_W; }};
};

TEST_F(Delivered, a_payload_that_was_never_released_is_not_judged) {
  where_W = {50.0, 0.0, 2.0};
  command(FlightCommand::Kind::land);
  EXPECT_EQ(judge.objection(), MissionFailure::none);
  EXPECT_TRUE(judge.figures().empty());
}

TEST_F(Delivered, a_payload_has_to_be_released_within_two_metres_of_the_goal) {
  where_W = {11.0, 1.0, 0.0};
  command(FlightCommand::Kind::release_payload);
  EXPECT_EQ(judge.objection(), MissionFailure::none);
  EXPECT_NEAR(judge.figures().at("delivery_error_m"), 1.414, 0.001);
  where_W = {10.0, 2.1, 0.0};
  command(FlightCommand::Kind::release_payload);
  EXPECT_EQ(judge.objection(), MissionFailure::misdelivered);
}

class Sighted : public Judged {
 protected:
  Sighted() {
    Person person;
    person.walk = {{0.0, {7.0, 0.0, 0.0}}};
    people = {person};
  }
  void report(const Vec3& p_W) {
    Finding what;
    what.p_W = p_W;
    what.at = MissionTime{3s};
    what.frame.camera = {8, 8, 4.0, 3.5, 3.5};
    what.frame.image = {{{}, 0, what.frame.camera, {}},
                        [](const auto&, ColourImage& into) { into.rgb.assign(8 * 8 * 3, 0); }};
    executor.publish(finding, what);
  }
  std::vector<Person> people;
  Topic<Sightings> sightings{graph.topic<Sightings>("sightings", 8)};
  Topic<Finding> finding{graph.topic<Finding>("finding")};
  VirtualExecutor executor{graph, *rig.platform, queue, {1, Hertz{1e9}}};
  MissionLink link{rig.brief, graph, topics, executor, queue};
  SightingJudge judge{link, people, executor, {sightings, finding}};
};

TEST_F(Sighted, a_search_that_reports_nobody_has_found_nobody) {
  EXPECT_EQ(judge.objection(), MissionFailure::not_found);
}

TEST_F(Sighted, a_report_within_a_metre_of_a_person_is_right) {
  report({7.5, 0.5, 1.0});
  EXPECT_EQ(judge.objection(), MissionFailure::none);
  EXPECT_EQ(judge.figures().at("time_to_find_s"), 3.0);
  EXPECT_NEAR(judge.figures().at("position_error_m"), std::sqrt(0.5), 1e-12);
}

TEST_F(Sighted, a_report_of_somebody_who_is_not_there_is_a_false_alarm) {
  report({9.0, 0.0, 1.0});
  EXPECT_EQ(judge.objection(), MissionFailure::false_alarm);
  EXPECT_EQ(judge.figures().count("time_to_find_s"), 0U);
}

TEST_F(Sighted, a_report_in_a_world_without_people_is_a_false_alarm_at_no_distance) {
  people.clear();
  report({9.0, 0.0, 1.0});
  EXPECT_EQ(judge.objection(), MissionFailure::false_alarm);
  EXPECT_EQ(judge.figures().count("position_error_m"), 0U);
  EXPECT_EQ(judge.frames().back().caption, "at 0.0 s: reported as found");
  EXPECT_EQ(judge.figures().count("time_to_find_s"), 0U);
}

TEST_F(Judged, a_scan_is_judged_by_where_the_camera_truly_was) {
  const auto pictures = graph.topic<GroundPicture>("picture");
  VirtualExecutor executor{graph, *rig.platform, queue, {1, Hertz{1e9}}};
  Pose X_WB = Pose::Identity();
  X_WB.translation().z() = 200.0;  // The whole area in one picture.
  MissionLink link{rig.brief, graph, topics, executor, queue};
  PictureJudge judge{link, executor, pictures, [&] { return X_WB; }};
  EXPECT_EQ(judge.objection(), MissionFailure::incomplete);
  X_WB.translation().x() = 1000.0;
  executor.publish(pictures, GroundPicture{});
  EXPECT_EQ(judge.objection(), MissionFailure::incomplete) << "it showed another place";
  X_WB.translation().x() = 0.0;
  executor.publish(pictures, GroundPicture{});
  EXPECT_EQ(judge.objection(), MissionFailure::none);
}

TEST_F(Judged, a_pose_estimate_is_held_against_the_truth_of_its_own_time) {
  const auto pose = graph.topic<PoseEstimate>("pose");
  VirtualExecutor executor{graph, *rig.platform, queue, {1, Hertz{1e9}}};
  LocalizationJudge judge{executor, pose};
  EXPECT_TRUE(judge.figures().empty());
  for (int i = 0; i < 3; ++i) {
    TruePose truth;
    truth.stamp = MissionTime{10ms * i};
    truth.X_WB.translation().x() = i;
    judge.note(truth);
  }
  PoseEstimate estimate;
  estimate.stamp = MissionTime{10ms};
  estimate.X_WB.translation() = Vec3{1.0, 0.4, 0.0};
  executor.publish(pose, estimate);
  estimate.X_WB.translation() = Vec3{1.0, 0.0, 0.0};
  executor.publish(pose, estimate);
  EXPECT_NEAR(judge.figures().at("localization_error_m_mean"), 0.2, 1e-12);
  EXPECT_NEAR(judge.figures().at("localization_error_m_max"), 0.4, 1e-12);
}

TEST(Referee, a_flight_that_arrives_has_succeeded_and_kept_its_distance) {
  const MissionRecord record = kit::flown(kit::short_delivery());
  EXPECT_EQ(record.summary.status, MissionStatus::succeeded);
  EXPECT_GT(record.summary.min_clearance_m, 0.0);
  EXPECT_EQ(record.summary.quality.at("localization_error_m_max"), 0.0);
}

TEST(Referee, a_flight_ends_at_its_time_limit) {
  Scenario scenario = kit::short_delivery(200.0);
  scenario.mission.time_limit_s = 5.0;
  const MissionRecord record = kit::flown(scenario);
  EXPECT_EQ(record.summary.failure, MissionFailure::time_limit);
  EXPECT_NEAR(record.summary.mission_time_s, 5.0, 0.1);
}

}  // namespace
}  // namespace flyball
