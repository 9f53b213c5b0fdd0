// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/governors/policy.h"
#include "flyball/governors/preset.h"
#include "flyball/kernels/detector.h"
#include "flyball/kernels/path_planner.h"
#include "flyball/records/text_table.h"
#include "flyball/runtime/text/listed.h"
#include "flyball/runtime/text/number_text.h"
#include "flyball/scenario/catalogue.h"
#include "flyball/scenario/files.h"
#include "flyball/scenario/knobs.h"
#include "flyball/scenario/plugins.h"

#include "commands.h"
#include "console.h"
#include "experiments/framework/all_experiments.h"
#include "flight_options.h"
#include <array>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

using Lines = std::vector<std::vector<std::string>>;

/// A data file's first comment that is not its licence.
std::string first_comment(const std::string& path) {
  std::ifstream file{path};
  std::string comment;
  for (std::string line; std::getline(file, line) && line.rfind('#', 0) == 0;) {
    if (line.size() < 3 && !comment.empty()) {
      break;
    }
    if (line.size() > 2 && line.find("SPDX-") == std::string::npos) {
      comment += (comment.empty() ? "" : " ") + line.substr(2);
    }
  }
  return comment;
}

/// The first sentence of that comment says what the file is.
std::string first_sentence(const std::string& path) {
  std::string comment = first_comment(path);
  // "DAC 2021. The" ends a sentence, "eq. 1" and ".3 m" do not.
  for (std::size_t at = comment.find(". "); at != std::string::npos;
       at = comment.find(". ", at + 1)) {
    const char next = at + 2 < comment.size() ? comment[at + 2] : ' ';
    if (next == '"' || std::isupper(static_cast<unsigned char>(next)) != 0) {
      return comment.substr(0, at + 1);
    }
  }
  return comment;
}

Result<Lines> list_files(const std::string& kind) {
  Lines lines;
  std::error_code failed;
  if (const std::string folder = share_folder(kind);
      !std::filesystem::is_directory(folder, failed)) {
    return Error{ErrorCode::not_found, "no folder \"" + folder +
                                           "\" to list; set FLYBALL_DATA to the folder "
                                           "share/flyball of the install, or of the build"};
  }
  for (const std::string& name : shipped(kind)) {
    lines.push_back({name, first_sentence(share_folder(kind) + "/" + name + ".toml")});
  }
  return lines;
}

Result<Lines> list_kernels(const Plugins& plugins) {
  Lines lines;
  for (const KernelFamily& family : kernel_families(plugins)) {
    for (const std::string& name : family.kernels) {
      lines.push_back({family.name, name});
    }
  }
  return lines;
}

std::string legal_values(const ParameterSpec& spec) {
  if (std::holds_alternative<double>(spec.fallback)) {
    return short_number_text(spec.min) + " .. " + short_number_text(spec.max);
  }
  std::string choices;
  for (const std::string& choice : spec.choices) {
    choices += (choices.empty() ? "" : "|") + choice;
  }
  return choices.empty() ? "any text" : choices;
}

void add_parameters(const std::vector<ParameterSpec>& specs, Lines& lines) {
  for (const ParameterSpec& spec : specs) {
    const double* fallback = std::get_if<double>(&spec.fallback);
    lines.push_back(
        {"  " + spec.name,
         fallback != nullptr ? short_number_text(*fallback) : std::get<std::string>(spec.fallback),
         legal_values(spec), spec.description});
  }
}

Result<Lines> list_worlds(const Plugins& plugins) {
  Lines lines;
  for (const std::string& name : world_names(plugins)) {
    lines.push_back({name});
    add_parameters(plugins.make<WorldGenerator>(name)->parameters(), lines);
  }
  return lines;
}

Result<Lines> list_policies(const Plugins& plugins) {
  Lines lines;
  for (const std::string& name : policy_names(plugins)) {
    const Result<std::string> file = find_shipped("presets", name);
    if (!file) {
      lines.push_back({name, "policy with its default parameters"});
      continue;
    }
    const Result<Preset> preset = load_preset(*file);
    if (!preset) {
      return preset.error();
    }
    const std::string rule =
        preset->is_combination() ? preset->application + " with " + preset->clock : preset->policy;
    lines.push_back({name, rule + ": " + preset->description});
  }
  return lines;
}

std::string legal_values(const KnobSpec& knob) {
  if (knob.legal.empty()) {
    return short_number_text(knob.min) + " .. " + short_number_text(knob.max);
  }
  std::string values;
  for (std::size_t i = 0; i < knob.legal.size(); ++i) {
    values += (values.empty() ? "" : " ") + short_number_text(knob.legal[i]);
    values += i < knob.labels.size() ? "=" + knob.labels[i] : "";
  }
  return values;
}

/// Names with commas between them.
template <class Family>
std::string all_of_family(const Plugins& plugins) {
  std::string text;
  for (const std::string& name : plugins.names<Family>()) {
    text += (text.empty() ? "" : ",") + name;
  }
  return text;
}

/// Among them those that exist only where a scenario asks for them.
Scenario with_all_knobs(const Plugins& plugins) {
  Scenario scenario;
  scenario.plugins = plugins;
  scenario.edge.platform = scenario.platform.name;
  scenario.knobs = {all_of_family<PathPlanner>(plugins), all_of_family<Detector>(plugins), true,
                    true};
  return scenario;
}

Result<Lines> list_knobs(const Plugins& plugins) {
  Lines lines{{"KNOB", "UNIT", "OWNER", "DEFAULT", "MEANING", "VALUES"}};
  const auto knobs = standard_knobs(with_all_knobs(plugins));
  if (!knobs) {
    return knobs.error();
  }
  for (const KnobSpec& knob : *knobs) {
    lines.push_back({knob.name, knob.unit, knob.owner, short_number_text(knob.fallback),
                     knob.description, legal_values(knob)});
  }
  return lines;
}

Result<Lines> list_workloads(const Plugins& plugins) {
  Lines lines;
  for (const std::string& name : workload_names(plugins)) {
    lines.push_back({name});
  }
  return lines;
}

Result<Lines> list_experiments(const Plugins&) {
  Lines lines;
  for (const NamedExperiment& each : all_experiments()) {
    lines.push_back({each.name, each.experiment.title});
  }
  return lines;
}

struct Listing {
  const char* kind;
  Result<Lines> (*list)(const Plugins&);
};

constexpr std::array<Listing, 10> listings{{
    {"scenarios", [](const Plugins&) { return list_files("scenarios"); }},
    {"workloads", list_workloads},
    {"kernels", list_kernels},
    {"policies", list_policies},
    {"platforms", [](const Plugins&) { return list_files("platforms"); }},
    {"boards", [](const Plugins&) { return list_files("boards"); }},
    {"worlds", list_worlds},
    {"airframes", [](const Plugins&) { return list_files("airframes"); }},
    {"knobs", list_knobs},
    {"experiments", list_experiments},
}};

std::string kinds() {
  return listed(listings, [](const Listing& listing) { return std::string{listing.kind}; });
}

int list(const std::string& kind, const Plugins& plugins) {
  for (const Listing& listing : listings) {
    if (kind != listing.kind) {
      continue;
    }
    const Result<Lines> lines = listing.list(plugins);
    if (!lines) {
      return refuse({lines.error()});
    }
    print(aligned(*lines));
    return exit_success;
  }
  return refuse(
      {{ErrorCode::not_found, "nothing to list under \"" + kind + "\"; there are: " + kinds()}});
}

}  // namespace

void add_list(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("list", "prints what can be named: " + kinds());
  const auto kind = std::make_shared<std::string>();  // Owners: the parser's callbacks.
  const auto plugins = std::make_shared<Plugins>();
  command->add_option("KIND", *kind, kinds())->required();
  add_kernels(*command, *plugins);
  command->callback([kind, plugins, &exit_code] { exit_code = list(*kind, *plugins); });
}

}  // namespace flyball
