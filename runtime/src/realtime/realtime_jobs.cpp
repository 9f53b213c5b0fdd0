// SPDX-License-Identifier: BSD-3-Clause
// tested-in: realtime_executor
#include "realtime/realtime_engine.h"
#include <algorithm>

#include <sched.h>

namespace flyball {

void RealtimeEngine::put(int topic, const Message& message, MissionTime at) {
  for (const int node : exchange.put(topic, message, at)) {
    if (nodes[index(node)].state == RealtimeNode::State::idle) {
      release(node, at);
    }
  }
}

void RealtimeEngine::release(int node, MissionTime at) {
  RealtimeNode& here = nodes[index(node)];
  here.state = RealtimeNode::State::ready;
  here.job.renew();
  here.job.record.node = node;
  here.job.record.released = at;
  Lane& lane = lanes[here.lane];
  lane.ready.push_back(node);
  ++lane.wanted_wakes;
  if (const Duration deadline = spec(node).deadline; deadline > Duration::zero()) {
    here.deadline = at + deadline;
    wake_timer_for(here.deadline);
  }
}

void RealtimeEngine::wake_timer_for(MissionTime at) {
  if (at < timer_wakes_at) {
    timer_is_early = true;
  }
}

void RealtimeEngine::note_running(int change) {
  const MissionTime at = now();
  if (running > 0) {
    busy_for += at - running_since;
  }
  running_since = at;
  running += change;
}

void RealtimeEngine::begin(int node) {
  RealtimeNode& here = nodes[index(node)];
  here.state = RealtimeNode::State::running;
  note_running(1);
  JobRecord& record = here.job.record;
  record.started = running_since;
  record.core = sched_getcpu();
  {
    const std::lock_guard points{point_mutex};
    record.clock = granted.frequency;
  }
  exchange.open(node, here.job);
  here.stuck_from = record.started + settings.stuck_after;
  wake_timer_for(here.stuck_from);
  log(RunEvent::Kind::start, node, record);
}

void RealtimeEngine::end(int node, Lock& lock) {
  RealtimeNode& here = nodes[index(node)];
  NodeJob& job = here.job;
  note_running(-1);
  here.stuck_from = never;
  job.note_questions();
  job.record.ended = running_since;
  if (job.record.ended > here.deadline) {  // The timer's thread has not got to it.
    pass_deadline(node);
  }
  here.deadline = never;
  job.record.killed = job.is_told_to_stop;
  if (!job.record.killed && !job.last_actions.empty()) {
    lock.unlock();
    for (const auto& action : job.last_actions) {
      action(job.record.ended);
    }
    lock.lock();
  }
  exchange.close(node, job);
  log(RunEvent::Kind::end, node, job.record);
  if (!job.record.killed) {
    for (const auto& [topic, message] : job.outputs) {
      put(topic, message, job.record.ended);
      if (is_listened[index(topic)]) {
        news.add(News::Kind::message, topic).message = message;
        has_news = true;
      }
    }
  }
  job.outputs.clear();
  tell_job(job.record);
  here.state = RealtimeNode::State::idle;
  release_owed(node);
}

void RealtimeEngine::release_owed(int node) {
  if (const auto since = exchange.owed_since(node)) {
    release(node, *since);
  }
}

void RealtimeEngine::forgo(int node) {
  RealtimeNode& here = nodes[index(node)];
  Lane& lane = lanes[here.lane];
  lane.ready.erase(std::find(lane.ready.begin(), lane.ready.end(), node));
  here.state = RealtimeNode::State::idle;
  JobRecord& record = here.job.record;
  record.killed = true;
  record.ended = now();
  record.started = record.ended;
  log(RunEvent::Kind::forgo, node, record);
  tell_job(record);
  exchange.drop_trigger(node);
  release_owed(node);
}

void RealtimeEngine::pass_deadline(int node) {
  RealtimeNode& late = nodes[index(node)];
  late.deadline = never;
  late.job.record.missed = true;
  (void)news.add(News::Kind::miss, node);
  has_news = true;
  if (spec(node).on_miss != OnMiss::skip) {
    return;
  }
  if (late.state == RealtimeNode::State::ready) {
    forgo(node);
  } else {
    late.job.is_told_to_stop = true;
  }
}

void RealtimeEngine::tell_job(const JobRecord& record) {
  if (has_job_listener) {
    news.add(News::Kind::job, record.node).record = record;
    has_news = true;
  }
}

void RealtimeEngine::log(RunEvent::Kind kind,
                         int index,
                         const JobRecord& record,
                         const Message& message) const {
  if (settings.log != nullptr) {
    settings.log->events.push_back({kind, now(), index, message, record});
  }
}

}  // namespace flyball
