// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/platform_file.h"

#include "built_data.h"
#include "scratch_folder.h"
#include <algorithm>

#include <gtest/gtest.h>

namespace flyball {
namespace {

const std::string tx2_file = kit::built_data() + "/platforms/jetson_tx2.toml";

PlatformModel tx2() {
  return load_platform(tx2_file).value();
}

const char* const whole = R"(
name = "board"
max_cores = 2
frequencies_hz = [1e9, 2e9]
switching_time_s = 1e-4
[power]
board_w = 1.0
converter = 1.1
soc_w = 0.5
memory_w = 0.2
cpu_constant_w = 0.1
cpu_linear_w = 0.2
core_linear_w = 0.3
core_cubic_w = 0.4
[kernels.octomap]
scale = 2.0
a = 0.9
b = 0.1
parallel_fraction = 0.5
[kernels.octomap.seconds_per]
updates = 1e-6
)";

std::string with(const std::string& from, const std::string& to) {
  std::string text = whole;
  text.replace(text.find(from), from.size(), to);
  return text;
}

std::string failure_of(const std::string& content) {
  const ScratchFolder scratch;
  const auto model = load_platform(scratch.file("board.toml", content));
  if (model) {
    return "";
  }
  EXPECT_EQ(model.error().code, ErrorCode::invalid_input);
  return model.error().message;
}

TEST(PlatformFile, is_read_number_by_number) {
  const ScratchFolder scratch;
  const auto model = load_platform(scratch.file("board.toml", whole));
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->name, "board");
  EXPECT_EQ(model->max_cores, 2);
  ASSERT_EQ(model->frequencies.size(), 2U);
  EXPECT_EQ(model->frequencies[1].value(), 2e9);
  EXPECT_EQ(model->switching_time, Duration{100000});
  EXPECT_EQ(model->power.converter, 1.1);
  EXPECT_EQ(model->power.core_cubic_w, 0.4);
  const KernelCost& octomap = model->kernels.at("octomap");
  EXPECT_EQ(octomap.scale, 2.0);
  EXPECT_EQ(octomap.parallel_fraction, 0.5);
  EXPECT_EQ(octomap.seconds_per.at("updates"), 1e-6);
}

TEST(PlatformFile, may_have_a_gpu_and_a_price_of_idle_cores_and_of_contention) {
  const ScratchFolder scratch;
  std::string text = with("board_w = 1.0", "board_w = 1.0\nidle_core_w = 0.02");
  text.replace(text.find("[power]"), 7,
               "memory_contention = 0.3\n[gpu]\nclock_hz = 1e9\nbusy_w = 4\n[power]");
  text.replace(text.find("scale = 2.0"), 11, "scale = 2.0\non = \"gpu\"");
  const auto model = load_platform(scratch.file("board.toml", text));
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->power.idle_core_w, 0.02);
  EXPECT_EQ(model->memory_contention, 0.3);
  ASSERT_TRUE(model->gpu);
  EXPECT_EQ(model->gpu->clock, Hertz{1e9});
  EXPECT_EQ(model->gpu->busy_w, 4.0);
  EXPECT_TRUE(model->kernels.at("octomap").on_gpu);
}

TEST(PlatformFile, whose_gpu_or_idle_cores_cannot_be_is_refused) {
  EXPECT_NE(failure_of(with("scale = 2.0", "on = \"gpu\""))
                .find("kernels.octomap.on = \"gpu\" needs a [gpu] table"),
            std::string::npos);
  EXPECT_NE(failure_of(with("scale = 2.0", "on = \"moon\""))
                .find("kernels.octomap.on = \"moon\" must be \"cores\" or \"gpu\""),
            std::string::npos);
  EXPECT_NE(failure_of(with("board_w = 1.0", "board_w = 1.0\nidle_core_w = 0.06"))
                .find("power.idle_core_w times max_cores is more than power.cpu_constant_w"),
            std::string::npos);
}

TEST(PlatformFile, that_is_missing_is_named_with_the_way_out) {
  const auto model = load_platform("no/such/board.toml");
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().code, ErrorCode::not_found);
  EXPECT_NE(model.error().message.find("flyball list platforms"), std::string::npos);
}

TEST(PlatformFile, reports_every_violation_at_once) {
  std::string text = with("converter = 1.1", "converter = 0.5\nfan_w = 1.0");
  text.replace(text.find("soc_w = 0.5\n"), 12, "");
  text.replace(text.find("updates = 1e-6"), 14, "updates = \"fast\"");
  const std::string message = failure_of(text);
  for (const char* part :
       {"power.converter = 0.5 is not between 1 and 10", "power.fan_w is unknown",
        "power.soc_w is missing", "kernels.octomap.seconds_per.updates is no number"}) {
    EXPECT_NE(message.find(part), std::string::npos) << part << " not in: " << message;
  }
}

TEST(PlatformFile, needs_ascending_clocks_and_whole_cores) {
  EXPECT_NE(failure_of(with("[1e9, 2e9]", "[2e9, 1e9]")).find("not ascending"), std::string::npos);
  EXPECT_NE(failure_of(with("max_cores = 2", "max_cores = 2.5")).find("whole"), std::string::npos);
}

TEST(PlatformFile, with_a_syntax_error_says_in_which_line) {
  EXPECT_NE(failure_of(with("max_cores = 2", "max_cores =")).find("line 3"), std::string::npos);
}

TEST(PlatformFile, with_a_text_that_its_parser_must_not_see_says_in_which_line) {
  for (const char* text : {"max_cores = 2\xcc\x9e", "[.max_cores]"}) {
    EXPECT_NE(failure_of(with("max_cores = 2", text)).find("line 3"), std::string::npos) << text;
  }
  EXPECT_EQ(load_platform("/dev/zero").error().code, ErrorCode::not_found);  // It never ends.
}

TEST(PlatformFile, refuses_a_kernel_that_would_cost_nothing) {
  EXPECT_NE(failure_of(with("updates = 1e-6", "")).find("names no work"), std::string::npos);
  EXPECT_NE(failure_of(with("scale = 2.0", "scale = 0.0")).find("must be positive"),
            std::string::npos);
}

TEST(PlatformFile, may_say_how_the_memory_clock_follows) {
  const ScratchFolder scratch;
  const std::string steps =
      "core_cubic_w = 0.4\nmemory_linear_w = 0.5\n[[power.memory_clocks]]\n"
      "from_hz = 0.0\nmemory_hz = 4e8\n[[power.memory_clocks]]\n";
  const auto model = load_platform(scratch.file(
      "board.toml", with("core_cubic_w = 0.4", steps + "from_hz = 2e9\nmemory_hz = 1.6e9")));
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->power.memory_linear_w, 0.5);
  EXPECT_EQ(model->power.memory_clock(Hertz{1e9}).value(), 4e8);
  EXPECT_EQ(model->power.memory_clock(Hertz{2e9}).value(), 1.6e9);
  EXPECT_NE(failure_of(with("core_cubic_w = 0.4", steps + "from_hz = 0.0\nmemory_hz = 1.6e9"))
                .find("power.memory_clocks are not ascending"),
            std::string::npos);
  EXPECT_NE(failure_of(with("core_cubic_w = 0.4", "core_cubic_w = 0.4\nmemory_linear_w = 0.5"))
                .find("power.memory_linear_w needs memory_clocks"),
            std::string::npos);
}

const char* const warm = R"(
[thermal]
ambient_c = 40.0
resistance_k_w = 8.0
time_constant_s = 540.0
[[thermal.trips]]
at_c = 80.0
hysteresis_k = 2.0
cap_hz = 1e9
)";

TEST(PlatformFile, may_say_how_warm_it_gets) {
  const ScratchFolder scratch;
  const auto model = load_platform(scratch.file("board.toml", std::string{whole} + warm));
  ASSERT_TRUE(model) << model.error().message;
  ASSERT_TRUE(model->thermal);
  EXPECT_EQ(model->thermal->resistance_k_w, 8.0);
  ASSERT_EQ(model->thermal->trips.size(), 1U);
  EXPECT_EQ(model->thermal->trips[0].cap.value(), 1e9);
}

TEST(PlatformFile, needs_ascending_trips_and_knows_their_keys) {
  const std::string twice = std::string{whole} + warm +
                            "[[thermal.trips]]\nat_c = 70.0\nhysteresis_k = 2.0\ncap_hz = 1e9\n"
                            "fan_w = 1.0\n";
  EXPECT_NE(failure_of(twice).find("thermal.trips are not ascending"), std::string::npos);
  EXPECT_NE(failure_of(twice).find("thermal.trips.fan_w is unknown"), std::string::npos);
}

TEST(PlatformFile, that_is_like_another_one_takes_over_what_it_does_not_say) {
  const ScratchFolder scratch;
  (void)scratch.file("board.toml", whole);
  const std::string hot = "like = \"board\"\nname = \"hot\"\nmax_cores = 1\n" + std::string{warm};
  const std::string path = scratch.file("hot.toml", hot);
  const auto model = load_platform(path);
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->name, "hot");
  EXPECT_EQ(model->max_cores, 1);
  EXPECT_EQ(model->kernels.at("octomap").scale, 2.0);
  EXPECT_TRUE(model->thermal);
  EXPECT_EQ(files_of_platform(path).size(), 2U);
}

TEST(PlatformFile, that_is_like_another_one_may_price_one_kernel_anew) {
  const ScratchFolder scratch;
  (void)scratch.file("board.toml", std::string{whole} + "[kernels.other]\na = 1.0\nb = 0.0\n" +
                                       "[kernels.other.seconds_per]\ncalls = 1.0\n");
  const auto model =
      load_platform(scratch.file("dear.toml",
                                 "like = \"board\"\n[kernels.other]\na = 2.0\nb = 0.0\n"
                                 "[kernels.other.seconds_per]\ncalls = 3.0\n"));
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->kernels.at("other").a, 2.0);
  EXPECT_EQ(model->kernels.at("octomap").scale, 2.0) << "the others keep their prices";
}

TEST(PlatformFile, may_be_like_one_that_is_shipped) {
  const ScratchFolder own;
  const ScratchFolder shipped;
  const std::string base = shipped.file("board.toml", whole);
  const std::string path = own.file("mine.toml", "like = \"board\"\nmax_cores = 1\n");
  EXPECT_FALSE(load_platform(path));
  const auto model = load_platform(path, shipped.path());
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->max_cores, 1);
  EXPECT_EQ(files_of_platform(path, shipped.path()), (std::vector<std::string>{path, base}));
}

TEST(PlatformFile, may_have_the_name_of_the_shipped_one_that_it_is_like) {
  const ScratchFolder shipped;
  const ScratchFolder own;
  (void)shipped.file("board.toml", whole);
  const std::string path = own.file("board.toml", "like = \"board\"\nmax_cores = 1\n");
  const auto loaded = load_platform(path, shipped.path());
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  EXPECT_EQ(loaded->max_cores, 1);
}

TEST(PlatformFile, names_another_one_in_quotes) {
  EXPECT_NE(failure_of("like = 5\n").find("like must be the name of another one"),
            std::string::npos);
  EXPECT_NE(failure_of("like = [\"board\"]\n").find("like must be the name of another one"),
            std::string::npos);
}

TEST(PlatformFile, cannot_be_like_one_that_is_like_another) {
  const ScratchFolder scratch;
  (void)scratch.file("board.toml", whole);
  (void)scratch.file("hot.toml", "like = \"board\"\n");
  const auto refused = load_platform(scratch.file("hotter.toml", "like = \"hot\"\n"));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("hot.toml\" is itself like another; name that one"),
            std::string::npos)
      << refused.error().message;
  EXPECT_FALSE(load_platform(scratch.file("self.toml", "like = \"self\"\n")));
}

TEST(PlatformFile, that_is_like_nothing_is_named) {
  EXPECT_NE(failure_of("like = \"moon\"\n").find("there is no"), std::string::npos);
}

TEST(JetsonTx2, passively_cooled_throttles_under_full_load_and_not_with_one_busy_core) {
  const auto model = load_platform(kit::built_data() + "/platforms/jetson_tx2_passive.toml");
  ASSERT_TRUE(model) << model.error().message;
  const ModeledPlatform platform{*model};
  const OperatingPoint top{4, platform.frequencies().back()};
  ThermalState full{*model->thermal, platform.power(top, 0.0)};
  ThermalState one = full;
  full.step(platform.power(top, 4.0), 1e5);
  one.step(platform.power(top, 1.0), 1e5);
  EXPECT_TRUE(full.cap());
  EXPECT_FALSE(one.cap());
  for (const ThermalTrip& trip : model->thermal->trips) {
    const auto& clocks = platform.frequencies();
    EXPECT_EQ(std::count(clocks.begin(), clocks.end(), trip.cap), 1) << trip.cap.value();
  }
}

TEST(JetsonTx2, has_the_boards_clocks_and_the_papers_cores) {
  const PlatformModel model = tx2();
  EXPECT_EQ(model.max_cores, 4);
  ASSERT_EQ(model.frequencies.size(), 12U);
  EXPECT_EQ(model.frequencies.front().value(), 345.6e6);
  EXPECT_EQ(model.frequencies.back().value(), 2035.2e6);
}

TEST(JetsonTx2, draws_what_the_board_is_known_to_draw) {
  const ModeledPlatform platform{tx2()};
  // Published: idle 1.4-2.1 W at the lowest clock; all cores busy at the top 6 to 8 W without GPU.
  const double idle_w = platform.power({4, Hertz{345.6e6}}, 0.0).value();
  const double full_w = platform.power({4, Hertz{2035.2e6}}, 4.0).value();
  EXPECT_GT(idle_w, 1.4);
  EXPECT_LT(idle_w, 2.1);
  EXPECT_GT(full_w, 6.0);
  EXPECT_LT(full_w, 8.0);
  // Published: the rail of the four cores takes 4.3 W; it has their leakage and clock tree, too.
  const double idle_top_w = platform.power({4, Hertz{2035.2e6}}, 0.0).value();
  const PowerCost& power = platform.model().power;
  const double rail_w =
      (full_w - idle_top_w) / power.converter + power.cpu_constant_w + power.cpu_linear_w * 2.0352;
  EXPECT_NEAR(rail_w, 4.3, 0.1);
}

TEST(JetsonTx2, raises_the_memory_clock_with_the_cores) {
  const PowerCost power = tx2().power;
  // the cores' clock tree over 1.69 GHz, and the memory's way from 408 MHz to 1.866 GHz
  EXPECT_NEAR((power.power(Hertz{2035.2e6}, 0.0) - power.power(Hertz{345.6e6}, 0.0)).value(),
              1.24 * (0.05 * 1.6896 + 0.402 * 1.458), 1e-6);
  EXPECT_EQ(power.memory_clock(Hertz{1267.2e6}).value(), 660e6);
}

struct PaperTime {
  const char* kernel;
  std::vector<WorkItem> work;
  double seconds;
};

// One call's work as `flyball fit jetson_tx2` records it in scene A. The fit checks the scales
// against a fresh record; this catches a price that changes by mistake.
TEST(JetsonTx2, prices_the_recorded_work_near_the_papers_kernel_times) {
  const ModeledPlatform platform{tx2()};
  const std::vector<PaperTime> paper{
      {"depth_to_points", {{"pixels", 36864.0}}, 0.002},
      {"swept_cylinder", {{"poses", 260.0}}, 0.001},
      {"rrt_connect", {{"iterations", 50.0}, {"collision_queries", 256.0}}, 0.182},
      {"visual_slam", {{"pixels", 36864.0}}, 0.055},
      {"track", {{"ticks", 1.0}}, 0.001},
  };
  for (const PaperTime& row : paper) {
    Work work;
    for (const WorkItem& item : row.work) {
      work.add(item.name, item.count);
    }
    const double seconds = to_seconds(platform.job_time(row.kernel, work, Hertz{2035.2e6}));
    EXPECT_NEAR(seconds, row.seconds, 0.1 * row.seconds) << row.kernel;
  }
}

TEST(JetsonTx2, knows_the_price_of_every_kernel_of_a_mission) {
  const ModeledPlatform platform{tx2()};
  for (const char* kernel : {"depth_to_points", "octomap", "swept_cylinder", "rrt", "rrt_connect",
                             "rrt_star", "prm", "bit_star", "lawnmower", "minimum_snap",
                             "minimum_jerk", "visual_slam", "localizer", "track"}) {
    EXPECT_TRUE(platform.knows(kernel)) << kernel;
  }
}

}  // namespace
}  // namespace flyball
