// SPDX-License-Identifier: BSD-3-Clause

#include "scenario/scenario_events.h"

#include "scratch_folder.h"
#include <algorithm>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using Errors = std::vector<Error>;

const char* const three = R"([platform]
name = "jetson_tx2_passive"
[[events]]
kind = "slowdown"
at_s = 20
factor = 3
[[events]]
kind = "co_runner"
at_s = 5
until_s = 7.5
cores = 2
memory_share = 0.3
[[events]]
kind = "cooling"
at_s = 1
resistance_k_w = 20
ambient_c = 45
)";

std::variant<LoadedScenario, Errors> load(const std::string& toml,
                                          const std::vector<std::string>& settings = {}) {
  const ScratchFolder scratch;
  return load_scenario(scratch.file("mine.toml", toml), settings);
}

std::string said_of(const std::string& toml, const std::vector<std::string>& settings = {}) {
  const auto loaded = load(toml, settings);
  std::string text;
  if (const auto* errors = std::get_if<Errors>(&loaded)) {
    for (const Error& error : *errors) {
      text += error.message + "\n";
    }
  }
  return text;
}

TEST(ScenarioEvents, are_read_in_their_order) {
  ASSERT_EQ(said_of(three), "");
  const auto loaded = load(three);
  const auto& events = std::get<LoadedScenario>(loaded).scenario.events;
  ASSERT_EQ(events.size(), 3U);
  EXPECT_EQ(events[0].kind, "slowdown");
  EXPECT_EQ(events[0].factor, 3.0);
  EXPECT_EQ(events[0].kernels, "all");
  EXPECT_EQ(events[1].until_s, 7.5);
  EXPECT_EQ(events[1].memory_share, 0.3);
  EXPECT_EQ(events[2].resistance_k_w, 20.0);
}

TEST(ScenarioEvents, what_is_written_reads_back) {
  const auto loaded = load(three, {"events.1.kernels=octomap, rrt_connect"});
  const std::string written = to_toml(std::get<LoadedScenario>(loaded).scenario);
  const auto again = load(written);
  EXPECT_EQ(to_toml(std::get<LoadedScenario>(again).scenario), written);
  EXPECT_NE(written.find("kernels = \"octomap, rrt_connect\""), std::string::npos) << written;
}

TEST(ScenarioEvents, are_part_of_the_printed_configuration) {
  const auto loaded = load(three);
  const auto& entries = std::get<LoadedScenario>(loaded).entries;
  const auto factor = std::find_if(entries.begin(), entries.end(), [](const ConfigEntry& entry) {
    return entry.key == "events.1.factor";
  });
  ASSERT_NE(factor, entries.end());
  EXPECT_EQ(factor->value, "3");
  EXPECT_EQ(factor->origin, "mine.toml:6");
}

TEST(ScenarioEvents, can_be_set_on_the_command_line) {
  EXPECT_EQ(said_of("", {"events.1.kind=slowdown", "events.1.at_s=3", "events.1.factor=2"}), "");
}

TEST(ScenarioEvents, each_mistake_gets_one_sentence) {
  const std::string said = said_of(R"([[events]]
kind = "slodown"
at_s = 3
[[events]]
kind = "slowdown"
at_s = -1
factor = "much"
cores = 2
[[events]]
kind = "co_runner"
at_s = 9
until_s = 4
)");
  for (const char* sentence :
       {"events.1.kind = \"slodown\" (mine.toml:2) must be one of: slowdown, co_runner, cooling",
        "events.2.at_s = -1 (mine.toml:6) must be at least 0 s and at most 86400 s",
        "events.2.factor = \"much\" (mine.toml:7) must be a number",
        "no setting \"events.2.cores\" (mine.toml:8); a slowdown has: kind, at_s, until_s, "
        "factor, kernels",
        "events.3.cores is missing: a co_runner needs it",
        "events.3.until_s = 4 (mine.toml:12) must be after its at_s = 9, or 0"}) {
    EXPECT_NE(said.find(sentence), std::string::npos) << sentence << "\nis missing from\n" << said;
  }
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 6) << said;
}

TEST(ScenarioEvents, a_bit_flip_names_its_topic_and_may_name_a_number) {
  EXPECT_EQ(said_of("[[events]]\nkind = \"bit_flip\"\nat_s = 3\ntopic = \"setpoint\"\n"
                    "variable = \"vx\"\ndraw = 7\n"),
            "");
  EXPECT_NE(said_of("[[events]]\nkind = \"bit_flip\"\nat_s = 3\nfactor = 2\n")
                .find("events.1.topic is missing: a bit_flip needs it"),
            std::string::npos);
}

TEST(ScenarioEvents, what_the_platform_cannot_do_is_refused) {
  EXPECT_NE(
      said_of("[[events]]\nkind = \"slowdown\"\nat_s = 1\nfactor = 3\nkernels = \"octomop\"\n")
          .find("jetson_tx2 has no price for a kernel \"octomop\""),
      std::string::npos);
  for (const auto& [kernels, has] : {std::pair{"octomap, octomap", "\"octomap\" twice"},
                                     {",", "an empty name"},
                                     {"octomap,", "an empty name"}}) {
    const std::string list{kernels};
    EXPECT_EQ(said_of("[[events]]\nkind = \"slowdown\"\nat_s = 1\nfactor = 3\nkernels = \"" + list +
                      "\"\n"),
              "events.1.kernels = \"" + list + "\" has " + has +
                  "; name each kernel once, with commas between, or give all\n");
  }
  EXPECT_NE(said_of("[[events]]\nkind = \"cooling\"\nat_s = 1\nresistance_k_w = 9\nambient_c = 9\n")
                .find("jetson_tx2 has no [thermal] table"),
            std::string::npos);
  EXPECT_NE(said_of("[[events]]\nkind = \"co_runner\"\nat_s = 1\ncores = 2\n"
                    "[[events]]\nkind = \"co_runner\"\nat_s = 2\ncores = 1.5\n")
                .find("co-runners take 3.5 of the 4 cores"),
            std::string::npos);
  EXPECT_NE(said_of("[platform]\nstart_temperature_c = 70\n").find("needs a platform"),
            std::string::npos);
}

TEST(ScenarioEvents, a_single_table_or_a_gap_in_the_numbers_is_refused) {
  EXPECT_NE(said_of("[events]\nkind = \"slowdown\"\n").find("events are tables [[events]]"),
            std::string::npos);
  EXPECT_NE(said_of("", {"events.2.kind=slowdown"}).find("numbered from 1 without a gap"),
            std::string::npos);
}

}  // namespace
}  // namespace flyball
