// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A look at the text of a TOML file before toml++ reads it. Some texts that are no TOML make
/// toml++ 3.3 (Debian 12's) do what C++ leaves undefined, or end the program where asserts are on:
/// letters outside of ASCII that are not quoted or stand behind a backslash, a table whose name
/// begins with no letter, a list that ends with a brace, a name of thousands of parts. Found by
/// tests/fuzz.

#include <optional>
#include <string>
#include <string_view>

namespace flyball {

struct TomlFault {
  int line{};  ///< The first one is 1.
  std::string what{};
};

/// What toml++ must not be given; empty: it may read the text, and says itself what else is wrong.
/// @cost  O(size of the text).
[[nodiscard]] std::optional<TomlFault> fault_of_toml(std::string_view text);

}  // namespace flyball
