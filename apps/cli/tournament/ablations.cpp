// SPDX-License-Identifier: BSD-3-Clause

#include "cli/tournament/ablations.h"

#include "flyball/governors/policy.h"
#include "flyball/governors/preset.h"
#include "flyball/records/report.h"
#include "flyball/scenario/files.h"
#include "flyball/studies/tuning.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace flyball {
namespace {

constexpr const char* left_out = "without";  // The parameter.

/// The preset of this name, or the policy with its default parameters.
Result<Preset> preset_of(const std::string& name, const Plugins& plugins) {
  const auto file = find_shipped("presets", name);
  if (file) {
    return load_preset(*file);
  }
  if (!plugins.make<Policy>(name)) {
    return Error{file.error().code, "--ablate: " + file.error().message};
  }
  Preset preset;
  preset.policy = name;
  return preset;
}

}  // namespace

std::string Ablations::file_of(const AblatedPolicy& variant) const {
  return folder + "/" + variant.policy + ".toml";
}

Result<Ablations> find_ablations(const std::string& name,
                                 const Plugins& plugins,
                                 const std::string& folder) {
  auto preset = preset_of(name, plugins);
  if (!preset) {
    return preset.error();
  }
  const auto policy = plugins.make<Policy>(preset->policy);
  const auto specs = policy ? policy->parameters() : std::vector<ParameterSpec>{};
  const auto spec = std::find_if(specs.begin(), specs.end(),
                                 [](const ParameterSpec& one) { return one.name == left_out; });
  if (spec == specs.end()) {
    return Error{ErrorCode::invalid_input,
                 "--ablate " + name + " has no parameter \"without\" that names its parts; give " +
                     "mission_energy, or a preset of it"};
  }
  const std::string stem = std::filesystem::path{name}.stem().string();
  Ablations found{name, preset->policy, std::move(preset->parameters), {}, folder};
  for (const std::string& part : spec->choices) {
    if (part != std::get<std::string>(spec->fallback)) {
      found.variants.push_back({part, stem + "_without_" + part});
    }
  }
  return found;
}

Status write_presets(const Ablations& ablations) {
  const auto prepared = prepare_folder(ablations.folder);
  if (!prepared) {
    return prepared.error();
  }
  for (const AblatedPolicy& variant : ablations.variants) {
    auto parameters = ablations.parameters;
    parameters[left_out] = variant.part;
    const std::string description = ablations.whole + " without " + variant.part;
    if (Status written = write_file(ablations.file_of(variant),
                                    preset_text(ablations.policy, description, parameters));
        !written) {
      return written;
    }
  }
  return Done{};
}

}  // namespace flyball
