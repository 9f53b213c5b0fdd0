// SPDX-License-Identifier: BSD-3-Clause
#include "link.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

// Ethernet's and Wi-Fi's largest payload of 1500 bytes less 40 for IP and TCP.
constexpr double packet_bytes = 1460.0;
// What each packet adds on the way: Ethernet's frame (38 bytes) and the headers of IP and TCP.
constexpr double header_bytes = 78.0;
// So often lost packets are sent again; then they count as arrived, so that a link that loses all
// delays a message by minutes and does not stop the simulation.
constexpr int most_rounds = 1000;

}  // namespace

Link::Link(const LinkModel& model, std::uint64_t seed, std::string_view direction)
    : model_{model}, random_{seed, direction} {
  FLYBALL_ASSERT(model.bandwidth_bit_s > 0.0 && model.loss >= 0.0 && model.loss <= 1.0,
                 "bandwidth_bit_s=%g, loss=%g", model.bandwidth_bit_s, model.loss);
}

std::uint64_t Link::lost_of(std::uint64_t count) {
  std::uint64_t lost = 0;
  for (std::uint64_t i = 0; model_.loss > 0.0 && i < count; ++i) {
    lost += random_.uniform() < model_.loss ? 1 : 0;
  }
  return lost;
}

MissionTime Link::send(MissionTime now, double bytes) {
  const double packets = std::max(1.0, std::ceil(bytes / packet_bytes));
  const double first_s = 8.0 * (bytes + packets * header_bytes) / model_.bandwidth_bit_s;
  const double packet_s = first_s / packets;  // In the mean: which one was lost is not drawn.
  double on_air_s = first_s;
  double waiting_s = 0.0;
  std::uint64_t lost = lost_of(static_cast<std::uint64_t>(packets));
  for (int round = 0; lost > 0 && round < most_rounds; ++round) {
    waiting_s += to_seconds(model_.timeout);
    on_air_s += static_cast<double>(lost) * packet_s;
    lost = lost_of(lost);
  }
  const double jitter_s = to_seconds(model_.jitter) * random_.uniform();
  const MissionTime begin = std::max(now, free_at_);
  free_at_ = begin + from_seconds(on_air_s + waiting_s);
  transfers_.push_back({begin, free_at_, on_air_s});
  return free_at_ + model_.latency + from_seconds(jitter_s);
}

double Link::on_air_s(MissionTime now) {
  while (!transfers_.empty() && transfers_.front().end <= now) {
    over_s_ += transfers_.front().on_air_s;
    transfers_.pop_front();
  }
  double sum_s = over_s_;
  for (const Transfer& one : transfers_) {
    if (one.begin < now) {
      sum_s += one.on_air_s * ratio(now - one.begin, one.end - one.begin);
    }
  }
  return sum_s;
}

}  // namespace flyball
