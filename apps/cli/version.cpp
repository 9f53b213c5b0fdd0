// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/records/version.h"

#include "commands.h"
#include "console.h"

#include <CLI/CLI.hpp>

namespace flyball {

void add_version(CLI::App& program, int& exit_code) {
  const std::string text = "flyball " + version() + ", build " + build_fingerprint();
  program.set_version_flag("--version", text, "Print version and build and exit");
  program.add_subcommand("version", "prints version and build")->callback([&exit_code, text] {
    print(text + "\n");
    exit_code = exit_success;
  });
}

}  // namespace flyball
