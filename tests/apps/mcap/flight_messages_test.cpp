// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/mcap/flight_messages.h"

#include "protobuf_decoder.h"
#include <cstring>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr MissionTime at{std::chrono::milliseconds{2500}};

DecodedMessage decoded(const std::string& type, const std::string& bytes) {
  return ProtobufDecoder{descriptor_set(flight_schemas(), type)}.decode(type, bytes);
}

void expect_time(const DecodedMessage& message) {
  EXPECT_EQ(message.message("timestamp").number("seconds"), 2.0);
  EXPECT_EQ(message.message("timestamp").number("nanos"), 500e6);
}

Pose made_pose() {
  Pose X_WB{Eigen::AngleAxisd{0.6, Vec3::UnitZ()}};
  X_WB.translation() = Vec3{1.0, -2.0, 3.0};
  return X_WB;
}

TEST(FlightMessages, say_where_the_vehicle_is) {
  const DecodedMessage pose = decoded("foxglove.PoseInFrame", pose_message(at, made_pose()));
  expect_time(pose);
  EXPECT_EQ(pose.text("frame_id"), "world");
  EXPECT_EQ(pose.message("pose").message("position").number("y"), -2.0);
  EXPECT_DOUBLE_EQ(pose.message("pose").message("orientation").number("w"), std::cos(0.3));
  EXPECT_DOUBLE_EQ(pose.message("pose").message("orientation").number("z"), std::sin(0.3));
  const DecodedMessage tf = decoded("foxglove.FrameTransform", transform_message(at, made_pose()));
  expect_time(tf);
  EXPECT_EQ(tf.text("parent_frame_id"), "world");
  EXPECT_EQ(tf.text("child_frame_id"), "body");
  EXPECT_EQ(tf.message("translation").number("z"), 3.0);
}

TEST(FlightMessages, lead_along_a_path) {
  const DecodedMessage path =
      decoded("foxglove.PosesInFrame",
              path_message(at, {{0.0, 0.0, 1.0}, {0.0, 2.0, 1.0}, {4.0, 2.0, 1.0}}));
  expect_time(path);
  const auto& poses = path.messages.at("poses");
  ASSERT_EQ(poses.size(), 3U);
  EXPECT_EQ(poses[2].message("position").number("x"), 4.0);
  EXPECT_DOUBLE_EQ(poses[0].message("orientation").number("z"), std::sin(0.25 * M_PI));
  EXPECT_DOUBLE_EQ(poses[2].message("orientation").number("z"), 0.0);  // As the last step led.
}

TEST(FlightMessages, pack_cells_as_points) {
  const DecodedMessage cloud =
      decoded("foxglove.PointCloud",
              cells_message(at, 0.25, {{{1.0, 2.0, 3.0}, true}, {{4.0, 5.0, 6.0}, false}}));
  expect_time(cloud);
  EXPECT_EQ(cloud.number("point_stride"), 17.0);
  const std::string& bytes = cloud.text("data");
  ASSERT_EQ(bytes.size(), 34U);
  float point[4];
  std::memcpy(point, bytes.data() + 17, sizeof point);
  EXPECT_EQ(point[1], 5.0F);
  EXPECT_EQ(point[3], 0.25F);
  EXPECT_EQ(bytes[16], 1);
  EXPECT_EQ(bytes[33], 0);
  const auto& fields = cloud.messages.at("fields");
  ASSERT_EQ(fields.size(), 5U);
  EXPECT_EQ(fields[4].text("name"), "occupied");
  EXPECT_EQ(fields[4].number("offset"), 16.0);
  EXPECT_EQ(fields[4].number("type"), 1.0);
}

TEST(FlightMessages, tell_what_happened) {
  const DecodedMessage log = decoded("foxglove.Log", log_message(at, "a frame was not mapped"));
  expect_time(log);
  EXPECT_EQ(log.text("message"), "a frame was not mapped");
  EXPECT_EQ(log.number("level"), 2.0);
}

TEST(FlightMessages, name_every_knob_and_what_the_computer_grants) {
  KnobsInForce knobs;
  knobs.version = 7;
  knobs.knobs = KnobSettings{{{"map.range_m", "m", "points", {}, 2.0, 25.0, 7.0, "range"}}};
  knobs.computer = {3, Hertz{1.2e9}};
  knobs.restraint.must_hover = true;
  const DecodedMessage message = decoded("flyball.Knobs", knobs_message(at, knobs));
  expect_time(message);
  EXPECT_EQ(message.number("version"), 7.0);
  EXPECT_EQ(message.message("knobs").text("name"), "map.range_m");
  EXPECT_EQ(message.message("knobs").number("value"), 7.0);
  EXPECT_EQ(message.message("knobs").text("unit"), "m");
  EXPECT_EQ(message.number("granted_cores"), 3.0);
  EXPECT_EQ(message.number("granted_clock_hz"), 1.2e9);
  EXPECT_EQ(message.number("must_hover"), 1.0);
}

TEST(FlightMessages, tell_how_a_job_ran) {
  Graph graph{"made"};
  const auto topic = graph.topic<int>("depth");
  NodeSpec spec;
  spec.name = "map";
  spec.trigger = OnMessage{topic.index};
  graph.node(spec, [](JobContext&) { return Work{}; });
  JobRecord job;
  job.released = at - std::chrono::seconds{2};
  job.started = at - std::chrono::seconds{1};
  job.ended = at;
  job.busy = std::chrono::milliseconds{700};
  job.work.add("rays", 12.0);
  job.missed = true;
  job.clock = Hertz{2e9};
  job.reads = {{topic.index, 41}};
  const DecodedMessage message = decoded("flyball.Job", job_message(job, graph));
  expect_time(message);
  EXPECT_EQ(message.text("node"), "map");
  EXPECT_EQ(message.number("released_s"), 0.5);
  EXPECT_EQ(message.number("started_s"), 1.5);
  EXPECT_EQ(message.number("ended_s"), 2.5);
  EXPECT_DOUBLE_EQ(message.number("busy_s"), 0.7);
  EXPECT_EQ(message.number("core"), -1.0);
  EXPECT_EQ(message.number("clock_hz"), 2e9);
  EXPECT_EQ(message.number("missed"), 1.0);
  EXPECT_EQ(message.number("killed"), 0.0);
  EXPECT_EQ(message.message("work").text("name"), "rays");
  EXPECT_EQ(message.message("work").number("count"), 12.0);
  EXPECT_EQ(message.message("reads").text("topic"), "depth");
  EXPECT_EQ(message.message("reads").number("version"), 41.0);
}

TEST(FlightMessages, take_their_fields_from_rows_of_the_log) {
  const LogRow choice{at,
                      "decision",
                      {{"knob", std::string{"cpu.cores"}},
                       {"value", 2.0},
                       {"before", 4.0},
                       {"reason", std::string{"energy"}}}};
  const DecodedMessage decision = decoded("flyball.Decision", decision_message(choice));
  expect_time(decision);
  EXPECT_EQ(decision.text("knob"), "cpu.cores");
  EXPECT_EQ(decision.number("value"), 2.0);
  EXPECT_EQ(decision.number("before"), 4.0);
  EXPECT_EQ(decision.text("reason"), "energy");
  const LogRow state{at, "state", {{"rotor_w", 300.0}, {"x_m", 1.0}, {"battery_percent", 71.0}}};
  const DecodedMessage power = decoded("flyball.Power", power_message(state));
  EXPECT_EQ(power.number("rotor_w"), 300.0);
  EXPECT_EQ(power.number("battery_percent"), 71.0);
  EXPECT_EQ(power.numbers.count("computer_w"), 0U);  // The row does not say.
}

TEST(FlightMessages, keep_any_row_whole) {
  const LogRow row{
      at, "plan", {{"ok", std::int64_t{-1}}, {"radius_m", 0.4}, {"failure", std::string{"late"}}}};
  const DecodedMessage message = decoded("flyball.Row", row_message(row));
  expect_time(message);
  EXPECT_EQ(message.text("channel"), "plan");
  const auto& fields = message.messages.at("fields");
  ASSERT_EQ(fields.size(), 3U);
  EXPECT_EQ(fields[0].number("whole"), -1.0);
  EXPECT_EQ(fields[1].number("number"), 0.4);
  EXPECT_EQ(fields[2].text("text"), "late");
  EXPECT_EQ(fields[2].text("name"), "failure");
}

}  // namespace
}  // namespace flyball
