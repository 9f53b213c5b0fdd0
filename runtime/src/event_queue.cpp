// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/event_queue.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace flyball {

namespace {

/// Runs its action and schedules itself again.
struct Repetition {
  EventQueue* queue;
  std::shared_ptr<const EventQueue::Action> action;  // owner: the one event that is pending
  Duration period;
  EventOrder order;

  void operator()() const {
    (*action)();
    queue->schedule(queue->now() + period, order, *this);
  }
};

}  // namespace

bool EventQueue::Later::operator()(const Event& a, const Event& b) const {
  if (a.at != b.at) {
    return a.at > b.at;
  }
  if (a.order != b.order) {
    return a.order > b.order;
  }
  return a.sequence > b.sequence;
}

void EventQueue::schedule(MissionTime at, EventOrder order, Action action) {
  FLYBALL_ASSERT(at >= now_, "at=%.9f s, now=%.9f s", to_seconds(at), to_seconds(now_));
  events_.push_back({at, order, sequence_++, std::move(action)});
  std::push_heap(events_.begin(), events_.end(), Later{});
}

bool EventQueue::step() {
  if (events_.empty()) {
    return false;
  }
  std::pop_heap(events_.begin(), events_.end(), Later{});
  const Event event = std::move(events_.back());
  events_.pop_back();
  now_ = event.at;
  event.action();
  return true;
}

void EventQueue::run(const std::function<bool()>& done) {
  while (step()) {
    if (done()) {
      return;
    }
  }
}

void EventQueue::every(MissionTime first, Duration period, EventOrder order, Action action) {
  FLYBALL_ASSERT(period > Duration::zero(), "period=%.9f s", to_seconds(period));
  auto shared = std::make_shared<const Action>(std::move(action));
  schedule(first, order, Repetition{this, std::move(shared), period, order});
}

}  // namespace flyball
