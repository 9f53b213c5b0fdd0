// SPDX-License-Identifier: BSD-3-Clause

#include "children.h"

#include "flyball/runtime/program.h"

#include "console.h"
#include <array>
#include <csignal>
#include <map>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
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

/// Those that end the missions, unless they are ignored (as under nohup), and the end of one.
sigset_t awaited_signals() {
  sigset_t signals{};
  sigemptyset(&signals);
  sigaddset(&signals, SIGCHLD);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction now {};
    sigaction(signal, nullptr, &now);
    if (now.sa_handler != SIG_IGN) {
      sigaddset(&signals, signal);
    }
  }
  return signals;
}

/// Runs the mission in the child and does not return. Nothing here may allocate memory, because
/// this is a copy of a process that may have had threads.
[[noreturn]] void become_mission(pid_t parent, int errors, const char* program, char* const* argv) {
  // Whatever ends the parent, SIGKILL too, ends the mission.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) {  // It ended before that line.
    _exit(cannot_start);
  }
  // A group of its own: else the terminal's Ctrl-C would reach it beside ours, and two end it at
  // once.
  setpgid(0, 0);
  sigset_t none{};
  sigemptyset(&none);
  pthread_sigmask(SIG_SETMASK, &none, nullptr);
  dup2(open("/dev/null", O_WRONLY | O_CLOEXEC), STDOUT_FILENO);
  dup2(errors, STDERR_FILENO);
  execv(program, argv);
  _exit(cannot_start);
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
  const std::string program = program_to_start();
  const pid_t parent = getpid();
  const pid_t child = fork();  // Not posix_spawn: it cannot tie the child's life to ours.
  if (child == 0) {
    become_mission(parent, errors, program.c_str(), argv.data());
  }
  return child;
}

int exit_code_of(int status) {
  return WIFSIGNALED(status) ? exit_by_signal + WTERMSIG(status) : WEXITSTATUS(status);
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

/// Waits until a process ends or a signal asks for the end of all. Returns that signal, which the
/// processes get as well, or 0.
int wait_for_signal(const sigset_t& signals, const Children& running) {
  const int signal = sigwaitinfo(&signals, nullptr);
  if (signal <= 0 || signal == SIGCHLD) {
    return 0;
  }
  for (const auto& [process, child] : running) {
    kill(process, signal);
  }
  return signal;
}

}  // namespace

int run_children(const std::vector<std::vector<std::string>>& arguments,
                 std::size_t jobs,
                 const std::function<void(const ChildEnd&)>& ended) {
  std::signal(SIGCHLD, SIG_DFL);  // A caller may have ignored it; then no end would be reported.
  const sigset_t signals = awaited_signals();
  sigset_t before{};
  pthread_sigmask(SIG_BLOCK, &signals, &before);  // They wait for `sigwaitinfo`: none is lost.
  Children running;
  std::size_t next = 0;
  int interrupted = 0;
  while (!running.empty() || (next < arguments.size() && interrupted == 0)) {
    if (running.size() >= jobs || next >= arguments.size() || interrupted != 0) {
      const int signal = wait_for_signal(signals, running);
      interrupted = interrupted == 0 ? signal : interrupted;
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
