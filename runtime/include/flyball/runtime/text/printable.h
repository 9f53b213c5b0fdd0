// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Text from plug-ins, scripts and files as it may be shown.

#include <string>
#include <string_view>

namespace flyball {

/// The text with each byte that could steer a terminal, or that is no UTF-8, as `\x1b`: control
/// characters (new lines too, so that it is one line), and marks that turn the direction of
/// writing.
///
/// @param kept  Control characters that stay: "\n\t" for text of several lines.
[[nodiscard]] std::string printable(std::string_view text, std::string_view kept = {});

}  // namespace flyball
