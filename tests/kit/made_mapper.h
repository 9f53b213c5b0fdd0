// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A mapper from a name and the parameters that differ from their defaults, and a scan put into it.

#include "flyball/kernels/kernels.h"
#include "flyball/kernels/mapper.h"
#include "flyball/runtime/registry.h"

#include "synthetic_scans.h"
#include <map>
#include <memory>
#include <string>

#include <gtest/gtest.h>

namespace flyball::kit {

inline std::unique_ptr<Mapper> made_mapper(
    const std::string& name, const std::map<std::string, ParameterValue>& given = {}) {
  Registry registry;
  register_kernels(registry);
  auto mapper = registry.make<Mapper>(name);
  const auto chosen = Parameters::resolve("mapper", mapper->parameters(), given);
  EXPECT_TRUE(mapper->configure(std::get<Parameters>(chosen), no_models));
  return mapper;
}

/// A small synthetic scan, prepared and committed. @return The work that was reported.
inline Work insert_scan(
    Mapper& mapper, Place place, int frame, double resolution_m, double range_m) {
  const auto scan = synthetic_scan(place, frame, range_m, 96);
  const auto work = mapper.prepare(scan.cloud_C, scan.X_WC, {resolution_m, range_m});
  EXPECT_TRUE(work.ok());
  mapper.commit();
  return work.ok() ? *work : Work{};
}

}  // namespace flyball::kit
