// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/records/version.h"

#include "commands.h"
#include "console.h"
#include <string>

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

std::string version_and_build() {
  return "flyball " + version() + ", build " + build_fingerprint();
}

}  // namespace

void add_version(CLI::App& program, int& exit_code) {
  program.set_version_flag("--version", version_and_build, "Print version and build and exit");
  program.add_subcommand("version", "prints version and build")->callback([&exit_code] {
    print(version_and_build() + "\n");
    exit_code = exit_success;
  });
}

}  // namespace flyball
