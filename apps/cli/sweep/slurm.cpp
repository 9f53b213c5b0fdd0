// SPDX-License-Identifier: BSD-3-Clause

#include "cli/sweep/slurm.h"

#include "flyball/records/report.h"

#include "cli/sweep/sweep_flights.h"
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <system_error>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace flyball {
namespace {

struct Answer {
  int exit_code{};
  std::string output{};  ///< What it wrote to either standard stream.
};

std::string read_all(int file) {
  std::string text;
  std::array<char, 4096> part{};
  for (ssize_t size = read(file, part.data(), part.size());
       size > 0 || (size < 0 && errno == EINTR); size = read(file, part.data(), part.size())) {
    text.append(part.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
  }
  while (!text.empty() && text.back() == '\n') {
    text.pop_back();
  }
  return text;
}

/// Runs one of Slurm's programs to its end.
Result<Answer> ask(std::vector<std::string> words) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    return Error{ErrorCode::unavailable,
                 std::string{"no pipe: "} + std::system_category().message(errno)};
  }
  posix_spawn_file_actions_t actions{};
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) {
    argv.push_back(word.data());
  }
  argv.push_back(nullptr);
  pid_t process = -1;
  const int failed = posix_spawnp(&process, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  Answer answer;
  if (failed == 0) {
    answer.output = read_all(ends[0]);
  }
  close(ends[0]);
  if (failed != 0) {
    return Error{ErrorCode::unavailable, "cannot start " + words[0] + ": " +
                                             std::system_category().message(failed) +
                                             "; install slurm-client, or leave --on out"};
  }
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  answer.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 1;
  return answer;
}

Error refused(const std::string& program, const Answer& answer) {
  return {ErrorCode::unavailable, program + ": " + answer.output};
}

}  // namespace

std::string array_script(const JobArray& array) {
  const std::string tasks = std::to_string(array.tasks);
  return "#!/bin/sh\n"
         "#SBATCH --job-name=" +
         array.name + "\n#SBATCH --array=1-" + tasks +
         "\n#SBATCH --ntasks=1\n#SBATCH --cpus-per-task=1\n#SBATCH --requeue\n"
         "#SBATCH --open-mode=append\nexec " +
         shell_text(array.command) + " \"${SLURM_ARRAY_TASK_ID}/" + tasks + "\"\n";
}

Result<std::string> submit(const JobArray& array) {
  const std::string script = array.folder + "/array.sh";
  if (const Status written = write_file(script, array_script(array)); !written) {
    return written.error();
  }
  // Not a line of the script: there no quotes would help a folder with a blank in its name.
  const auto answer =
      ask({"sbatch", "--parsable", "--output=" + array.folder + "/task_%a.log", script});
  if (!answer) {
    return answer.error();
  }
  if (answer->exit_code != 0) {
    return refused("sbatch", *answer);
  }
  return answer->output.substr(0, answer->output.find(';'));  // `NUMBER;CLUSTER`
}

Result<std::size_t> tasks_left(const std::string& array_number) {
  const auto answer =
      ask({"squeue", "--noheader", "--array", "--format=%i", "--job", array_number});
  if (!answer) {
    return answer.error();
  }
  if (answer->exit_code != 0) {
    // Slurm forgets jobs some minutes after their end.
    if (answer->output.find("Invalid job id") != std::string::npos) {
      return std::size_t{0};
    }
    return refused("squeue", *answer);
  }
  const auto lines = std::count(answer->output.begin(), answer->output.end(), '\n');
  return answer->output.empty() ? 0 : static_cast<std::size_t>(lines) + 1;
}

Result<std::size_t> slurm_processors() {
  const auto answer = ask({"sinfo", "--noheader", "--format=%C"});
  if (!answer) {
    return answer.error();
  }
  if (answer->exit_code != 0) {
    return refused("sinfo", *answer);
  }
  const std::size_t slash = answer->output.rfind('/');  // allocated/idle/other/total
  const long total =
      slash == std::string::npos ? 1 : std::strtol(answer->output.c_str() + slash + 1, nullptr, 10);
  return static_cast<std::size_t>(std::max(total, 1L));
}

}  // namespace flyball
