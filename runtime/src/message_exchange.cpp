// SPDX-License-Identifier: BSD-3-Clause
#include "message_exchange.h"

#include <algorithm>
#include <utility>

namespace flyball {
namespace {

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

MessageExchange::MessageExchange(const Graph& graph)
    : graph_{graph}, nodes_(graph.nodes().size()), topics_(graph.topics().size()) {
  for (int node = 0; node < static_cast<int>(nodes_.size()); ++node) {
    open_inboxes(node);
  }
  triggered_.reserve(nodes_.size());
}

void MessageExchange::open_inboxes(int node) {
  NodeMail& here = nodes_[index(node)];
  const NodeSpec& spec = graph_.nodes()[index(node)].spec;
  std::vector<int> reads = spec.reads;
  if (const auto* message = std::get_if<OnMessage>(&spec.trigger)) {
    here.has_trigger = true;
    reads.insert(reads.begin(), message->topic);
  }
  for (const int topic : reads) {
    auto& readers = topics_[index(topic)].readers;
    if (readers.empty() || readers.back() != node) {
      readers.push_back(node);
      here.inboxes.emplace_back(topic, graph_.topics()[index(topic)].capacity);
    }
  }
}

bool MessageExchange::loses(const NodeMail& node, const Inbox& inbox) {
  return (node.has_trigger && &inbox == &node.inboxes.front()) || inbox.capacity() > 1;
}

const std::vector<int>& MessageExchange::put(int topic, Message message, MissionTime now) {
  TopicMail& here = topics_[index(topic)];
  here.newest = {std::move(message), here.newest.version + 1};
  triggered_.clear();
  for (const int node : here.readers) {
    NodeMail& reader = nodes_[index(node)];
    const auto inbox = std::find_if(reader.inboxes.begin(), reader.inboxes.end(),
                                    [topic](const Inbox& box) { return box.topic() == topic; });
    if (inbox->add(here.newest, now) && loses(reader, *inbox)) {
      ++drops_;
    }
    if (reader.has_trigger && inbox == reader.inboxes.begin()) {
      triggered_.push_back(node);
    }
  }
  return triggered_;
}

void MessageExchange::equip(int node, NodeJob& job) const {
  for (const Inbox& inbox : nodes_[index(node)].inboxes) {
    job.unread.emplace_back(inbox.topic(), inbox.capacity());
    job.newest.emplace_back();
  }
}

void MessageExchange::open(int node, NodeJob& job) {
  NodeMail& here = nodes_[index(node)];
  for (std::size_t i = 0; i < here.inboxes.size(); ++i) {
    std::swap(here.inboxes[i], job.unread[i]);
    job.newest[i] = topics_[index(here.inboxes[i].topic())].newest;
  }
}

void MessageExchange::close(int node, NodeJob& job) {
  NodeMail& here = nodes_[index(node)];
  if (here.has_trigger && !job.has_taken_trigger) {
    (void)job.unread.front().take();  // Read by `latest`, or of no interest: one job, one message.
  }
  for (std::size_t i = 0; i < here.inboxes.size(); ++i) {
    std::swap(here.inboxes[i], job.unread[i]);
    job.newest[i] = {};
    Inbox& arrived = job.unread[i];
    while (const auto at = arrived.oldest_arrival()) {
      if (here.inboxes[i].add(arrived.take(), *at) && loses(here, here.inboxes[i])) {
        ++drops_;
      }
    }
  }
}

std::optional<MissionTime> MessageExchange::owed_since(int node) const {
  const NodeMail& here = nodes_[index(node)];
  return here.has_trigger ? here.inboxes.front().oldest_arrival() : std::nullopt;
}

void MessageExchange::drop_trigger(int node) {
  if (NodeMail& here = nodes_[index(node)]; here.has_trigger) {
    (void)here.inboxes.front().take();
  }
}

}  // namespace flyball
