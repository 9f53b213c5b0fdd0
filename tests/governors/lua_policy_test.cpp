// SPDX-License-Identifier: BSD-3-Clause
#include "scripts/lua_policy.h"

#include "policy_start.h"
#include "scratch_folder.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

#ifndef FLYBALL_HAS_LUA

TEST(LuaPolicy, without_lua_the_way_out_is_named) {
  const auto refused = open_lua_policy("mine.lua", 1);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(std::string::npos, refused.error().message.find("liblua5.4-dev"));
}

#else

class LuaPolicy : public testing::Test {
 protected:
  Result<std::unique_ptr<Policy> > open(const std::string& script) const {
    return open_lua_policy(scratch_.file("mine.lua", script), 1);
  }
  std::unique_ptr<Policy> started(const std::string& script,
                                  const kit::GivenParameters& given = {}) const {
    auto policy = open(script);
    EXPECT_TRUE(policy.ok()) << policy.error().message;
    const Status status = kit::start(**policy, given);
    EXPECT_TRUE(status.ok()) << status.error().message;
    return std::move(*policy);
  }
  /// What is wrong with the first decision of this body of `decide`.
  std::string trouble_of(const std::string& body) const {
    const auto policy = started("\nfunction decide(seen)\n" + body + "\nend");
    EXPECT_EQ(0U, policy->decide({}).size());
    const std::string all{kit::trouble(*policy)};
    const std::size_t file = all.find("mine.lua");
    return file == std::string::npos ? all : all.substr(file);
  }
  const ScratchFolder scratch_;
};

TEST_F(LuaPolicy, decides_with_wishes_in_the_order_of_the_knobs) {
  const auto policy = started(
      "function decide(seen)\n"
      "  return {['cpu.cores'] = 2, ['map.range_m'] = 9, ['map.resolution_m'] = 0.3}, 'energy'\n"
      "end");
  const Decision wished = policy->decide({});
  ASSERT_EQ(3U, wished.size()) << kit::trouble(*policy);
  EXPECT_EQ("map.resolution_m", wished.begin()[0].knob);
  EXPECT_EQ("map.range_m", wished.begin()[1].knob);
  EXPECT_EQ("cpu.cores", wished.begin()[2].knob);
  EXPECT_EQ(9.0, wished.begin()[1].value);
  EXPECT_EQ(Reason::energy, wished.reason);
}

TEST_F(LuaPolicy, sees_every_member_of_the_observation) {
  const auto policy = started(
      "function decide(seen)\n"
      "  local sum = 0\n"
      "  for name, value in pairs(seen) do if name ~= 'phase' then sum = sum + value end end\n"
      "  log(seen.phase, seen.now_s)\n"
      "  return {['map.range_m'] = sum}\n"
      "end");
  Observation seen;
  seen.phase = MissionPhase::cruise;
  seen.now = MissionTime{std::chrono::seconds{2}};
  seen.speed_m_s = 3.0;
  seen.latency = std::chrono::seconds{4};
  seen.battery_percent = 50.0;
  seen.rotor_power = Watts{200.0};
  EXPECT_EQ(2.0 + 3.0 + 4.0 + 50.0 + 200.0, kit::wish_for(policy->decide(seen), "map.range_m"));
  EXPECT_EQ("cruise 2.0", kit::remark(*policy));
}

TEST_F(LuaPolicy, declares_parameters_and_a_period_and_gets_what_a_preset_gives) {
  const std::string script =
      "period_s = 0.5\n"
      "parameters = {{name = 'fine_m', default = 0.15, min = 0.05, max = 2,\n"
      "               description = 'Fine.'}}\n"
      "function start(given, knobs)\n"
      "  fine_m = given.fine_m\n"
      "  coarsest_m = knobs['map.resolution_m'].legal[5]\n"
      "end\n"
      "function decide(seen) return {['map.resolution_m'] = fine_m + coarsest_m} end";
  const auto policy = started(script, {{"fine_m", 0.25}});
  ASSERT_EQ(1U, policy->parameters().size());
  EXPECT_EQ(0.05, policy->parameters()[0].min);
  EXPECT_EQ("Fine.", policy->parameters()[0].description);
  EXPECT_EQ(Duration{std::chrono::milliseconds{500}}, kit::period(*policy));
  EXPECT_EQ(0.25 + 1.20, kit::wish_for(policy->decide({}), "map.resolution_m"));
}

TEST_F(LuaPolicy, is_told_what_the_computer_draws_and_where_it_gets_too_hot) {
  const auto policy = open(
      "function start(given, knobs, board)\n"
      "  local top = board.clocks[#board.clocks]\n"
      "  watts = top.idle_w + top.busy_core_w\n"
      "  trip = board.thermal.trips[1]\n"
      "  log(board.cores, top.hz, board.switching_s, board.thermal.resistance_k_w)\n"
      "end\n"
      "function decide(seen)\n"
      "  return {['map.range_m'] = watts, ['map.rate_hz'] = trip.at_c - trip.hysteresis_k,\n"
      "          ['cpu.frequency_hz'] = trip.cap_hz}\n"
      "end");
  ASSERT_TRUE(policy.ok()) << policy.error().message;
  const BoardModel board = conformance_board();
  const Status started = kit::start(**policy, {}, conformance_knobs(), board);
  ASSERT_TRUE(started.ok()) << started.error().message;
  const Decision wished = (*policy)->decide({});
  EXPECT_DOUBLE_EQ(board.power->power(board.frequencies.back(), 1.0).value(),
                   kit::wish_for(wished, "map.range_m").value_or(0.0));
  EXPECT_EQ(78.0, kit::wish_for(wished, "map.rate_hz"));
  EXPECT_EQ(806.4e6, kit::wish_for(wished, "cpu.frequency_hz"));
}

TEST_F(LuaPolicy, is_told_the_price_of_cores) {
  const auto policy = open(
      "function start(given, knobs, board)\n"
      "  off, slower = board.off_core_w, board.memory_contention\n"
      "end\n"
      "function decide(seen)\n"
      "  return {['map.range_m'] = off, ['map.rate_hz'] = slower}\n"
      "end");
  ASSERT_TRUE(policy.ok()) << policy.error().message;
  BoardModel board = conformance_board();
  board.power->converter = 1.25;
  board.power->idle_core_w = 8.0;
  board.memory_contention = 20.0;
  ASSERT_TRUE(kit::start(**policy, {}, conformance_knobs(), board).ok());
  const Decision wished = (*policy)->decide({});
  EXPECT_EQ(10.0, kit::wish_for(wished, "map.range_m"));
  EXPECT_EQ(20.0, kit::wish_for(wished, "map.rate_hz"));
}

TEST_F(LuaPolicy, is_not_told_what_nobody_knows) {
  const auto policy = open(
      "function start(given, knobs, board)\n"
      "  for name in pairs(board) do error('told: ' .. name) end\n"
      "end\n"
      "function decide() return {} end");
  ASSERT_TRUE(policy.ok()) << policy.error().message;
  const Status started = kit::start(**policy, {}, conformance_knobs(), {});
  EXPECT_TRUE(started.ok()) << started.error().message;
}

TEST_F(LuaPolicy, refuses_to_start_in_its_own_words) {
  const auto policy = open("function start() error('no wind') end\nfunction decide() end");
  ASSERT_TRUE(policy.ok());
  const Status refused = kit::start(**policy);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(std::string::npos, refused.error().message.find("mine.lua:1: no wind"));
}

TEST_F(LuaPolicy, is_refused_when_it_is_no_policy) {
  const std::map<std::string, std::string> sentences{
      {"x = 1", "there is no function decide(seen)"},
      {"parameters = 3 function decide() end", "parameters must be a table, this is a number"},
      {"parameters = {{}} function decide() end", "parameters[1] has no name"},
      {"parameters = {{name='a'}, {name='a'}} function decide() end", "\"a\" twice"},
      {"period_s = -1 function decide() end", "period_s is -1; it must be a number of seconds"},
      {"function decide() end end", "mine.lua:1:"}};
  for (const auto& [script, sentence] : sentences) {
    const auto policy = open(script);
    ASSERT_FALSE(policy.ok()) << script;
    EXPECT_NE(std::string::npos, policy.error().message.find(sentence)) << policy.error().message;
  }
}

TEST_F(LuaPolicy, what_goes_wrong_in_a_decision_is_one_sentence_with_file_and_line) {
  EXPECT_EQ("mine.lua:3: attempt to perform arithmetic on a nil value (field 'altitude_m')",
            trouble_of("return {['map.range_m'] = seen.altitude_m + 1}"));
  EXPECT_EQ("mine.lua:2: decide names a knob that does not exist: \"map.colour\"",
            trouble_of("return {['map.range_m'] = 1, ['map.zoom'] = 2, ['map.colour'] = 3}"));
  EXPECT_EQ("mine.lua:2: decide gives no number for \"map.range_m\"",
            trouble_of("return {['map.range_m'] = {}}"));
  EXPECT_EQ("mine.lua:2: decide must return a table of wishes, this is a \"nil\"", trouble_of(""));
  EXPECT_EQ("mine.lua:4: its budget of instructions is used up; does this loop end?",
            trouble_of("while true do\nseen.x = 1\nend"));
}

TEST_F(LuaPolicy, that_has_failed_is_asked_again_and_may_recover) {
  const auto policy = started(
      "function decide(seen)\n"
      "  if seen.speed_m_s > 5 then error('too fast') end\n"
      "  return {['map.range_m'] = 5}\n"
      "end");
  Observation fast;
  fast.speed_m_s = 6.0;
  EXPECT_EQ(0U, policy->decide(fast).size());
  EXPECT_NE("", kit::trouble(*policy));
  EXPECT_EQ(1U, policy->decide({}).size());
  EXPECT_EQ("", kit::trouble(*policy));
}

#endif

}  // namespace
}  // namespace flyball
