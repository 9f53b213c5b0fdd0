// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The frame of a study's page: one file that needs no network.

#include <string>

namespace flyball {

/// Up to the title and the first heading.
[[nodiscard]] std::string page_begin(const std::string& title);
/// @param footer  Text, not HTML.
[[nodiscard]] std::string page_end(const std::string& footer);

}  // namespace flyball
