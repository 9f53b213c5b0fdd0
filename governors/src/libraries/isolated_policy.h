// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Runs code from outside in a process of its own, where it may crash, hang or use up its memory.

#include "flyball/governors/policy.h"
#include "flyball/governors/policy_abilities.h"

#include <functional>
#include <memory>
#include <string>

namespace flyball {

class ChildProcess;
struct AnswerPacket;
struct QuestionPacket;

struct IsolationLimits {
  /// For one answer, host time; far above what a policy may take, because a mission must not
  /// depend on how fast its host is: only who never answers, or nearly, comes so far.
  Duration answer{std::chrono::seconds{2}};
  Duration start{std::chrono::seconds{10}};  ///< For loading and starting.
  std::size_t memory_bytes{256U << 20U};     ///< Beyond what the process has when it begins.
};

/// What a policy declares, learned in a process that has ended since.
struct PolicyDeclaration {
  bool is_confined{};  ///< False where the kernel has no seccomp.
  std::vector<ParameterSpec> parameters{};
};

/// Makes the policy, in the child. @error One sentence.
using PolicyMaker = std::function<Result<std::unique_ptr<Policy>>()>;

/// @error The maker's, or how the process ended.
[[nodiscard]] Result<PolicyDeclaration> declaration_of(const PolicyMaker& make,
                                                       const IsolationLimits& limits);

/// The process is forked by `start` and lives as long as the policy. An answer costs two messages
/// through a socket, some tens of microseconds; nothing allocates here while it has nothing to say.
class IsolatedPolicy final : public Policy, public ChoosesPeriod, public HostsCode {
 public:
  /// @param name  For messages: the file.
  IsolatedPolicy(std::string name,
                 PolicyMaker make,
                 PolicyDeclaration declaration,
                 IsolationLimits limits);
  ~IsolatedPolicy() override;

  [[nodiscard]] std::vector<ParameterSpec> parameters() const override;
  Status start(const Parameters& given,
               const KnobSettings& knobs,
               const BoardModel& board) override;
  [[nodiscard]] std::optional<Duration> period() const override { return period_; }
  [[nodiscard]] Decision decide(const Observation& seen) noexcept override;
  [[nodiscard]] std::string_view trouble() const noexcept override { return trouble_; }
  [[nodiscard]] std::string_view remark() const noexcept override { return remark_; }

 private:
  [[nodiscard]] Decision decision_of(const AnswerPacket& answer) noexcept;

  std::string name_;
  PolicyMaker make_;
  PolicyDeclaration declaration_;
  IsolationLimits limits_;
  KnobSettings knobs_{};
  std::optional<Duration> period_{};
  std::unique_ptr<ChildProcess> process_;
  std::unique_ptr<QuestionPacket> question_;
  std::unique_ptr<AnswerPacket> answer_;
  std::string trouble_{};
  std::string remark_{};
};

}  // namespace flyball
