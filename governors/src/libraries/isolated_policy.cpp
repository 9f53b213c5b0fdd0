// SPDX-License-Identifier: BSD-3-Clause
#include "isolated_policy.h"

#include "flyball/governors/policy_period.h"
#include "flyball/runtime/text/printable.h"

#include "child_process.h"
#include "policy_packets.h"
#include "policy_server.h"
#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

namespace flyball {

namespace {

std::string seconds_text(Duration limit) {
  std::array<char, 32> text{};
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg)
  std::snprintf(text.data(), text.size(), "%g s", to_seconds(limit));
  return text.data();
}

/// Why nothing came; the process is ended.
std::string silence(ChildProcess& child, PacketSocket::Received how, Duration limit) {
  const std::string end = child.end();
  switch (how) {
    case PacketSocket::Received::late:
      return "did not answer within " + seconds_text(limit) + "; its process was ended";
    case PacketSocket::Received::of_other_size:
      return "sent a packet of another size than was agreed on; its process was ended";
    case PacketSocket::Received::ended:
    case PacketSocket::Received::packet:
      break;
  }
  return "its process " + end;
}

/// A packet without a fault; nothing: `trouble` says why, and the process is ended.
template <class Packet, class... Expected>
bool receive(ChildProcess& child,
             Packet* packet,
             Duration limit,
             std::string* trouble,
             Expected... expected) {
  const auto received = child.socket().receive(packet, sizeof *packet, limit);
  if (received != PacketSocket::Received::packet) {
    *trouble = silence(child, received, limit);
    return false;
  }
  if (const char* fault = fault_of(*packet, expected...)) {
    child.end();
    *trouble = std::string{fault} + "; its process was ended";
    return false;
  }
  return true;
}

/// The policy's own words after its name, once.
Error named(const std::string& name, ErrorCode code, const std::string& message) {
  return {code, message.find(name) == std::string::npos ? name + ": " + message : message};
}

}  // namespace

Result<PolicyDeclaration> declaration_of(const PolicyMaker& make, const IsolationLimits& limits) {
  auto child = ChildProcess::fork(
      limits.memory_bytes, [&make](const PacketSocket& socket) { declare_policy(socket, make); });
  if (!child) {
    return child.error();
  }
  OpeningPacket opening;
  std::string trouble;
  const auto until = HostTime::clock::now() + limits.start;
  bool heard = receive(**child, &opening, limits.start, &trouble);
  if (heard && opening.ok == 0) {
    return Error{static_cast<ErrorCode>(opening.code), printable(opening.why.data())};
  }
  PolicyDeclaration declaration;
  declaration.is_confined = opening.is_confined != 0;
  for (std::uint32_t i = 0; heard && i < opening.parameters; ++i) {
    ParameterPacket packet;
    const Duration left = until - HostTime::clock::now();
    heard = receive(**child, &packet, std::max(left, Duration{0}), &trouble);
    if (heard) {
      declaration.parameters.push_back(unpacked(packet));
    }
  }
  if (!heard) {
    return Error{ErrorCode::failed, trouble};
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
      question_{std::make_unique<QuestionPacket>()},
      answer_{std::make_unique<AnswerPacket>()} {}

IsolatedPolicy::~IsolatedPolicy() = default;

std::vector<ParameterSpec> IsolatedPolicy::parameters() const {
  return declaration_.parameters;
}

Status IsolatedPolicy::start(const Parameters& given,
                             const KnobSettings& knobs,
                             const BoardModel& board) {
  knobs_ = knobs;
  process_.reset();
  auto child = ChildProcess::fork(limits_.memory_bytes, [&](const PacketSocket& socket) {
    serve_policy(socket, make_, given, knobs, board);
  });
  if (!child) {
    return child.error();
  }
  OpeningPacket opening;
  std::string trouble;
  if (!receive(**child, &opening, limits_.start, &trouble)) {
    return named(name_, ErrorCode::failed, trouble);
  }
  if (opening.ok == 0) {
    return named(name_, static_cast<ErrorCode>(opening.code), printable(opening.why.data()));
  }
  period_ = opening.period_ns >= 0 ? std::optional{Duration{opening.period_ns}} : std::nullopt;
  if (period_) {
    if (const auto fault = fault_of_period(to_seconds(*period_)); fault[0] != '\0') {
      return Error{ErrorCode::invalid_input, name_ + ": " + fault.data()};
    }
  }
  process_ = std::move(*child);
  return Done{};
}

Decision IsolatedPolicy::decide(const Observation& seen) noexcept {
  remark_.clear();
  if (process_ == nullptr) {
    return {};  // `trouble_` says why since then.
  }
  trouble_.clear();
  ++question_->number;
  question_->seen = seen;
  // Who has ended cannot be asked, but what it sent before tells how it ended.
  static_cast<void>(process_->socket().send(question_.get(), sizeof *question_));
  std::string trouble;
  if (!receive(*process_, answer_.get(), limits_.answer, &trouble, question_->number)) {
    trouble_ = name_ + ": " + trouble;
    process_.reset();
    return {};
  }
  return decision_of(*answer_);
}

Decision IsolatedPolicy::decision_of(const AnswerPacket& answer) noexcept {
  constexpr std::string_view nowhere = "(no such place)";
  Decision decision;
  decision.reason = static_cast<Reason>(answer.reason);
  for (std::size_t i = 0; i < answer.size; ++i) {
    const auto& [knob, value] = answer.wishes[i];
    const bool exists = knob < knobs_.specs().size();
    decision.set(exists ? std::string_view{knobs_.specs()[knob].name} : nowhere, value);
  }
  while (answer.overflowed != 0 && !decision.overflowed()) {
    decision.set(nowhere, 0.0);
  }
  if (answer.trouble[0] != '\0') {
    trouble_ = printable(answer.trouble.data());
  }
  remark_.clear();
  if (answer.remark[0] != '\0') {
    remark_ = printable(answer.remark.data());
  }
  return decision;
}

}  // namespace flyball
