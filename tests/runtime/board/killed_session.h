// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Runs a session of a board in a process of its own, which may be killed, and waits until the
/// board has been restored.

#include <csignal>
#include <string>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

namespace flyball::fake {

/// Forks; returns how `session` ended, as waitpid has it, after the lock of the board is free.
template <class Session>
int run_apart(const std::string& run_folder, Session session) {
  const pid_t process = fork();
  if (process == 0) {
    session();
    _exit(0);
  }
  int status = 0;
  waitpid(process, &status, 0);
  // The process that restores holds the lock until it is done.
  const int lock = open((run_folder + "/board.lock").c_str(), O_RDWR | O_CLOEXEC);
  if (lock >= 0) {
    flock(lock, LOCK_EX);
    close(lock);
  }
  return status;
}

inline bool was_killed(int status) {
  return WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
}

}  // namespace flyball::fake
