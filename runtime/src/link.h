// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// One direction of the link between vehicle and edge computer.

#include "flyball/runtime/edge.h"
#include "flyball/runtime/random.h"

#include <cstdint>
#include <deque>
#include <string_view>

namespace flyball {

class Link {
 public:
  /// @param direction  Names the random stream: the two directions draw independently.
  Link(const LinkModel& model, std::uint64_t seed, std::string_view direction);

  /// Sends a message behind those that were sent before. Calls come in the order of time.
  ///
  /// @param bytes  Of the message; one packet is sent at least.
  /// @return       When its last packet arrives.
  MissionTime send(MissionTime now, double bytes);

  /// For how long packets have been on the air until `now` [s]. @pre `now` does not decrease.
  [[nodiscard]] double on_air_s(MissionTime now);

 private:
  /// A message from its first packet to its last. While the sender waits for a time-out nothing is
  /// on the air; its share is spread evenly.
  struct Transfer {
    MissionTime begin{};
    MissionTime end{};
    double on_air_s{};
  };
  /// Packets of `count` that are lost.
  [[nodiscard]] std::uint64_t lost_of(std::uint64_t count);

  LinkModel model_;
  RandomStream random_;
  MissionTime free_at_{};
  std::deque<Transfer> transfers_{};  ///< That may not be over yet.
  double over_s_{};                   ///< On the air in those that are.
};

}  // namespace flyball
