// SPDX-License-Identifier: BSD-3-Clause
// tested-in: scenario

#include "scenario/scenario_check.h"

#include "flyball/kernels/mapper.h"
#include "flyball/runtime/text/listed.h"
#include "flyball/runtime/text/number_text.h"
#include "flyball/scenario/catalogue.h"
#include "flyball/scenario/files.h"
#include "flyball/scenario/shipped_platform.h"

#include "scenario/kernel_choice.h"
#include "scenario/scenario_keys.h"
#include "scenario/scenario_parameters.h"
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace flyball {
namespace {

/// A name that was looked for among others.
struct NamedThing {
  std::string key;
  std::string thing;  ///< `mapper`
  std::string name;
  std::vector<std::string> known;
  std::string list;  ///< Argument of `flyball list`.
};

bool is_known(const NamedThing& wanted) {
  return std::find(wanted.known.begin(), wanted.known.end(), wanted.name) != wanted.known.end();
}

Error unknown(const NamedThing& wanted, const GivenValues& given) {
  return {ErrorCode::not_found,
          "no " + wanted.thing + " \"" + wanted.name + "\"" + place_of(wanted.key, given) + "; " +
              name_meant(wanted.name, wanted.known) + "try: flyball list " + wanted.list};
}

std::vector<NamedThing> plug_ins_of(const Scenario& scenario) {
  std::vector<NamedThing> things{
      {"mission.workload", "workload", scenario.mission.workload, workload_names(scenario.plugins),
       "workloads"},
      {"world.generator", "world", scenario.world.generator, world_names(scenario.plugins),
       "worlds"},
  };
  for (const FamilyChoice& family : family_choices()) {
    things.push_back({"kernels." + family.name, family.name, scenario.kernels.*family.kernel,
                      family.names(scenario.plugins), "kernels"});
  }
  return things;
}

std::vector<NamedThing> files_of(const Scenario& scenario) {
  return {
      {"vehicle.airframe", "airframe", scenario.vehicle.airframe, shipped("airframes"),
       "airframes"},
      {"platform.name", "platform", scenario.platform.name, shipped("platforms"), "platforms"},
      {"governor.policy", "policy", scenario.governor.policy, policy_names(scenario.plugins),
       "policies"},
  };
}

/// As `find_shipped` has it.
std::string kind_of(const NamedThing& wanted) {
  return wanted.list == "policies" ? "presets" : wanted.list;
}

/// For `files_of`: a path to a file is as good as a name.
Result<std::string> file_of(const NamedThing& wanted) {
  return find_shipped(kind_of(wanted), wanted.name);
}

std::optional<Error> missing_file(const NamedThing& wanted, const GivenValues& given) {
  const auto file = file_of(wanted);
  if (is_known(wanted) || file) {
    return std::nullopt;
  }
  // Where nothing is shipped at all, or a path is given, the place is what is wrong.
  const bool is_place = wanted.known.empty() || looks_like_path(kind_of(wanted), wanted.name);
  return is_place ? file.error() : unknown(wanted, given);
}

std::string clocks_of(const PlatformModel& platform) {
  return listed(platform.frequencies, [](Hertz clock) { return number_text(clock.value()); });
}

std::vector<Error> check_operating_point(const Scenario& scenario, const GivenValues& given) {
  if (!find_shipped("platforms", scenario.platform.name)) {
    return {};  // Named as unknown elsewhere.
  }
  const Result<PlatformModel> platform = find_platform(scenario.platform.name);
  if (!platform) {
    return {platform.error()};
  }
  std::vector<Error> errors;
  const auto& [name, cores, clock_hz, start_c] = scenario.platform;
  if (start_c != 0.0 && !platform->thermal) {
    errors.push_back({ErrorCode::invalid_input,
                      "platform.start_temperature_c = " + number_text(start_c) +
                          place_of("platform.start_temperature_c", given) + " needs a platform " +
                          "with a [thermal] table, and " + name +
                          " has none; try: --set platform.name=jetson_tx2_passive"});
  }
  if (cores > platform->max_cores) {
    errors.push_back({ErrorCode::invalid_input,
                      "platform.cores = " + std::to_string(cores) +
                          place_of("platform.cores", given) + " must be at most " +
                          std::to_string(platform->max_cores) + ", all that " + name + " has"});
  }
  const auto is_clock = [wanted = clock_hz](Hertz clock) {
    return std::abs(clock.value() - wanted) < 0.5;
  };
  if (std::none_of(platform->frequencies.begin(), platform->frequencies.end(), is_clock)) {
    errors.push_back({ErrorCode::invalid_input, "platform.frequency_hz = " + number_text(clock_hz) +
                                                    place_of("platform.frequency_hz", given) +
                                                    " is no clock of " + name +
                                                    "; it has: " + clocks_of(*platform)});
  }
  return errors;
}

bool is_folder_name(const std::string& name) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  return std::all_of(name.begin(), name.end(), is_plain);
}

Error refused_by_mapper(const Scenario& scenario, const Error& why) {
  return {ErrorCode::invalid_input,
          "mapper \"" + scenario.kernels.mapper + "\" refuses: " + why.message};
}

/// Whether the mapper takes scans from here. It knows best how far it reaches, and it refuses an
/// empty scan only for its pose or settings.
Status try_map(Mapper& mapper, const Scenario& scenario, const Vec3& camera_W) {
  Pose X_WC = Pose::Identity();
  X_WC.translation() = camera_W;
  const auto tried =
      mapper.prepare(PointCloud{}, X_WC, {scenario.map.resolution_m, scenario.map.range_m});
  if (!tried) {
    return refused_by_mapper(scenario, tried.error());
  }
  return Done{};
}

}  // namespace

std::vector<Error> check_map(const Scenario& scenario,
                             const GivenValues& given,
                             const std::vector<Vec3>& corners_W) {
  const FamilyChoice& family = family_choice(typeid(Mapper));
  const auto unconfigured = family.make(scenario.plugins, scenario.kernels.mapper);
  if (!unconfigured || !resolved(family.owner(scenario.kernels), unconfigured->parameters(),
                                 scenario.kernels.mapper_parameters)) {
    return {};  // Named elsewhere.
  }
  const auto mapper = make_kernel<Mapper>(scenario.plugins, scenario.kernels);
  if (!mapper) {
    return {refused_by_mapper(scenario, mapper.error())};
  }
  const std::vector<double> cells_m = (*mapper)->resolutions_m();
  const double wanted_m = scenario.map.resolution_m;
  if (!cells_m.empty() && std::find(cells_m.begin(), cells_m.end(), wanted_m) == cells_m.end()) {
    return {{ErrorCode::invalid_input,
             "map.resolution_m = " + number_text(wanted_m) + place_of("map.resolution_m", given) +
                 " must be one of " + listed(cells_m, number_text) + ", the cells of mapper \"" +
                 scenario.kernels.mapper + "\""}};
  }
  if (const Status tried = try_map(**mapper, scenario, Vec3::Zero()); !tried) {
    return {tried.error()};
  }
  for (const Vec3& corner_W : corners_W) {
    if (const Status tried = try_map(**mapper, scenario, corner_W); !tried) {
      return {{ErrorCode::invalid_input,
               "world \"" + scenario.world.generator + "\" reaches to (" +
                   number_text(corner_W.x()) + ", " + number_text(corner_W.y()) + ") m, and " +
                   tried.error().message + "; fly a shorter way, or with larger cells"}};
    }
  }
  return {};
}

std::vector<Error> check_names(const Scenario& scenario, const GivenValues& given) {
  std::vector<Error> errors;
  for (const NamedThing& thing : plug_ins_of(scenario)) {
    if (!is_known(thing)) {
      errors.push_back(unknown(thing, given));
    }
  }
  for (const FamilyChoice& family : family_choices()) {
    const std::string place = place_of("knobs." + family.name + "_kinds", given);
    if (const Status known = check_kinds(family, scenario, place); !known) {
      errors.push_back(known.error());
    }
  }
  for (const NamedThing& thing : files_of(scenario)) {
    if (auto error = missing_file(thing, given)) {
      errors.push_back(std::move(*error));
    }
  }
  for (Error& error : check_operating_point(scenario, given)) {
    errors.push_back(std::move(error));
  }
  if (!is_folder_name(scenario.name)) {
    errors.push_back(
        {ErrorCode::invalid_input,
         "name = " + scenario.name + place_of("name", given) +
             " must be of letters, digits, _ and -, because flights go to a folder of this name"});
  }
  return errors;
}

}  // namespace flyball
