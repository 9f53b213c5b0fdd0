// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// One job of the pool executor.

#include "flyball/runtime/assert.h"
#include "flyball/runtime/executor.h"

#include "inbox.h"
#include <algorithm>
#include <chrono>
#include <functional>
#include <utility>
#include <vector>

namespace flyball::kit {

/// What a job may touch: all of it is the job's own while it runs.
class PoolJob final : public JobContext {
 public:
  PoolJob(const NodeSpec& spec, MissionTime now) : spec_{spec}, now_{now} { record.started = now; }

  [[nodiscard]] MissionTime now() const override { return now_; }
  [[nodiscard]] MissionTime released() const override { return record.released; }
  void at_end(std::function<void(MissionTime)> action) override {
    last_actions.push_back(std::move(action));
  }

  JobRecord record{};
  std::vector<Inbox> unread{};    ///< The trigger's first, if a message is the trigger.
  std::vector<Message> newest{};  ///< Of the same topics.
  std::vector<std::pair<int, Message>> outputs{};
  std::vector<std::function<void(MissionTime)>> last_actions{};
  std::chrono::microseconds pause{};
  bool has_taken_trigger{};

 protected:
  [[nodiscard]] Message read(int topic) const override { return newest[place_of(topic)]; }
  [[nodiscard]] Message pop(int topic) override {
    const std::size_t place = place_of(topic);
    has_taken_trigger = has_taken_trigger || place == 0;
    return unread[place].take();
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
  MissionTime now_;
};

}  // namespace flyball::kit
