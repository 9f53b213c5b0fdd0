// SPDX-License-Identifier: BSD-3-Clause
// tested-in: isolated_policy
#include "policy_server.h"

#include "flyball/governors/policy_abilities.h"

#include "confinement.h"
#include "policy_packets.h"
#include <algorithm>
#include <exception>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include <unistd.h>

namespace flyball {

static_assert(std::is_trivially_copyable_v<Observation>, "it is sent as it lies in memory");

namespace {

/// What `work` throws becomes its error.
template <class Work>
auto guarded(const Work& work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::exception& error) {
    return Error{ErrorCode::failed, std::string{"threw: "} + error.what()};
  } catch (...) {
    return Error{ErrorCode::failed, "threw an exception of no known type"};
  }
}

Result<std::unique_ptr<Policy>> started(const PolicyMaker& make,
                                        const Parameters& given,
                                        const KnobSettings& knobs,
                                        const BoardModel& board) {
  return guarded([&]() -> Result<std::unique_ptr<Policy>> {
    auto made = make();
    Status status = made ? (*made)->start(given, knobs, board) : Status{made.error()};
    return status ? std::move(made) : Result<std::unique_ptr<Policy>>{status.error()};
  });
}

/// Sends the first answer, with nothing but an error if there is one.
bool send_opening(const PacketSocket& socket, OpeningPacket opening, const Status& status) {
  opening.ok = status ? 1 : 0;
  if (!status) {
    opening.code = static_cast<std::uint32_t>(status.error().code);
    put(opening.why, status.error().message);
  }
  return socket.send(&opening, sizeof opening);
}

/// Where the kernel cannot, the host is told.
Status confine_to(Confinement how, OpeningPacket* opening) {
  const Confined confined = confine(how);
  opening->is_confined = confined == Confined::yes ? 1 : 0;
  return confined == Confined::failed
             ? Status{Error{ErrorCode::failed, "the kernel refuses to confine its process"}}
             : Status{Done{}};
}

void fill(AnswerPacket& answer,
          Policy& policy,
          const KnobSettings& knobs,
          const Observation& seen) {
  const Decision wished = policy.decide(seen);
  answer.reason = static_cast<std::uint32_t>(wished.reason);
  answer.overflowed = wished.overflowed() ? 1 : 0;
  answer.size = 0;
  for (const auto& [name, value] : wished) {
    std::size_t knob = 0;
    while (knob < knobs.specs().size() && knobs.specs()[knob].name != name) {
      ++knob;
    }
    answer.wishes[answer.size++] = {knob, value};
  }
  const auto* host = dynamic_cast<const HostsCode*>(&policy);
  put(answer.trouble, host != nullptr ? host->trouble() : std::string_view{});
  put(answer.remark, host != nullptr ? host->remark() : std::string_view{});
}

}  // namespace

void declare_policy(const PacketSocket& socket, const PolicyMaker& make) {
  OpeningPacket opening;
  std::vector<ParameterSpec> specs;
  const Status status = guarded([&]() -> Status {
    if (Status confined = confine_to(Confinement::loading, &opening); !confined) {
      return confined;
    }
    auto policy = make();
    if (!policy) {
      return policy.error();
    }
    specs = (*policy)->parameters();
    return Done{};
  });
  // One too many is enough to be refused.
  opening.parameters =
      static_cast<std::uint32_t>(std::min<std::size_t>(specs.size(), most_parameters + 1));
  bool heard = send_opening(socket, opening, status);
  for (std::size_t i = 0; heard && i < std::min<std::size_t>(specs.size(), most_parameters); ++i) {
    const ParameterPacket packet = packed(specs[i]);
    heard = socket.send(&packet, sizeof packet);
  }
}

void serve_policy(const PacketSocket& socket,
                  const PolicyMaker& make,
                  const Parameters& given,
                  const KnobSettings& knobs,
                  const BoardModel& board) {
  OpeningPacket opening;
  std::unique_ptr<Policy> policy;
  const Status status = guarded([&]() -> Status {
    if (Status confined = confine_to(Confinement::loading, &opening); !confined) {
      return confined;
    }
    auto made = started(make, given, knobs, board);
    if (!made) {
      return made.error();
    }
    policy = std::move(*made);
    const auto* chooses = dynamic_cast<const ChoosesPeriod*>(policy.get());
    const auto period = chooses != nullptr ? chooses->period() : std::nullopt;
    opening.period_ns = period ? period->count() : -1;
    return confine_to(Confinement::deciding, &opening);
  });
  if (!send_opening(socket, opening, status) || !status) {
    _exit(0);  // What was loaded has no more to say.
  }
  QuestionPacket question;
  AnswerPacket answer;
  while (socket.receive(&question, sizeof question, Duration{-1}) ==
         PacketSocket::Received::packet) {
    answer.number = question.number;
    fill(answer, *policy, knobs, question.seen);
    if (!socket.send(&answer, sizeof answer)) {
      break;
    }
  }
  _exit(0);
}

}  // namespace flyball
