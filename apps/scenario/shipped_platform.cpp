// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/scenario/shipped_platform.h"

#include "flyball/scenario/files.h"

#include "scenario/scenario_keys.h"
#include <algorithm>
#include <vector>

namespace flyball {
namespace {

/// Prices each kernel that Flyball has.
constexpr const char* reference_name = "jetson_tx2";

std::vector<std::string> work_names(const PlatformModel& model) {
  std::vector<std::string> names;
  for (const auto& [kernel, cost] : model.kernels) {
    for (const auto& [name, price_s] : cost.seconds_per) {
      names.push_back(name);
    }
  }
  return names;
}

/// What is wrong with the prices of one kernel of Flyball's, of which `reference` has them all.
/// Kernels of plug-ins may count anything, and nobody knows what.
std::vector<std::string> slips_in(const std::string& kernel,
                                  const KernelCost& cost,
                                  const KernelCost& reference,
                                  const std::vector<std::string>& works) {
  std::vector<std::string> slips;
  for (const auto& [name, price_s] : cost.seconds_per) {
    if (std::find(works.begin(), works.end(), name) == works.end()) {
      const std::string near = nearest_name(name, works);
      slips.push_back("kernels." + kernel + ".seconds_per." + name +
                      " prices what no kernel counts" +
                      (near.empty() ? "" : "; did you mean " + near + "?"));
    }
  }
  for (const auto& [name, price_s] : reference.seconds_per) {
    if (cost.seconds_per.find(name) == cost.seconds_per.end()) {
      slips.push_back("kernels." + kernel + ".seconds_per has no price of " + name +
                      "; give it one, 0 where it costs nothing");
    }
  }
  return slips;
}

Status check_works(const PlatformModel& model, const std::string& file) {
  const auto reference_file = find_shipped("platforms", reference_name);
  const auto reference = reference_file ? load_platform(*reference_file)
                                        : Result<PlatformModel>{reference_file.error()};
  if (!reference) {
    return Done{};  // A build without shipped files has nothing to compare with.
  }
  const std::vector<std::string> works = work_names(*reference);
  std::string all;
  for (const auto& [kernel, cost] : model.kernels) {
    const auto known = reference->kernels.find(kernel);
    if (known == reference->kernels.end()) {
      continue;
    }
    for (const std::string& slip : slips_in(kernel, cost, known->second, works)) {
      all += (all.empty() ? "" : "; ") + slip;
    }
  }
  return all.empty()
             ? Status{Done{}}
             : Status{Error{ErrorCode::invalid_input, "platform file \"" + file + "\": " + all}};
}

}  // namespace

Result<PlatformModel> find_platform(const std::string& name_or_path) {
  const Result<std::string> file = find_shipped("platforms", name_or_path);
  if (!file) {
    return file.error();
  }
  Result<PlatformModel> model = load_platform(*file, share_folder("platforms"));
  if (model) {
    if (const Status works = check_works(*model, *file); !works) {
      return works.error();
    }
  }
  return model;
}

}  // namespace flyball
