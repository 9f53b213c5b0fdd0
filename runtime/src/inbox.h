// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What one node has not yet read of one topic.

#include "flyball/runtime/graph.h"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace flyball {

/// A message and its place in its topic's history; see `MessageVersion`.
struct VersionedMessage {
  Message message{};
  std::uint64_t version{};
};

/// A latest-value topic is a queue of one. In the inbox of the topic that triggers the node, each
/// unread message is owed a job; one that is pushed out is owed none. Allocates only when it is
/// made.
class Inbox {
 public:
  Inbox(int topic, std::size_t capacity) : topic_{topic}, letters_(capacity) {}

  [[nodiscard]] int topic() const { return topic_; }
  [[nodiscard]] std::size_t capacity() const { return letters_.size(); }
  /// Whether an older message was pushed out.
  [[nodiscard]] bool add(VersionedMessage message, MissionTime arrived) {
    const bool is_full = count_ == letters_.size();
    if (is_full) {
      (void)take();
    }
    letters_[(first_ + count_) % letters_.size()] = {std::move(message), arrived};
    ++count_;
    return is_full;
  }
  /// Oldest unread message, which is removed; null when there is none.
  [[nodiscard]] VersionedMessage take() {
    if (count_ == 0) {
      return {};
    }
    VersionedMessage oldest = std::exchange(letters_[first_].message, {});
    first_ = (first_ + 1) % letters_.size();
    --count_;
    return oldest;
  }
  [[nodiscard]] std::optional<MissionTime> oldest_arrival() const {
    return count_ == 0 ? std::nullopt : std::optional{letters_[first_].arrived};
  }

 private:
  struct Letter {
    VersionedMessage message{};
    MissionTime arrived{};
  };
  int topic_;
  std::vector<Letter> letters_;  ///< A ring.
  std::size_t first_{};
  std::size_t count_{};
};

}  // namespace flyball
