// SPDX-License-Identifier: BSD-3-Clause
#include "isolated_policy.h"

#include "child_process.h"
#include "policy_packets.h"
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <exception>
#include <type_traits>
#include <utility>

namespace flyball {

static_assert(std::is_trivially_copyable_v<Observation>, "it is sent as it lies in memory");

namespace {

/// The first answer of a process: how many parameters follow, or why not.
struct OpeningPacket {
  bool ok{};
  ErrorCode code{ErrorCode::failed};
  Text why{};
  std::size_t parameters{};
  std::int64_t period_ns{-1};
};

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
                                        const KnobSettings& knobs) {
  return guarded([&]() -> Result<std::unique_ptr<Policy>> {
    auto made = make();
    Status status = made ? (*made)->start(given, knobs) : Status{made.error()};
    return status ? std::move(made) : Result<std::unique_ptr<Policy>>{status.error()};
  });
}

void declare(const PolicyMaker& make, const PacketSocket& socket) {
  const auto specs = guarded([&make]() -> Result<std::vector<ParameterSpec>> {
    auto policy = make();
    return policy ? Result<std::vector<ParameterSpec>>{(*policy)->parameters()}
                  : Result<std::vector<ParameterSpec>>{policy.error()};
  });
  OpeningPacket opening;
  opening.ok = specs.ok();
  if (!specs) {
    opening.code = specs.error().code;
    put(opening.why, specs.error().message);
  }
  opening.parameters = specs ? specs->size() : 0;
  bool heard = socket.send(&opening, sizeof opening);
  for (std::size_t i = 0; heard && i < opening.parameters; ++i) {
    const ParameterPacket packet = packed((*specs)[i]);
    heard = socket.send(&packet, sizeof packet);
  }
}

std::string seconds_text(Duration limit) {
  std::array<char, 32> text{};
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg)
  std::snprintf(text.data(), text.size(), "%g s", to_seconds(limit));
  return text.data();
}

/// Why nothing came; the process is ended.
std::string silence(ChildProcess& child, PacketSocket::Received how, Duration limit) {
  if (how == PacketSocket::Received::late) {
    child.end();
    return "did not answer within " + seconds_text(limit) + "; its process was ended";
  }
  return "its process " + child.end();
}

}  // namespace

/// A decision as it travels: knobs by their place.
struct IsolatedPolicy::Answer {
  struct Wish {
    std::size_t knob{};
    double value{};
  };
  Reason reason{Reason::fixed};
  bool overflowed{};
  std::size_t size{};
  std::array<Wish, Decision::capacity> wishes{};
  Text unknown{};  ///< Name of the first wish's knob that does not exist.
  Text trouble{};
  Text remark{};
};

class IsolatedPolicy::Process {
 public:
  explicit Process(std::unique_ptr<ChildProcess> child) : child_{std::move(child)} {}
  [[nodiscard]] ChildProcess& child() { return *child_; }
  [[nodiscard]] const PacketSocket& socket() const { return child_->socket(); }

  /// The child's whole life: start, then an answer for each observation.
  static void serve(const PacketSocket& socket,
                    const PolicyMaker& make,
                    const Parameters& given,
                    const KnobSettings& knobs) {
    auto policy = started(make, given, knobs);
    OpeningPacket opening;
    opening.ok = policy.ok();
    if (!policy) {
      opening.code = policy.error().code;
      put(opening.why, policy.error().message);
    }
    const auto period = policy ? (*policy)->period() : std::nullopt;
    opening.period_ns = period ? period->count() : -1;
    if (!socket.send(&opening, sizeof opening) || !policy) {
      return;
    }
    Observation seen;
    Answer answer;
    while (socket.receive(&seen, sizeof seen, Duration{-1}) == PacketSocket::Received::packet) {
      fill(answer, **policy, knobs, seen);
      if (!socket.send(&answer, sizeof answer)) {
        return;
      }
    }
  }

 private:
  static void fill(Answer& answer,
                   Policy& policy,
                   const KnobSettings& knobs,
                   const Observation& seen) {
    const Decision wished = policy.decide(seen);
    answer.reason = wished.reason;
    answer.overflowed = wished.overflowed();
    answer.size = 0;
    for (const auto& [name, value] : wished) {
      std::size_t knob = 0;
      while (knob < knobs.specs().size() && knobs.specs()[knob].name != name) {
        ++knob;
      }
      if (knob == knobs.specs().size()) {
        put(answer.unknown, name);
      }
      answer.wishes[answer.size++] = {knob, value};
    }
    put(answer.trouble, policy.trouble());
    put(answer.remark, policy.remark());
  }

  std::unique_ptr<ChildProcess> child_;
};

Result<PolicyDeclaration> declaration_of(const PolicyMaker& make, const IsolationLimits& limits) {
  auto child = ChildProcess::fork(limits.memory_bytes,
                                  [&make](const PacketSocket& socket) { declare(make, socket); });
  if (!child) {
    return child.error();
  }
  const PacketSocket& socket = (*child)->socket();
  OpeningPacket opening;
  auto received = socket.receive(&opening, sizeof opening, limits.start);
  if (received == PacketSocket::Received::packet && !opening.ok) {
    return Error{opening.code, opening.why.data()};
  }
  PolicyDeclaration declaration;
  for (std::size_t i = 0; i < opening.parameters; ++i) {
    ParameterPacket packet;
    received = socket.receive(&packet, sizeof packet, limits.start);
    if (received != PacketSocket::Received::packet) {
      break;
    }
    declaration.parameters.push_back(unpacked(packet));
  }
  if (received != PacketSocket::Received::packet) {
    return Error{ErrorCode::failed, silence(**child, received, limits.start)};
  }
  return declaration;
}

IsolatedPolicy::IsolatedPolicy(std::string name,
                               PolicyMaker make,
                               PolicyDeclaration declaration,
                               IsolationLimits limits)
    : name_{std::move(name)},
      make_{std::move(make)},
      declaration_{std::move(declaration)},
      limits_{limits},
      answer_{std::make_unique<Answer>()} {}

IsolatedPolicy::~IsolatedPolicy() = default;

std::vector<ParameterSpec> IsolatedPolicy::parameters() const {
  return declaration_.parameters;
}

Status IsolatedPolicy::start(const Parameters& given, const KnobSettings& knobs) {
  knobs_ = knobs;
  process_.reset();
  auto child = ChildProcess::fork(limits_.memory_bytes, [&](const PacketSocket& socket) {
    Process::serve(socket, make_, given, knobs);
  });
  if (!child) {
    return child.error();
  }
  OpeningPacket opening;
  const auto received = (*child)->socket().receive(&opening, sizeof opening, limits_.start);
  if (received != PacketSocket::Received::packet) {
    return Error{ErrorCode::failed, name_ + ": " + silence(**child, received, limits_.start)};
  }
  if (!opening.ok) {
    return Error{opening.code, opening.why.data()};
  }
  period_ = opening.period_ns > 0 ? std::optional{Duration{opening.period_ns}} : std::nullopt;
  process_ = std::make_unique<Process>(std::move(*child));
  return Done{};
}

Decision IsolatedPolicy::decide(const Observation& seen) noexcept {
  remark_ = {};
  if (process_ == nullptr) {
    return {};  // `trouble_` says why since then.
  }
  trouble_.clear();
  auto received = PacketSocket::Received::ended;
  if (process_->socket().send(&seen, sizeof seen)) {
    received = process_->socket().receive(answer_.get(), sizeof *answer_, limits_.answer);
  }
  if (received != PacketSocket::Received::packet) {
    trouble_ = name_ + ": " + silence(process_->child(), received, limits_.answer);
    process_.reset();
    return {};
  }
  return decision_of(*answer_);
}

Decision IsolatedPolicy::decision_of(const Answer& answer) noexcept {
  Decision decision;
  decision.reason = answer.reason;
  for (std::size_t i = 0; i < std::min(answer.size, Decision::capacity); ++i) {
    const auto& [knob, value] = answer.wishes[i];
    const bool exists = knob < knobs_.specs().size();
    decision.set(exists ? std::string_view{knobs_.specs()[knob].name} : answer.unknown.data(),
                 value);
  }
  while (answer.overflowed && !decision.overflowed()) {
    decision.set(answer.unknown.data(), 0.0);
  }
  if (answer.trouble[0] != '\0') {
    trouble_ = answer.trouble.data();
  }
  remark_ = answer.remark.data();
  return decision;
}

}  // namespace flyball
