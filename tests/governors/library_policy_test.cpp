// SPDX-License-Identifier: BSD-3-Clause
#include "libraries/library_policy.h"

#include "flyball/governors/plugin_policy.h"

#include "policy_start.h"
#include "scratch_folder.h"
#include <stdexcept>

#include <gtest/gtest.h>

namespace flyball {
namespace {

std::string test_library(const std::string& name) {
  return std::string{FLYBALL_TEST_PLUGINS} + "/" + name + ".so";
}

std::unique_ptr<Policy> opened(const std::string& name, std::uint64_t seed = 1) {
  auto policy = LibraryPolicy::open(test_library(name), seed);
  EXPECT_TRUE(policy.ok()) << policy.error().message;
  return policy ? std::move(*policy) : nullptr;
}

Observation at_speed(double speed_m_s) {
  Observation seen;
  seen.now = MissionTime{std::chrono::seconds{3}};
  seen.speed_m_s = speed_m_s;
  return seen;
}

TEST(LibraryPolicy, declares_decides_and_gives_its_reason) {
  const auto policy = opened("culprit");
  ASSERT_EQ(1U, policy->parameters().size());
  EXPECT_EQ("crime", policy->parameters()[0].name);
  ASSERT_TRUE(kit::start(*policy).ok());
  const Decision wished = policy->decide(at_speed(1.0));
  EXPECT_EQ(0.15, kit::wish_for(wished, "map.resolution_m"));
  EXPECT_EQ(Reason::load, wished.reason);
  EXPECT_EQ("", kit::trouble(*policy));
}

TEST(LibraryPolicy, is_told_what_the_computer_draws_and_where_it_gets_too_hot) {
  const auto policy = opened("culprit");
  BoardModel board = conformance_board();
  const double top_w = board.power->power(board.frequencies.back(), 1.0).value();
  ASSERT_TRUE(kit::start(*policy, {{"crime", 11.0}}, conformance_knobs(), board).ok());
  Decision wished = policy->decide(at_speed(1.0));
  EXPECT_DOUBLE_EQ(top_w, kit::wish_for(wished, "map.resolution_m").value_or(0.0));
  EXPECT_EQ(board.thermal->trips.front().at_c, kit::wish_for(wished, "map.range_m"));
  ASSERT_TRUE(kit::start(*policy, {{"crime", 11.0}}, conformance_knobs(), {}).ok());
  wished = policy->decide(at_speed(1.0));
  EXPECT_EQ(0.0, kit::wish_for(wished, "map.resolution_m")) << "nothing is known";
  EXPECT_EQ(0.0, kit::wish_for(wished, "map.range_m"));
}

TEST(LibraryPolicy, is_told_the_cells_and_the_range_of_the_newest_map) {
  const auto policy = opened("culprit");
  ASSERT_TRUE(kit::start(*policy, {{"crime", 12.0}}).ok());
  Observation seen = at_speed(1.0);
  seen.map_resolution_m = 0.3;
  seen.map_range_m = 7.0;
  const Decision wished = policy->decide(seen);
  EXPECT_EQ(0.3, kit::wish_for(wished, "map.resolution_m"));
  EXPECT_EQ(7.0, kit::wish_for(wished, "map.range_m"));
}

TEST(LibraryPolicy, says_why_it_does_not_start) {
  const auto policy = opened("culprit");
  const Status refused = kit::start(*policy, {{"crime", 8.0}});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(test_library("culprit") + ": not today", refused.error().message);
}

TEST(LibraryPolicy, that_returns_an_error_is_in_trouble_with_its_own_words) {
  const auto policy = opened("culprit");
  ASSERT_TRUE(kit::start(*policy, {{"crime", 7.0}}).ok());
  EXPECT_EQ(0U, policy->decide(at_speed(1.0)).size());
  EXPECT_EQ(test_library("culprit") + ": I cannot", kit::trouble(*policy));
}

TEST(LibraryPolicy, draws_from_the_hosts_stream_and_knows_the_hosts_time) {
  const auto one = opened("culprit", 5);
  const auto other = opened("culprit", 5);
  const auto third = opened("culprit", 6);
  for (const auto* policy : {&one, &other, &third}) {
    ASSERT_TRUE(kit::start(**policy, {{"crime", 9.0}}).ok());
  }
  const double drawn = *kit::wish_for(one->decide(at_speed(1.0)), "map.resolution_m");
  EXPECT_EQ(drawn, kit::wish_for(other->decide(at_speed(1.0)), "map.resolution_m"));
  EXPECT_NE(drawn, kit::wish_for(third->decide(at_speed(1.0)), "map.resolution_m"));
  EXPECT_NE(drawn, kit::wish_for(one->decide(at_speed(1.0)), "map.resolution_m"));
  EXPECT_EQ("in time", kit::remark(*one));
}

TEST(LibraryPolicy, a_wish_for_no_place_in_the_list_names_no_knob) {
  const auto policy = opened("culprit");
  ASSERT_TRUE(kit::start(*policy, {{"crime", 5.0}}).ok());
  const Decision wished = policy->decide(at_speed(1.0));
  ASSERT_EQ(1U, wished.size());
  EXPECT_EQ(nullptr, conformance_knobs().spec(wished.begin()->knob));
}

TEST(LibraryPolicy, too_many_wishes_overflow) {
  const auto policy = opened("culprit");
  ASSERT_TRUE(kit::start(*policy, {{"crime", 6.0}}).ok());
  EXPECT_TRUE(policy->decide(at_speed(1.0)).overflowed());
}

TEST(LibraryPolicy, built_against_the_first_header_still_works) {
  const auto policy = opened("culprit_older");
  ASSERT_TRUE(kit::start(*policy).ok());
  EXPECT_EQ(std::nullopt, kit::period(*policy));
  EXPECT_EQ(0.15, kit::wish_for(policy->decide(at_speed(1.0)), "map.resolution_m"));
}

TEST(LibraryPolicy, built_against_less_than_that_is_refused_in_one_sentence) {
  const auto refused = LibraryPolicy::open(test_library("culprit_too_old"), 1);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(std::string::npos,
            refused.error().message.find("its FlyballPolicy has 56 bytes, the "
                                         "oldest that this program knows has 64"))
      << refused.error().message;
}

TEST(LibraryPolicy, an_exception_through_the_c_function_is_caught) {
  const auto policy = opened("thrower");
  ASSERT_TRUE(kit::start(*policy).ok());
  EXPECT_EQ(0U, policy->decide(at_speed(4.0)).size());
  EXPECT_EQ(test_library("thrower") + ": threw: too fast for me", kit::trouble(*policy));
  static_cast<void>(policy->decide(at_speed(2.5)));
  EXPECT_EQ(test_library("thrower") + ": threw an exception of no known type",
            kit::trouble(*policy));
  static_cast<void>(policy->decide(at_speed(1.0)));
  EXPECT_EQ("", kit::trouble(*policy)) << "of the last decision only";
}

class ThrowsItsPeriod final : public PluginPolicy {
 public:
  static PluginDescription description() { return {"throws", "Throws when asked how often", {}}; }
  ThrowsItsPeriod(const PluginHost& /*host*/, const PluginStart& /*start*/) {}
  void decide(const FlyballObservation& /*seen*/, PluginWishes& /*wishes*/) override {}
  [[nodiscard]] double period_s() const override { throw std::runtime_error{"who knows"}; }
};

TEST(PluginEntry, lets_no_exception_out_that_the_period_throws) {
  std::string logged;
  FlyballHost host{};
  host.struct_size = sizeof host;
  host.context = &logged;
  host.log = [](void* to, const char* text) { *static_cast<std::string*>(to) = text; };
  FlyballStart start{};
  start.struct_size = sizeof start;
  const FlyballPolicy& policy = *PluginEntry<ThrowsItsPeriod>::policy();
  void* const made = policy.create(&host, &start);
  ASSERT_NE(made, nullptr);
  EXPECT_EQ(policy.period_s(made), 0.0);
  EXPECT_EQ(logged, "period_s threw an exception; the scenario's period is taken");
  policy.destroy(made);
}

TEST(LibraryPolicy, what_is_no_library_is_named) {
  const ScratchFolder scratch;
  const auto no_file = LibraryPolicy::open(scratch.path("missing.so"), 1);
  ASSERT_FALSE(no_file.ok());
  EXPECT_EQ(ErrorCode::not_found, no_file.error().code);
  const auto text = LibraryPolicy::open(scratch.file("text.so", "not ELF"), 1);
  ASSERT_FALSE(text.ok());
  EXPECT_NE(std::string::npos, text.error().message.find("text.so: cannot be loaded"));
}

}  // namespace
}  // namespace flyball
