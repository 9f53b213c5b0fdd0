// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A real autopilot, or one in the loop, that flies the vehicle: PX4 or ArduPilot by MAVLink 2.

#include "flyball/flight/vehicle_port.h"
#include "flyball/runtime/realtime/priority_mutex.h"
#include "flyball/runtime/result.h"
#include "flyball/runtime/time.h"
#include "flyball/vehicles/byte_stream.h"
#include "flyball/vehicles/clock_offset.h"
#include "flyball/vehicles/flight_start.h"
#include "flyball/vehicles/vehicle_report.h"

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace flyball {

class OffboardControl;  // see apps/vehicles/offboard_control.h

/// Owned and called by one thread. After `connect` mission time begins at 0.
class AutopilotLink {
 public:
  /// @param tell   Called, by whoever calls the link, with one sentence for each thing that a
  ///               person should know: warnings of the autopilot, silence, limits that are set
  ///               unsafely, why a flight cannot go on.
  /// @param clock  The time since any moment. With it, a thread of the link's own exchanges bytes
  ///               each 10 ms, so that set-points keep coming while the caller computes; a caller
  ///               that is silent for 5 s has its vehicle landed. Empty: bytes are exchanged in the
  ///               calls below only, at the times that they name, which may be virtual.
  AutopilotLink(std::unique_ptr<ByteStream> stream,
                std::function<void(const std::string&)> tell,
                std::function<Duration()> clock = {});
  ~AutopilotLink();
  AutopilotLink(const AutopilotLink&) = delete;
  AutopilotLink& operator=(const AutopilotLink&) = delete;

  /// Waits for the autopilot and for what it has to send, up to a minute.
  /// @param stop  Asked often; true ends the wait. May be empty.
  /// @error `unavailable`: what was not heard, not answered or denied; or stopped.
  [[nodiscard]] Status connect(const FlightStart& start, const std::function<bool()>& stop);

  /// The mission has come to `now`. Without a clock it has to say so each 20 ms: what has come is
  /// received then, and what is due is sent. @pre `connect` succeeded, for this and all below.
  void step(MissionTime now);
  /// Ready to arm is the autopilot's affair: a refusal is a `failure`. A payload it cannot release.
  void obey(const FlightCommand& command);
  /// Flown while the vehicle is up, from the end of its take-off on. Not finite: refused.
  void follow(const Setpoint& setpoint);

  /// At the time of the last step.
  [[nodiscard]] ReportedMotion motion() const;
  /// Empty where nobody measures it, or has not said so for 2 s.
  [[nodiscard]] std::optional<ReportedBattery> battery() const;
  [[nodiscard]] FlightStatus status() const;
  [[nodiscard]] bool may_touch_ground() const;
  /// One sentence when the flight cannot go on: a command was refused or not answered, or somebody
  /// took over. Empty otherwise.
  [[nodiscard]] std::string failure() const;

  /// Ends a flight early: asks to land, if the vehicle is up and nobody else flies it, without
  /// waiting.
  void begin_landing();
  /// Waits until it stands disarmed, or somebody took over, or it took two minutes. Then Flyball
  /// falls silent.
  /// @param turned  Called often, for whoever has to know that the program lives. May be empty.
  void await_landing(const std::function<bool()>& turned);

 private:
  using Lock = std::lock_guard<PriorityMutex>;

  // With the lock.
  void exchange(Duration now);
  void watch_caller();

  // Without it.
  void run();
  void end_thread();
  /// Lets 10 ms pass, and passes on what they brought.
  void wait();
  void tell_news();
  bool has_connected();
  void insist_on_landing();
  [[nodiscard]] bool is_in_charge() const;
  [[nodiscard]] Duration now() const;

  std::unique_ptr<ByteStream> stream_;
  std::function<void(const std::string&)> tell_;
  std::function<Duration()> clock_;
  Duration clock_began_{};
  std::vector<int> cpus_;  ///< For the thread: the caller may be bound to one of them later.

  mutable PriorityMutex mutex_{};  ///< Guards what follows, and the stream but for its `wait`.
  std::unique_ptr<OffboardControl> control_{};
  Duration now_{};     ///< Since the link was made, at the last exchange.
  Duration asked_{};   ///< When the mission was where its last step says.
  Duration called_{};  ///< When the caller was heard last.
  ClockOffset mission_{};
  Duration next_landing_try_{};
  bool is_broken_{};   ///< The stream said so, and people were told.
  bool has_failed_{};  ///< The flight, and people were told.
  std::vector<std::string> news_{};
  std::vector<std::uint8_t> received_{};

  std::atomic<bool> is_ending_{false};
  std::thread thread_{};
};

}  // namespace flyball
