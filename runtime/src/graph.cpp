// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/graph.h"

#include "flyball/runtime/text/listed.h"
#include "flyball/runtime/text/number_text.h"

#include <algorithm>
#include <cstdio>
#include <string_view>
#include <utility>

namespace flyball {

namespace {

std::string milliseconds(Duration d) {
  return short_number_text(1e3 * to_seconds(d)) + " ms";
}

std::string_view name_of(OnMiss on_miss) {
  switch (on_miss) {
    case OnMiss::warn:
      return "warn";
    case OnMiss::skip:
      return "skip";
    case OnMiss::brake:
      return "brake";
  }
  return "unknown";
}

/// "on cloud, priority 3, deadline 500 ms (skip)", with `separator` for the comma.
std::string terms_of(const NodeSpec& spec, const Graph& graph, const std::string& separator) {
  std::string text;
  if (const auto* message = std::get_if<OnMessage>(&spec.trigger)) {
    text = "on " + graph.topics()[static_cast<std::size_t>(message->topic)].name;
  } else {
    const auto& every = std::get<OnPeriod>(spec.trigger);
    text = "every " + milliseconds(every.period);
    if (every.phase != Duration::zero()) {
      text += " from " + milliseconds(every.phase);
    }
  }
  text += separator + "priority " + std::to_string(spec.priority);
  if (spec.deadline != Duration::zero()) {
    text += separator + "deadline " + milliseconds(spec.deadline) + " (" +
            std::string{name_of(spec.on_miss)} + ")";
  }
  if (spec.threads > 1) {
    text += separator + std::to_string(spec.threads) + " threads";
  }
  return text;
}

std::string topic_list(const Graph& graph, const std::vector<int>& topics) {
  return listed(
      topics, [&graph](int topic) { return graph.topics()[static_cast<std::size_t>(topic)].name; });
}

bool contains(const std::vector<int>& topics, int topic) {
  return std::find(topics.begin(), topics.end(), topic) != topics.end();
}

bool is_trigger(const NodeSpec& spec, int topic) {
  const auto* message = std::get_if<OnMessage>(&spec.trigger);
  return message != nullptr && message->topic == topic;
}

std::string quoted(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) {
    text += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
  }
  return text + "\"";
}

std::string edge(const std::string& from, const std::string& to, const std::string& style) {
  return "  " + quoted(from) + " -> " + quoted(to) + " [" + style + "];\n";
}

/// Nodes that write the topic, or the ellipse that stands for whoever does so outside the graph.
std::vector<std::string> writers_of(const Graph& graph, int topic, const std::string& outside) {
  std::vector<std::string> writers;
  for (const Node& node : graph.nodes()) {
    if (contains(node.spec.writes, topic)) {
      writers.push_back(node.spec.name);
    }
  }
  return writers.empty() ? std::vector<std::string>{outside} : writers;
}

/// From one writer to each reader; dashed where the message does not start a job.
std::string edges_from(const std::string& writer, const Graph& graph, int topic) {
  const std::string label = "label=" + quoted(graph.topics()[static_cast<std::size_t>(topic)].name);
  std::string edges;
  for (const Node& node : graph.nodes()) {
    if (is_trigger(node.spec, topic)) {
      edges += edge(writer, node.spec.name, label);
    } else if (contains(node.spec.reads, topic)) {
      edges += edge(writer, node.spec.name, label + ", style=dashed");
    }
  }
  return edges;
}

std::string edges_of(const Graph& graph, int topic) {
  const std::string& name = graph.topics()[static_cast<std::size_t>(topic)].name;
  const std::string outside = "topic " + name;
  const std::vector<std::string> writers = writers_of(graph, topic, outside);
  bool has_outside = writers.front() == outside;
  std::string edges;
  for (const std::string& writer : writers) {
    std::string from_writer = edges_from(writer, graph, topic);
    if (from_writer.empty() && writer != outside) {
      has_outside = true;
      from_writer = edge(writer, outside, "label=" + quoted(name));
    }
    edges += from_writer;
  }
  if (has_outside) {
    edges.insert(0, "  " + quoted(outside) + " [label=" + quoted(name) + ", shape=ellipse];\n");
  }
  return edges;
}

void check_trigger(const NodeSpec& spec, const std::function<bool(int)>& exists) {
  const char* name = spec.name.c_str();
  if (const auto* message = std::get_if<OnMessage>(&spec.trigger)) {
    FLYBALL_ASSERT(exists(message->topic), "node %s, trigger topic %d", name, message->topic);
    return;
  }
  const auto& every = std::get<OnPeriod>(spec.trigger);
  const bool runs = every.period > Duration::zero() && every.phase >= Duration::zero();
  FLYBALL_ASSERT(runs, "node %s, period %g s, phase %g s", name, to_seconds(every.period),
                 to_seconds(every.phase));
}

}  // namespace

void Graph::node(NodeSpec spec, Body body) {
  const char* name = spec.name.c_str();
  const auto exists = [this](int topic) {
    return topic >= 0 && topic < static_cast<int>(topics_.size());
  };
  for (const Node& other : nodes_) {
    FLYBALL_ASSERT(other.spec.name != spec.name, "two nodes \"%s\"", name);
  }
  FLYBALL_ASSERT(spec.threads >= 1, "node %s, threads=%d", name, spec.threads);
  FLYBALL_ASSERT(spec.deadline >= Duration::zero(), "node %s has a negative deadline", name);
  FLYBALL_ASSERT(body != nullptr, "node %s has no body", name);
  check_trigger(spec, exists);
  for (const auto* topics : {&spec.reads, &spec.writes}) {
    FLYBALL_ASSERT(std::all_of(topics->begin(), topics->end(), exists),
                   "node %s names a topic that does not exist", name);
  }
  nodes_.push_back({std::move(spec), std::move(body)});
}

int Graph::add_topic(TopicSpec spec) {
  FLYBALL_ASSERT(spec.capacity >= 1, "topic %s has no room", spec.name.c_str());
  for (const TopicSpec& other : topics_) {
    FLYBALL_ASSERT(other.name != spec.name, "two topics \"%s\"", spec.name.c_str());
  }
  topics_.push_back(std::move(spec));
  return static_cast<int>(topics_.size()) - 1;
}

int Graph::find_topic(const std::string& name, std::type_index type) const {
  for (std::size_t i = 0; i < topics_.size(); ++i) {
    if (topics_[i].name == name && topics_[i].type == type) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

std::string Graph::to_text() const {
  std::string text = "graph " + name_ + "\n";
  for (const Node& node : nodes_) {
    const NodeSpec& spec = node.spec;
    text += "  node " + spec.name + ": " + terms_of(spec, *this, ", ");
    text += ", cost " + (spec.cost.empty() ? "none" : spec.cost) + "\n";
    text += spec.reads.empty() ? "" : "    reads " + topic_list(*this, spec.reads) + "\n";
    text += spec.writes.empty() ? "" : "    writes " + topic_list(*this, spec.writes) + "\n";
  }
  for (const TopicSpec& topic : topics_) {
    text += "  topic " + topic.name + ": " +
            (topic.capacity == 1 ? "latest value" : "queue of " + std::to_string(topic.capacity)) +
            "\n";
  }
  return text;
}

std::string Graph::to_dot() const {
  std::string text = "digraph " + quoted(name_) + " {\n  rankdir=LR;\n  node [shape=box];\n";
  for (const Node& node : nodes_) {
    // the line break is dot's own escape, so it goes in after quoting
    std::string label = quoted(node.spec.name);
    label.pop_back();
    label += "\\n" + quoted(terms_of(node.spec, *this, "|")).substr(1);
    for (std::size_t at = label.find('|'); at != std::string::npos; at = label.find('|', at)) {
      label.replace(at, 1, "\\n");
    }
    text += "  " + quoted(node.spec.name) + " [label=" + label + "];\n";
  }
  for (int topic = 0; topic < static_cast<int>(topics_.size()); ++topic) {
    text += edges_of(*this, topic);
  }
  return text + "}\n";
}

}  // namespace flyball
