// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a service manager is told about a flight.

#include <chrono>
#include <memory>

namespace flyball {

/// Tells systemd that the flight has begun and goes on, by the protocol of sd_notify(3), where the
/// environment says that it listens (`NOTIFY_SOCKET`, `WATCHDOG_USEC`); else nothing.
class ServiceNotice {
 public:
  /// Reads the environment; before other threads start.
  ServiceNotice();
  ~ServiceNotice();
  ServiceNotice(const ServiceNotice&) = delete;
  ServiceNotice& operator=(const ServiceNotice&) = delete;

  /// The flight made a step. The first one is told as READY=1, and one is told as WATCHDOG=1 three
  /// times in the interval after which systemd takes the program for dead. Never waits.
  void step();
  /// The flight is over. Its record may take longer to write than systemd waits for a step, and a
  /// program that is killed for that would be started anew and would fly again: `WATCHDOG_USEC`
  /// asks it to wait for as long as it takes. Nothing is told after that.
  void end();

 private:
  struct Manager;
  void tell(const char* what) const;

  std::unique_ptr<Manager> manager_;  ///< Null: nobody listens.
  std::chrono::steady_clock::time_point next_{};
};

}  // namespace flyball
