// SPDX-License-Identifier: BSD-3-Clause

#include "commands.h"
#include "console.h"
#include <exception>
#include <sstream>
#include <string>

#include <CLI/CLI.hpp>

namespace {

/// `flyball map from --help` where the mistake stands behind `flyball map from`.
std::string nearest_help(const CLI::App& program) {
  std::string command = "flyball";
  for (const CLI::App* at = &program; !at->get_subcommands().empty();) {
    at = at->get_subcommands().back();
    command += " " + at->get_name();
  }
  return command + " --help";
}

/// The parser would answer `flyball nosuch --help` with its own help, as if all was well.
bool names_unknown_command(const CLI::App& program, const std::string& word) {
  const auto is_meant = [&word](const CLI::App* command) { return command->check_name(word); };
  return !word.empty() && word.front() != '-' && program.get_subcommands(is_meant).empty();
}

int parse_and_run(int argc, char** argv) {
  CLI::App program{
      "Flies simulated missions of micro aerial vehicles and compares governor policies."};
  int exit_code = flyball::exit_success;
  flyball::add_run(program, exit_code);
  flyball::add_compare(program, exit_code);
  flyball::add_tournament(program, exit_code);
  flyball::add_sweep(program, exit_code);
  flyball::add_reproduce(program, exit_code);
  flyball::add_tune(program, exit_code);
  flyball::add_drift(program, exit_code);
  flyball::add_bound(program, exit_code);
  flyball::add_list(program, exit_code);
  flyball::add_graph(program, exit_code);
  flyball::add_config(program, exit_code);
  flyball::add_policy(program, exit_code);
  flyball::add_replay(program, exit_code);
  flyball::add_explain(program, exit_code);
  flyball::add_map(program, exit_code);
  flyball::add_world(program, exit_code);
  flyball::add_detect(program, exit_code);
  flyball::add_models(program, exit_code);
  flyball::add_board(program, exit_code);
  flyball::add_fit(program, exit_code);
  flyball::add_calibrate(program, exit_code);
  flyball::add_log(program, exit_code);
  flyball::add_localize(program, exit_code);
  flyball::add_version(program, exit_code);
  program.footer("`flyball SUBCOMMAND --help` explains the options of one sub-command.");
  if (argc > 1 && names_unknown_command(program, argv[1])) {
    flyball::remark(std::string{"no sub-command \""} + argv[1] + "\"; try: flyball --help");
    return flyball::exit_bad_input;
  }
  try {
    program.parse(argc, argv);
    if (program.get_subcommands().empty()) {
      flyball::print(program.help());
    }
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {  // --help, --version
      std::ostringstream help;
      program.exit(error, help, help);
      flyball::print(help.str());
      return flyball::exit_success;
    }
    flyball::remark(std::string{error.what()} + "; try: " + nearest_help(program));
    return flyball::exit_bad_input;
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  flyball::open_standard_files();
  try {
    return flyball::exit_code_with_output(parse_and_run(argc, argv));
  } catch (const std::exception& error) {  // Out of memory, or a third-party library's surprise.
    flyball::remark(error.what());
    return flyball::exit_mission_failed;
  }
}
