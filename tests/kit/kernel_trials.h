// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Puts kernels on trial: those that are registered, and culprits that break a rule on purpose.

#include "flyball/kernels/conformance/kernel_conformance.h"
#include "flyball/kernels/kernels.h"
#include "flyball/kernels/switched.h"
#include "flyball/runtime/registry.h"

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace flyball::kit {

inline const Registry& kernels() {
  static const Registry registry = [] {
    Registry filled;
    register_kernels(filled);
    return filled;
  }();
  return registry;
}

/// Runs a kit over every kernel of a family without naming any of them.
template <class Conformance, class Family>
void try_all_registered(const FindModel& find_model = no_models) {
  int tried = 0;
  for (const std::string& name : kernels().names<Family>()) {
    Conformance conformance{{[&name] { return kernels().make<Family>(name); }, {}, find_model}};
    const auto breaches = conformance.breaches();
    for (const std::string& breach : breaches) {
      // What a machine has no weights for cannot be tried on it.
      if (breach.rfind("cannot be configured: ", 0) == 0) {
        GTEST_LOG_(INFO) << name << " " << breach;
      } else {
        ADD_FAILURE() << name << " " << breach;
      }
    }
    tried += breaches.empty() ? 1 : 0;
  }
  EXPECT_GE(tried, 1);
}

/// Runs a kit over each kernel of a family in turn, behind a knob that chooses among all of them
/// and that has been turned to it.
///
/// @param work  A small job, so that the first one after a switch is over.
template <class Conformance, class Family, class Switched>
void try_all_behind_a_switch(const std::function<void(Family&)>& work,
                             const FindModel& find_model = no_models) {
  const auto usable = [&find_model](const std::string& name) {
    auto kernel = kernels().make<Family>(name);
    const auto chosen = Parameters::resolve(name, kernel->parameters(), {});
    return kernel->configure(std::get<Parameters>(chosen), find_model) ? std::move(kernel)
                                                                       : nullptr;
  };
  std::vector<std::string> names = kernels().names<Family>();
  names.erase(std::remove_if(names.begin(), names.end(),
                             [&usable](const std::string& name) { return !usable(name); }),
              names.end());
  EXPECT_GE(names.size(), 2U);
  for (std::size_t active = 0; active < names.size(); ++active) {
    const auto make = [&]() -> std::unique_ptr<Family> {
      std::vector<KernelKind<Family>> kinds;
      for (const std::string& name : names) {
        kinds.push_back({name, usable(name)});
      }
      auto all = std::make_unique<Switched>(std::move(kinds));
      KnobSettings knobs{all->knobs()};
      EXPECT_TRUE(knobs.set(knobs.specs().front().name, static_cast<double>(active)).ok());
      all->apply(knobs);
      work(*all);
      return all;
    };
    for (const std::string& breach : Conformance{{make}}.breaches()) {
      ADD_FAILURE() << names[active] << " behind a switch " << breach;
    }
  }
}

/// Each crime, and a part of the sentence that must be found about it.
using Findings = std::map<std::string, std::string>;

/// @param make  A kernel that commits the crime; without fault for the crime `none`.
template <class Conformance, class Family>
void expect_crimes_found(
    const std::function<std::unique_ptr<Family>(const std::string& crime)>& make,
    const Findings& findings) {
  const auto tried = [&make](const std::string& crime) {
    return Conformance{{[&make, crime] { return make(crime); }}}.breaches();
  };
  for (const std::string& breach : tried("none")) {
    ADD_FAILURE() << "without fault, but " << breach;
  }
  for (const auto& [crime, finding] : findings) {
    const std::vector<std::string> breaches = tried(crime);
    const bool found =
        std::any_of(breaches.begin(), breaches.end(), [part = finding](const std::string& breach) {
          return breach.find(part) != std::string::npos;
        });
    std::string all;
    for (const std::string& breach : breaches) {
      all += "\n  " + breach;
    }
    EXPECT_TRUE(found) << crime << ": should say \"" << finding << "\", says:" << all;
  }
}

}  // namespace flyball::kit
