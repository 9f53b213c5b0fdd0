// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// One function for each sub-command: adds it to the program. When it is called it leaves its exit
/// code in `exit_code`: 0 done, 1 a failed mission, 2 bad input, 128 + the signal that interrupted
/// it.

namespace CLI {  // NOLINT(readability-identifier-naming): not ours
class App;
}

namespace flyball {

void add_run(CLI::App& program, int& exit_code);
void add_compare(CLI::App& program, int& exit_code);
void add_tournament(CLI::App& program, int& exit_code);
void add_bound(CLI::App& program, int& exit_code);
void add_drift(CLI::App& program, int& exit_code);
void add_sweep(CLI::App& program, int& exit_code);
void add_reproduce(CLI::App& program, int& exit_code);
void add_tune(CLI::App& program, int& exit_code);
void add_list(CLI::App& program, int& exit_code);
void add_fit(CLI::App& program, int& exit_code);
void add_calibrate(CLI::App& program, int& exit_code);
void add_graph(CLI::App& program, int& exit_code);
void add_policy(CLI::App& program, int& exit_code);
void add_replay(CLI::App& program, int& exit_code);
void add_explain(CLI::App& program, int& exit_code);
void add_detect(CLI::App& program, int& exit_code);
void add_models(CLI::App& program, int& exit_code);
void add_board(CLI::App& program, int& exit_code);
void add_map(CLI::App& program, int& exit_code);
void add_world(CLI::App& program, int& exit_code);
void add_map_from(CLI::App& map, int& exit_code);
void add_log(CLI::App& program, int& exit_code);
void add_localize(CLI::App& program, int& exit_code);
void add_config(CLI::App& program, int& exit_code);
void add_version(CLI::App& program, int& exit_code);

}  // namespace flyball
