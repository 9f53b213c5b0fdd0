// SPDX-License-Identifier: BSD-3-Clause
// tested-in: realtime_executor
#include "flyball/runtime/realtime/cpus.h"

#include "realtime/cpu_meter.h"
#include "realtime/realtime_engine.h"
#include "realtime/thread_setup.h"
#include <algorithm>

#include <pthread.h>

namespace flyball {
namespace {

constexpr int nice_per_level = 3;  // Chosen: each level gets about half the time of the one above.
constexpr int most_nice = 19;

}  // namespace

MissionTime RealtimeEngine::now() const {
  return has_begun ? MissionTime{Clock::now() - epoch} : MissionTime{};
}

RealtimeEngine::Clock::time_point RealtimeEngine::host_time(MissionTime at) const {
  return epoch + at.time_since_epoch();
}

std::vector<int> RealtimeEngine::active_cpus(int cores) const {
  const auto count = std::min(cpus.size(), index(std::max(1, cores)));
  return {cpus.begin(), cpus.begin() + static_cast<std::ptrdiff_t>(count)};
}

template <class Condition>
bool RealtimeEngine::wait_for(const Condition& condition, std::optional<Clock::time_point> until) {
  while (true) {
    const std::uint32_t ticket = owner.ticket();
    {
      const std::lock_guard lock{mutex};
      if (condition()) {
        return true;
      }
    }
    if (until && Clock::now() >= *until) {
      return false;
    }
    owner.wait(ticket, {}, until);
  }
}

void RealtimeEngine::start() {
  is_started = true;
  const auto note_if = [this](std::optional<std::string> note) {
    if (note) {
      notes.push_back(std::move(*note));
    }
  };
  note_if(settings.lock_memory ? lock_process_memory() : std::nullopt);
  note_if(settings.fifo_priority ? real_time_throttle() : std::nullopt);
  fifo = fifo_from();
  for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
    const auto count = std::min(index(lanes[lane].nodes), cpus.size());
    for (std::size_t i = 0; i < count; ++i) {
      threads.emplace_back([this, lane] { work(lane); });
    }
  }
  threads.emplace_back([this] { keep_time(); });
  wait_for([this] { return threads_ready == threads.size(); }, {});
  for (const std::string& note : notes) {  // No thread adds to them any more.
    if (settings.tell) {
      settings.tell(note);
    }
  }
  {
    const std::lock_guard lock{mutex};
    for (int node = 0; node < static_cast<int>(nodes.size()); ++node) {
      if (const auto* every = std::get_if<OnPeriod>(&spec(node).trigger)) {
        nodes[index(node)].next_period = MissionTime{every->phase};
      }
    }
    epoch = Clock::now();
    has_begun = true;
  }
  for (Lane& lane : lanes) {
    lane.parking.wake_all();
  }
  timer.wake_all();
}

// If each thread asked for itself, the most urgent ones would be refused first, and the others
// would keep them from running.
std::optional<int> RealtimeEngine::fifo_from() {
  if (!settings.fifo_priority) {
    return std::nullopt;
  }
  const int above = static_cast<int>(lanes.size());  // Of the clock's thread.
  const FifoGrant granted = grantable_fifo(*settings.fifo_priority, above);
  if (!granted.note.empty()) {
    notes.push_back(granted.note);
  }
  return granted.from;
}

void RealtimeEngine::set_up(const std::string& name, std::size_t level) {
  ThreadWish wish;
  wish.name = name;
  wish.prefault_stack = settings.lock_memory;
  if (fifo) {
    wish.fifo_priority = *fifo + static_cast<int>(lanes.size() - level);
  } else {
    const int below_timer = std::max(0, static_cast<int>(level) - 1);
    wish.nice = std::min(most_nice, process_nice() + nice_per_level * below_timer);
  }
  std::vector<std::string> refused = set_up_thread(wish);
  const std::vector<int> active = active_cpus(operating_point().cores);
  if (auto note = bind_thread(0, active)) {
    refused.push_back(std::move(*note));
  }
  clockid_t clock{};
  pthread_getcpuclockid(pthread_self(), &clock);
  {
    const std::lock_guard lock{mutex};
    for (std::string& note : refused) {
      if (std::find(notes.begin(), notes.end(), note) == notes.end()) {
        notes.push_back(std::move(note));
      }
    }
    thread_ids.push_back(thread_id());
    cpu_clocks.push_back(clock);
    ++threads_ready;
  }
  owner.wake();
}

void RealtimeEngine::leave(Lock& lock) {
  ++threads_left;
  unlock_and_wake(lock);
  cpu_ns_of_ended += thread_cpu_time().count();
  owner.wake();
}

void RealtimeEngine::unlock_and_wake(Lock& lock) {
  lock.unlock();
  for (Lane& lane : lanes) {
    if (const int count = lane.wanted_wakes.exchange(0); count > 0) {
      lane.parking.wake(count);
    }
  }
  if (timer_is_early.exchange(false)) {
    timer.wake();
  }
  if (has_news.exchange(false)) {
    owner.wake();
  }
}

void RealtimeEngine::work(std::size_t level) {
  Lane& lane = lanes[level];
  set_up("jobs-" + std::to_string(lane.priority), level + 1);
  CpuMeter meter;
  Lock lock{mutex};
  while (!is_stopping) {
    if (!has_begun || lane.ready.empty()) {
      const std::uint32_t ticket = lane.parking.ticket();
      unlock_and_wake(lock);
      lane.parking.wait(ticket, settings.spin);
      lock.lock();
      continue;
    }
    const int node = lane.ready.front();
    lane.ready.erase(lane.ready.begin());
    // This thread runs the job itself, a successor of its last one in particular. Each job that is
    // left keeps its wake-up: whoever released it may not have got to waking somebody yet.
    if (int wakes = lane.wanted_wakes; wakes > static_cast<int>(lane.ready.size())) {
      lane.wanted_wakes.compare_exchange_strong(wakes, wakes - 1);
    }
    begin(node);
    unlock_and_wake(lock);
    run_body(node, meter);
    lock.lock();
    end(node, lock);
  }
  leave(lock);
}

void RealtimeEngine::run_body(int node, CpuMeter& meter) {
  NodeJob& job = nodes[index(node)].job;
  const Clock::time_point begun = Clock::now();
  Work work = graph.nodes()[index(node)].body(job);
  const Duration took = Clock::now() - begun;
  // The timer's thread may write `missed` meanwhile: only `busy`, `host_s` and `work` are ours.
  job.record.work = std::move(work);
  job.record.host_s = to_seconds(took);
  job.record.busy = meter.job(took);
}

void RealtimeEngine::begin_period(int node, MissionTime at) {
  RealtimeNode& here = nodes[index(node)];
  const Duration period = std::get<OnPeriod>(spec(node).trigger).period;
  if (here.state == RealtimeNode::State::idle) {
    release(node, here.next_period);
  } else {
    ++dropped_periods;
  }
  here.next_period += period;
  if (here.next_period <= at) {  // The timer came late: what it missed is dropped.
    const auto missed = (at - here.next_period) / period + 1;
    dropped_periods += static_cast<std::uint64_t>(missed);
    here.next_period += missed * period;
  }
}

MissionTime RealtimeEngine::do_what_is_due() {
  const MissionTime at = now();
  for (int node = 0; node < static_cast<int>(nodes.size()); ++node) {
    RealtimeNode& here = nodes[index(node)];
    if (here.deadline <= at) {
      pass_deadline(node);
    }
    if (here.stuck_from <= at) {
      here.stuck_from = never;
      news.add(News::Kind::stuck, node).running = at - here.job.record.started;
      has_news = true;
    }
    if (here.next_period <= at) {
      begin_period(node, at);
    }
  }
  MissionTime next = never;
  for (const RealtimeNode& node : nodes) {
    next = std::min({next, node.deadline, node.stuck_from, node.next_period});
  }
  return next;
}

void RealtimeEngine::keep_time() {
  set_up("clock", 0);
  Lock lock{mutex};
  while (!is_stopping) {
    timer_wakes_at = has_begun ? do_what_is_due() : never;
    const std::uint32_t ticket = timer.ticket();
    const MissionTime next = timer_wakes_at;
    timer_is_early = false;
    unlock_and_wake(lock);
    timer.wait(ticket, {}, next == never ? std::nullopt : std::optional{host_time(next)});
    lock.lock();
    timer_wakes_at = {};  // It is awake: nobody needs to wake it.
  }
  leave(lock);
}

void RealtimeEngine::stop() {
  {
    const std::lock_guard lock{mutex};
    is_stopping = true;
    for (RealtimeNode& node : nodes) {
      node.job.is_told_to_stop = true;
    }
  }
  for (Lane& lane : lanes) {
    lane.parking.wake_all();
  }
  timer.wake_all();
  wait_for_jobs();
  for (std::thread& thread : threads) {
    thread.join();
  }
  threads.clear();
  is_stopped = true;
}

// A thread cannot be ended from outside, so a job that does not return keeps everything waiting: a
// person is told which one it is, once.
void RealtimeEngine::wait_for_jobs() {
  const auto have_left = [this] { return threads_left == threads.size(); };
  if (!wait_for(have_left, Clock::now() + settings.tell_at_stop_after)) {
    tell_jobs_that_run_on();
    wait_for(have_left, {});
  }
}

void RealtimeEngine::tell_jobs_that_run_on() const {
  std::string names;
  {
    const std::lock_guard lock{mutex};
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (nodes[i].state == RealtimeNode::State::running) {
        names += (names.empty() ? "" : ", ") + graph.nodes()[i].spec.name;
      }
    }
  }
  if (settings.tell && !names.empty()) {
    settings.tell("told to stop, jobs of these nodes still run: " + names +
                  "; the program ends when they return, or by SIGKILL");
  }
}

}  // namespace flyball
