// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Puts kernels on trial: those that are registered, and culprits that break a rule on purpose.

#include "flyball/kernels/conformance/kernel_conformance.h"
#include "flyball/kernels/kernels.h"
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
