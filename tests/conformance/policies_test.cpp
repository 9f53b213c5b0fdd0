// SPDX-License-Identifier: BSD-3-Clause
//
// Holds every registered policy, and every shipped preset, to the contract in policy.h without
// naming any of them.

#include "flyball/policies/policies.h"

#include "flyball/governors/combined_policy.h"
#include "flyball/governors/policy_conformance.h"
#include "flyball/governors/preset.h"
#include "flyball/runtime/registry.h"

#include "built_data.h"
#include "counting_new.h"
#include <algorithm>
#include <filesystem>
#include <iterator>

#include <gtest/gtest.h>

namespace {

const flyball::Registry& policies() {
  static const flyball::Registry registry = [] {
    flyball::Registry filled;
    flyball::register_policies(filled);
    return filled;
  }();
  return registry;
}

std::string breaches_by(const std::string& name, flyball::PolicyCandidate candidate) {
  flyball::PolicyConformance conformance{std::move(candidate)};
  std::string text;
  for (const std::string& breach : conformance.breaches()) {
    text += name + " " + breach + "\n";
  }
  return text;
}

std::string breaches_of(const std::string& name,
                        const std::map<std::string, flyball::ParameterValue>& parameters) {
  return breaches_by(name, {[&name] { return policies().make<flyball::Policy>(name); }, parameters,
                            flyball::allocation_count});
}

/// A shipped preset's policy, started with the conformance knobs; null when it does not.
std::unique_ptr<flyball::Policy> started_half(const std::string& name) {
  const auto preset =
      flyball::load_preset(flyball::kit::built_data() + "/presets/" + name + ".toml");
  auto policy = policies().make<flyball::Policy>(preset ? preset->policy : name);
  if (policy == nullptr) {
    return nullptr;
  }
  const auto given = flyball::Parameters::resolve(
      name, policy->parameters(),
      preset ? preset->parameters : std::map<std::string, flyball::ParameterValue>{});
  const auto* parameters = std::get_if<flyball::Parameters>(&given);
  const bool starts =
      parameters != nullptr &&
      policy->start(*parameters, flyball::conformance_knobs(), flyball::conformance_board()).ok();
  return starts ? std::move(policy) : nullptr;
}

std::string breaches_of(const flyball::Preset& both) {
  const auto make = [&both]() -> std::unique_ptr<flyball::Policy> {
    auto application = started_half(both.application);
    auto clock = started_half(both.clock);
    if (application == nullptr || clock == nullptr) {
      return nullptr;
    }
    return std::make_unique<flyball::CombinedPolicy>(std::move(application), std::move(clock),
                                                     std::chrono::milliseconds{250},
                                                     flyball::conformance_knobs());
  };
  return breaches_by(both.application + " with " + both.clock,
                     {make, {}, flyball::allocation_count});
}

/// What needs a package is left out of a build without it, and its presets fly nowhere.
bool is_left_out(const flyball::Preset& preset) {
  return preset.policy == "roborun" && policies().make<flyball::Policy>("roborun") == nullptr;
}

TEST(Policies, keep_their_contract_with_default_parameters) {
  const auto names = policies().names<flyball::Policy>();
  ASSERT_FALSE(names.empty());
  for (const std::string& name : names) {
    EXPECT_EQ("", breaches_of(name, {}));
  }
}

TEST(Policies, keep_their_contract_with_every_shipped_preset) {
  std::size_t count = 0;
  for (const auto& file :
       std::filesystem::directory_iterator{flyball::kit::built_data() + "/presets"}) {
    const auto preset = flyball::load_preset(file.path().string());
    ASSERT_TRUE(preset.ok()) << preset.error().message;
    EXPECT_FALSE(preset->description.empty()) << file.path();
    if (is_left_out(*preset)) {
      continue;
    }
    EXPECT_EQ("", preset->is_combination() ? breaches_of(*preset)
                                           : breaches_of(preset->policy, preset->parameters))
        << file.path();
    ++count;
  }
  EXPECT_GE(count, 3U);
}

TEST(Policies, start_or_say_why_not_when_a_mission_has_no_knobs) {
  for (const std::string& name : policies().names<flyball::Policy>()) {
    const auto policy = policies().make<flyball::Policy>(name);
    auto specs = policy->parameters();
    for (auto& spec : specs) {
      spec.required = false;
    }
    const auto given = flyball::Parameters::resolve(name, specs, {});
    const auto status = policy->start(std::get<flyball::Parameters>(given), {}, {});
    EXPECT_TRUE(status.ok() || !status.error().message.empty()) << name;
  }
}

/// Why a policy does not start with these knobs; empty: it starts.
std::string refusal(const std::string& name, const flyball::KnobSettings& knobs) {
  const auto policy = policies().make<flyball::Policy>(name);
  auto specs = policy->parameters();
  for (auto& spec : specs) {
    spec.required = false;
  }
  const auto given = flyball::Parameters::resolve(name, specs, {});
  const auto status =
      policy->start(std::get<flyball::Parameters>(given), knobs, flyball::conformance_board());
  return status.ok() ? "" : status.error().message;
}

TEST(Policies, that_need_the_computers_power_say_what_to_pass) {
  int refused = 0;
  for (const std::string& name : policies().names<flyball::Policy>()) {
    const auto policy = policies().make<flyball::Policy>(name);
    const auto given = flyball::Parameters::resolve(
        name, policy->parameters(), flyball::with_examples(policy->parameters(), {}));
    const auto status =
        policy->start(std::get<flyball::Parameters>(given), flyball::conformance_knobs(), {});
    if (!status.ok()) {
      EXPECT_NE(std::string::npos, status.error().message.find("pass a flyball::BoardModel"))
          << status.error().message;
      ++refused;
    }
  }
  EXPECT_EQ(refused, 2) << "energy_clock, mission_energy";
}

TEST(Policies, name_all_knobs_that_they_miss_at_once) {
  int named = 0;
  const auto all = flyball::conformance_knobs();
  for (const std::string& name : policies().names<flyball::Policy>()) {
    const std::string without_any = refusal(name, {});
    for (const flyball::KnobSpec& needed : all.specs()) {
      std::vector<flyball::KnobSpec> others;
      std::copy_if(all.specs().begin(), all.specs().end(), std::back_inserter(others),
                   [&](const flyball::KnobSpec& one) { return one.name != needed.name; });
      if (!refusal(name, flyball::KnobSettings{others}).empty()) {
        EXPECT_NE(std::string::npos, without_any.find(needed.name)) << name << ": " << without_any;
        ++named;
      }
    }
  }
  EXPECT_GE(named, 12) << "nothing was compared";
}

/// Breaks the contract in the way that its parameter says.
class Culprit final : public flyball::Policy {
 public:
  explicit Culprit(std::string crime) : crime_{std::move(crime)} {}
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    if (crime_ == "parameter") {
      return {{"speed_m_s", 9.0, 0.0, 1.0, "Out of its own bounds."}};
    }
    return {};
  }
  flyball::Status start(const flyball::Parameters& /*given*/,
                        const flyball::KnobSettings& /*knobs*/,
                        const flyball::BoardModel& /*board*/) override {
    return flyball::Done{};
  }
  [[nodiscard]] flyball::Decision decide(const flyball::Observation& /*seen*/) noexcept override {
    flyball::Decision wish;
    wish.set(crime_ == "knob" ? "map.colour" : "map.resolution_m",
             crime_ == "nan" ? std::nan("") : 0.15);
    for (int i = 0; crime_ == "overflow" && i < 30; ++i) {
      wish.set("map.range_m", 7.0);
    }
    if (crime_ == "random") {
      wish.set("map.range_m", static_cast<double>(++decisions));
    }
    if (crime_ == "allocate") {
      delete new double{1.0};  // NOLINT(cppcoreguidelines-owning-memory): the crime
      memory_ = std::vector<double>(3, 1.0);
    }
    return wish;
  }

 private:
  inline static int decisions = 0;
  std::string crime_;
  std::vector<double> memory_;
};

TEST(PolicyConformance, finds_each_kind_of_breach) {
  const std::map<std::string, std::string> findings{
      {"knob", "names no knob: \"map.colour\""},
      {"nan", "wishes a number that is not finite for map.resolution_m"},
      {"overflow", "wishes more than a decision holds"},
      {"random", "decides differently on equal input"},
      {"allocate", "allocates in decide()"},
      {"parameter", "the default of \"speed_m_s\" is out of its own bounds"}};
  for (const auto& [crime, finding] : findings) {
    flyball::PolicyConformance conformance{
        {[crime = crime] { return std::make_unique<Culprit>(crime); },
         {},
         flyball::allocation_count}};
    const auto breaches = conformance.breaches();
    EXPECT_TRUE(std::count(breaches.begin(), breaches.end(), finding) == 1) << crime;
  }
}

TEST(PolicyConformance, passes_a_policy_without_fault) {
  flyball::PolicyConformance conformance{
      {[] { return std::make_unique<Culprit>("none"); }, {}, flyball::allocation_count}};
  EXPECT_TRUE(conformance.breaches().empty());
}

}  // namespace
