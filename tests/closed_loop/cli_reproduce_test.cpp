// SPDX-License-Identifier: BSD-3-Clause

#include "flyball_process.h"
#include "flyball_program.h"
#include "made_slurm.h"
#include <chrono>
#include <csignal>
#include <filesystem>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

/// The experiment whose flights are the shortest.
constexpr const char* line = "reproduce speed_latency --seeds 1 --out r ";
constexpr const char* tables[] = {"r/claims.csv", "r/speed_latency/slower_maps_flights.csv",
                                  "r/speed_latency/slower_maps_cells.csv",
                                  "r/speed_latency/eq_2.csv", "r/reproduce.html"};

/// Ends it after its first flight.
void kill_after_a_flight(const FlyballProgram& flyball) {
  FlyballProcess killed{
      flyball, {"reproduce", "speed_latency", "--seeds", "1", "--out", "r", "--jobs", "1"}};
  killed.wait_for_file("r/reproduce.db");
  std::vector<pid_t> first;
  for (std::vector<pid_t> now; first.empty() || now == first || now.empty();) {
    std::this_thread::sleep_for(std::chrono::milliseconds{10});  // The flight needs the processor.
    now = killed.children();
    first = first.empty() ? now : first;
  }
  killed.send(SIGKILL);
  EXPECT_EQ(killed.exit_code(), -SIGKILL) << killed.errors();
}

void expect_equal_tables(const FlyballProgram& one, const FlyballProgram& other) {
  for (const char* table : tables) {
    EXPECT_EQ(one.place.content(table), other.place.content(table)) << table;
  }
}

TEST(CliReproduce, ends_with_the_same_tables_after_a_kill_and_on_slurm) {
  const FlyballProgram whole;
  const auto expected = whole.run(std::string{line} + "--jobs 2");
  ASSERT_EQ(expected.exit_code, 0) << expected.errors;
  EXPECT_NE(expected.output.find("speed_latency"), std::string::npos);
  EXPECT_NE(expected.output.find("reproduced"), std::string::npos) << expected.output;

  const FlyballProgram killed;
  kill_after_a_flight(killed);
  const auto continued = killed.run(std::string{line} + "--jobs 1");
  ASSERT_EQ(continued.exit_code, 0) << continued.errors;
  EXPECT_NE(continued.errors.find("of 5 flights are known from before"), std::string::npos)
      << continued.errors;
  EXPECT_EQ(continued.output, expected.output);
  expect_equal_tables(killed, whole);
  EXPECT_FALSE(fs::exists(killed.place.path("r/speed_latency/slower_maps")))
      << "records go when they are counted";

  const FlyballProgram cluster;
  const MadeSlurm slurm{cluster, "sh \"$script\""};
  const auto flown = cluster.run(std::string{line} + "--on slurm");
  ASSERT_EQ(flown.exit_code, 0) << flown.errors;
  EXPECT_EQ(flown.output, expected.output);
  EXPECT_EQ(cluster.place.content("slurm_programs/arrays"), "array\n") << flown.errors;
  expect_equal_tables(cluster, whole);
}

TEST(CliReproduce, finds_no_flight_that_is_faster_than_eq_2_allows) {
  const FlyballProgram flyball;
  ASSERT_EQ(flyball.run(line).exit_code, 0);
  std::istringstream claims{flyball.place.content("r/claims.csv")};
  int rows = 0;
  for (std::string row; std::getline(claims, row);) {
    const std::string what = "highest speed over eq. 2\",,,,";
    if (const auto at = row.find(what); at != std::string::npos) {
      EXPECT_LT(std::stod(row.substr(at + what.size())), 1.0) << row;
      ++rows;
    }
  }
  EXPECT_EQ(rows, 5);
}

TEST(CliReproduce, refuses_what_it_does_not_know_before_anything_flies) {
  const FlyballProgram flyball;
  const struct {
    const char* arguments;
    const char* sentence;
  } refused[] = {
      {"moon_landing", "no experiment \"moon_landing\"; try: flyball list experiments"},
      {"speed_latency --seeds 0", "--seeds"},
      {"speed_latency --on moon", "--on"},
      {"speed_latency --on slurm --jobs 2", "--on"},
      {"speed_latency --out \"\"", "--out"},
  };
  for (const auto& [arguments, sentence] : refused) {
    const auto outcome = flyball.run(std::string{"reproduce "} + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_NE(outcome.errors.find(sentence), std::string::npos) << outcome.errors;
    EXPECT_TRUE(flyball.place.is_empty()) << arguments;
  }
}

}  // namespace
