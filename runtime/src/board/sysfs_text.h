// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How the kernel writes numbers and lists into its files.

#include "flyball/runtime/board/linux_system.h"
#include "flyball/runtime/units.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flyball {

/// Without blanks, newlines and NULs at the end, and blanks in front.
[[nodiscard]] std::string trimmed(std::string_view text);
/// Words between blanks.
[[nodiscard]] std::vector<std::string> words_of(std::string_view text);
/// A whole number and nothing else; empty: it is none, or does not fit.
[[nodiscard]] std::optional<long long> integer_of(std::string_view text);
/// "0,3-5" and "0 3 4 5" alike, ascending; what is no list is empty.
[[nodiscard]] std::vector<int> cpu_list_of(std::string_view text);
/// The number behind `prefix`: 12 of "cpu12"; empty: the name is another one.
[[nodiscard]] std::optional<int> number_behind(std::string_view prefix, std::string_view name);

/// The file's content trimmed; empty: it cannot be read.
[[nodiscard]] std::optional<std::string> text_in(const LinuxSystem& system,
                                                 const std::string& path);
[[nodiscard]] std::optional<long long> integer_in(const LinuxSystem& system,
                                                  const std::string& path);
/// The text is a number of kHz; empty where it is not, or not positive.
[[nodiscard]] std::optional<Hertz> clock_of(std::string_view text);
/// The same of a file.
[[nodiscard]] std::optional<Hertz> clock_in(const LinuxSystem& system, const std::string& path);
/// The clock as cpufreq's files have it: whole kHz.
[[nodiscard]] std::string khz_of(Hertz clock);
/// For people: "1420.8 MHz".
[[nodiscard]] std::string mhz_of(Hertz clock);

}  // namespace flyball
