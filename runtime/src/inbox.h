// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What one node has not yet read of one topic.

#include "flyball/runtime/graph.h"

#include <deque>
#include <optional>
#include <utility>

namespace flyball {

/// A latest-value topic is a queue of one. In the inbox of the topic that triggers the node, each
/// unread message is owed a job; one that is pushed out is owed none.
class Inbox {
 public:
  Inbox(int topic, std::size_t capacity) : topic_{topic}, capacity_{capacity} {}

  [[nodiscard]] int topic() const { return topic_; }
  [[nodiscard]] std::size_t capacity() const { return capacity_; }
  /// Whether an older message was pushed out.
  [[nodiscard]] bool add(Message message, MissionTime arrived) {
    unread_.push_back({std::move(message), arrived});
    if (unread_.size() <= capacity_) {
      return false;
    }
    unread_.pop_front();
    return true;
  }
  /// Oldest unread message, which is removed; null when there is none.
  [[nodiscard]] Message take() {
    if (unread_.empty()) {
      return nullptr;
    }
    Message oldest = std::move(unread_.front().message);
    unread_.pop_front();
    return oldest;
  }
  [[nodiscard]] std::optional<MissionTime> oldest_arrival() const {
    return unread_.empty() ? std::nullopt : std::optional{unread_.front().arrived};
  }

 private:
  struct Letter {
    Message message;
    MissionTime arrived;
  };
  int topic_;
  std::size_t capacity_;
  std::deque<Letter> unread_;
};

}  // namespace flyball
