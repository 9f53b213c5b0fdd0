// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// One job whose messages were handed to it when it began.

#include "flyball/runtime/assert.h"
#include "flyball/runtime/executor.h"

#include "inbox.h"
#include <algorithm>
#include <atomic>
#include <functional>
#include <utility>
#include <vector>

namespace flyball {

/// What a job may touch: all of it is the job's own while it runs, so that the body needs no lock.
/// A node keeps its job for the next one: nothing is allocated once the largest has been seen.
class NodeJob final : public JobContext {
 public:
  /// `spec` outlives the job.
  NodeJob(const NodeSpec& spec, std::shared_ptr<MessagePool> pool)
      : JobContext{std::move(pool)}, spec_{spec} {}

  /// When it began: what a job computes is a function of what it was handed.
  [[nodiscard]] MissionTime now() const override { return record.started; }
  [[nodiscard]] MissionTime released() const override { return record.released; }
  [[nodiscard]] bool should_stop() const override {
    const bool is_told = is_told_to_stop.load(std::memory_order_relaxed) || asked_ == stop_after;
    asked_ += is_told ? 0 : 1;
    return is_told;
  }
  void at_end(std::function<void(MissionTime)> action) override {
    last_actions.push_back(std::move(action));
  }

  /// Forgets the last job.
  void renew() {
    std::vector<MessageVersion> room = std::move(record.reads);
    record = {};
    record.reads = std::move(room);
    reads_.clear();
    outputs.clear();
    last_actions.clear();
    is_told_to_stop = false;
    has_taken_trigger = false;
    asked_ = 0;
    stop_after = never;
  }
  /// What the body asked for goes to the record.
  void note_questions() {
    record.reads = reads_;
    record.questions_before_stop = asked_;
  }

  static constexpr std::uint64_t never = ~std::uint64_t{};
  JobRecord record{};
  std::vector<Inbox> unread{};             ///< The trigger's first, if a message is the trigger.
  std::vector<VersionedMessage> newest{};  ///< Of the same topics.
  std::vector<std::pair<int, Message>> outputs{};
  std::vector<std::function<void(MissionTime)>> last_actions{};
  std::atomic<bool> is_told_to_stop{};  ///< Another thread may set it.
  /// A replayed job is told so after this many questions.
  std::uint64_t stop_after{never};
  bool has_taken_trigger{};

 protected:
  [[nodiscard]] Message read(int topic) const override {
    const VersionedMessage& found = newest[place_of(topic)];
    reads_.push_back({topic, found.version});
    return found.message;
  }
  [[nodiscard]] Message pop(int topic) override {
    const std::size_t place = place_of(topic);
    has_taken_trigger = has_taken_trigger || place == 0;
    VersionedMessage taken = unread[place].take();
    reads_.push_back({topic, taken.version});
    return std::move(taken.message);
  }
  void push(int topic, Message message) override {
    FLYBALL_ASSERT(std::count(spec_.writes.begin(), spec_.writes.end(), topic) == 1,
                   "node %s does not declare that it writes topic %d", spec_.name.c_str(), topic);
    outputs.emplace_back(topic, std::move(message));
  }

 private:
  [[nodiscard]] std::size_t place_of(int topic) const {
    const auto box = std::find_if(unread.begin(), unread.end(),
                                  [topic](const Inbox& b) { return b.topic() == topic; });
    FLYBALL_ASSERT(box != unread.end(), "node %s does not declare that it reads topic %d",
                   spec_.name.c_str(), topic);
    return static_cast<std::size_t>(box - unread.begin());
  }

  const NodeSpec& spec_;
  mutable std::vector<MessageVersion> reads_{};  ///< To look is to note that it was looked at.
  mutable std::uint64_t asked_{};
};

}  // namespace flyball
