// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/records/report.h"

#include "made_flights.h"
#include "scratch_folder.h"
#include <array>
#include <atomic>
#include <csignal>
#include <cstring>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace flyball {
namespace {

TEST(RunFolder, holds_the_mission_its_summary_its_trace_and_a_page) {
  const ScratchFolder scratch;
  Scenario scenario;
  scenario.seed = 5;
  ASSERT_TRUE(write_run(scratch.path("deep/run"), scenario, made_record("a", 5)).ok());
  Summary summary;
  EXPECT_TRUE(from_json(scratch.content("deep/run/summary.json"), summary));
  EXPECT_EQ(summary.seed, 5U);
  EXPECT_EQ(scratch.content("deep/run/mission.toml"), mission_file(scenario));
  EXPECT_NE(scratch.content("deep/run/report.html").find("<canvas"), std::string::npos);
  EXPECT_NE(scratch.content("deep/run/report.html").find("<th>area covered %</th>"),
            std::string::npos);
  for (const auto& entry : std::filesystem::directory_iterator{scratch.path("deep/run")}) {
    EXPECT_NE(entry.path().extension(), ".part");
  }
}

TEST(RunFolder, the_page_has_units_as_its_other_columns_have_them) {
  const ScratchFolder scratch;
  MissionRecord record = made_record("a", 5);
  record.summary.quality = {{"known_percent", 90.0}, {"localization_error_m_max", 0.25}};
  ASSERT_TRUE(write_run(scratch.path(), Scenario{}, record).ok());
  EXPECT_NE(
      scratch.content("report.html").find("<th>known %</th><th>localization error max m</th></tr>"),
      std::string::npos);
}

TEST(RunFolder, a_file_behind_a_link_is_written_and_the_link_stays) {
  const ScratchFolder scratch;
  (void)scratch.file("target", "before");
  std::filesystem::create_symlink("target", scratch.path("link"));
  ASSERT_TRUE(write_file(scratch.path("link"), "after").ok());
  EXPECT_TRUE(std::filesystem::is_symlink(scratch.path("link")));
  EXPECT_EQ(scratch.content("target"), "after");
}

TEST(RunFolder, a_pipe_is_written_to_and_stays_a_pipe) {
  const ScratchFolder scratch;
  const std::string pipe = scratch.path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  ASSERT_GE(reader, 0);
  EXPECT_TRUE(write_file(pipe, "content").ok());
  std::array<char, 16> text{};
  EXPECT_EQ(read(reader, text.data(), text.size()), 7);
  EXPECT_STREQ(text.data(), "content");
  close(reader);
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

TEST(RunFolder, knows_the_names_of_all_that_it_writes) {
  const ScratchFolder scratch;
  ASSERT_TRUE(write_run(scratch.path("run"), Scenario{}, made_record("a", 5)).ok());
  for (const auto& entry : std::filesystem::directory_iterator{scratch.path("run")}) {
    EXPECT_TRUE(is_of_record(entry.path().filename().string())) << entry.path();
  }
  EXPECT_TRUE(is_of_record("frame_12.png"));
  EXPECT_FALSE(is_of_record("flight.mcap"));
}

TEST(RunFolder, says_why_the_system_does_not_let_a_file_be_written) {
  const ScratchFolder scratch;
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto ignored = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{100, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const Status written = write_file(scratch.path("big"), std::string(100000, 'x'));
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, ignored);
  ASSERT_FALSE(written.ok());
  EXPECT_EQ(written.error().message,
            "cannot write \"" + scratch.path("big") + "\": File too large; choose another place");
  EXPECT_TRUE(scratch.is_empty());
}

TEST(RunFolder, pictures_of_the_flight_before_go) {
  const ScratchFolder scratch;
  (void)scratch.file("frame_1.png", "of somebody else");
  ASSERT_TRUE(write_run(scratch.path(), Scenario{}, made_record("a", 5)).ok());
  EXPECT_EQ(scratch.content("frame_1.png"), "of somebody else") << "there was no record";
  ASSERT_TRUE(write_run(scratch.path(), Scenario{}, made_record("a", 5)).ok());
  EXPECT_EQ(scratch.content("frame_1.png"), "");
}

TEST(RunFolder, the_page_says_that_a_policy_was_replaced) {
  const ScratchFolder scratch;
  ASSERT_TRUE(write_run(scratch.path(), Scenario{}, made_record("<a>", 5)).ok());
  EXPECT_NE(scratch.content("report.html")
                .find("policy &lt;a&gt; was replaced by safe settings in 10 of 400 decisions"),
            std::string::npos);
}

TEST(RunFolder, the_page_begins_with_the_figures_by_which_a_workload_is_judged) {
  const ScratchFolder scratch;
  MissionRecord record = made_record("a", 5);
  record.summary.quality = {
      {"looks", 3.0}, {"map_precision", 0.987}, {"map_recall", 0.5}, {"tracked_s", 61.25}};
  ASSERT_TRUE(write_run(scratch.path(), Scenario{}, record).ok());
  const std::string page = scratch.content("report.html");
  EXPECT_NE(page.find("<th>end</th><th>tracked s</th><th>map recall %</th><th>map precision %</th>"
                      "<th>time s</th>"),
            std::string::npos);
  EXPECT_NE(page.find("<td>succeeded</td><td>61.2</td><td>50.0</td><td>98.7</td>"),
            std::string::npos);
  EXPECT_NE(page.find("<div class=\"table\"><table>"), std::string::npos);
}

TEST(RunFolder, the_mission_file_reads_back) {
  const ScratchFolder scratch;
  Scenario scenario;
  scenario.map.range_m = 6.25;
  const auto loaded = load_scenario(scratch.file("mission.toml", mission_file(scenario)), {});
  ASSERT_TRUE(std::holds_alternative<LoadedScenario>(loaded))
      << std::get<1>(loaded).front().message;
  EXPECT_EQ(std::get<LoadedScenario>(loaded).scenario.map.range_m, 6.25);
}

TEST(RunFolder, trace_lines_read_back_to_the_same_bits) {
  const ScratchFolder scratch;
  ASSERT_TRUE(write_run(scratch.path(), Scenario{}, made_record("a", 5)).ok());
  std::istringstream lines{scratch.content("trace.jsonl")};
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(nlohmann::json::parse(line)["channel"], "mission");
  std::getline(lines, line);
  const auto first = nlohmann::json::parse(line);
  EXPECT_EQ(first["channel"], "state");
  const double y_m = first["y_m"];
  const double third = 1.0 / 3.0;
  EXPECT_EQ(std::memcmp(&y_m, &third, sizeof y_m), 0);
  nlohmann::json last;
  int count = 1;
  for (; std::getline(lines, line); ++count) {
    last = nlohmann::json::parse(line);
  }
  EXPECT_EQ(count, 22);
  EXPECT_EQ(last["what"], "\"</script>\" ends\nit");
}

TEST(RunFolder, a_finished_run_is_known_by_its_mission) {
  const ScratchFolder scratch;
  Scenario scenario;
  const MissionRecord record = made_record("a", 5);
  EXPECT_FALSE(finished_run(scratch.path("run"), scenario).has_value());
  ASSERT_TRUE(write_run(scratch.path("run"), scenario, record).ok());
  const auto found = finished_run(scratch.path("run"), scenario);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->summary.trace_hash, record.summary.trace_hash);
  EXPECT_EQ(found->json, picture_of(record).json);
  scenario.map.range_m += 1e-12;
  EXPECT_FALSE(finished_run(scratch.path("run"), scenario).has_value()) << "another mission";
}

TEST(RunFolder, an_interrupted_run_is_marked_and_not_finished) {
  const ScratchFolder scratch;
  MissionRecord record = made_record("a", 5);
  record.summary.status = MissionStatus::interrupted;
  ASSERT_TRUE(write_run(scratch.path(), Scenario{}, record).ok());
  EXPECT_EQ(scratch.content("mission.toml").rfind("# Interrupted", 0), 0U);
  EXPECT_FALSE(finished_run(scratch.path(), Scenario{}).has_value());
}

TEST(RunFolder, a_place_that_cannot_be_written_is_refused_and_left_alone) {
  const ScratchFolder scratch;
  const std::string in_the_way = scratch.file("file", "precious");
  for (const std::string& folder : {in_the_way, in_the_way + "/below"}) {
    const auto prepared = prepare_folder(folder);
    ASSERT_FALSE(prepared.ok()) << folder;
    EXPECT_EQ(prepared.error().code, ErrorCode::unavailable);
    EXPECT_NE(prepared.error().message.find(folder), std::string::npos);
    EXPECT_NE(prepared.error().message.find("--out"), std::string::npos);
    EXPECT_FALSE(write_run(folder, Scenario{}, made_record("a", 1)).ok());
  }
  EXPECT_EQ(scratch.content("file"), "precious");
}

TEST(RunFolder, preparing_can_be_undone) {
  const ScratchFolder scratch;
  const auto made = prepare_folder(scratch.path("a/b/c"));
  ASSERT_TRUE(made.ok());
  EXPECT_EQ(made->size(), 3U);
  EXPECT_TRUE(std::filesystem::is_empty(scratch.path("a/b/c")));
  (void)scratch.file("a/kept", "precious");
  remove_empty(*made);
  EXPECT_FALSE(std::filesystem::exists(scratch.path("a/b")));
  EXPECT_EQ(scratch.content("a/kept"), "precious");
}

TEST(RunFolder, a_folder_is_made_though_others_remove_what_is_empty) {
  const ScratchFolder scratch;
  std::atomic<bool> is_done{false};
  std::thread other{[&] {
    while (!is_done) {
      remove_empty({scratch.path("a"), scratch.path("a/b"), scratch.path("a/b/c")});
      std::this_thread::yield();
    }
  }};
  for (int i = 0; i < 500; ++i) {
    const auto made = prepare_folder(scratch.path("a/b/c/d"));
    EXPECT_TRUE(made.ok()) << made.error().message;
    std::filesystem::remove(scratch.path("a/b/c/d"));
  }
  is_done = true;
  other.join();
}

TEST(RunFolder, a_file_that_cannot_be_replaced_keeps_its_content) {
  const ScratchFolder scratch;
  std::filesystem::create_directory(scratch.path("name"));
  (void)scratch.file("name/inside", "precious");
  EXPECT_FALSE(write_file(scratch.path("name"), "new").ok());
  EXPECT_EQ(scratch.content("name/inside"), "precious");
  for (const auto& entry : std::filesystem::directory_iterator{scratch.path()}) {
    EXPECT_EQ(entry.path().filename(), "name") << "nothing else is left";
  }
}

TEST(RunFolder, a_mission_is_another_one_when_a_file_that_it_names_changes) {
  const ScratchFolder scratch;
  Scenario scenario;
  const std::string world = scratch.file("world.bt", "one");
  scenario.world.parameters["file"] = world;
  scenario.edge.platform = scratch.file("edge.toml", "like = \"jetson_tx2\"\n");
  const std::string rule = scratch.file("rule.lua", "-- one");
  scenario.governor.policy =
      scratch.file("both.toml", "application = \"" + rule + "\"\nclock = \"schedutil_10ms\"\n");
  for (const char* changed : {"world.bt", "edge.toml", "rule.lua"}) {
    const std::string before = mission_file(scenario);
    (void)scratch.file(changed, scratch.content(changed) + "# another\n");
    EXPECT_NE(mission_file(scenario), before) << changed;
    EXPECT_EQ(mission_file(scenario), mission_file(scenario)) << changed;
  }
}

}  // namespace
}  // namespace flyball
