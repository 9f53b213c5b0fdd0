// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The messages of a graph whose jobs run: what is newest on each topic, and what each
/// node has not read yet.

#include "flyball/runtime/graph.h"

#include "inbox.h"
#include "node_job.h"
#include <cstdint>
#include <optional>
#include <vector>

namespace flyball {

/// It knows no threads and no clock: its owner locks it and says what time it is. A job takes its
/// node's messages with it when it begins, and what arrives meanwhile is collected for the next.
class MessageExchange {
 public:
  /// `graph` outlives it.
  explicit MessageExchange(const Graph& graph);

  /// Returns the nodes whose trigger the message is, until the next call.
  const std::vector<int>& put(int topic, Message message, MissionTime now);
  /// Makes room in the job of `node` for its messages, once for all its jobs.
  void equip(int node, NodeJob& job) const;
  /// Hands the unread messages of `node` to its job, and the newest ones of the topics it reads.
  void open(int node, NodeJob& job);
  /// Takes back what the job has not read; what has arrived since stands behind it.
  void close(int node, NodeJob& job);
  /// When the oldest trigger of `node` arrived that is owed a job; empty: none is.
  [[nodiscard]] std::optional<MissionTime> owed_since(int node) const;
  /// The job that was owed for the oldest trigger will not run.
  void drop_trigger(int node);
  /// The newest message of a topic; version 0: there is none.
  [[nodiscard]] const VersionedMessage& newest(int topic) const {
    return topics_[static_cast<std::size_t>(topic)].newest;
  }
  [[nodiscard]] std::uint64_t version(int topic) const { return newest(topic).version; }
  /// Messages that were pushed out before a job could read them.
  [[nodiscard]] std::uint64_t drops() const { return drops_; }

 private:
  struct NodeMail {
    std::vector<Inbox> inboxes{};  ///< The trigger's first, if a message is the trigger.
    bool has_trigger{};
  };
  struct TopicMail {
    VersionedMessage newest{};
    std::vector<int> readers{};  ///< Nodes, ascending.
  };
  void open_inboxes(int node);
  /// Whether a message that is pushed out of this inbox is lost. Looking at the newest value now
  /// and then drops nothing; an overtaken trigger does.
  [[nodiscard]] static bool loses(const NodeMail& node, const Inbox& inbox);

  const Graph& graph_;
  std::vector<NodeMail> nodes_;
  std::vector<TopicMail> topics_;
  std::vector<int> triggered_{};
  std::uint64_t drops_{};
};

}  // namespace flyball
