// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The files and calls of a Linux system that a board is governed by. It is an interface so that
/// tests can stand in for the kernel, which refuses some writes and answers others with a lie.

#include "flyball/runtime/result.h"

#include <memory>
#include <string>
#include <vector>

#include <sys/types.h>

namespace flyball {

/// Paths are those of the running system (`/sys/devices/system/cpu/online`), wherever its root is.
class LinuxSystem {
 public:
  LinuxSystem() = default;
  LinuxSystem(const LinuxSystem&) = delete;
  LinuxSystem& operator=(const LinuxSystem&) = delete;
  virtual ~LinuxSystem() = default;

  /// The whole content, with the newline at its end; at most 64 KiB.
  /// @error `not_found`, `unavailable` (not permitted, or read-only), `invalid_input` (EINVAL),
  ///        `failed`; the message names the file and the system's reason.
  /// @cost  Three system calls. Files of sensors may take milliseconds (a conversion over I2C).
  [[nodiscard]] virtual Result<std::string> read(const std::string& path) const = 0;
  /// Replaces the content.
  /// @error As `read`; what the file holds then is the kernel's business: read it back.
  /// @cost  Three system calls; a change of the clock takes some 100 us, hot-plug tens of ms.
  virtual Status write(const std::string& path, const std::string& text) = 0;
  /// Whether `write` has the permission, found without writing.
  /// @error As `write`.
  [[nodiscard]] virtual Status may_write(const std::string& path) const = 0;
  /// Names in a folder, sorted; empty where there is no such folder.
  [[nodiscard]] virtual std::vector<std::string> entries(const std::string& folder) const = 0;
  /// Lets a thread (0: the calling one) run on these cores only, and reads that back.
  /// @error `invalid_input`: none of the cores is on-line; `not_found`: no such thread;
  ///        `unavailable`: not permitted; `failed`: fewer cores were granted.
  virtual Status set_affinity(pid_t thread, const std::vector<int>& cpus) = 0;
  /// The core that the calling thread runs on.
  [[nodiscard]] virtual int current_cpu() const = 0;
};

/// The system below `root`: "/" is this one, another folder a copy of one. Affinities and
/// the current core are always those of this system.
[[nodiscard]] std::unique_ptr<LinuxSystem> linux_system(const std::string& root = "/");

}  // namespace flyball
