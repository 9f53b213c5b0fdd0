// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop
#include "flyball/kernels/detector.h"

#include "short_delivery.h"
#include <cmath>
#include <memory>
#include <string>
#include <variant>

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// One cross wall, and nothing fallen.
Scenario small_search() {
  Scenario scenario;
  scenario.name = "small_search";
  scenario.mission.workload = "search_and_rescue";
  scenario.world.generator = "collapsed_building";
  scenario.world.parameters = {{"length_m", 9.0}, {"width_m", 6.0}, {"walls", 1.0},
                               {"slabs", 0.0},    {"rubble", 0.0},  {"hole_m", 2.0}};
  scenario.vehicle.payload_kg = 0.0;
  scenario.colour_camera.rate_hz = 2.0;
  scenario.kernels.mapper = "flyball";
  scenario.kernels.mapper_parameters["cost_of"] = std::string{"octomap"};
  scenario.mission.time_limit_s = 600.0;
  return scenario;
}

TEST(SearchAndRescue, finds_the_person_who_is_there_and_comes_home) {
  const MissionRecord record = kit::flown(small_search());
  const Summary& summary = record.summary;
  EXPECT_EQ(summary.status, MissionStatus::succeeded) << to_string(summary.failure);
  EXPECT_TRUE(kit::says(record, "perhaps somebody: looks from another place"));
  EXPECT_LE(summary.quality.at("position_error_m"), 1.0);
  EXPECT_LT(summary.quality.at("time_to_find_s"), summary.mission_time_s);
  EXPECT_GE(summary.kernels.at("hog").calls, 1U);
  ASSERT_FALSE(record.frames.empty());
  EXPECT_NE(record.frames.back().caption.find("the person"), std::string::npos);
}

/// HOG, which misses everybody in the first pictures.
class LateDetector final : public Detector {
 public:
  explicit LateDetector(int blind_looks) : blind_looks_{blind_looks} {}

  [[nodiscard]] std::vector<ParameterSpec> parameters() const override {
    return hog_->parameters();
  }
  [[nodiscard]] Status configure(const Parameters& chosen, const FindModel& find_model) override {
    return hog_->configure(chosen, find_model);
  }
  [[nodiscard]] Result<std::vector<Detection>> detect(const ColourImage& image,
                                                      double scale,
                                                      Work& work) override {
    if (blind_looks_-- > 0) {
      work.add("images", 1.0);
      return std::vector<Detection>{};
    }
    return hog_->detect(image, scale, work);
  }

 private:
  int blind_looks_;
  std::unique_ptr<Detector> hog_{Plugins{}.make<Detector>("hog")};
};

MissionRecord searched(int blind_looks, double rate_hz) {
  Scenario scenario = small_search();
  scenario.colour_camera.rate_hz = rate_hz;  // Pictures take most of the test's time.
  scenario.plugins = Plugins{}.with([blind_looks](Registry& registry) {
    registry.add<Detector>("late", [=] { return std::make_unique<LateDetector>(blind_looks); });
  });
  scenario.kernels.detector = "late";
  scenario.detector.cost_of = "hog";
  return kit::flown(scenario);
}

TEST(SearchAndRescue, looks_again_where_it_has_been_before_it_gives_up) {
  constexpr int first_pass = 50;  // Pictures; chosen: more than it takes.
  const MissionRecord record = searched(first_pass, 1.0);
  EXPECT_TRUE(kit::says(record, "nobody found: looks again"));
  EXPECT_FALSE(kit::says(record, "nobody found: gives up"));
  EXPECT_EQ(record.summary.status, MissionStatus::succeeded);
}

/// Of the vehicle's last state.
double last_number(const MissionRecord& record, const std::string& name) {
  double last = std::nan("");
  for (const auto& row : record.trace->rows()) {
    for (const auto& field : row.fields) {
      const auto* number = std::get_if<double>(&field.value);
      last = row.channel == "state" && field.name == name && number != nullptr ? *number : last;
    }
  }
  return last;
}

TEST(SearchAndRescue, comes_home_without_anybody) {
  constexpr int all_passes = 1000000;
  const MissionRecord record = searched(all_passes, 0.2);
  EXPECT_TRUE(kit::says(record, "nobody found: gives up"));
  EXPECT_EQ(record.summary.failure, MissionFailure::not_found);
  const Vec3 start_W = record.world.start_W;
  EXPECT_NEAR(last_number(record, "x_m"), start_W.x(), 0.3);
  EXPECT_NEAR(last_number(record, "y_m"), start_W.y(), 0.3);
  EXPECT_NEAR(last_number(record, "z_m"), start_W.z(), 0.3) << "it has landed";
}

}  // namespace
}  // namespace flyball
