// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/scenario/overruled_settings.h"

#include "flyball/governors/preset.h"
#include "flyball/scenario/files.h"
#include "flyball/scenario/knobs.h"
#include "flyball/scenario/policy_choice.h"
#include "flyball/scenario/shipped_platform.h"

#include <algorithm>
#include <filesystem>
#include <map>

namespace flyball {
namespace {

/// The knob that begins with a setting's value: most have the setting's name.
std::string knob_of(const std::string& key) {
  return key == "platform.cores"          ? "cpu.cores"
         : key == "platform.frequency_hz" ? "cpu.frequency_hz"
                                          : key;
}

/// Whether it is a preset whose knobs stand still.
bool is_fixed(const std::string& policy) {
  const auto file = find_shipped("presets", policy);
  if (!file || std::filesystem::path{*file}.extension() != ".toml") {
    return false;
  }
  const auto preset = load_preset(*file);
  return preset && preset->policy == "fixed";
}

/// Where the policy keeps each knob that it sets; none, where it cannot be started, which is told
/// elsewhere.
std::map<std::string, double> kept_by(const std::string& policy,
                                      const Scenario& scenario,
                                      const KnobSettings& knobs) {
  const auto platform = find_platform(scenario.platform.name);
  const auto choice = choose_policy(policy, scenario.plugins, scenario.seed);
  std::map<std::string, double> kept;
  if (!platform || !choice) {
    return kept;
  }
  const auto started = choice->started(knobs, board_model_of(*platform));
  for (const auto& wish : started ? (*started)->decide({}) : Decision{}) {
    if (const KnobSpec* const spec = knobs.spec(wish.knob)) {
      kept[spec->name] = spec->nearest(wish.value);
    }
  }
  return kept;
}

/// The last one given counts; null: none sets the knob.
const Override* find_setting(const std::string& knob, const std::vector<Override>& given) {
  const auto sets = [&knob](const Override& one) {
    return knob_of(key_of(one.key_and_value)) == knob;
  };
  const auto found = std::find_if(given.rbegin(), given.rend(), sets);
  return found == given.rend() ? nullptr : &*found;
}

}  // namespace

std::vector<std::string> overruled_settings(const Scenario& scenario,
                                            const std::vector<Override>& given) {
  std::vector<std::string> sentences;
  for (const std::string& policy : asked_policies(scenario.governor.policy)) {
    auto specs = is_fixed(policy) ? standard_knobs(scenario) : std::vector<KnobSpec>{};
    if (!specs) {
      continue;
    }
    const KnobSettings knobs{std::move(*specs)};
    for (const auto& [knob, value] : kept_by(policy, scenario, knobs)) {
      const Override* const setting = find_setting(knob, given);
      if (setting != nullptr && knobs.spec(knob)->fallback != value) {
        const std::string key = key_of(setting->key_and_value);
        sentences.push_back("policy " + policy + " sets " + key + " itself, so " + setting->option +
                            " " + key + " changes nothing; policy fixed leaves it to the scenario");
      }
    }
  }
  return sentences;
}

}  // namespace flyball
