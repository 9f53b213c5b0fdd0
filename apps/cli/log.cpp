// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/mcap/mcap_recovery.h"
#include "flyball/records/text_table.h"

#include "commands.h"
#include "console.h"
#include "flight_options.h"
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

struct LogOptions {
  std::string broken;
  std::string out;
};

std::string counted(std::uint64_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

int recover(const LogOptions& options) {
  const auto done = recover_mcap(options.broken, options.out);
  if (!done) {
    return refuse({done.error()});
  }
  std::string text =
      counted(done->chunks, "chunk") + " with " + counted(done->messages, "message") + ", " +
      rounded(to_seconds(done->begin), 3) + " s to " + rounded(to_seconds(done->end), 3) + " s\n";
  if (done->was_whole) {
    text += "the file had its end already\n";
  } else {
    text += counted(done->lost_bytes, "byte") + " behind the last whole record are lost\n";
  }
  if (done->damaged_chunks > 0) {
    text += counted(done->damaged_chunks, "damaged chunk") + " left out\n";
  }
  if (done->missing_rows > 0) {
    text += counted(done->missing_rows, "row") + " dropped in flight or left out\n";
  }
  print(text);
  return exit_success;
}

}  // namespace

void add_log(CLI::App& program, int& exit_code) {
  CLI::App* log = program.add_subcommand("log", "brings back records of flights");
  log->require_subcommand(1);
  const auto options = std::make_shared<LogOptions>();  // Owners: the parser's callbacks.
  CLI::App* command = log->add_subcommand(
      "recover", "writes all closed chunks of a cut or damaged MCAP file to a whole one");
  refuse_empty(
      *command->add_option("BROKEN", options->broken, "an .mcap file of `run --mcap`")->required());
  refuse_empty(*command->add_option("--out", options->out, "the file to write")
                    ->required()
                    ->type_name("FILE"));
  command->callback([options, &exit_code] { exit_code = recover(*options); });
}

}  // namespace flyball
