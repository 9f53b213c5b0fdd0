// SPDX-License-Identifier: BSD-3-Clause
//
// A library whose process sends the host packets of its own: good ones, each exclusive-or'ed with
// noise that fuzz_inputs.py writes into the finished library behind the marker.

#include "flyball/governors/plugin_abi.h"

#include "libraries/policy_packets.h"
#include <cstdint>
#include <cstring>

#include <sys/socket.h>
#include <unistd.h>

namespace {

using namespace flyball;

enum Moment : std::uint8_t { when_declared, when_started, when_asked };

/// Volatile, so that no compiler believes the zeros that it sees here.
struct Noise {
  char marker[24];
  std::uint8_t moment;    ///< A `Moment`.
  std::uint8_t cut_off;   ///< Bytes that the packet lacks.
  std::uint8_t repeated;  ///< How often it is sent again.
  std::uint8_t returns;   ///< 0: the process waits after it, so that nothing else follows.
  std::uint8_t bytes[4096];
};
volatile Noise noise{"FLYBALL PACKETS' NOISE:", when_asked, 0, 0, 1, {}};

/// To whatever the process has open: one of them leads to the host.
template <class Packet>
void send_noisy(const Packet& packet, std::size_t noise_from) {
  static_assert(sizeof(Packet) + 600 < sizeof Noise::bytes);
  std::uint8_t bytes[sizeof packet];
  std::memcpy(bytes, &packet, sizeof packet);
  for (std::size_t i = 0; i < sizeof packet; ++i) {
    bytes[i] ^= noise.bytes[noise_from + i];
  }
  for (int times = 0; times <= noise.repeated; ++times) {
    for (int file = 3; file < 16; ++file) {
      const auto sent = send(file, bytes, sizeof packet - noise.cut_off, MSG_NOSIGNAL);
      static_cast<void>(sent);
    }
  }
}

void finish() {
  if (noise.returns == 0) {
    pause();
  }
}

void send_opening(std::uint32_t parameters) {
  OpeningPacket opening;
  opening.ok = 1;
  opening.is_confined = 1;
  opening.parameters = parameters;
  send_noisy(opening, 0);
}

void* create(const FlyballHost*, const FlyballStart*) {
  static std::uint64_t questions;
  if (noise.moment == when_started) {
    send_opening(0);
    finish();
  }
  return &questions;
}

std::int32_t decide(void* questions, const FlyballObservation*, FlyballDecision*) {
  const std::uint64_t number = ++*static_cast<std::uint64_t*>(questions);
  if (noise.moment == when_asked) {
    AnswerPacket answer;
    answer.number = number;
    answer.size = 1;
    answer.wishes[0] = {0, 0.15};
    send_noisy(answer, 0);
    finish();
  }
  return 0;
}

FlyballPolicy policy{sizeof policy,
                     flyball_abi_version,
                     "packets",
                     "Sends packets of its own",
                     nullptr,
                     0,
                     0,
                     create,
                     [](void*) {},
                     decide,
                     nullptr};

}  // namespace

extern "C" const FlyballPolicy* flyball_policy() {
  if (noise.moment == when_declared) {
    send_opening(1);
    flyball::ParameterSpec number;
    number.name = "one";
    number.fallback = 0.5;
    number.max = 1.0;
    send_noisy(flyball::packed(number), sizeof(OpeningPacket));
    finish();
  }
  return &policy;
}
