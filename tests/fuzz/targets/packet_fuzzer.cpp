// SPDX-License-Identifier: BSD-3-Clause
//
// What a policy's process sends: packets that have no fault must be usable.

#include "flyball/runtime/parameters.h"
#include "flyball/runtime/text/printable.h"

#include "input_folder.h"
#include "libraries/policy_packets.h"
#include <cstring>

namespace {

/// Copies as the socket does, and takes what is missing as zeros.
template <class Packet>
Packet received(const std::uint8_t* bytes, std::size_t size) {
  Packet packet;
  std::memset(static_cast<void*>(&packet), 0, sizeof packet);
  std::memcpy(static_cast<void*>(&packet), bytes, std::min(size, sizeof packet));
  return packet;
}

void take_parameters(const std::uint8_t* bytes, std::size_t size) {
  std::vector<flyball::ParameterSpec> specs;
  std::map<std::string, flyball::ParameterValue> given;
  while (size > 0) {
    const auto packet = received<flyball::ParameterPacket>(bytes, size);
    const std::size_t used = std::min(size, sizeof packet);
    if (flyball::fault_of(packet) == nullptr) {
      specs.push_back(flyball::unpacked(packet));
      given[specs.back().name] = specs.back().fallback;
    }
    bytes += used;
    size -= used;
  }
  const auto resolved = flyball::Parameters::resolve("packets", specs, given);
  if (const auto* parameters = std::get_if<flyball::Parameters>(&resolved)) {
    for (const flyball::ParameterSpec& spec : specs) {
      if (std::holds_alternative<double>(spec.fallback)) {
        require(parameters->number(spec.name) >= spec.min, "a value is within its bounds");
      }
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (size == 0) {
    return 0;
  }
  const std::uint8_t kind = *bytes++ % 3;
  --size;
  if (kind == 0) {
    const auto opening = received<flyball::OpeningPacket>(bytes, size);
    if (flyball::fault_of(opening) == nullptr) {
      static_cast<void>(flyball::printable(opening.why.data()));
    }
  } else if (kind == 1) {
    take_parameters(bytes, size);
  } else {
    const auto answer = received<flyball::AnswerPacket>(bytes, size);
    if (flyball::fault_of(answer, answer.number) == nullptr) {
      flyball::Decision decision;
      decision.reason = static_cast<flyball::Reason>(answer.reason);
      require(!flyball::to_string(decision.reason).empty(), "a reason has a name");
      for (std::size_t i = 0; i < answer.size; ++i) {
        decision.set("any", answer.wishes[i].value);
      }
      require(!decision.overflowed(), "it holds as many wishes as a packet has");
    }
  }
  return 0;
}
