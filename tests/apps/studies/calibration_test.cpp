// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/studies/calibration.h"

#include "flyball/scenario/files.h"
#include "flyball/sim/platform_file.h"

#include "scratch_folder.h"
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr Hertz low{1e9};
constexpr Hertz high{2e9};

PlatformModel made_platform() {
  PlatformModel model;
  model.name = "made";
  model.max_cores = 2;
  model.frequencies = {low, high};
  model.kernels["map"] = {{{"rays", 1e-9}, {"updates", 1e-9}}, 10.0, 0.5, 0.5, 0.3};
  model.kernels["plan"] = {{{"iterations", 1e-6}}, 10.0, 1.0, 0.0, 0.0};
  return model;
}

/// Jobs on a computer with known prices: 20 ns a ray, 500 ns an update, a = .8, b = .2.
std::vector<MeasuredJob> measured_maps(const std::vector<Hertz>& clocks) {
  std::vector<MeasuredJob> jobs;
  for (const Hertz clock : clocks) {
    for (int i = 1; i <= 12; ++i) {
      MeasuredJob job{"map", {}, 0.0, clock};
      job.work.add("rays", 1000.0 * i);
      job.work.add("updates", 50.0 * (i * i % 5 + 1));
      const double at_1_ghz_s = 20e-9 * job.work.count("rays") + 500e-9 * job.work.count("updates");
      job.cpu_s = at_1_ghz_s * (0.8 * 1e9 / clock.value() + 0.2);
      jobs.push_back(job);
    }
  }
  return jobs;
}

TEST(Calibration, finds_prices_and_how_they_follow_the_clock) {
  const PlatformModel fitted = with_prices(made_platform(), measured_maps({low, high}));
  const KernelCost& map = fitted.kernels.at("map");
  EXPECT_NEAR(map.scale * map.seconds_per.at("rays"), 20e-9, 1e-15);
  EXPECT_NEAR(map.scale * map.seconds_per.at("updates"), 500e-9, 1e-14);
  EXPECT_NEAR(map.a, 0.8, 1e-9);
  EXPECT_NEAR(map.b, 0.2, 1e-9);
  EXPECT_EQ(map.parallel_fraction, 0.0);
}

TEST(Calibration, keeps_what_one_clock_cannot_tell) {
  const PlatformModel fitted = with_prices(made_platform(), measured_maps({high}));
  const KernelCost& map = fitted.kernels.at("map");
  EXPECT_EQ(map.a, 0.5);
  EXPECT_EQ(map.b, 0.5);
  const auto jobs = measured_maps({high});
  const ModeledPlatform platform{fitted};
  for (const MeasuredJob& job : jobs) {
    EXPECT_NEAR(to_seconds(platform.job_time("map", job.work, high)), job.cpu_s, 2e-9);
  }
}

TEST(Calibration, scales_what_was_never_called_like_the_rest) {
  std::vector<MeasuredJob> jobs = measured_maps({high});
  const ModeledPlatform before{made_platform()};
  // Each job takes a third of what the old file says, so all do.
  for (MeasuredJob& job : jobs) {
    job.cpu_s = to_seconds(before.job_time("map", job.work, high)) / 3.0;
  }
  const PlatformModel fitted = with_prices(made_platform(), jobs);
  EXPECT_NEAR(fitted.kernels.at("plan").scale, 10.0 / 3.0, 1e-4);
}

TEST(Calibration, checks_on_other_jobs_than_it_was_fitted_on) {
  const auto jobs = measured_maps({high});
  const PlatformModel fitted = with_prices(made_platform(), jobs);
  std::vector<MeasuredJob> slower = measured_maps({high});
  slower.pop_back();
  for (MeasuredJob& job : slower) {
    job.cpu_s *= 2.0;
  }
  const std::vector<KernelCheck> checks = check_prices(fitted, jobs, slower);
  ASSERT_EQ(checks.size(), 2U);
  EXPECT_EQ(checks[0].kernel, "map");
  EXPECT_EQ(checks[0].fitted_jobs, 12U);
  EXPECT_EQ(checks[0].checked_jobs, 11U);
  EXPECT_NEAR(checks[0].predicted_ms / checks[0].checked_ms, 0.5, 1e-4);
  EXPECT_NEAR(checks[0].checked_error, 0.5, 1e-4);
  EXPECT_EQ(checks[1].kernel, "plan");
  EXPECT_EQ(checks[1].fitted_jobs, 0U);
}

TEST(Calibration, leaves_out_jobs_that_did_nothing_or_took_no_time) {
  std::vector<MeasuredJob> jobs = measured_maps({high});
  jobs.push_back({"map", {}, 1.0, high});
  jobs.push_back(jobs.front());
  jobs.back().cpu_s = 0.0;
  jobs.push_back({"unknown", jobs.front().work, 1.0, high});
  const PlatformModel model = made_platform();
  EXPECT_EQ(check_prices(model, jobs, {}).front().fitted_jobs, 12U);
  EXPECT_EQ(with_prices(model, jobs).kernels.size(), 2U);
}

TEST(Calibration, finds_the_power_of_idle_and_busy_cores) {
  std::vector<MeasuredPower> samples;
  for (const double ghz : {0.5, 1.0, 1.5, 2.0}) {
    for (const double n : {0.0, 1.0, 2.0, 4.0}) {
      const double w = 1.5 + 0.2 * ghz + n * (0.3 * ghz + 0.1 * std::pow(ghz, 3.0));
      samples.push_back({Hertz{1e9 * ghz}, n, Watts{w}});
    }
  }
  const PowerCost power = fitted_power(samples);
  EXPECT_NEAR(power.cpu_constant_w, 1.5, 1e-6);
  EXPECT_NEAR(power.cpu_linear_w, 0.2, 1e-6);
  EXPECT_NEAR(power.core_linear_w, 0.3, 1e-6);
  EXPECT_NEAR(power.core_cubic_w, 0.1, 1e-6);
  EXPECT_NEAR(power.power(Hertz{2e9}, 3.0).value(), 1.9 + 3.0 * 1.4, 1e-6);
}

TEST(Calibration, writes_a_file_that_is_read_as_the_same_platform) {
  const auto shipped = find_shipped("platforms", "jetson_tx2_passive");
  ASSERT_TRUE(shipped);
  const PlatformModel model = load_platform(*shipped).value();
  const ScratchFolder place;
  const auto read = load_platform(place.file("board.toml", to_toml(model, {"Made by a test."})));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->name, model.name);
  EXPECT_EQ(read->frequencies, model.frequencies);
  ASSERT_TRUE(read->thermal);
  EXPECT_EQ(read->thermal->trips.size(), model.thermal->trips.size());
  EXPECT_EQ(read->power.power(high, 2.0), model.power.power(high, 2.0));
  Work work;
  work.add("pixels", 1e5);
  EXPECT_NEAR(ratio(ModeledPlatform{*read}.job_time("depth_to_points", work, high),
                    ModeledPlatform{model}.job_time("depth_to_points", work, high)),
              1.0, 1e-3);
}

TEST(Calibration, writes_heat_without_trips_so_that_it_can_be_read) {
  PlatformModel model = load_platform(*find_shipped("platforms", "jetson_tx2_passive")).value();
  model.thermal = ThermalModel{20.0, 2.0, 30.0, {}};
  const ScratchFolder place;
  const auto read = load_platform(place.file("board.toml", to_toml(model, {})));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->thermal->resistance_k_w, 2.0);
  EXPECT_TRUE(read->thermal->trips.empty());
}

CalibrationOptions short_calibration(const ScratchFolder& place) {
  CalibrationOptions options;
  options.like = "jetson_tx2";
  options.draft = place.path("draft.toml");
  options.flights = {{"delivery_forest", {"camera.width_px=64", "camera.height_px=36"}}};
  options.flight_s = 6.0;
  options.clock.current = Hertz{3e9};
  return options;
}

TEST(Calibration, measures_what_a_flight_calls) {
  const ScratchFolder place;
  const auto made = calibrate(short_calibration(place));
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_FALSE(std::filesystem::exists(place.path("draft.toml")));
  EXPECT_EQ(made->model.frequencies, std::vector<Hertz>{Hertz{3e9}});
  for (const KernelCheck& kernel : made->kernels) {
    const bool is_called = kernel.kernel == "octomap" || kernel.kernel == "swept_cylinder";
    EXPECT_TRUE(!is_called || (kernel.fitted_jobs > 0 && kernel.checked_jobs > 0)) << kernel.kernel;
    EXPECT_TRUE(!is_called || (kernel.checked_ms > 0.0 && kernel.predicted_ms > 0.0))
        << kernel.kernel;
  }
  EXPECT_NE(to_text(*made).find("octomap"), std::string::npos);
}

TEST(Calibration, leaves_out_a_flight_whose_files_are_not_here) {
  const ScratchFolder place;
  CalibrationOptions options = short_calibration(place);
  options.flight_s = 2.0;
  const CalibrationFlight without_people{"photography_park",
                                         {"colour_camera.people_folder=" + place.path("")}};
  options.flights.push_back(without_people);
  const auto made = calibrate(options);
  ASSERT_TRUE(made) << made.error().message;
  ASSERT_EQ(made->left_out.size(), 1U);
  EXPECT_NE(made->left_out.front().find("photography_park was left out: no mesh of a person"),
            std::string::npos)
      << made->left_out.front();
  options.flights = {without_people};
  const auto refused = calibrate(options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, made->left_out.front());
}

TEST(Calibration, flies_at_each_clock_that_may_be_set) {
  const ScratchFolder place;
  CalibrationOptions options = short_calibration(place);
  std::vector<double> asked_hz;
  options.flight_s = 2.0;
  options.clock.settable = {low, high};
  options.clock.set = [&](Hertz clock) {
    asked_hz.push_back(clock.value());
    return Status{Done{}};
  };
  ASSERT_TRUE(calibrate(options));
  EXPECT_EQ(asked_hz, (std::vector<double>{2e9, 1e9, 2e9, 1e9, 2e9, 1e9}));
  options.clock.set = [](Hertz) { return Status{Error{ErrorCode::unavailable, "no such clock"}}; };
  const auto refused = calibrate(options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "no such clock");
}

TEST(Calibration, ends_when_it_is_told_to) {
  const ScratchFolder place;
  CalibrationOptions options = short_calibration(place);
  options.stop = [] { return true; };
  const auto ended = calibrate(options);
  ASSERT_FALSE(ended);
  EXPECT_EQ(ended.error().code, ErrorCode::unavailable);
  EXPECT_FALSE(std::filesystem::exists(place.path("draft.toml")));
}

}  // namespace
}  // namespace flyball
