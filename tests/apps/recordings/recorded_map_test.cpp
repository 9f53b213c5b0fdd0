// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
#include "flyball/recordings/recorded_map.h"

#include "circle_flight.h"
#include "flyball_program.h"
#include "textured_camera.h"
#include "tum_sequence.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace flyball {
namespace {

constexpr int frames = 8;
constexpr double cell_m = 0.2;
constexpr double range_m = 12.0;

MissionTime at(int frame) {
  return MissionTime{from_seconds(1.0 + 0.1 * frame)};
}

const World& world() {
  static const World made = kit::circle_world(2);
  return made;
}

DepthCameraSpec camera() {
  DepthCameraSpec spec;
  spec.width_px = 224;
  spec.height_px = 168;
  return spec;
}

/// Two metres of the circle.
struct RecordedFlight {
  RecordedFlight() {
    const kit::TexturedCamera eye{world(), camera(), 2};
    kit::TumSequence sequence{place.path()};
    for (int i = 0; i < frames; ++i) {
      const Pose X_WC = kit::circle_pose(0.25 * i);
      sequence.add(eye.capture(X_WC, at(i), static_cast<std::uint64_t>(i)), X_WC);
    }
  }
  [[nodiscard]] Result<Recording> read() const {
    RecordingSettings settings;
    settings.intrinsics = {112.0, 112.0, 111.5, 83.5};  // 90 degrees, 224 pixels.
    return read_tum(place.path(), settings);
  }
  ScratchFolder place;
};

const RecordedFlight& flight() {
  static const RecordedFlight made;
  return made;
}

struct Agreement {
  double precision{};
  double recall{};
};

/// Occupied cells that lie at a solid, and seen points at which something is occupied; a cell of
/// tolerance. `off_W` is where the map's origin lies in the world.
Agreement agreement(const Mapper& mapper, const Vec3& off_W = Vec3::Zero()) {
  const Clearance clearance{world()};
  Agreement found;
  const auto occupied = mapper.occupied();
  for (const OccupiedCell& cell : occupied) {
    const Cylinder body{0.01, 0.01};
    found.precision += clearance.distance_m(cell.centre_W + off_W, body, 1.0, false) < 1.5 * cell_m;
  }
  found.precision /= static_cast<double>(occupied.size());
  DepthCameraSpec exact = camera();
  exact.rgbd_noise = false;
  const DepthImage seen = DepthCamera{world(), exact, 1}.capture(kit::circle_pose(0.0), at(0), 0);
  int points = 0;
  for (std::size_t i = 0; i < seen.depth_m.size(); i += 7) {
    const double d = static_cast<double>(seen.depth_m[i]);
    const double x = (static_cast<int>(i) % 224 - 111.5) / 112.0;
    const double y = (static_cast<int>(i) / 224 - 83.5) / 112.0;
    if (d * std::hypot(x, y, 1.0) < 0.9 * range_m) {
      ++points;
      const Vec3 p_W = kit::circle_pose(0.0) * Vec3{x * d, y * d, d} - off_W;
      bool is_found = false;
      for (int k = 0; k < 27; ++k) {
        const Vec3 step = cell_m * Vec3{k % 3 - 1.0, k / 3 % 3 - 1.0, k / 9 - 1.0};
        is_found = is_found || mapper.view().state(p_W + step) == CellState::occupied;
      }
      found.recall += is_found;
    }
  }
  EXPECT_GT(points, 500);
  found.recall /= points;
  return found;
}

MappingSettings settings() {
  MappingSettings chosen;
  chosen.map = {cell_m, range_m};
  return chosen;
}

TEST(RecordedMap, agrees_with_the_world_that_was_recorded_whatever_the_mapper) {
  const auto recording = flight().read();
  ASSERT_TRUE(recording) << recording.error().message;
  for (const char* name : {"flyball", "octomap"}) {
    const auto mapper = make_mapper(name, Plugins{});
    ASSERT_TRUE(mapper);
    const auto run =
        map_recording(*recording, recording->truth, settings(), **mapper, [] { return false; });
    ASSERT_TRUE(run) << run.error().message;
    EXPECT_EQ(run->frames, frames);
    EXPECT_EQ(run->without_pose, 0);
    EXPECT_GT(run->rays, 10000.0);
    const Agreement found = agreement(**mapper);
    EXPECT_GT(found.precision, 0.95) << name;
    EXPECT_GT(found.recall, 0.9) << name;
  }
}

TEST(RecordedMap, disagrees_with_another_place) {
  const auto recording = flight().read();
  const auto mapper = make_mapper("flyball", Plugins{});
  ASSERT_TRUE(
      map_recording(*recording, recording->truth, settings(), **mapper, [] { return false; }));
  EXPECT_LT(agreement(**mapper, Vec3{0.0, 0.0, 1.5}).precision, 0.5);
}

TEST(RecordedMap, frees_nothing_where_a_pixel_has_no_depth) {
  const ScratchFolder place;
  kit::TumSequence sequence{place.path()};
  VisualFrame frame;
  frame.captured = at(0);
  frame.camera = {8, 6, 4.0, 4.0, 3.5, 2.5, {}};
  frame.grey.assign(48, 90);
  frame.depth_m.assign(48, 2.0F);
  frame.depth_m[2 * 8 + 3] = std::numeric_limits<float>::infinity();
  sequence.add(frame, Pose::Identity());
  RecordingSettings as_it_is;
  as_it_is.intrinsics = {4.0, 4.0, 3.5, 2.5};
  const auto recording = read_tum(place.path(), as_it_is);
  const auto mapper = make_mapper("octomap", Plugins{});
  MappingSettings fine;
  fine.map = {0.05, 5.0};
  ASSERT_TRUE(map_recording(*recording, recording->truth, fine, **mapper, [] { return false; }));
  const Vec3 seen{0.125, 0.125, 1.0};
  const Vec3 unseen{-0.125, -0.125, 1.0};
  EXPECT_EQ((*mapper)->view().state(seen), CellState::free);
  EXPECT_EQ((*mapper)->view().state(unseen), CellState::unknown);
}

TEST(RecordedMap, leaves_out_frames_that_have_no_pose) {
  const auto recording = flight().read();
  const auto mapper = make_mapper("flyball", Plugins{});
  const std::vector<TimedPose> two{recording->truth[2], recording->truth[3]};
  const auto run = map_recording(*recording, two, settings(), **mapper, [] { return false; });
  ASSERT_TRUE(run);
  EXPECT_EQ(run->without_pose, frames - 2);
  const auto none = map_recording(*recording, {}, settings(), **mapper, [] { return false; });
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("none of 8 frames has a pose"), std::string::npos);
}

TEST(PoseBetween, is_in_between_but_not_across_a_gap) {
  TimedPose first{at(0), Pose::Identity()};
  TimedPose second{at(1), Pose::Identity()};
  second.X_WB.translation() = Vec3{1.0, 0.0, 0.0};
  second.X_WB.linear() = Eigen::AngleAxisd{0.4, Vec3::UnitZ()}.toRotationMatrix();
  const std::vector<TimedPose> poses{first, second};
  const MissionTime middle = first.stamp + (second.stamp - first.stamp) / 2;
  const auto between = pose_between(poses, middle, std::chrono::milliseconds{100});
  ASSERT_TRUE(between);
  EXPECT_NEAR(between->translation().x(), 0.5, 1e-9);
  EXPECT_NEAR(Eigen::AngleAxisd{between->linear()}.angle(), 0.2, 1e-9);
  EXPECT_FALSE(pose_between(poses, middle, std::chrono::milliseconds{99}));
  EXPECT_TRUE(pose_between(poses, second.stamp, Duration{}));
  EXPECT_FALSE(pose_between(poses, at(2), std::chrono::milliseconds{100}));
  EXPECT_FALSE(pose_between(poses, first.stamp - Duration{1}, std::chrono::milliseconds{100}));
}

const char* const intrinsics = " --intrinsics 112,112,111.5,83.5 --resolution 0.2 --range 12";

TEST(MapFrom, writes_a_map_that_any_mapper_reads) {
  const FlyballProgram flyball;
  for (const std::string& how :
       {std::string{"--mapper flyball --out a.bt"}, std::string{"--mapper octomap --out a.ot"},
        std::string{"--localizer visual_slam --out a.ot"}}) {
    const auto said =
        flyball.run("map from " + flight().place.path() + intrinsics + " --json " + how);
    ASSERT_EQ(said.exit_code, 0) << said.errors;
    const auto json = nlohmann::json::parse(said.output);
    EXPECT_EQ(json.at("frames"), frames);
    EXPECT_EQ(json.at("without_pose"), 0);
    const auto mapper = make_mapper("octomap", Plugins{});
    const std::string file = flyball.place.path(how.substr(how.size() - 4));
    ASSERT_TRUE((*mapper)->read(file));
    EXPECT_EQ((*mapper)->contents().levels.front().occupied_cells, json.at("occupied_cells"));
    const Agreement found = agreement(**mapper);
    EXPECT_GT(found.precision, 0.95) << how;
    EXPECT_GT(found.recall, 0.9) << how;
  }
}

TEST(MapFrom, writes_cells_of_the_resolution_also_where_a_mapper_has_finer_ones) {
  const FlyballProgram flyball;
  for (const auto& [resolution, range] : {std::pair{"0.3", "12"}, std::pair{"0.6", "60"}}) {
    const auto said = flyball.run("map from " + flight().place.path() +
                                  " --intrinsics 112,112,111.5,83.5 --out a.bt --json " +
                                  "--resolution " + resolution + " --range " + range);
    ASSERT_EQ(said.exit_code, 0) << said.errors;
    EXPECT_NEAR(nlohmann::json::parse(said.output).at("cell_m"), std::stod(resolution), 1e-9);
  }
}

TEST(MapFrom, takes_poses_from_a_file) {
  const FlyballProgram flyball;
  const auto recording = flight().read();
  auto poses = recording->truth;
  for (TimedPose& pose : poses) {
    pose.X_WB.translation().x() += 4.0;
  }
  ASSERT_TRUE(write_tum_trajectory(flyball.place.path("poses.txt"), poses));
  const auto said = flyball.run("map from " + flight().place.path() + intrinsics +
                                " --poses poses.txt --every 2 --out a.bt");
  ASSERT_EQ(said.exit_code, 0) << said.errors;
  const auto mapper = make_mapper("flyball", Plugins{});
  ASSERT_TRUE((*mapper)->read(flyball.place.path("a.bt")));
  EXPECT_GT(agreement(**mapper, Vec3{-4.0, 0.0, 0.0}).precision, 0.95);
}

TEST(MapFrom, refuses_bad_input_in_one_sentence_and_leaves_no_file) {
  const FlyballProgram flyball;
  const auto refused = [&flyball](const std::string& arguments, const std::string& words) {
    const auto said = flyball.run("map from " + arguments);
    EXPECT_EQ(said.exit_code, 2) << arguments;
    EXPECT_NE(said.errors.find(words), std::string::npos) << said.errors;
    EXPECT_EQ(std::count(said.errors.begin(), said.errors.end(), '\n'), 1) << said.errors;
    EXPECT_EQ(said.output, "");
  };
  const std::string folder = flight().place.path();
  refused("nowhere --out a.bt", "no folder \"nowhere\"");
  refused(folder + " --out a.pcd", "must end in .bt or .ot");
  refused(folder + " --out nowhere/a.bt",
          "cannot write \"nowhere/a.bt\": there is no folder \"nowhere\"");
  refused(folder + " --out a.bt --mapper voxels", "no mapper \"voxels\"; there are: flyball, oct");
  refused(folder + " --out a.bt --resolution 0", "--resolution");
  refused(folder + " --out a.bt --range nan", "--range");
  refused(folder + " --out a.bt --every 0", "--every 0 must be at least 1");
  refused(folder + " --out a.bt --poses p --localizer visual_slam", "exclude each other");
  refused(folder + " --out a.bt --poses none.txt", "cannot read \"none.txt\"");
  refused(folder + " --out a.bt --localizer visual_inertial", "no inertial measurements");
  EXPECT_TRUE(flyball.place.is_empty());
}

}  // namespace
}  // namespace flyball
