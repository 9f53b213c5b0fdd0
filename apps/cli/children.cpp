// SPDX-License-Identifier: BSD-3-Clause

#include "children.h"

#include <array>
#include <csignal>
#include <map>

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace flyball {
namespace {

constexpr int cannot_start = 127;  // As shells say it.

struct Child {
  std::size_t index{};
  int errors{};  ///< File in memory that takes its standard error.
};
using Children = std::map<pid_t, Child>;

std::string read_and_close(int file) {
  std::string text;
  std::array<char, 4096> part{};
  lseek(file, 0, SEEK_SET);
  for (ssize_t size = read(file, part.data(), part.size()); size > 0;
       size = read(file, part.data(), part.size())) {
    text.append(part.data(), static_cast<std::size_t>(size));
  }
  close(file);
  return text;
}

void take_signals(sigset_t& signals) {
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGCHLD);
}

/// The process, or -1.
pid_t start(const std::vector<std::string>& arguments, int errors) {
  std::vector<std::string> words{"flyball"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) {
    argv.push_back(word.data());
  }
  argv.push_back(nullptr);
  posix_spawn_file_actions_t files{};
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&files, errors, STDERR_FILENO);
  // A group of its own: else the terminal's Ctrl-C would reach it beside ours, and two end it at
  // once.
  sigset_t none{};
  sigemptyset(&none);
  posix_spawnattr_t ways{};
  posix_spawnattr_init(&ways);
  posix_spawnattr_setflags(&ways, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
  posix_spawnattr_setsigmask(&ways, &none);
  pid_t child = -1;
  const int failed = posix_spawn(&child, "/proc/self/exe", &files, &ways, argv.data(), environ);
  posix_spawnattr_destroy(&ways);
  posix_spawn_file_actions_destroy(&files);
  return failed == 0 ? child : -1;
}

int exit_code_of(int status) {
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

/// Tells of every process that has ended by now.
void collect(Children& running, const std::function<void(const ChildEnd&)>& ended) {
  for (auto child = running.begin(); child != running.end();) {
    int status = 0;
    if (waitpid(child->first, &status, WNOHANG) != child->first) {
      ++child;
      continue;
    }
    ended({child->second.index, exit_code_of(status), read_and_close(child->second.errors)});
    child = running.erase(child);
  }
}

/// Waits until a process ends or Ctrl-C comes; true for the latter.
bool wait_for_signal(const sigset_t& signals, const Children& running) {
  const bool interrupted = sigwaitinfo(&signals, nullptr) == SIGINT;
  for (const auto& [process, child] : running) {
    if (interrupted) {
      kill(process, SIGINT);
    }
  }
  return interrupted;
}

}  // namespace

bool run_children(const std::vector<std::vector<std::string>>& arguments,
                  std::size_t jobs,
                  const std::function<void(const ChildEnd&)>& ended) {
  sigset_t signals{};
  sigset_t before{};
  take_signals(signals);
  pthread_sigmask(SIG_BLOCK, &signals, &before);  // They wait for `sigwaitinfo`: none is lost.
  Children running;
  std::size_t next = 0;
  bool interrupted = false;
  while (!running.empty() || (next < arguments.size() && !interrupted)) {
    if (running.size() >= jobs || next >= arguments.size() || interrupted) {
      interrupted = wait_for_signal(signals, running) || interrupted;
      collect(running, ended);
      continue;
    }
    const int errors = memfd_create("errors", MFD_CLOEXEC);
    const pid_t process = start(arguments[next], errors);
    if (process < 0) {
      ended({next, cannot_start, read_and_close(errors) + "the process cannot be started"});
    } else {
      running[process] = {next, errors};
    }
    ++next;
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return interrupted;
}

}  // namespace flyball
