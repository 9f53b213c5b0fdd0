// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Parts of Flyball that bring half a hundred libraries, a tenth of a second and more at every
/// start of a program that links them. They are modules, and are loaded when they are asked for:
/// `../lib/flyball/NAME.so` seen from the program, or where this library was installed, or, before
/// both, beside the data in `$FLYBALL_DATA`: `../../lib/flyball` seen from there.

#include <string>

namespace flyball {

[[nodiscard]] std::string module_path(const std::string& name);

/// A function of a module, which stays loaded; null when the module is not there or cannot be
/// loaded.
[[nodiscard]] void* module_function(const std::string& name, const char* function);

}  // namespace flyball
