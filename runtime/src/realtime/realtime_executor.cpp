// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/realtime/realtime_executor.h"

#include "flyball/runtime/assert.h"
#include "flyball/runtime/realtime/cpus.h"
#include "flyball/runtime/text/number_text.h"

#include "realtime/realtime_engine.h"
#include <algorithm>
#include <ctime>
#include <utility>

namespace flyball {
namespace {

std::vector<int> distinct_priorities(const Graph& graph) {
  std::vector<int> priorities;
  for (const Node& node : graph.nodes()) {
    priorities.push_back(node.spec.priority);
  }
  std::sort(priorities.rbegin(), priorities.rend());
  priorities.erase(std::unique(priorities.begin(), priorities.end()), priorities.end());
  return priorities;
}

}  // namespace

RealtimeEngine::RealtimeEngine(const Graph& hosted,
                               const RealtimeSettings& chosen,
                               const OperatingPoint& first,
                               const std::shared_ptr<MessagePool>& pool)
    : graph{hosted},
      settings{chosen},
      cpus{chosen.cpus.empty() ? usable_cpus() : chosen.cpus},
      exchange{hosted},
      is_listened(hosted.topics().size()),
      wanted{first},
      first_clock{first.frequency},
      listeners(hosted.topics().size()) {
  FLYBALL_ASSERT(first.cores >= 1, "cores=%d", first.cores);
  const std::vector<int> priorities = distinct_priorities(graph);
  for (const int priority : priorities) {
    lanes.emplace_back().priority = priority;
  }
  for (int node = 0; node < static_cast<int>(graph.nodes().size()); ++node) {
    RealtimeNode& here = nodes.emplace_back(spec(node), pool);
    exchange.equip(node, here.job);
    here.lane = static_cast<std::size_t>(
        std::find(priorities.begin(), priorities.end(), spec(node).priority) - priorities.begin());
    ++lanes[here.lane].nodes;
  }
  for (Lane& lane : lanes) {
    lane.ready.reserve(index(lane.nodes));
  }
  granted = grant(first);
}

OperatingPoint RealtimeEngine::grant(const OperatingPoint& point) const {
  OperatingPoint result =
      settings.grant ? settings.grant(point) : OperatingPoint{point.cores, first_clock};
  result.cores = std::clamp(result.cores, 1, static_cast<int>(cpus.size()));
  return result;
}

void RealtimeEngine::set_point(const std::optional<OperatingPoint>& point) {
  const std::lock_guard setting{setting_mutex};
  wanted = point.value_or(wanted);
  const OperatingPoint got = grant(wanted);
  bool has_new_cores{};
  {
    const std::lock_guard lock{point_mutex};
    has_new_cores = got.cores != granted.cores;
    granted = got;
  }
  if (!has_new_cores) {
    return;
  }
  std::vector<pid_t> bound;
  {
    const std::lock_guard lock{mutex};
    bound = thread_ids;
  }
  const std::vector<int> active = active_cpus(got.cores);
  for (const pid_t thread : bound) {
    (void)bind_thread(thread, active);  // Of cores that it could be bound to at the start.
  }
}

OperatingPoint RealtimeEngine::operating_point() const {
  const std::lock_guard lock{point_mutex};
  return granted;
}

double RealtimeEngine::cpu_s() const {
  double sum_s = static_cast<double>(cpu_ns_of_ended) * 1e-9;
  if (is_stopped) {
    return sum_s;
  }
  for (const clockid_t clock : cpu_clocks) {
    timespec used{};
    clock_gettime(clock, &used);
    sum_s += static_cast<double>(used.tv_sec) + static_cast<double>(used.tv_nsec) * 1e-9;
  }
  return sum_s;
}

void RealtimeEngine::tell_news() {
  {
    const std::lock_guard lock{mutex};
    told.swap(news);
  }
  is_telling = true;
  for (std::size_t i = 0; i < told.size(); ++i) {
    const News& one = told[i];
    const auto tell = [](auto& them, const auto&... what) {
      const std::size_t count = them.size();
      for (std::size_t k = 0; k < count; ++k) {
        them[k](what...);
      }
    };
    switch (one.kind) {
      case News::Kind::message:
        tell(listeners[index(one.index)], one.message);
        break;
      case News::Kind::job:
        tell(job_listeners, one.record);
        break;
      case News::Kind::miss:
        tell(miss_listeners, one.index, spec(one.index).on_miss);
        break;
      case News::Kind::stuck:
        if (settings.tell) {
          settings.tell("the job of node " + spec(one.index).name + " has run for " +
                        short_number_text(to_seconds(one.running)) + " s and has not ended");
        }
        tell(stuck_listeners, one.index, one.running);
        break;
    }
  }
  told.clear();
  is_telling = false;
}

RealtimeExecutor::RealtimeExecutor(const Graph& graph,
                                   const OperatingPoint& point,
                                   const RealtimeSettings& settings)
    : RealtimeExecutor{std::make_shared<MessagePool>(), graph, point, settings} {}

RealtimeExecutor::RealtimeExecutor(const std::shared_ptr<MessagePool>& pool,
                                   const Graph& graph,
                                   const OperatingPoint& point,
                                   const RealtimeSettings& settings)
    : Executor{pool}, engine_{std::make_unique<RealtimeEngine>(graph, settings, point, pool)} {}

RealtimeExecutor::~RealtimeExecutor() {
  if (!engine_->is_stopped) {
    engine_->stop();  // Whoever listened may be gone by now.
  }
}

MissionTime RealtimeExecutor::now() const {
  return engine_->now();
}

void RealtimeExecutor::serve_until(MissionTime at) {
  if (!engine_->is_started && !engine_->is_stopped) {
    engine_->start();
  }
  while (true) {
    const std::uint32_t ticket = engine_->owner.ticket();
    if (engine_->is_stopped) {
      return;
    }
    engine_->tell_news();
    if (engine_->is_stopped) {
      engine_->tell_news();  // What happened until a listener stopped it.
      return;
    }
    if (const Duration late = engine_->now() - at; late >= Duration::zero()) {
      engine_->longest_delay = std::max(engine_->longest_delay, late);
      return;
    }
    engine_->owner.wait(ticket, {}, engine_->host_time(at));
  }
}

void RealtimeExecutor::on_job(std::function<void(const JobRecord&)> listener) {
  const std::lock_guard lock{engine_->mutex};
  engine_->has_job_listener = true;
  engine_->job_listeners.push_back(std::move(listener));
}

void RealtimeExecutor::on_miss(std::function<void(int node, OnMiss)> listener) {
  engine_->miss_listeners.push_back(std::move(listener));
}

void RealtimeExecutor::on_stuck(std::function<void(int node, Duration)> listener) {
  engine_->stuck_listeners.push_back(std::move(listener));
}

void RealtimeExecutor::set_operating_point(const OperatingPoint& point) {
  engine_->set_point(point);
}

OperatingPoint RealtimeExecutor::operating_point() const {
  return engine_->operating_point();
}

void RealtimeExecutor::platform_changed() {
  engine_->set_point(std::nullopt);
}

double RealtimeExecutor::busy_core_s() const {
  return engine_->cpu_s();
}

double RealtimeExecutor::busiest_core_s() const {
  const std::lock_guard lock{engine_->mutex};
  const Duration since =
      engine_->running > 0 ? engine_->now() - engine_->running_since : Duration::zero();
  return to_seconds(engine_->busy_for + since);
}

double RealtimeExecutor::busy_cores() const {
  const int cores = operating_point().cores;
  const std::lock_guard lock{engine_->mutex};
  return std::min(engine_->running, cores);
}

std::uint64_t RealtimeExecutor::drops() const {
  const std::lock_guard lock{engine_->mutex};
  return engine_->exchange.drops() + engine_->dropped_periods;
}

void RealtimeExecutor::stop() {
  if (engine_->is_stopped) {
    return;
  }
  engine_->stop();
  if (!engine_->is_telling) {
    engine_->tell_news();
  }
}

void RealtimeExecutor::run_last(int node) {
  FLYBALL_ASSERT(engine_->is_stopped, "node %d is to run last, but the executor runs", node);
  if (engine_->exchange.owed_since(node)) {
    NodeJob& job = engine_->nodes[RealtimeEngine::index(node)].job;
    engine_->exchange.open(node, job);
    (void)engine_->graph.nodes()[RealtimeEngine::index(node)].body(job);
    engine_->exchange.close(node, job);
  }
}

Duration RealtimeExecutor::longest_delay() const {
  return engine_->longest_delay;
}

void RealtimeExecutor::inject(int topic, Message message) {
  RealtimeEngine::Lock lock{engine_->mutex};
  engine_->log(RunEvent::Kind::publish, topic, {}, message);
  engine_->put(topic, message, engine_->now());
  engine_->unlock_and_wake(lock);
  auto& here = engine_->listeners[RealtimeEngine::index(topic)];
  const std::size_t count = here.size();
  for (std::size_t i = 0; i < count; ++i) {
    here[i](message);
  }
}

void RealtimeExecutor::listen(int topic, std::function<void(const Message&)> listener) {
  const std::lock_guard lock{engine_->mutex};
  engine_->is_listened[RealtimeEngine::index(topic)] = true;
  engine_->listeners[RealtimeEngine::index(topic)].push_back(std::move(listener));
}

}  // namespace flyball
