// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/people/target_nodes.h"

#include "flyball/kernels/switched.h"
#include "flyball/runtime/modeled/virtual_executor.h"

#include "grid_map.h"
#include "mission_rig.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

TEST(Pick, takes_the_person_with_the_highest_score_when_nobody_was_followed) {
  const std::vector<Detection> people{{{50, 0, 10, 20}, 0.9}, {{10, 0, 10, 20}, 0.4}};
  EXPECT_EQ(pick(people, std::nullopt, 30.0)->box.x_px, 50.0);
  EXPECT_FALSE(pick({}, std::nullopt, 30.0).has_value());
}

TEST(Pick, takes_the_person_nearest_to_the_last_place_and_nobody_beyond_reach) {
  const std::vector<Detection> people{{{50, 0, 10, 20}, 0.9}, {{10, 0, 10, 20}, 0.4}};
  EXPECT_EQ(pick(people, ImageBox{14, 0, 10, 20}, 30.0)->box.x_px, 10.0);
  EXPECT_FALSE(pick(people, ImageBox{200, 0, 10, 20}, 30.0).has_value());
}

TEST(Plausible, leaves_out_whatever_has_not_the_size_of_a_person_where_it_stands) {
  kit::GridMap map = kit::corridor(10.0);
  kit::MissionRig rig{map};
  Detections seen;
  seen.frame.camera = {384, 288, 400.0, 191.5, 143.5};
  seen.frame.X_LC = camera_in_level_frame({0.0, 0.4});
  // In the middle, 8.6 m ahead of a camera 4.5 m up, a person is 69 pixels tall.
  seen.people = {{{180, 109, 24, 69}, 0.5}, {{170, 44, 60, 200}, 0.9}, {{185, 129, 8, 30}, 0.8}};
  PoseEstimate pose;
  pose.X_WB.translation().z() = rig.brief->site.ground_z_m + 4.5;
  const auto people = plausible(seen, &pose, *rig.brief);
  ASSERT_EQ(people.size(), 1U);
  EXPECT_EQ(people.front().score, 0.5);
  EXPECT_EQ(plausible(seen, nullptr, *rig.brief).size(), 3U) << "no height is known yet";
}

/// Finds one person in each frame up to a last one, where the frame's first byte says.
class ByteDetector final : public Detector {
 public:
  explicit ByteDetector(std::uint8_t last = 255) : last_{last} {}
  Result<std::vector<Detection>> detect(const ColourImage& image, double, Work& work) override {
    work.add("images", 1.0);
    if (image.rgb.front() > last_) {
      return std::vector<Detection>{};
    }
    return std::vector<Detection>{{{static_cast<double>(image.rgb.front()), 5, 10, 20}, 1.0}};
  }

 private:
  std::uint8_t last_;
};

constexpr PixelRegion corner{0, 0, 8, 8};

/// Sees the target where the frame's first byte says; remembers which frames it was shown.
class ByteTracker final : public Tracker {
 public:
  explicit ByteTracker(std::vector<std::uint64_t>& shown, bool loses = false)
      : shown_{shown}, loses_{loses} {}
  PixelRegion learns_from(const ImageBox&, const Intrinsics&) const override { return corner; }
  PixelRegion looks_at(const Intrinsics&) const override { return corner; }
  Status begin(const ColourPatch& patch, const ImageBox&, Work& work) override {
    work.add("starts", 1.0);
    shown_.push_back(patch.sequence);
    return Done{};
  }
  Result<std::optional<ImageBox>> update(const ColourPatch& patch, Work& work) override {
    work.add("updates", 1.0);
    shown_.push_back(patch.sequence);
    if (loses_) {
      return std::optional<ImageBox>{};
    }
    return std::optional{ImageBox{static_cast<double>(patch.rgb.front()), 5, 10, 20}};
  }

 private:
  std::vector<std::uint64_t>& shown_;
  bool loses_;
};

/// All bytes are the frame's number. `rendered` counts pixels.
ColourFrame frame_at(MissionTime now, std::uint64_t sequence, int& rendered) {
  const Intrinsics camera{256, 100, 100.0, 128.0, 50.0};
  return {now,
          sequence,
          camera,
          {},
          {{now, sequence, camera, {}},
           [&rendered](const std::vector<PixelRegion>& regions, ColourImage& into) {
             std::fill(into.rgb.begin(), into.rgb.end(), static_cast<std::uint8_t>(into.sequence));
             for (const PixelRegion& region : regions) {
               rendered += region.width_px * region.height_px;
             }
           }}};
}

/// A camera of 20 Hz before a computer on which a detection takes 320 ms and tracking nothing.
class TargetGraph : public testing::Test {
 protected:
  TargetGraph() {
    rig.kernels.detector = std::make_shared<ByteDetector>();
    rig.kernels.buffered_tracker = std::make_shared<ByteTracker>(buffered);
    rig.kernels.real_time_tracker = std::make_shared<ByteTracker>(real_time);
  }

  void fly(Duration time) {
    VehicleExtras extras;
    extras.colour_camera = true;
    const FlightParts parts = rig.parts(graph, extras);
    LocalizationTopics localization;
    localization.pose = graph.topic<PoseEstimate>("pose");
    const TargetTopics topics = add_target(graph, parts, localization);
    VirtualExecutor executor{graph, platform, queue, {2, Hertz{1e9}}};
    executor.subscribe<Target>(topics.target,
                               [this](const Target& target) { targets.push_back(target); });
    executor.subscribe<Target>(topics.sighting,
                               [this](const Target& seen) { sightings.push_back(seen); });
    executor.subscribe<CaughtUp>(topics.caught_up,
                                 [this](const CaughtUp& what) { log = what.log; });
    executor.publish(parts.mission.knobs, *rig.knobs);
    executor.publish(parts.mission.state, MissionState{MissionPhase::cruise});
    std::uint64_t sequence = 0;
    queue.every(MissionTime{50ms}, 50ms, EventOrder::sensor, [&] {
      const ColourFrame frame = frame_at(queue.now(), sequence++, rendered);
      executor.publish(parts.vehicle.colour, frame);
      executor.publish(parts.vehicle.colour_buffer, frame);
    });
    executor.on_job([this](const JobRecord& job) {
      if (graph.nodes()[static_cast<std::size_t>(job.node)].spec.name == "detect") {
        looks.push_back(job);
      }
    });
    queue.every(MissionTime{200ms}, 1h, EventOrder::sensor, [&] {
      if (knobs_later) {
        executor.publish(parts.mission.knobs, *knobs_later);
      }
    });
    queue.run([&] { return queue.now() >= MissionTime{time}; });
  }

  static PlatformModel slow_detection() {
    PlatformModel model = kit::free_of_charge();
    model.max_cores = 2;
    model.kernels["hog"].seconds_per["images"] = 0.32;
    model.kernels["haar"].seconds_per = {{"images", 0.10}, {"switches", 0.05}};
    return model;
  }

  kit::GridMap map = kit::corridor(10.0);
  kit::MissionRig rig{map};
  ModeledPlatform platform{slow_detection()};
  EventQueue queue;
  Graph graph{"target"};
  std::optional<KnobsInForce> knobs_later;  ///< From 200 ms on.
  std::vector<JobRecord> looks;             ///< Jobs of the detector.
  TargetLog log;
  std::vector<std::uint64_t> buffered;
  std::vector<std::uint64_t> real_time;
  std::vector<Target> targets;
  std::vector<Target> sightings;
  int rendered{};
};

TEST_F(TargetGraph, works_through_exactly_the_frames_that_came_while_the_detector_ran) {
  fly(1500ms);
  // The first frame comes at 50 ms, its detection at 370 ms: frames 1..6 came meanwhile. The newest
  // is looked at next, and so on.
  const std::vector<std::uint64_t> first{0, 1, 2, 3, 4, 5, 6, 6, 7, 8, 9, 10, 11, 12};
  ASSERT_GE(buffered.size(), first.size());
  EXPECT_TRUE(std::equal(first.begin(), first.end(), buffered.begin()));
  EXPECT_EQ(log.detections, 4);
  EXPECT_EQ(log.missed_in_row, 0);
}

TEST_F(TargetGraph, a_detector_is_switched_between_two_jobs_and_the_first_one_pays) {
  std::vector<KernelKind<Detector>> kinds;
  kinds.push_back({"hog", std::make_unique<ByteDetector>()});
  kinds.push_back({"haar", std::make_unique<ByteDetector>()});
  rig.kernels.detector = std::make_shared<SwitchedDetector>(std::move(kinds));
  auto specs = standard_knobs(rig.scenario, *rig.platform).value();
  specs.push_back(rig.kernels.detector->knobs().front());
  rig.set(KnobSettings{specs});
  knobs_later = *rig.knobs;
  ASSERT_TRUE(knobs_later->knobs.set("detector.kind", 1.0));
  fly(1000ms);
  ASSERT_GE(looks.size(), 3U);
  const auto took_s = [](const JobRecord& job) { return to_seconds(job.ended - job.started); };
  EXPECT_EQ(looks[0].work.charged_as(), "hog") << "began at 50 ms, before the knob was turned";
  EXPECT_NEAR(took_s(looks[0]), 0.32, 1e-6);
  EXPECT_EQ(looks[1].work.charged_as(), "haar");
  EXPECT_NEAR(took_s(looks[1]), 0.15, 1e-6) << "an image and the switch";
  EXPECT_EQ(looks[2].work.charged_as(), "haar");
  EXPECT_NEAR(took_s(looks[2]), 0.10, 1e-6);
}

TEST_F(TargetGraph, hands_the_newest_buffered_frame_on_to_the_real_time_tracker) {
  fly(1000ms);
  ASSERT_GE(real_time.size(), 3U);
  EXPECT_EQ(real_time[0], 6U);  // Begins where the buffered one arrived, ...
  EXPECT_EQ(real_time[1], 7U);  // ... and goes on with the frame that comes next.
  ASSERT_FALSE(targets.empty());
  EXPECT_FALSE(targets.front().box.has_value());
  ASSERT_TRUE(targets.back().box.has_value());
  EXPECT_EQ(targets.back().box->x_px, 18.0);
}

TEST_F(TargetGraph, says_whom_the_detector_saw_also_when_no_tracker_holds_them) {
  rig.kernels.buffered_tracker = std::make_shared<ByteTracker>(buffered, true);
  fly(1000ms);
  ASSERT_FALSE(targets.empty());
  EXPECT_FALSE(targets.back().box.has_value());
  ASSERT_GE(sightings.size(), 2U);
  EXPECT_EQ(sightings[1].frame.sequence, 6U);
  EXPECT_EQ(sightings[1].box->x_px, 6.0);
}

TEST_F(TargetGraph, gives_up_what_was_not_seen_for_a_second) {
  rig.kernels.real_time_tracker = std::make_shared<ByteTracker>(real_time, true);
  rig.kernels.detector = std::make_shared<ByteDetector>(0);
  fly(3000ms);
  EXPECT_EQ(real_time.size(), 1U + 20U) << "once begun, twenty times not seen";
}

TEST_F(TargetGraph, gives_up_what_the_detector_does_not_confirm) {
  rig.kernels.detector = std::make_shared<ByteDetector>(0);
  fly(3500ms);
  // The first look ends at 370 ms, the sixth after it at 2290 ms.
  ASSERT_FALSE(targets.empty());
  MissionTime last{};
  for (const Target& target : targets) {
    last = target.box ? target.frame.captured : last;
  }
  EXPECT_GE(last, MissionTime{2200ms});
  EXPECT_LE(last, MissionTime{2350ms});
}

TEST_F(TargetGraph, has_the_frames_between_detections_rendered_where_the_trackers_look) {
  fly(1500ms);
  // Detection begins in frames 0, 6, 12, 18 and 24: whole pictures. Of all others the corner, from
  // the first one that was tracked on.
  EXPECT_EQ(log.looks, 4U);
  EXPECT_EQ(rendered, 5 * 256 * 100 + 24 * 64);
}

}  // namespace
}  // namespace flyball
