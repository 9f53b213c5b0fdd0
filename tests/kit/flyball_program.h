// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "built_data.h"
#include "scratch_folder.h"
#include <cstdlib>
#include <string>

#include <sys/wait.h>

/// The built command, run from a folder of the test's own.
class FlyballProgram {
 public:
  struct Outcome {
    int exit_code{};
    std::string output;
    std::string errors;
  };

  [[nodiscard]] static std::string binary() {
    return flyball::kit::built_data() + "/../../bin/flyball";
  }

  /// `arguments` as a shell reads them.
  [[nodiscard]] Outcome run(const std::string& arguments) const {
    const ScratchFolder said;
    return run(arguments, "> '" + said.path("out") + "'", said);
  }
  /// Its output goes where the shell's `redirection` says: `> /dev/full`.
  [[nodiscard]] Outcome run_into(const std::string& redirection,
                                 const std::string& arguments) const {
    return run(arguments, redirection, ScratchFolder{});
  }

  ScratchFolder place;

 private:
  [[nodiscard]] Outcome run(const std::string& arguments,
                            const std::string& redirection,
                            const ScratchFolder& said) const {
    const std::string line = "cd '" + place.path() + "' && '" + binary() + "' " + arguments + " " +
                             redirection + " 2> '" + said.path("err") + "'";
    const int status = std::system(line.c_str());  // NOLINT(cert-env33-c): the test's own words
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, said.content("out"), said.content("err")};
  }
};
