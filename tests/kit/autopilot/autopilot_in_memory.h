// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A line to a stand-in autopilot that needs neither sockets nor time of the host.

#include "flyball/scenario/files.h"
#include "flyball/vehicles/byte_stream.h"

#include "stand_in_autopilot.h"
#include <memory>
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

}  // namespace flyball::kit
