// SPDX-License-Identifier: BSD-3-Clause
#include "pool_executor.h"

#include "flyball/runtime/random.h"

#include "message_exchange.h"
#include "node_job.h"
#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace flyball::kit {
namespace {

// Every so many jobs one waits a little before its body, so that others overlap with it even where
// one core runs all threads.
constexpr std::uint64_t jobs_per_pause = 4;
constexpr std::uint64_t longest_pause_us = 400;

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

struct PoolNode {
  enum class State { idle, ready, running };
  explicit PoolNode(const NodeSpec& spec) : job{spec, nullptr} {}

  State state{State::idle};
  std::uint64_t due_slice{};  ///< The job has ended when this slice has.
  std::chrono::microseconds pause{};
  NodeJob job;
};

/// What listeners have not yet been told: a message, or that a job has ended.
struct News {
  int topic{-1};
  Message message{};
  JobRecord job{};
};

}  // namespace

struct PoolExecutor::Pool : std::enable_shared_from_this<Pool> {
  Pool(const Graph& hosted, const Platform& model, EventQueue& events, const PoolSettings& chosen)
      : graph{hosted},
        platform{model},
        queue{events},
        settings{chosen},
        random{chosen.seed, "pool"},
        exchange{hosted},
        listeners(hosted.topics().size()) {}

  [[nodiscard]] const NodeSpec& spec(int node) const { return graph.nodes()[index(node)].spec; }
  void start();
  void every(MissionTime first, Duration period, EventOrder order, std::function<void()> action);

  // With the lock held.
  void put(int topic, const Message& message);
  void release(int node, MissionTime at);
  void begin(int node);
  void end(int node);
  [[nodiscard]] bool has_job_due(std::uint64_t by_slice) const;

  void work();
  void trigger(int node);
  void end_slice();
  void wait_until(const std::function<bool()>& done);
  [[nodiscard]] bool tell_news();
  void grant();
  void name_overlaps() const;

  const Graph& graph;
  const Platform& platform;
  EventQueue& queue;
  const PoolSettings settings;

  mutable std::mutex mutex{};  ///< Of all that follows, down to `is_stopped`.
  std::condition_variable ready_or_stopped{};
  std::condition_variable job_ended{};
  RandomStream random;
  MissionTime now{};
  std::uint64_t slice{};
  MessageExchange exchange;
  std::deque<PoolNode> nodes{};
  std::uint64_t dropped_periods{};
  std::vector<int> ready{};
  std::vector<int> running{};
  std::deque<News> news{};
  std::set<std::pair<int, int>> overlaps{};
  bool is_stopped{};

  mutable std::mutex point_mutex{};  ///< Of the two points.
  OperatingPoint wanted{};
  OperatingPoint granted{};

  // The owner's thread only. Deques: a listener may add another one while it runs.
  std::vector<std::deque<std::function<void(const Message&)>>> listeners;
  std::deque<std::function<void(const JobRecord&)>> job_listeners{};
  std::vector<std::thread> threads{};
};

void PoolExecutor::Pool::every(MissionTime first,
                               Duration period,
                               EventOrder order,
                               std::function<void()> action) {
  queue.every(first, period, order, [weak = weak_from_this(), action = std::move(action)] {
    if (const auto pool = weak.lock()) {
      action();
    }
  });
}

void PoolExecutor::Pool::start() {
  for (int node = 0; node < static_cast<int>(graph.nodes().size()); ++node) {
    exchange.equip(node, nodes.emplace_back(spec(node)).job);
    if (const auto* period = std::get_if<OnPeriod>(&spec(node).trigger)) {
      every(queue.now() + period->phase, period->period, EventOrder::trigger,
            [this, node] { trigger(node); });
    }
  }
  every(queue.now() + settings.slice, settings.slice, EventOrder::observer,
        [this] { end_slice(); });
  for (int i = 0; i < settings.threads; ++i) {
    threads.emplace_back([this] { work(); });
  }
}

void PoolExecutor::Pool::put(int topic, const Message& message) {
  for (const int node : exchange.put(topic, message, now)) {
    if (nodes[index(node)].state == PoolNode::State::idle) {
      release(node, now);
    }
  }
}

void PoolExecutor::Pool::release(int node, MissionTime at) {
  PoolNode& here = nodes[index(node)];
  here.state = PoolNode::State::ready;
  here.job.renew();
  here.job.record.node = node;
  here.job.record.released = at;
  std::uint64_t more = random.next() % (static_cast<std::uint64_t>(settings.most_slices_more) + 1);
  if (const Duration deadline = spec(node).deadline; deadline > Duration::zero()) {
    const auto whole_slices = static_cast<std::uint64_t>(deadline / settings.slice);
    more = std::min(more, std::max<std::uint64_t>(whole_slices, 1) - 1);
  }
  here.due_slice = slice + more;
  ready.push_back(node);
  ready_or_stopped.notify_one();
}

void PoolExecutor::Pool::begin(int node) {
  PoolNode& here = nodes[index(node)];
  here.state = PoolNode::State::running;
  for (const int other : running) {
    overlaps.emplace(std::min(node, other), std::max(node, other));
  }
  running.push_back(node);
  here.job.record.started = now;
  here.pause = {};
  if (random.next() % jobs_per_pause == 0) {
    here.pause = std::chrono::microseconds{random.next() % longest_pause_us};
  }
  exchange.open(node, here.job);
}

void PoolExecutor::Pool::end(int node) {
  PoolNode& here = nodes[index(node)];
  NodeJob& job = here.job;
  exchange.close(node, job);
  running.erase(std::find(running.begin(), running.end(), node));
  job.note_questions();
  job.record.ended = now;
  for (const auto& [topic, message] : job.outputs) {
    put(topic, message);
    news.push_back({topic, message, {}});
  }
  news.push_back({-1, nullptr, job.record});
  here.state = PoolNode::State::idle;
  if (const auto since = exchange.owed_since(node)) {
    release(node, *since);
  }
  job_ended.notify_all();
}

void PoolExecutor::Pool::work() {
  std::unique_lock lock{mutex};
  while (true) {
    ready_or_stopped.wait(lock, [this] { return is_stopped || !ready.empty(); });
    if (is_stopped) {
      return;
    }
    std::swap(ready[random.next() % ready.size()], ready.back());
    const int node = ready.back();
    ready.pop_back();
    begin(node);
    lock.unlock();
    NodeJob& job = nodes[index(node)].job;
    std::this_thread::sleep_for(nodes[index(node)].pause);
    job.record.work = graph.nodes()[index(node)].body(job);
    for (const auto& action : job.last_actions) {
      action(job.now());
    }
    lock.lock();
    end(node);
  }
}

void PoolExecutor::Pool::trigger(int node) {
  const std::lock_guard lock{mutex};
  now = queue.now();
  if (nodes[index(node)].state == PoolNode::State::idle) {
    release(node, now);
  } else {
    ++dropped_periods;
  }
}

bool PoolExecutor::Pool::has_job_due(std::uint64_t by_slice) const {
  return std::any_of(nodes.begin(), nodes.end(), [by_slice](const PoolNode& node) {
    return node.state != PoolNode::State::idle && node.due_slice <= by_slice;
  });
}

void PoolExecutor::Pool::wait_until(const std::function<bool()>& done) {
  std::unique_lock lock{mutex};
  now = queue.now();
  job_ended.wait(lock, [&] { return is_stopped || done(); });
}

void PoolExecutor::Pool::end_slice() {
  wait_until([this] { return !has_job_due(slice); });
  {
    const std::lock_guard lock{mutex};
    ++slice;
  }
  grant();
  (void)tell_news();
}

bool PoolExecutor::Pool::tell_news() {
  std::deque<News> untold;
  {
    const std::lock_guard lock{mutex};
    untold.swap(news);
  }
  for (const News& one : untold) {
    const std::size_t count =
        one.topic < 0 ? job_listeners.size() : listeners[index(one.topic)].size();
    for (std::size_t i = 0; i < count; ++i) {
      one.topic < 0 ? job_listeners[i](one.job) : listeners[index(one.topic)][i](one.message);
    }
  }
  return !untold.empty();
}

void PoolExecutor::Pool::grant() {
  const std::lock_guard lock{point_mutex};
  granted = platform.granted(wanted);
}

void PoolExecutor::Pool::name_overlaps() const {
  for (const auto& [one, other] : overlaps) {
    if (settings.overlaps != nullptr) {
      settings.overlaps->insert(std::minmax(spec(one).name, spec(other).name));
    }
  }
}

PoolExecutor::PoolExecutor(const Graph& graph,
                           const Platform& platform,
                           EventQueue& queue,
                           const OperatingPoint& point,
                           const PoolSettings& settings)
    : pool_{std::make_shared<Pool>(graph, platform, queue, settings)} {
  pool_->wanted = point;
  pool_->grant();
  pool_->start();
}

PoolExecutor::~PoolExecutor() {
  stop();
}

void PoolExecutor::settle() {
  do {
    pool_->wait_until([this] { return pool_->ready.empty() && pool_->running.empty(); });
  } while (pool_->tell_news());
}

void PoolExecutor::on_job(std::function<void(const JobRecord&)> listener) {
  pool_->job_listeners.push_back(std::move(listener));
}

void PoolExecutor::on_miss(std::function<void(int node, OnMiss)> /*listener*/) {}

void PoolExecutor::set_operating_point(const OperatingPoint& point) {
  const std::lock_guard lock{pool_->point_mutex};
  pool_->wanted = point;
}

OperatingPoint PoolExecutor::operating_point() const {
  const std::lock_guard lock{pool_->point_mutex};
  return pool_->granted;
}

void PoolExecutor::platform_changed() {
  pool_->grant();
}

std::uint64_t PoolExecutor::drops() const {
  const std::lock_guard lock{pool_->mutex};
  return pool_->exchange.drops() + pool_->dropped_periods;
}

void PoolExecutor::stop() {
  {
    const std::lock_guard lock{pool_->mutex};
    pool_->is_stopped = true;
  }
  pool_->ready_or_stopped.notify_all();
  for (std::thread& thread : pool_->threads) {
    thread.join();
  }
  pool_->threads.clear();
  pool_->name_overlaps();
}

void PoolExecutor::inject(int topic, Message message) {
  {
    const std::lock_guard lock{pool_->mutex};
    pool_->now = pool_->queue.now();
    pool_->put(topic, message);
  }
  auto& here = pool_->listeners[index(topic)];
  const std::size_t count = here.size();
  for (std::size_t i = 0; i < count; ++i) {
    here[i](message);
  }
}

void PoolExecutor::listen(int topic, std::function<void(const Message&)> listener) {
  pool_->listeners[index(topic)].push_back(std::move(listener));
}

}  // namespace flyball::kit
