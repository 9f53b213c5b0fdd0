// SPDX-License-Identifier: BSD-3-Clause
#include "cli/computer/real_computer.h"

#include "flyball/records/text_table.h"
#include "flyball/runtime/realtime/cpus.h"
#include "flyball/scenario/files.h"
#include "flyball/simulation/realtime_flight.h"

#include "cli/console.h"
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <sys/utsname.h>

namespace flyball {
namespace {

Result<BoardFile> board_named(const std::string& name) {
  const auto path = find_shipped("boards", name);
  return path ? load_board_file(*path) : Result<BoardFile>{path.error()};
}

bool is_x86() {
  utsname system{};
  uname(&system);
  const std::string machine{static_cast<const char*>(system.machine)};
  return machine == "x86_64" || machine == "i686";
}

}  // namespace

Result<BoardFile> choose_board(const std::string& name, const std::string& model) {
  if (!name.empty()) {
    return board_named(name);
  }
  std::vector<BoardFile> known;
  for (const std::string& one : shipped("boards")) {
    auto board = board_named(one);
    if (!board) {
      return board;
    }
    known.push_back(std::move(*board));
  }
  BoardFile found = board_file_for(known, model);
  // Firmware names thousands of PCs; a device tree names a board that a file could describe.
  return found.models.empty() && is_x86() ? board_named("generic_x86") : Result<BoardFile>{found};
}

std::vector<int> cores_for_jobs(const BoardFile& board) {
  const std::vector<int> usable = usable_cpus();
  const std::vector<int> cores = cores_in_order(board, usable);
  return cores.empty() ? usable : cores;
}

void add_executor(CLI::App& command, ExecutorOptions& options) {
  command
      .add_option("--executor", options.executor,
                  "what runs the nodes: a modeled computer, or this one in real time")
      ->check(CLI::IsMember({"virtual", "realtime"}))
      ->capture_default_str();
  command
      .add_option("--fifo", options.fifo_priority,
                  "with --executor realtime: SCHED_FIFO priority of the least urgent nodes")
      ->check(CLI::Range(1, 80))
      ->type_name("N");
  command.add_flag("--set-clocks", options.sets_clocks,
                   "with --executor realtime: sets this computer's clock as the policy asks, and "
                   "restores it");
}

Result<std::unique_ptr<RealComputer>> RealComputer::open(const ExecutorOptions& options,
                                                         const PlatformModel& expected) {
  const bool is_modeled = options.executor == "virtual";
  if (is_modeled && (options.fifo_priority > 0 || options.sets_clocks)) {
    return Error{ErrorCode::invalid_input,
                 std::string{options.sets_clocks ? "--set-clocks" : "--fifo"} +
                     " is of no use to a modeled computer; add --executor realtime"};
  }
  std::unique_ptr<RealComputer> computer{new RealComputer{options}};
  if (is_modeled) {
    return computer;
  }
  computer->system_ = linux_system();
  auto file = choose_board({}, discover_board(*computer->system_).model);
  if (!file) {
    return file.error();
  }
  computer->file_ = std::move(*file);
  if (options.sets_clocks) {
    if (const Status opened = computer->open_board(expected); !opened) {
      return opened.error();
    }
  }
  return computer;
}

Status RealComputer::open_board(const PlatformModel& expected) {
  LinuxBoardOptions options;
  options.file = file_;
  options.power_prior = expected.power;
  auto opened = LinuxBoard::open(*system_, options);
  if (!opened) {
    return opened.error();
  }
  board_ = std::move(*opened);
  const std::vector<Hertz> missing = clocks_missing_on(board_->model(), expected.frequencies);
  if (!missing.empty()) {
    remark("this computer lacks " + std::to_string(missing.size()) + " of the " +
           std::to_string(expected.frequencies.size()) + " clocks of platform \"" + expected.name +
           "\", such as " + rounded(missing.back().value() * 1e-9, 2) +
           " GHz; try: flyball calibrate");
  }
  shared_board_ = std::make_unique<RealtimeBoard>(*board_);
  tell_notes();  // That no clock can be set is better known before the flight.
  return Done{};
}

void RealComputer::tell_notes() {
  for (const std::string& sentence : shared_board_->take_notes()) {
    remark(sentence);
  }
}

void RealComputer::equip(MissionHooks& hooks) {
  if (options_.executor == "virtual") {
    return;
  }
  RealtimeSettings settings;
  settings.cpus = cores_for_jobs(file_);
  if (options_.fifo_priority > 0) {
    settings.fifo_priority = options_.fifo_priority;
  }
  settings.lock_memory = true;
  settings.tell = [](const std::string& sentence) { remark(sentence); };
  if (shared_board_) {
    settings.grant = [board = shared_board_.get()](const OperatingPoint& wanted) {
      return board->grant(wanted);
    };
    hooks.computer = shared_board_.get();
  }
  hooks.executor = in_real_time(settings);
  hooks.rendering = Rendering::as_cameras_do;
}

void RealComputer::close() {
  if (!shared_board_) {
    return;
  }
  tell_notes();
  for (const Error& error : board_->close()) {
    remark(error.message);
  }
}

}  // namespace flyball
