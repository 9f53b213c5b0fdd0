// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/modeled/virtual_executor.h"

#include "flyball/runtime/assert.h"

#include "virtual_computer.h"
#include <algorithm>
#include <utility>

namespace flyball {

VirtualComputer::VirtualComputer(const Graph& hosted,
                                 const Platform& model,
                                 EventQueue& events,
                                 OperatingPoint first)
    : graph{hosted},
      platform{model},
      queue{events},
      requested{first},
      point{model.granted(first)},
      taken_cores{model.taken_cores()},
      exchange{hosted},
      listeners(hosted.topics().size()),
      advanced_to{events.now()} {
  FLYBALL_ASSERT(point.cores >= 1 && point.frequency.value() > 0.0, "cores=%d, frequency=%g Hz",
                 point.cores, point.frequency.value());
  for (int node = 0; node < static_cast<int>(graph.nodes().size()); ++node) {
    exchange.equip(node, nodes.emplace_back(spec(node)).context);
  }
}

void VirtualComputer::start() {
  for (int node = 0; node < static_cast<int>(nodes.size()); ++node) {
    const auto* every = std::get_if<OnPeriod>(&spec(node).trigger);
    if (every == nullptr) {
      continue;
    }
    at(queue.now() + every->phase, EventOrder::trigger,
       [node](VirtualComputer& computer) { computer.trigger_periodically(node); });
  }
}

void VirtualComputer::at(MissionTime time,
                         EventOrder order,
                         std::function<void(VirtualComputer&)> action) {
  queue.schedule(time, order, [weak = weak_from_this(), action = std::move(action)] {
    if (const auto computer = weak.lock(); computer && !computer->is_stopped) {
      action(*computer);
    }
  });
}

void VirtualComputer::trigger_periodically(int node) {
  at(queue.now() + std::get<OnPeriod>(spec(node).trigger).period, EventOrder::trigger,
     [node](VirtualComputer& computer) { computer.trigger_periodically(node); });
  if (nodes[index(node)].job) {
    ++dropped_periods;
  } else {
    release(node, queue.now());
  }
}

void VirtualComputer::publish(int topic, const Message& published) {
  const Message message = filter ? filter(topic, published) : published;
  if (!message) {
    return;
  }
  for (const int node : exchange.put(topic, message, queue.now())) {
    if (!nodes[index(node)].job) {
      release(node, queue.now());
    }
  }
  auto& told = listeners[index(topic)];
  const std::size_t count = told.size();
  for (std::size_t i = 0; i < count; ++i) {
    told[i](message);
  }
}

void VirtualComputer::release(int node, MissionTime at_time) {
  Job job;
  job.id = jobs_released++;
  job.place = place_of(node);
  job.record.node = node;
  job.record.released = at_time;
  if (const Duration deadline = spec(node).deadline; deadline > Duration::zero()) {
    // `trigger`: behind the jobs that end at the same moment, for those are in time
    at(std::max(queue.now(), at_time + deadline), EventOrder::trigger,
       [node, id = job.id](VirtualComputer& computer) { computer.pass_deadline(node, id); });
  }
  nodes[index(node)].job = std::move(job);
  request_dispatch();
}

void VirtualComputer::release_next(int node) {
  if (const auto since = exchange.owed_since(node)) {
    release(node, *since);
  }
}

void VirtualComputer::pass_deadline(int node, std::uint64_t job) {
  auto& late = nodes[index(node)].job;
  if (!late || late->id != job) {
    return;
  }
  late->record.missed = true;
  const OnMiss on_miss = spec(node).on_miss;
  for (std::size_t i = 0; i < miss_listeners.size(); ++i) {
    miss_listeners[i](node, on_miss);
  }
  if (on_miss == OnMiss::skip) {
    tell_to_stop(node);
  }
}

void VirtualComputer::tell_to_stop(int node) {
  Job& job = *nodes[index(node)].job;
  const Duration latency = spec(node).stop_latency;
  if (!job.has_started || latency <= Duration::zero()) {
    kill_job(node);
    return;
  }
  job.is_told_to_stop = true;
  at(queue.now() + latency, EventOrder::trigger, [node, id = job.id](VirtualComputer& computer) {
    if (const auto& present = computer.nodes[index(node)].job; present && present->id == id) {
      computer.kill_job(node);
    }
  });
}

Job VirtualComputer::take_job(int node) {
  advance();
  Job job = std::move(*nodes[index(node)].job);
  nodes[index(node)].job.reset();
  job.record.ended = queue.now();
  job.record.busy = nearest_duration(job.busy_s);
  request_dispatch();
  return job;
}

void VirtualComputer::end_job(int node) {
  if (nodes[index(node)].job->is_told_to_stop) {
    kill_job(node);
    return;
  }
  if (const Job& ended = *nodes[index(node)].job;
      ended.place == ComputePlace::edge && !ended.is_done) {
    send_outputs(node);
    return;
  }
  const Job job = take_job(node);
  release_next(node);
  for (const auto& action : job.at_end) {
    action(queue.now());
  }
  for (const auto& [topic, message] : job.outputs) {
    publish(topic, message);
    if (job.place == ComputePlace::edge) {
      edge->knows(topic, exchange.version(topic));
    }
  }
  tell(job.record);
}

void VirtualComputer::kill_job(int node) {
  Job job = take_job(node);
  job.record.killed = true;
  if (!job.has_started) {
    job.record.started = job.record.ended;
    exchange.drop_trigger(node);  // Nobody will read it any more.
  }
  release_next(node);
  tell(job.record);
}

void VirtualComputer::tell(const JobRecord& record) {
  for (std::size_t i = 0; i < job_listeners.size(); ++i) {
    job_listeners[i](record);
  }
}

VirtualExecutor::VirtualExecutor(const Graph& graph,
                                 const Platform& platform,
                                 EventQueue& queue,
                                 OperatingPoint point)
    : computer_{std::make_shared<VirtualComputer>(graph, platform, queue, point)} {
  computer_->start();
}

VirtualExecutor::~VirtualExecutor() = default;

void VirtualExecutor::filter_messages(std::function<Message(int topic, const Message&)> filter) {
  computer_->filter = std::move(filter);
}

void VirtualExecutor::on_job(std::function<void(const JobRecord&)> listener) {
  computer_->job_listeners.push_back(std::move(listener));
}

void VirtualExecutor::on_miss(std::function<void(int node, OnMiss)> listener) {
  computer_->miss_listeners.push_back(std::move(listener));
}

void VirtualExecutor::set_operating_point(const OperatingPoint& point) {
  computer_->set_operating_point(point);
}

void VirtualExecutor::platform_changed() {
  computer_->change_platform();
}

OperatingPoint VirtualExecutor::operating_point() const {
  return computer_->point;
}

double VirtualExecutor::busy_core_s() const {
  const double since_s = to_seconds(computer_->queue.now() - computer_->advanced_to);
  return computer_->busy_core_s + computer_->busy_cores() * since_s;
}

double VirtualExecutor::busiest_core_s() const {
  const double since_s = to_seconds(computer_->queue.now() - computer_->advanced_to);
  return computer_->busiest_core_s + std::min(1.0, computer_->busy_cores()) * since_s;
}

double VirtualExecutor::busy_cores() const {
  return computer_->busy_cores();
}

std::uint64_t VirtualExecutor::drops() const {
  return computer_->exchange.drops() + computer_->dropped_periods;
}

void VirtualExecutor::connect_edge(const EdgeModel& edge) {
  computer_->edge.emplace(edge, computer_->graph.topics().size());
}

void VirtualExecutor::place(int node, bool on_edge) {
  computer_->place(node, on_edge);
}

DeviceUse VirtualExecutor::device_use() const {
  DeviceUse use;
  const double since_s = to_seconds(computer_->queue.now() - computer_->advanced_to);
  use.gpu_s = computer_->busy_gpu_s + (computer_->is_gpu_busy() ? since_s : 0.0);
  if (computer_->edge) {
    use.sending_s = computer_->edge->up.on_air_s(computer_->queue.now());
    use.receiving_s = computer_->edge->down.on_air_s(computer_->queue.now());
  }
  return use;
}

void VirtualExecutor::stop() {
  computer_->is_stopped = true;
}

void VirtualExecutor::inject(int topic, Message message) {
  computer_->publish(topic, message);
}

void VirtualExecutor::listen(int topic, std::function<void(const Message&)> listener) {
  computer_->listeners[VirtualComputer::index(topic)].push_back(std::move(listener));
}

}  // namespace flyball
