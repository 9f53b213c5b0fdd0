// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What the sub-commands share: results go to standard output, all else to standard error.

#include "flyball/runtime/result.h"

#include <string>
#include <vector>

namespace flyball {

constexpr int exit_success = 0;
constexpr int exit_mission_failed = 1;
constexpr int exit_bad_input = 2;
constexpr int exit_by_signal = 128;  // And the signal's number, as shells say it.

/// Prints to standard output.
void print(const std::string& text);
/// With what the program ends: `exit_bad_input` at least, and a sentence, where a result could not
/// be written.
[[nodiscard]] int exit_code_with_output(int exit_code);
/// Before anything else is opened: where the caller closed standard output or another one, the next
/// file that is opened would get its number, and results would go into that.
void open_standard_files();
/// Prints one line to standard error.
void note(const std::string& line);
/// Prints one line that begins with the program's name: what whoever gave the command has to know.
/// Lines about progress have no name before them.
void remark(const std::string& sentence);
/// What such lines of another process of this program say, from the first one on: without that
/// one's name, which `remark` and `refuse` put before it again, and without the last line's end.
[[nodiscard]] std::string remarked(const std::string& lines);
/// Prints each error as such a line; returns `exit_bad_input`.
[[nodiscard]] int refuse(const std::vector<Error>& errors);

/// Whether somebody watches standard error: only then progress is shown.
[[nodiscard]] bool has_watcher();

/// From now on SIGINT (Ctrl-C), SIGTERM and SIGHUP are only remembered, unless they are ignored; a
/// second one ends the program at once.
void catch_interrupt();
/// They end the program again, while it waits without anything to keep.
/// @return Whether `catch_interrupt` had caught any of them.
bool release_interrupt();
[[nodiscard]] bool was_interrupted();
/// 130 after SIGINT, 143 after SIGTERM, 129 after SIGHUP.
[[nodiscard]] int interrupted_exit_code();

}  // namespace flyball
