// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop
#include "flyball/studies/replay.h"

#include "flyball/records/report.h"
#include "flyball/runtime/observation_fields.h"
#include "flyball/simulation/realtime_flight.h"

#include "scratch_folder.h"
#include "short_delivery.h"
#include <chrono>
#include <thread>
#include <tuple>

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// Flies, leaves the record in the folder, reads it back.
RecordedFlight flown_with(const std::string& policy, const ScratchFolder& folder) {
  Scenario scenario = kit::short_delivery(8.0);
  scenario.governor.policy = policy;
  const MissionRecord record = kit::flown(scenario);
  EXPECT_TRUE(write_run(folder.path(), scenario, record).ok());
  auto flight = read_flight(folder.path());
  EXPECT_TRUE(flight.ok()) << flight.error().message;
  EXPECT_EQ(record.summary.decisions, flight->decisions);
  return *flight;
}

TEST(Replay, repeats_every_decision_bit_for_bit) {
  for (const char* policy : {"two_level", "mission_energy", "schedutil_10ms"}) {
    const ScratchFolder folder;
    const RecordedFlight flight = flown_with(policy, folder);
    const auto result = replay(flight);
    ASSERT_TRUE(result.ok()) << result.error().message;
    EXPECT_EQ(flight.decisions, result->decisions);
    EXPECT_GT(result->decisions, 50U);
    EXPECT_EQ(0U, result->different)
        << policy << " at " << to_seconds(result->differences.front().at) << "\n"
        << result->differences.front().recorded << "\n"
        << result->differences.front().now;
  }
}

TEST(Replay, repeats_a_flight_in_real_time_with_decisions_that_were_dropped) {
  Scenario scenario = kit::short_delivery(200.0);
  scenario.mission.time_limit_s = 3.0;
  scenario.governor.period_s = 0.01;
  // Each decision is another one, so that a decision too many or too few shows.
  const ScratchFolder scripts;
  scenario.governor.policy = scripts.file("to_and_fro.lua", R"(
    description = "One clock, then the other"
    local count = 0
    function decide(seen)
      count = count + 1
      return {["cpu.frequency_hz"] = count % 2 == 0 and 345.6e6 or 2035.2e6}, "fixed"
    end
  )");
  RealtimeSettings settings;
  settings.grant = [](const OperatingPoint& wanted) {
    std::this_thread::sleep_for(std::chrono::milliseconds{25});  // A slow board.
    return wanted;
  };
  MissionHooks hooks;
  hooks.executor = in_real_time(settings);
  const auto record = fly(scenario, hooks);
  ASSERT_TRUE(record) << record.error().message;
  const ScratchFolder folder;
  ASSERT_TRUE(write_run(folder.path(), scenario, *record));
  const auto flight = read_flight(folder.path());
  ASSERT_TRUE(flight) << flight.error().message;
  EXPECT_FALSE(flight->after_drops.empty());
  const auto result = replay(*flight);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->decisions, record->summary.decisions);
  EXPECT_EQ(result->different, 0U);
}

TEST(Replay, finds_what_was_changed_in_a_record) {
  const ScratchFolder folder;
  RecordedFlight flight = flown_with("two_level", folder);
  flight.choices.begin()->second += "!";
  const auto wrong = replay(flight);
  ASSERT_TRUE(wrong.ok());
  EXPECT_GT(wrong->different, 0U);
  EXPECT_EQ(MissionTime{}, wrong->differences.front().at);
}

TEST(Replay, another_input_makes_other_decisions) {
  const ScratchFolder folder;
  RecordedFlight flight = flown_with("two_level", folder);
  const auto& fields = observation_fields();
  for (auto& [at, changes] : flight.changes) {
    for (auto& [field, value] : changes) {
      if (std::string{fields[field].name} == "obstacle_density" && to_seconds(at) > 5.0) {
        value = 0.5;
      }
    }
  }
  const auto result = replay(flight);
  ASSERT_TRUE(result.ok());
  EXPECT_GT(result->different, 0U);
  EXPECT_NEAR(5.25, to_seconds(result->differences.front().at), 0.01);
}

TEST(Replay, asks_another_policy_what_it_would_have_done) {
  const ScratchFolder folder;
  const RecordedFlight flight = flown_with("fixed_coarse", folder);
  const auto same = shadow(flight, "fixed_coarse");
  ASSERT_TRUE(same.ok());
  EXPECT_EQ(0U, same->different);
  const auto other = shadow(flight, "fixed_fine");
  ASSERT_TRUE(other.ok());
  EXPECT_EQ(other->decisions, other->different);
  ASSERT_EQ(1U, other->differences.size());
  EXPECT_EQ("map.resolution_m 0.8", other->differences[0].recorded);
  EXPECT_EQ("map.resolution_m 0.15", other->differences[0].now);
  EXPECT_FALSE(shadow(flight, "just_in_tme").ok());
}

TEST(Replay, says_that_the_other_policy_failed) {
  const ScratchFolder folder;
  const RecordedFlight flight = flown_with("fixed_fine", folder);
  const auto failing =
      shadow(flight, folder.file("failing.lua", "function decide(seen)\n  error('enough')\nend\n"));
  ASSERT_TRUE(failing.ok()) << failing.error().message;
  EXPECT_EQ(failing->faults, failing->decisions);
  EXPECT_NE(failing->trouble.find("enough"), std::string::npos) << failing->trouble;
  const auto sound = shadow(flight, "two_level");
  ASSERT_TRUE(sound.ok());
  EXPECT_EQ(sound->faults, 0U);
  EXPECT_EQ(sound->trouble, "");
}

/// The first look in cruise above 1 m/s, where latency counts.
MissionTime first_cruise(const RecordedFlight& flight) {
  const auto& fields = observation_fields();
  for (const auto& [at, changes] : flight.changes) {
    bool cruises = false;
    bool moves = false;
    for (const auto& [field, value] : changes) {
      const std::string name = fields[field].name;
      cruises = cruises || (name == "phase" && value == 1.0);
      moves = moves || (name == "speed_m_s" && value > 1.0);
    }
    if (cruises && moves) {
      return at;
    }
  }
  ADD_FAILURE() << "it never cruises";
  return {};
}

TEST(Replay, explains_one_decision) {
  const ScratchFolder folder;
  const RecordedFlight flight = flown_with("mission_energy", folder);
  const MissionTime at = first_cruise(flight);
  const auto told = explain(flight, at + std::chrono::milliseconds{100});
  ASSERT_TRUE(told.ok()) << told.error().message;
  EXPECT_EQ(at, told->at) << "the last one before";
  EXPECT_EQ(at, told->seen.now);
  EXPECT_NE(std::string::npos, told->choice.find("map.resolution_m="));
  ASSERT_FALSE(told->options.empty());
  for (std::size_t i = 1; i < told->options.size(); ++i) {
    EXPECT_LE(told->options[i - 1].joules_per_m, told->options[i].joules_per_m);
  }
  const double power_w = told->seen.rotor_power.value() + told->seen.computer_power.value();
  const double slowest_s = told->response_s + told->seen.speed_m_s / 6.0;  // a = 6 m/s^2
  EXPECT_NEAR(power_w / slowest_s, told->watts_per_second, 1e-9);
  EXPECT_FALSE(explain(flight, MissionTime{from_seconds(1e5)}).ok());
}

TEST(Replay, explains_the_last_decision_until_then_where_decisions_were_dropped) {
  const ScratchFolder folder;
  RecordedFlight flight = flown_with("fixed_coarse", folder);
  ASSERT_EQ(flight.period, std::chrono::milliseconds{250});
  ASSERT_GT(to_seconds(flight.end), 4.0);
  const auto after = [](double s) { return MissionTime{from_seconds(s)}; };
  flight.after_drops = {{5, after(3.0)}};
  flight.decisions = 6;
  for (const auto& [asked_s, made_s] :
       {std::pair{0.0, 0.0}, {0.3, 0.25}, {2.9, 1.0}, {3.0, 3.0}, {4.0, 3.0}}) {
    const auto told = explain(flight, after(asked_s));
    ASSERT_TRUE(told.ok()) << told.error().message;
    EXPECT_EQ(told->at, after(made_s)) << asked_s;
  }
  EXPECT_FALSE(explain(flight, flight.end + Duration{1}).ok());
}

TEST(Replay, loads_the_library_of_a_record_only_when_it_is_trusted) {
  const ScratchFolder folder;
  RecordedFlight flight = flown_with("fixed_coarse", folder);
  const std::string library = folder.file("theirs.so", "nothing that could be loaded");
  const std::string preset = folder.file("theirs.toml", "policy = 'theirs.so'\n");
  for (const std::string& policy : {library, preset}) {
    flight.scenario.governor.policy = policy;
    flight.may_load_library = false;
    const std::string refusal =
        "the record's policy is code from library \"" + library +
        "\", which was not loaded; add --trust if you trust whoever made it";
    EXPECT_EQ(refusal, replay(flight).error().message);
    EXPECT_EQ(refusal, explain(flight, MissionTime{}).error().message);
    EXPECT_TRUE(shadow(flight, "two_level").ok()) << "which does not ask the recorded one";
    flight.may_load_library = true;
    for (const std::string& tried :
         {replay(flight).error().message, explain(flight, MissionTime{}).error().message}) {
      EXPECT_NE(std::string::npos, tried.find("theirs.so: cannot be loaded")) << tried;
    }
  }
}

TEST(Replay, says_what_a_folder_lacks) {
  const ScratchFolder folder;
  EXPECT_EQ(ErrorCode::not_found, read_flight(folder.path()).error().code);
  static_cast<void>(folder.file("trace.jsonl", "{\"t_s\":0,\"channel\":\"state\"}\nnonsense\n"));
  const auto broken = read_flight(folder.path());
  ASSERT_FALSE(broken.ok());
  EXPECT_NE(std::string::npos, broken.error().message.find("trace.jsonl:2:"));
  static_cast<void>(folder.file("trace.jsonl", "{\"t_s\":0,\"channel\":\"state\"}\n"));
  EXPECT_NE(std::string::npos, read_flight(folder.path()).error().message.find("no decisions"));
}

/// Writes a file of a record anew, with one text in place of another, and reads the record.
Result<RecordedFlight> read_with(const ScratchFolder& folder,
                                 const std::string& file,
                                 const std::string& text,
                                 const std::string& instead) {
  const std::string whole = folder.content(file);
  std::string damaged = whole;
  EXPECT_NE(std::string::npos, damaged.find(text)) << file << " has no " << text;
  damaged.replace(damaged.find(text), text.size(), instead);
  static_cast<void>(folder.file(file, damaged));
  auto read = read_flight(folder.path());
  static_cast<void>(folder.file(file, whole));
  return read;
}

TEST(Replay, says_from_where_a_file_of_the_record_is_seen) {
  const ScratchFolder folder;
  (void)flown_with("fixed_coarse", folder);
  for (const auto& [before, after, key] :
       {std::tuple{"policy = \"fixed_coarse\"", "policy = \"./mine.lua\"", "governor.policy"},
        std::tuple{"name = \"jetson_tx2\"", "name = \"boards/mine.toml\"", "platform.name"}}) {
    const auto moved = read_with(folder, "mission.toml", before, after);
    ASSERT_FALSE(moved.ok());
    const std::string named{after};
    EXPECT_EQ(moved.error().message,
              folder.path() + "mission.toml: " + key + named.substr(named.find(" = ")) +
                  ", and there is no such file from here; go to the folder from which the mission "
                  "was flown");
  }
  EXPECT_EQ(read_with(folder, "mission.toml", "\"fixed_coarse\"", "\"nosuch\"")
                .error()
                .message.rfind("no policy \"nosuch\"", 0),
            0U);
}

TEST(Replay, refuses_more_or_fewer_decisions_than_a_flight_can_have) {
  const ScratchFolder folder;
  const RecordedFlight flight = flown_with("fixed_coarse", folder);
  const std::string right = "\"decisions\": " + std::to_string(flight.decisions);
  for (const char* wrong : {"-5", "18446744073709551615", "100000000000", "1e300"}) {
    const auto read =
        read_with(folder, "summary.json", right, std::string{"\"decisions\": "} + wrong);
    ASSERT_FALSE(read.ok()) << wrong;
    EXPECT_EQ(ErrorCode::invalid_input, read.error().code);
    EXPECT_NE(std::string::npos, read.error().message.find("summary.json: ")) << wrong;
    EXPECT_NE(std::string::npos, read.error().message.find("decisions = ")) << read.error().message;
  }
  EXPECT_TRUE(read_with(folder, "summary.json", right, right).ok());
}

TEST(Replay, refuses_choices_and_times_that_are_none) {
  const ScratchFolder folder;
  static_cast<void>(flown_with("fixed_coarse", folder));
  const std::string choice = "\"channel\":\"choice\",\"what\":\"";
  const std::string resolution = "map.resolution_m=0.80000000000000004";
  const std::pair<std::string, std::string> damages[] = {
      {resolution, "map.resolution_m=abc"},
      {resolution, "map.resolution_m="},
      {resolution, "map.resolution_m=1e999"},
      {resolution, "map.resolution_m"},
      {choice + "fixed: " + resolution, choice},
      {choice + "fixed: " + resolution, choice + "fixed: "},
      {choice + "fixed: " + resolution, choice + "fixed:" + resolution},
      {"\"period_s\":0.25", "\"period_s\":1e300"},
      {"\"period_s\":0.25", "\"period_s\":-1"},
      {"\"period_s\":0.25", "\"period_s\":1e-9"},
      {"\"period_s\":0.25", "\"period_s\":null"},
      {"{\"t_s\":0.25,", "{\"t_s\":-1e300,"},
      {"{\"t_s\":0.25,", "{\"t_s\":1e300,"},
      {"{\"t_s\":0.25,", "{\"t_s\":100000,"},
      {"{\"t_s\":0.25,", "{\"t_s\":\"now\","}};
  for (const auto& [right, wrong] : damages) {
    const auto read = read_with(folder, "trace.jsonl", right, wrong);
    ASSERT_FALSE(read.ok()) << wrong;
    EXPECT_EQ(ErrorCode::invalid_input, read.error().code);
    EXPECT_NE(std::string::npos, read.error().message.find("trace.jsonl:")) << wrong;
    EXPECT_NE(std::string::npos, read.error().message.find("; fly the mission again")) << wrong;
  }
}

TEST(Replay, takes_a_choice_without_words_for_one_that_turns_no_knob) {
  const ScratchFolder folder;
  RecordedFlight flight = flown_with("fixed_coarse", folder);
  for (const char* what : {"", "map.resolution_m", "fixed: map.resolution_m=abc", "; "}) {
    flight.choices.begin()->second = what;
    const auto other = shadow(flight, "fixed_coarse");
    ASSERT_TRUE(other.ok()) << what;
    EXPECT_EQ(other->decisions, other->different) << what;
  }
}

}  // namespace
}  // namespace flyball
