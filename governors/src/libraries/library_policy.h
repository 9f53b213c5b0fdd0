// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The host's side of plugin_abi.h.

#include "flyball/governors/plugin_abi.h"
#include "flyball/governors/policy.h"
#include "flyball/governors/policy_abilities.h"
#include "flyball/runtime/random.h"

#include <memory>
#include <string>
#include <vector>

namespace flyball {

/// A policy in a shared library, called in this process: what it breaks, it breaks here
/// (isolated_policy.h).
class LibraryPolicy final : public Policy, public ChoosesPeriod, public HostsCode {
 public:
  /// @param seed  Of the random stream that the library draws from.
  /// @error `not_found`, or `invalid_input` with what the file lacks.
  static Result<std::unique_ptr<Policy>> open(const std::string& path, std::uint64_t seed);
  ~LibraryPolicy() override;

  [[nodiscard]] std::vector<ParameterSpec> parameters() const override;
  Status start(const Parameters& given,
               const KnobSettings& knobs,
               const BoardModel& board) override;
  [[nodiscard]] std::optional<Duration> period() const override { return period_; }
  [[nodiscard]] Decision decide(const Observation& seen) noexcept override;
  [[nodiscard]] std::string_view trouble() const noexcept override { return trouble_; }
  [[nodiscard]] std::string_view remark() const noexcept override { return remark_; }

 private:
  struct Unload {
    void operator()(void* library) const;
  };
  using Library = std::unique_ptr<void, Unload>;
  LibraryPolicy(std::string path, Library library, const FlyballPolicy& policy, std::uint64_t seed);
  Status ask_period();
  [[nodiscard]] Decision decision_of(const FlyballDecision& answer) const noexcept;

  std::string path_;
  Library library_;
  FlyballPolicy policy_;
  FlyballHost host_{};
  RandomStream random_;
  std::uint64_t seed_;
  MissionTime now_{};
  KnobSettings knobs_{};
  void* state_{};
  std::optional<Duration> period_{};
  std::string trouble_{};
  std::string remark_{};
};

}  // namespace flyball
