// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/recordings/localization_run.h"

#include "flyball/kernels/localizer.h"

#include "circle_flight.h"
#include "flyball_program.h"
#include "textured_camera.h"
#include "tum_sequence.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace flyball {
namespace {

constexpr int frames = 10;
constexpr double step_m = 0.25;

/// Two and a half metres of the circle, at 10 Hz; the last frame is from elsewhere.
struct RenderedFlight {
  RenderedFlight() {
    DepthCameraSpec spec;
    spec.width_px = 224;
    spec.height_px = 168;
    const kit::TexturedCamera camera{kit::circle_world(2), spec, 2};
    kit::TumSequence sequence{place.path()};
    for (int i = 0; i < frames; ++i) {
      const Pose X_WC = kit::circle_pose(i + 1 < frames ? i * step_m : 70.0);
      const MissionTime t{from_seconds(1.0 + 0.1 * i)};
      sequence.add(camera.capture(X_WC, t, static_cast<std::uint64_t>(i)), X_WC);
    }
  }
  ScratchFolder place;
};

const RenderedFlight& flight() {
  static const RenderedFlight made;
  return made;
}

const char* const intrinsics = " --intrinsics 112,112,111.5,83.5";  // 90 degrees, 224 pixels.

TEST(Localize, finds_the_path_of_a_rendered_flight) {
  RecordingSettings settings;
  settings.intrinsics = {112.0, 112.0, 111.5, 83.5};
  const auto recording = read_tum(flight().place.path(), settings);
  ASSERT_TRUE(recording) << recording.error().message;
  const auto localizer = make_seeing_localizer("visual_slam", Plugins{});
  ASSERT_TRUE(localizer);
  const auto run = localize(*recording, **localizer, [] { return false; });
  ASSERT_TRUE(run) << run.error().message;
  EXPECT_EQ(run->frames, frames);
  EXPECT_EQ(run->lost, 1) << "the last one";
  EXPECT_EQ(run->uncertain, 0);
  EXPECT_GT(run->sigma_m_last, 0.001);
  EXPECT_EQ(run->path.size(), frames - 1U);
  ASSERT_TRUE(run->error);
  EXPECT_LT(run->error->rmse_m, 0.05);
  EXPECT_NEAR(run->error->path_m, step_m * (frames - 2), 0.01);
}

/// A view a second, a metre apart: good enough to be tracked, not good enough to be believed.
TEST(Localize, counts_the_poses_that_the_localizer_does_not_trust_itself) {
  DepthCameraSpec spec;
  spec.width_px = 224;
  spec.height_px = 168;
  const kit::TexturedCamera camera{kit::circle_world(2), spec, 2};
  const ScratchFolder place;
  kit::TumSequence sequence{place.path()};
  for (int i = 0; i < 16; ++i) {
    const Pose X_WC = kit::circle_pose(i);
    sequence.add(
        camera.capture(X_WC, MissionTime{from_seconds(1.0 + i)}, static_cast<std::uint64_t>(i)),
        X_WC);
  }
  RecordingSettings settings;
  settings.intrinsics = {112.0, 112.0, 111.5, 83.5};
  const auto recording = read_tum(place.path(), settings);
  ASSERT_TRUE(recording);
  const auto run =
      localize(*recording, **make_seeing_localizer("visual_slam", Plugins{}), [] { return false; });
  ASSERT_TRUE(run);
  ASSERT_TRUE(run->error);
  EXPECT_GT(run->error->max_m, 0.05);
  EXPECT_LT(run->lost, 4);
  EXPECT_GT(run->uncertain, 5);
  EXPECT_GT(run->sigma_m_last, 0.1);
}

TEST(Localize, knows_which_localizers_see) {
  const auto unknown = make_seeing_localizer("orb", Plugins{});
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().message,
            "no localizer \"orb\"; there are: visual_inertial, visual_slam");
}

TEST(Localize, prints_what_it_found_and_writes_the_path) {
  const FlyballProgram flyball;
  const auto said =
      flyball.run("localize " + flight().place.path() + intrinsics + " --json --out path.txt");
  ASSERT_EQ(said.exit_code, 0) << said.errors;
  const auto json = nlohmann::json::parse(said.output);
  EXPECT_EQ(json.at("frames"), frames);
  EXPECT_EQ(json.at("lost"), 1);
  EXPECT_LT(json.at("absolute_trajectory_error_m").at("rmse"), 0.05);
  EXPECT_GT(json.at("frame_ms").at("mean"), 0.0);
  const std::string path = flyball.place.content("path.txt");
  EXPECT_EQ(std::count(path.begin(), path.end(), '\n'), frames) << "a comment and nine poses";
}

TEST(Localize, refuses_bad_input_in_one_sentence) {
  const FlyballProgram flyball;
  const auto refused = [&flyball](const std::string& arguments, const std::string& words) {
    const auto said = flyball.run("localize " + arguments);
    EXPECT_EQ(said.exit_code, 2) << arguments;
    EXPECT_NE(said.errors.find(words), std::string::npos) << said.errors;
    EXPECT_EQ(std::count(said.errors.begin(), said.errors.end(), '\n'), 1) << said.errors;
    EXPECT_EQ(said.output, "");
  };
  const std::string folder = flight().place.path();
  refused("nowhere", "no folder \"nowhere\"");
  refused(folder + " --localizer truth", "localizer \"truth\" looks at no images; there are: ");
  refused(folder + " --intrinsics 0,1,2,3", "focal lengths");
  refused(folder + " --depth-factor 0", "--depth-factor");
  refused(folder + " --out /dev/null/x", "cannot write");
  refused(folder + " --uncertain-above 0", "--uncertain-above: Value 0 not in range");
  const std::string list = flight().place.content("rgb.txt");
  refused(folder + " --out " + folder + "/rgb.txt", "is a file of the recording itself");
  EXPECT_EQ(flight().place.content("rgb.txt"), list);
}

}  // namespace
}  // namespace flyball
