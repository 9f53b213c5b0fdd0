// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A second modeled computer that is not on board, and the link to it.

#include "flyball/runtime/platform.h"
#include "flyball/runtime/time.h"

#include <cstdint>
#include <memory>

namespace flyball {

/// One direction of a link. Messages are cut into packets and sent one after the other; what is
/// lost of a message is sent again before the next one is begun, as over one TCP connection.
struct LinkModel {
  double bandwidth_bit_s{1e9};
  Duration latency{};  ///< One way, of each message, beside the time that its bytes take.
  Duration jitter{};   ///< A message takes up to so much longer, evenly distributed.
  double loss{};       ///< Share of the packets that do not arrive, independently, 0..1.
  Duration timeout{};  ///< After so long without an answer lost packets are sent again.
};

/// The edge computer never changes its clock and grants all its cores to this graph.
struct EdgeModel {
  /// Its prices of work. Owners: this, and the executor.
  std::shared_ptr<const Platform> platform{};
  OperatingPoint point{};
  double speed_factor{1.0};  ///< It computes so many times faster than the platform says.
  LinkModel link{};          ///< Of both directions, which do not disturb each other.
  std::uint64_t seed{1};     ///< Of jitter and loss.
};

/// How long devices beside the cores have worked since the start [s].
struct DeviceUse {
  double gpu_s{};
  double sending_s{};    ///< The radio sent.
  double receiving_s{};  ///< The radio received.
};

}  // namespace flyball
