// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/scenario/plugins.h"

#include "flyball/flight/workload.h"
#include "flyball/kernels/kernels.h"
#include "flyball/policies/policies.h"
#include "flyball/sim/worlds.h"

#include "scenario/kernel_library.h"
#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

namespace flyball {
namespace {

namespace fs = std::filesystem;

Registry compiled_in() {
  Registry all;
  register_kernels(all);
  register_policies(all);
  register_worlds(all);
  register_workloads(all);
  return all;
}

/// Made once and constant: every scenario begins with them. Owners: this and all `Plugins`.
const std::shared_ptr<const Registry>& shipped_registry() {
  static const auto all = std::make_shared<const Registry>(compiled_in());
  return all;
}

}  // namespace

Plugins::Plugins() : registry_{shipped_registry()} {}

Plugins::Plugins(Registry&& registry, std::vector<std::string> libraries)
    : registry_{std::make_shared<const Registry>(std::move(registry))},
      libraries_{std::move(libraries)} {}

Plugins Plugins::with(const std::function<void(Registry&)>& add) const {
  Registry all = *registry_;
  add(all);
  return Plugins{std::move(all), libraries_};
}

Result<Plugins> Plugins::with_library(const std::string& path) const {
  const auto is_same = [&path](const std::string& other) {
    std::error_code failed;
    return fs::equivalent(path, other, failed);
  };
  if (std::any_of(libraries_.begin(), libraries_.end(), is_same)) {
    return *this;
  }
  auto brought = load_kernel_library(path);
  if (!brought) {
    return brought.error();
  }
  Registry all = *registry_;
  if (const Status merged = all.merge(std::move(*brought)); !merged) {
    return broken_library(path, "cannot be added: " + merged.error().message);
  }
  std::error_code failed;
  std::vector<std::string> libraries = libraries_;
  libraries.push_back(fs::absolute(path, failed).string());
  return Plugins{std::move(all), std::move(libraries)};
}

}  // namespace flyball
