// SPDX-License-Identifier: BSD-3-Clause

#include "experiments/framework/all_experiments.h"

#include "flyball/scenario/scenario.h"

#include "experiments/framework/papers.h"
#include <algorithm>
#include <set>

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// `map.range_m` of `map.range_m=5`.
std::string key_of(const std::string& setting) {
  return setting.substr(0, setting.find('='));
}

TEST(AllExperiments, have_names_titles_and_methods) {
  const auto all = all_experiments();
  ASSERT_FALSE(all.empty());
  for (const auto& [name, experiment] : all) {
    EXPECT_FALSE(experiment.title.empty()) << name;
    EXPECT_EQ(experiment.title.back(), '?') << name;
    EXPECT_FALSE(experiment.method.empty()) << name;
    EXPECT_TRUE(experiment.evaluate) << name;
  }
  EXPECT_TRUE(std::is_sorted(all.begin(), all.end(),
                             [](const auto& a, const auto& b) { return a.name < b.name; }));
}

TEST(AllExperiments, name_their_sweeps_once_and_set_nothing_twice) {
  for (const auto& [name, experiment] : all_experiments()) {
    std::set<std::string> sweeps;
    for (const ExperimentSweep& sweep : experiment.sweeps) {
      EXPECT_TRUE(sweeps.insert(sweep.name).second) << name << "/" << sweep.name;
      std::multiset<std::string> keys;
      for (const std::string& setting : sweep.settings) {
        keys.insert(key_of(setting));
      }
      for (const SweepAxis& axis : sweep.axes) {
        keys.insert(axis.key);
        EXPECT_FALSE(axis.values.empty()) << name << "/" << sweep.name;
      }
      EXPECT_EQ(keys.size(), std::set<std::string>(keys.begin(), keys.end()).size())
          << name << "/" << sweep.name;
    }
  }
}

TEST(AllExperiments, fly_only_what_can_be_flown) {
  for (const auto& [name, experiment] : all_experiments()) {
    for (const ExperimentSweep& sweep : experiment.sweeps) {
      const auto policies = sweep.policies.empty() ? std::vector<std::string>{""} : sweep.policies;
      for (const SweepPoint& point : points_of(sweep.axes, policies)) {
        std::vector<std::string> settings = sweep.settings;
        for (std::size_t i = 0; i < sweep.axes.size(); ++i) {
          settings.push_back(sweep.axes[i].key + "=" + point.values[i]);
        }
        if (!point.policy.empty()) {
          settings.push_back("governor.policy=" + point.policy);
        }
        const auto loaded = load_scenario(sweep.scenario, settings);
        const auto* errors = std::get_if<std::vector<Error>>(&loaded);
        EXPECT_EQ(errors, nullptr) << name << "/" << sweep.name << ": " << errors->front().message;
      }
    }
  }
}

TEST(AllExperiments, have_the_corners_of_the_papers_operating_points) {
  const auto at = [](const std::vector<std::string>& corner) {
    const auto loaded = load_scenario("delivery_forest", corner);
    return std::get<LoadedScenario>(loaded).scenario.platform;
  };
  EXPECT_EQ(at(fast_corner()).cores, 4);
  EXPECT_EQ(at(fast_corner()).frequency_hz, 2.0352e9);
  EXPECT_EQ(at(slow_corner()).cores, 2);
  EXPECT_EQ(at(slow_corner()).frequency_hz, 0.8064e9);
}

}  // namespace
}  // namespace flyball
