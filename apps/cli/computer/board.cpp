// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/runtime/board/board_report.h"
#include "flyball/runtime/board/settings_keeper.h"

#include "cli/commands.h"
#include "cli/computer/real_computer.h"
#include "cli/console.h"
#include "cli/flight_options.h"
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

struct BoardArguments {
  std::string root{"/"};
  std::string board{};  ///< Empty: the one whose file names the model that was found.
  std::string run_folder{KeeperOptions{}.run_folder};
  bool prints{};
};

int report(const BoardArguments& given) {
  const auto system = linux_system(given.root);
  if (system->entries("/sys/devices/system/cpu").empty()) {
    const auto folder = std::filesystem::path{given.root} / "sys/devices/system/cpu";
    return refuse({{ErrorCode::not_found, "no folder \"" + folder.string() +
                                              "\" to look for a board in; --root names a folder "
                                              "that has sys and proc"}});
  }
  const BoardInventory found = discover_board(*system);
  const auto board = choose_board(given.board, found.model);
  if (!board) {
    return refuse({board.error()});
  }
  print(board_report(*system, found, *board));
  return exit_success;
}

int restore(const BoardArguments& given) {
  const auto system = linux_system(given.root);
  std::error_code ignored;
  if (given.run_folder != KeeperOptions{}.run_folder &&
      !std::filesystem::exists(given.run_folder, ignored)) {
    return refuse({{ErrorCode::not_found, "no session has left anything in \"" + given.run_folder +
                                              "\"; leave out --run-folder for the usual place"}});
  }
  const auto keeper = SettingsKeeper::open(*system, {given.run_folder, true});
  if (!keeper) {
    return refuse({keeper.error()});
  }
  const std::size_t count = (*keeper)->kept().size();
  const std::vector<Error> errors = (*keeper)->restore();
  print(std::to_string(count - errors.size()) + " of " + std::to_string(count) +
        " settings that an earlier session left are restored\n");
  return errors.empty() ? exit_success : refuse(errors);
}

int setup(const BoardArguments& given) {
  if (!given.prints) {
    return refuse({{ErrorCode::invalid_input,
                    "board setup changes nothing by itself; try: flyball board setup "
                    "--print, and run as root what it prints"}});
  }
  print(board_setup_script());
  return exit_success;
}

}  // namespace

void add_board(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand(
      "board", "prints what this computer has, what may be set, what not and why");
  const auto given = std::make_shared<BoardArguments>();  // Owners: the parser's callbacks.
  refuse_empty(
      *command
           ->add_option("--root", given->root, "looks at /sys and /proc below this folder instead")
           ->type_name("DIR"));
  refuse_empty(
      *command
           ->add_option(
               "--board", given->board,
               "a name from `flyball list boards`, if the model of this computer does not tell")
           ->type_name("NAME"));
  CLI::App* setup_command =
      command->add_subcommand("setup", "tells how a user other than root may set clocks and cores");
  setup_command->add_flag("--print", given->prints, "prints a script for root; writes nothing");
  setup_command->callback([given, &exit_code] { exit_code = setup(*given); });
  CLI::App* restore_command = command->add_subcommand(
      "restore", "restores what a session left that was killed together with its watchdog");
  refuse_empty(*restore_command
                    ->add_option("--run-folder", given->run_folder,
                                 "the folder with its lock and journal (default: /run/flyball)")
                    ->type_name("DIR"));
  restore_command->callback([given, &exit_code] { exit_code = restore(*given); });
  command->callback([command, given, &exit_code] {
    if (command->get_subcommands().empty()) {
      exit_code = report(*given);
    }
  });
}

}  // namespace flyball
