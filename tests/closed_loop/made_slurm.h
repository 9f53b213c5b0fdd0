// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "flyball_program.h"
#include <cstdlib>
#include <filesystem>
#include <string>

/// Programs with the names of Slurm's in front of everything else on the search path. `sbatch` runs
/// the array's tasks one after the other, and does to them what `fate` says in shell words.
class MadeSlurm {
 public:
  MadeSlurm(const FlyballProgram& flyball, const std::string& fate) {
    const std::string folder = flyball.place.path("slurm_programs");
    std::filesystem::create_directory(folder);
    add(flyball, "sinfo", "echo 0/2/0/2");
    add(flyball, "squeue", "echo 'slurm_load_jobs error: Invalid job id specified' >&2; exit 1");
    add(flyball, "sbatch",
        "for word; do script=$word; done\n"
        "tasks=$(sed -n 's/^#SBATCH --array=1-//p' \"$script\")\n"
        "echo array >> \"" +
            folder +
            "/arrays\"\n"
            "for task in $(seq \"$tasks\"); do\n"
            "  export SLURM_ARRAY_TASK_ID=$task\n" +
            fate + "\ndone >&2\necho 17");
    setenv("PATH", (folder + ":" + path_).c_str(), 1);
  }
  MadeSlurm(const MadeSlurm&) = delete;
  MadeSlurm& operator=(const MadeSlurm&) = delete;
  ~MadeSlurm() { setenv("PATH", path_.c_str(), 1); }

 private:
  static void add(const FlyballProgram& flyball, const std::string& name, const std::string& body) {
    const std::string file =
        flyball.place.file("slurm_programs/" + name, "#!/bin/sh\n" + body + "\n");
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  }
  std::string path_{std::getenv("PATH")};
};
