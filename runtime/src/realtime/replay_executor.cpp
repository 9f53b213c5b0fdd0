// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/realtime/replay_executor.h"

#include "flyball/runtime/assert.h"
#include "flyball/runtime/text/number_text.h"

#include "message_exchange.h"
#include "node_job.h"
#include <algorithm>
#include <deque>
#include <string>
#include <utility>
#include <vector>

namespace flyball {
namespace {

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

Error differs(const NodeSpec& spec, MissionTime at, const std::string& how) {
  return {ErrorCode::failed, "the job of node " + spec.name + " that began at " +
                                 short_number_text(to_seconds(at)) + " s " + how +
                                 ": does it use something beside its messages?"};
}

}  // namespace

struct ReplayState {
  ReplayState(const Graph& hosted, const RunLog& run)
      : graph{hosted}, log{run}, exchange{hosted}, listeners(hosted.topics().size()) {
    for (int node = 0; node < static_cast<int>(graph.nodes().size()); ++node) {
      exchange.equip(node, jobs.emplace_back(graph.nodes()[index(node)].spec, nullptr));
    }
  }

  [[nodiscard]] Status check() const;
  void publish(int topic, const Message& message, MissionTime at);
  void begin(int node, const JobRecord& logged, std::uint64_t stop_after);
  Status end(const RunEvent& event);
  void tell(const JobRecord& record);
  /// How the job that begins at this place of the log ended; null: it was not waited for.
  [[nodiscard]] const JobRecord* end_of(std::size_t place) const;

  const Graph& graph;
  const RunLog& log;
  MessageExchange exchange;
  std::deque<NodeJob> jobs{};
  std::vector<std::deque<std::function<void(const Message&)>>> listeners;
  std::deque<std::function<void(const JobRecord&)>> job_listeners{};
  std::deque<std::function<void(int, OnMiss)>> miss_listeners{};
  OperatingPoint point{};
  double busy_core_s{};
};

Status ReplayState::check() const {
  for (const RunEvent& event : log.events) {
    const std::size_t count =
        event.kind == RunEvent::Kind::publish ? graph.topics().size() : graph.nodes().size();
    if (event.index < 0 || index(event.index) >= count) {
      return Error{ErrorCode::invalid_input, "the log names node or topic " +
                                                 std::to_string(event.index) + ", and graph \"" +
                                                 graph.name() + "\" has " + std::to_string(count) +
                                                 ": was it recorded with this graph?"};
    }
  }
  return Done{};
}

void ReplayState::publish(int topic, const Message& message, MissionTime at) {
  (void)exchange.put(topic, message, at);
  const std::size_t count = listeners[index(topic)].size();
  for (std::size_t i = 0; i < count; ++i) {
    listeners[index(topic)][i](message);
  }
}

const JobRecord* ReplayState::end_of(std::size_t place) const {
  const int node = log.events[place].index;
  const auto end = std::find_if(log.events.begin() + static_cast<std::ptrdiff_t>(place),
                                log.events.end(), [node](const RunEvent& event) {
                                  return event.kind == RunEvent::Kind::end && event.index == node;
                                });
  return end == log.events.end() ? nullptr : &end->record;
}

void ReplayState::begin(int node, const JobRecord& logged, std::uint64_t stop_after) {
  NodeJob& job = jobs[index(node)];
  job.renew();
  job.record.node = node;
  job.record.released = logged.released;
  job.record.started = logged.started;
  job.record.core = logged.core;
  job.record.clock = logged.clock;
  job.stop_after = stop_after;
  point.frequency = logged.clock;
  exchange.open(node, job);
  job.record.work = graph.nodes()[index(node)].body(job);
}

Status ReplayState::end(const RunEvent& event) {
  NodeJob& job = jobs[index(event.index)];
  const NodeSpec& spec = graph.nodes()[index(event.index)].spec;
  job.note_questions();
  if (job.record.reads != event.record.reads) {
    return differs(spec, job.record.started, "read other messages than when it was recorded");
  }
  if (job.record.questions_before_stop != event.record.questions_before_stop) {
    return differs(spec, job.record.started, "asked more or less often whether to stop");
  }
  job.record.ended = event.record.ended;
  job.record.busy = event.record.busy;
  job.record.missed = event.record.missed;
  job.record.killed = event.record.killed;
  busy_core_s += to_seconds(job.record.busy);
  if (!job.record.killed) {
    for (const auto& action : job.last_actions) {
      action(job.record.ended);
    }
  }
  exchange.close(event.index, job);
  if (!job.record.killed) {
    for (const auto& [topic, message] : job.outputs) {
      publish(topic, message, job.record.ended);
    }
  }
  tell(job.record);
  return Done{};
}

void ReplayState::tell(const JobRecord& record) {
  if (record.missed) {
    const OnMiss action = graph.nodes()[index(record.node)].spec.on_miss;
    for (const auto& listener : miss_listeners) {
      listener(record.node, action);
    }
  }
  for (const auto& listener : job_listeners) {
    listener(record);
  }
}

ReplayExecutor::ReplayExecutor(const Graph& graph, const RunLog& log)
    : state_{std::make_unique<ReplayState>(graph, log)} {}

ReplayExecutor::~ReplayExecutor() = default;

Status ReplayExecutor::run() {
  if (Status checked = state_->check(); !checked) {
    return checked;
  }
  const std::vector<RunEvent>& events = state_->log.events;
  for (std::size_t place = 0; place < events.size(); ++place) {
    const RunEvent& event = events[place];
    switch (event.kind) {
      case RunEvent::Kind::publish:
        state_->publish(event.index, event.message, event.at);
        break;
      case RunEvent::Kind::start:
        if (const JobRecord* end = state_->end_of(place)) {
          state_->begin(event.index, event.record,
                        end->killed ? end->questions_before_stop : NodeJob::never);
        }
        break;
      case RunEvent::Kind::end:
        if (Status same = state_->end(event); !same) {
          return same;
        }
        break;
      case RunEvent::Kind::forgo:
        state_->exchange.drop_trigger(event.index);
        state_->tell(event.record);
        break;
    }
  }
  return Done{};
}

void ReplayExecutor::on_job(std::function<void(const JobRecord&)> listener) {
  state_->job_listeners.push_back(std::move(listener));
}

void ReplayExecutor::on_miss(std::function<void(int node, OnMiss)> listener) {
  state_->miss_listeners.push_back(std::move(listener));
}

OperatingPoint ReplayExecutor::operating_point() const {
  return state_->point;
}

double ReplayExecutor::busy_core_s() const {
  return state_->busy_core_s;
}

std::uint64_t ReplayExecutor::drops() const {
  return state_->exchange.drops();
}

void ReplayExecutor::inject(int topic, Message /*message*/) {
  FLYBALL_ASSERT(false, "topic %d is published to during a replay; the log has its messages",
                 topic);
}

void ReplayExecutor::listen(int topic, std::function<void(const Message&)> listener) {
  state_->listeners[index(topic)].push_back(std::move(listener));
}

}  // namespace flyball
