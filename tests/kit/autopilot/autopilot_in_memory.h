// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A line to a stand-in autopilot that needs neither sockets nor time of the host.

#include "flyball/scenario/files.h"
#include "flyball/vehicles/byte_stream.h"

#include "stand_in_autopilot.h"
#include <condition_variable>
#include <memory>
#include <mutex>
#include <utility>

namespace flyball::kit {

inline Airframe shipped_airframe(const std::string& name = "matrice_100") {
  const auto file = find_shipped("airframes", name);
  FLYBALL_ASSERT(file.ok(), "%s", file.error().message.c_str());
  auto airframe = load_airframe(*file);
  FLYBALL_ASSERT(airframe.ok(), "%s", airframe.error().message.c_str());
  return *airframe;
}

/// The other end moves on while this one waits; in flight, whoever has the time moves it.
class MemoryStream final : public ByteStream {
 public:
  /// @param autopilot  Outlives the stream.
  explicit MemoryStream(StandInAutopilot& autopilot) : autopilot_{autopilot} {}

  Status send(const std::vector<std::uint8_t>& bytes) override {
    autopilot_.hear(bytes);
    return Done{};
  }
  Status receive(std::vector<std::uint8_t>& bytes) override {
    const std::vector<std::uint8_t> sent = autopilot_.take_output();
    bytes.insert(bytes.end(), sent.begin(), sent.end());
    return Done{};
  }
  Duration wait(Duration at_most) override {
    autopilot_.step(at_most);
    return at_most;
  }

 private:
  StandInAutopilot& autopilot_;
};

/// For a link with a thread of its own: a clock that stands still until a test lets it go on, so
/// that nothing depends on how fast the host is. Then the link's thread rests, and the test may
/// look at the autopilot.
class PacedAutopilot {
 public:
  explicit PacedAutopilot(const StandInRules& rules) : autopilot{rules, shipped_airframe()} {}

  /// Time goes on by itself, as fast as the link's thread, until it is stopped.
  void run_freely(bool is_free) {
    std::unique_lock lock{mutex_};
    is_free_ = is_free;
    left_ = Duration::zero();
    news_.notify_all();
    news_.wait(lock, [this] { return is_free_ || rests_; });
  }
  /// Lets so much time pass, in which the link does what it does. @pre Time does not run freely.
  void let_pass(Duration by) {
    std::unique_lock lock{mutex_};
    left_ = by;
    rests_ = false;
    news_.notify_all();
    news_.wait(lock, [this] { return rests_; });
  }
  [[nodiscard]] Duration now() const {
    const std::lock_guard lock{mutex_};
    return now_;
  }

  class Stream final : public ByteStream {
   public:
    explicit Stream(PacedAutopilot& paced) : paced_{paced}, line_{paced.autopilot} {}
    Status send(const std::vector<std::uint8_t>& bytes) override { return line_.send(bytes); }
    Status receive(std::vector<std::uint8_t>& bytes) override { return line_.receive(bytes); }
    Duration wait(Duration at_most) override {
      paced_.rest(at_most);
      return line_.wait(at_most);
    }

   private:
    PacedAutopilot& paced_;
    MemoryStream line_;
  };

  StandInAutopilot autopilot;

 private:
  void rest(Duration at_most) {
    std::unique_lock lock{mutex_};
    rests_ = left_ < at_most;
    news_.notify_all();
    news_.wait(lock, [&] { return is_free_ || left_ >= at_most; });
    rests_ = false;
    left_ -= is_free_ ? Duration::zero() : at_most;
    now_ += at_most;
  }

  mutable std::mutex mutex_{};
  std::condition_variable news_{};
  Duration now_{};
  Duration left_{};
  bool is_free_{true};
  bool rests_{};
};

}  // namespace flyball::kit
