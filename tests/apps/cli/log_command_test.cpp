// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop

#include "flyball/mcap/mcap_recovery.h"

#include "flyball_program.h"
#include "mcap_reader.h"
#include <csignal>
#include <filesystem>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace {

const std::string short_flight = "run delivery_forest --set mission.time_limit_s=8 --out run ";

struct LogCommand : testing::Test {
  void expect_refused(const std::string& arguments, const std::string& sentence) const {
    const FlyballProgram::Outcome outcome = flyball.run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_NE(outcome.errors.find(sentence), std::string::npos) << outcome.errors;
    EXPECT_EQ(outcome.output, "");
  }
  FlyballProgram flyball;
};

TEST_F(LogCommand, records_a_flight_and_says_how_many_rows) {
  const auto outcome = flyball.run(short_flight + "--mcap a.mcap --json");
  ASSERT_EQ(outcome.exit_code, 1) << outcome.errors;  // It has no time to arrive.
  const McapReader file{flyball.place.path("a.mcap")};
  EXPECT_TRUE(file.faults.empty());
  const auto summary = nlohmann::json::parse(outcome.output);
  EXPECT_EQ(summary["quality"]["record_rows"], file.messages().size());
  EXPECT_EQ(summary["quality"]["record_rows_dropped"], 0);
  EXPECT_EQ(file.metadata.at("flyball.mission").at("seed"), "1");
  EXPECT_NE(file.metadata.at("flyball.mission").at("scenario").find("[mission]"),
            std::string::npos);
}

TEST_F(LogCommand, refuses_a_place_where_no_record_can_be_made_before_it_flies) {
  expect_refused(short_flight + "--mcap missing/a.mcap", "missing/a.mcap\" cannot be made");
  EXPECT_TRUE(flyball.place.is_empty());
  expect_refused(short_flight + "--mcap ''", "--mcap");
  expect_refused(short_flight + "--timeline missing/a.pftrace", "there is no folder \"missing\"");
  EXPECT_TRUE(flyball.place.is_empty());
}

TEST_F(LogCommand, refuses_to_write_two_things_into_one_file) {
  expect_refused(short_flight + "--timeline run/../run/summary.json", "would be written twice");
  expect_refused(short_flight + "--mcap run/picture.json", "would be written twice");
  expect_refused(short_flight + "--timeline run/frame_1.png", "would be written twice");
  expect_refused(short_flight + "--timeline a --mcap ./a", "would be written twice");
  EXPECT_TRUE(flyball.place.is_empty());
}

TEST_F(LogCommand, keeps_the_record_before_when_a_flight_is_refused) {
  (void)flyball.place.file("a.mcap", "of another flight");
  expect_refused(short_flight + "--mcap a.mcap --start-map missing.bt", "missing.bt");
  EXPECT_EQ(flyball.place.content("a.mcap"), "of another flight");
  EXPECT_EQ(flyball.run(short_flight + "--mcap a.mcap").exit_code, 1);
  EXPECT_TRUE(McapReader{flyball.place.path("a.mcap")}.faults.empty());
  EXPECT_FALSE(std::filesystem::exists(flyball.place.path("a.mcap.before")));
}

TEST_F(LogCommand, leaves_a_file_alone_that_has_the_name_of_a_kept_record) {
  (void)flyball.place.file("a.mcap", "of another flight");
  (void)flyball.place.file("a.mcap.before", "mine");
  std::filesystem::create_symlink("a.mcap", flyball.place.path("link.mcap"));
  EXPECT_EQ(flyball.run(short_flight + "--mcap link.mcap").exit_code, 1);
  EXPECT_EQ(flyball.place.content("a.mcap.before"), "mine");
  EXPECT_TRUE(std::filesystem::is_symlink(flyball.place.path("link.mcap")));
  EXPECT_TRUE(McapReader{flyball.place.path("a.mcap")}.faults.empty());
  EXPECT_FALSE(std::filesystem::exists(flyball.place.path("a.mcap.before2")));
}

TEST_F(LogCommand, keeps_a_flight_whose_map_cannot_be_written) {
  expect_refused(short_flight + "--map missing/a.bt", "there is no folder \"missing\"");
  EXPECT_TRUE(flyball.place.is_empty()) << "nothing has flown";
  const auto outcome =
      flyball.run("run scanning_farm --set mission.time_limit_s=4 --out run --map a.bt");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("a.bt\": nothing has been mapped"), std::string::npos);
  EXPECT_NE(outcome.output.find("time_limit"), std::string::npos) << outcome.output;
  EXPECT_TRUE(std::filesystem::exists(flyball.place.path("run/summary.json")));
}

TEST_F(LogCommand, does_not_write_over_what_it_reads) {
  (void)flyball.place.file("mission.toml", "name = \"mine\"\n");
  expect_refused("run mission.toml --set mission.time_limit_s=2 --out .", "would overwrite it");
  expect_refused("run mission.toml --set mission.time_limit_s=2 --out run --mcap mission.toml",
                 "would overwrite it");
  EXPECT_EQ(flyball.place.content("mission.toml"), "name = \"mine\"\n");
}

TEST_F(LogCommand, recovers_what_was_closed_of_a_flight_that_was_cut) {
  (void)flyball.run(short_flight + "--mcap a.mcap");
  const McapReader whole{flyball.place.path("a.mcap")};
  ASSERT_GE(whole.chunks.size(), 5U);
  std::filesystem::resize_file(flyball.place.path("a.mcap"), whole.chunks[4].end - 1);
  const auto outcome = flyball.run("log recover a.mcap --out b.mcap");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.output.find("4 chunks with "), 0U) << outcome.output;
  EXPECT_NE(outcome.output.find("bytes behind the last whole record are lost"), std::string::npos);
  const McapReader back{flyball.place.path("b.mcap")};
  EXPECT_TRUE(back.faults.empty());
  ASSERT_EQ(back.chunks.size(), 4U);
  for (std::size_t i = 0; i < back.chunks.size(); ++i) {
    EXPECT_EQ(back.chunks[i].messages, whole.chunks[i].messages);
  }
}

TEST_F(LogCommand, says_in_one_sentence_what_it_cannot_recover) {
  (void)flyball.place.file("text.mcap", "not a record");
  expect_refused("log recover missing.mcap --out b.mcap", "no file \"missing.mcap\"");
  expect_refused("log recover text.mcap --out b.mcap", "\"text.mcap\" is no MCAP file");
  expect_refused("log recover text.mcap --out text.mcap", "is the broken file itself");
  expect_refused("log recover text.mcap", "--out is required");
  expect_refused("log", "subcommand is required");
  EXPECT_FALSE(std::filesystem::exists(flyball.place.path("b.mcap")));
}

TEST_F(LogCommand, brings_back_a_flight_in_real_time_that_was_killed) {
  const std::string broken = flyball.place.path("a.mcap");
  const std::string out = flyball.place.path("b.mcap");
  const pid_t child = fork();
  if (child == 0) {
    (void)!chdir(flyball.place.path().c_str());
    (void)!freopen("/dev/null", "w", stderr);
    execl(FlyballProgram::binary().c_str(), "flyball", "run", "delivery_forest", "--executor",
          "realtime", "--out", "run", "--mcap", "a.mcap", nullptr);
    _exit(127);
  }
  std::size_t closed = 0;
  // Ends when three chunks have come; if they never did, the time limit would end the test.
  while (closed < 3) {
    const auto done = flyball::recover_mcap(broken, out);
    closed = done ? done->chunks : 0;
    std::this_thread::sleep_for(std::chrono::milliseconds{50});
  }
  kill(child, SIGKILL);
  int status{};
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  const auto outcome = flyball.run("log recover a.mcap --out b.mcap");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  const McapReader file{out};
  EXPECT_TRUE(file.faults.empty());
  EXPECT_GE(file.chunks.size(), closed);
  EXPECT_FALSE(file.decoded("/pose").empty());
}

}  // namespace
