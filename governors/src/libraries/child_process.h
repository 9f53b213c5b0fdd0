// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A forked process that is talked to in packets through a socket.

#include "flyball/runtime/result.h"
#include "flyball/runtime/time.h"

#include <functional>
#include <memory>
#include <string>

#include <sys/types.h>

namespace flyball {

/// One end of a socket that keeps packets apart.
class PacketSocket {
 public:
  explicit PacketSocket(int descriptor) : descriptor_{descriptor} {}
  /// False when the other side has gone.
  [[nodiscard]] bool send(const void* packet, std::size_t size) const noexcept;
  enum class Received { packet, ended, late, of_other_size };
  /// Waits for one packet of `size` bytes; a negative limit: for ever. A packet `of_other_size` is
  /// lost.
  [[nodiscard]] Received receive(void* packet, std::size_t size, Duration limit) const noexcept;
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

/// Runs `work` in a copy of this process. The copy ignores Ctrl-C (its parent decides), ends with
/// its parent and takes its own children along, has none of the parent's files, gains no
/// privileges, writes no file, and what it prints goes nowhere.
class ChildProcess {
 public:
  /// @param memory_bytes  That it may take beyond what it has when it begins.
  /// @error `failed` when the system refuses another process.
  static Result<std::unique_ptr<ChildProcess>> fork(
      std::size_t memory_bytes, const std::function<void(const PacketSocket&)>& work);
  ChildProcess(pid_t id, int descriptor) : id_{id}, socket_{descriptor} {}
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  /// Ends it at once.
  ~ChildProcess();

  [[nodiscard]] const PacketSocket& socket() const { return socket_; }
  /// Ends it if it still runs; how it ended, as the end of a sentence: `was ended by signal 11
  /// (Segmentation fault)`.
  std::string end();

 private:
  pid_t id_;  ///< 0: it has been waited for.
  PacketSocket socket_;
  std::string how_{};
};

}  // namespace flyball
