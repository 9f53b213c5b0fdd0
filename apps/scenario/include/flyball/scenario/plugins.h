// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Every kernel, policy, world and workload that a scenario may name.

#include "flyball/runtime/registry.h"

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace flyball {

/// What the names in a scenario stand for. It never changes after it was made, and copies share
/// what they hold: two missions in one process, each with kernels of its own, do not see each
/// other's.
class Plugins {
 public:
  /// Those that are compiled in.
  Plugins();

  /// These, and kernels, policies, worlds and workloads of the caller's own.
  ///
  /// @param add  A `FLYBALL_PLUGIN` function, or one that calls several. A name that is taken is a
  ///             programming error, as it is in the tree.
  [[nodiscard]] Plugins with(const std::function<void(Registry&)>& add) const;

  /// These, and what somebody brings in a shared library, `libmine.so` with a FLYBALL_PLUGIN(mine),
  /// built against these headers in this version. Other than a policy's library it runs inside this
  /// process: whoever loads it trusts its author with all that they may do themselves, and a fault
  /// in it ends the program. It stays loaded until the program ends. One that is among these
  /// already adds nothing.
  ///
  /// @error `not_found`; `invalid_input` where it is no such library, or brings a name that is
  ///        taken.
  [[nodiscard]] Result<Plugins> with_library(const std::string& path) const;

  /// As those of `Registry`.
  template <class Interface>
  [[nodiscard]] std::vector<std::string> names() const {
    return registry_->names<Interface>();
  }
  template <class Interface>
  [[nodiscard]] std::unique_ptr<Interface> make(std::string_view name) const {
    return registry_->make<Interface>(name);
  }
  [[nodiscard]] const Registry& registry() const { return *registry_; }

  /// Paths of the libraries, in the order in which they were added: a mission consists of them,
  /// too.
  [[nodiscard]] const std::vector<std::string>& libraries() const { return libraries_; }

 private:
  Plugins(Registry&& registry, std::vector<std::string> libraries);

  std::shared_ptr<const Registry> registry_;  ///< Owners: all copies.
  std::vector<std::string> libraries_{};
};

}  // namespace flyball
