// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A second process that does something once this one has ended, however it ended: SIGKILL cannot
/// be caught, and a crash leaves nobody to clean up.

#include "flyball/runtime/result.h"

#include <functional>
#include <vector>

#include <sys/types.h>

namespace flyball {

/// The same file with a number above those of the standard files, which the other process opens
/// anew: a program that has closed its own gives their numbers to what it opens next.
/// @param file  Closed where it is moved; -1 stays -1, with `errno`.
[[nodiscard]] int above_standard(int file);

/// The other process stands in a session of its own and ignores SIGINT, SIGTERM and SIGHUP, so that
/// neither a terminal nor a service manager's first signal takes it along. It holds no files but
/// those that it is told to keep.
class Watchdog {
 public:
  /// Forks, and returns when the other process watches. Start it before other threads: `work` runs
  /// in a copy of this process that has only the calling one.
  /// @param kept  Descriptors that `work` uses.
  /// @param work  What to do when this process has ended, or after `end`.
  /// @error `failed`: the system has no process or socket left.
  static Result<Watchdog> start(std::vector<int> kept, const std::function<void()>& work);
  Watchdog(Watchdog&& other) noexcept;
  Watchdog& operator=(Watchdog&& other) noexcept;
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;
  /// As `end`; in a forked copy of this process, nothing.
  ~Watchdog();

  /// False once somebody has killed it.
  [[nodiscard]] bool is_alive();
  /// Lets it do its work now, and waits for it.
  void end();
  [[nodiscard]] pid_t process() const { return process_; }

 private:
  Watchdog(int socket, pid_t process);

  int socket_{-1};     ///< Its other end closes when this process ends.
  pid_t process_{-1};  ///< -1: ended, or handed on.
  pid_t owner_{-1};
};

}  // namespace flyball
