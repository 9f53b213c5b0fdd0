// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Keys with units in their names: finds the unit of a key, and the key that was probably meant.

#include <string>
#include <vector>

namespace flyball {

/// A key without its unit, and the unit as people write it.
struct KeyParts {
  std::string stem;  ///< `map.range` of `map.range_m`.
  std::string unit;  ///< `m`; empty when the key has none.
};
[[nodiscard]] KeyParts parts_of(const std::string& key);

/// The hint for an unknown key: the right unit, the nearest key, or nothing.
///
/// @return  A clause such as `did you mean map.range_m?`; empty when no key is near.
[[nodiscard]] std::string suggest_key(const std::string& unknown,
                                      const std::vector<std::string>& known);

/// The name with the fewest edits; empty when every name differs by more than a third.
[[nodiscard]] std::string nearest_name(const std::string& wanted,
                                       const std::vector<std::string>& names);

/// `did you mean NAME? `, to begin what follows with; empty when no name is near.
[[nodiscard]] std::string name_meant(const std::string& wanted,
                                     const std::vector<std::string>& names);

}  // namespace flyball
