// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A world from a generator's name, a seed and the parameters that differ from their defaults.

#include "flyball/runtime/registry.h"
#include "flyball/sim/world.h"
#include "flyball/sim/worlds.h"

#include <map>
#include <string>

namespace flyball {

inline Result<World> made_world(const std::string& generator,
                                std::uint64_t seed,
                                const std::map<std::string, ParameterValue>& given = {}) {
  Registry registry;
  register_worlds(registry);
  const auto maker = registry.make<WorldGenerator>(generator);
  if (!maker) {
    return Error{ErrorCode::not_found, "no generator \"" + generator + "\""};
  }
  const auto parameters =
      Parameters::resolve("world \"" + generator + "\"", maker->parameters(), given);
  if (const auto* errors = std::get_if<std::vector<Error>>(&parameters)) {
    return errors->front();
  }
  return maker->make(std::get<Parameters>(parameters), seed);
}

}  // namespace flyball
