// SPDX-License-Identifier: BSD-3-Clause
#include "pool_executor.h"

#include "flyball/runtime/random.h"

#include "pool_job.h"
#include <algorithm>
#include <atomic>
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
  State state{State::idle};
  MissionTime released{};
  std::uint64_t due_slice{};  ///< The job has ended when this slice has.
  std::vector<Inbox> inboxes{};
  bool has_trigger_inbox{};
};

struct PoolTopic {
  Message newest{};
  std::vector<int> readers{};
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
        nodes(hosted.nodes().size()),
        topics(hosted.topics().size()),
        listeners(hosted.topics().size()) {}

  [[nodiscard]] const NodeSpec& spec(int node) const { return graph.nodes()[index(node)].spec; }
  void open_inboxes(int node);
  void start();
  void every(MissionTime first, Duration period, EventOrder order, std::function<void()> action);

  // With the lock held.
  void put(int topic, const Message& message);
  void deliver(int node, int topic, const Message& message);
  void release(int node, MissionTime at);
  void begin(int node, PoolJob& job);
  void end(int node, PoolJob& job);
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
  std::vector<PoolNode> nodes;
  std::vector<PoolTopic> topics;
  std::vector<int> ready{};
  std::vector<int> running{};
  std::deque<News> news{};
  std::set<std::pair<int, int>> overlaps{};
  bool is_stopped{};

  std::atomic<std::uint64_t> drops{};
  mutable std::mutex point_mutex{};  ///< Of the two points.
  OperatingPoint wanted{};
  OperatingPoint granted{};

  // The owner's thread only. Deques: a listener may add another one while it runs.
  std::vector<std::deque<std::function<void(const Message&)>>> listeners;
  std::deque<std::function<void(const JobRecord&)>> job_listeners{};
  std::vector<std::thread> threads{};
};

void PoolExecutor::Pool::open_inboxes(int node) {
  PoolNode& here = nodes[index(node)];
  std::vector<int> reads = spec(node).reads;
  if (const auto* message = std::get_if<OnMessage>(&spec(node).trigger)) {
    here.has_trigger_inbox = true;
    reads.insert(reads.begin(), message->topic);
  }
  for (const int topic : reads) {
    auto& readers = topics[index(topic)].readers;
    if (readers.empty() || readers.back() != node) {
      readers.push_back(node);
      here.inboxes.emplace_back(topic, graph.topics()[index(topic)].capacity);
    }
  }
}

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
  for (int node = 0; node < static_cast<int>(nodes.size()); ++node) {
    open_inboxes(node);
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
  PoolTopic& here = topics[index(topic)];
  here.newest = message;
  for (const int node : here.readers) {
    deliver(node, topic, message);
  }
}

void PoolExecutor::Pool::deliver(int node, int topic, const Message& message) {
  PoolNode& reader = nodes[index(node)];
  const auto inbox = std::find_if(reader.inboxes.begin(), reader.inboxes.end(),
                                  [topic](const Inbox& box) { return box.topic() == topic; });
  const bool is_trigger = reader.has_trigger_inbox && inbox == reader.inboxes.begin();
  if (inbox->add(message, now) && (is_trigger || inbox->capacity() > 1)) {
    ++drops;
  }
  if (is_trigger && reader.state == PoolNode::State::idle) {
    release(node, now);
  }
}

void PoolExecutor::Pool::release(int node, MissionTime at) {
  PoolNode& here = nodes[index(node)];
  here.state = PoolNode::State::ready;
  here.released = at;
  std::uint64_t more = random.next() % (static_cast<std::uint64_t>(settings.most_slices_more) + 1);
  if (const Duration deadline = spec(node).deadline; deadline > Duration::zero()) {
    const auto whole_slices = static_cast<std::uint64_t>(deadline / settings.slice);
    more = std::min(more, std::max<std::uint64_t>(whole_slices, 1) - 1);
  }
  here.due_slice = slice + more;
  ready.push_back(node);
  ready_or_stopped.notify_one();
}

/// The inboxes go with the job; what arrives meanwhile is collected in empty ones.
void PoolExecutor::Pool::begin(int node, PoolJob& job) {
  PoolNode& here = nodes[index(node)];
  here.state = PoolNode::State::running;
  for (const int other : running) {
    overlaps.emplace(std::min(node, other), std::max(node, other));
  }
  running.push_back(node);
  job.record.node = node;
  job.record.released = here.released;
  if (random.next() % jobs_per_pause == 0) {
    job.pause = std::chrono::microseconds{random.next() % longest_pause_us};
  }
  for (Inbox& inbox : here.inboxes) {
    job.newest.push_back(topics[index(inbox.topic())].newest);
    job.unread.push_back(std::exchange(inbox, Inbox{inbox.topic(), inbox.capacity()}));
  }
}

void PoolExecutor::Pool::end(int node, PoolJob& job) {
  PoolNode& here = nodes[index(node)];
  if (here.has_trigger_inbox && !job.has_taken_trigger) {
    (void)job.unread.front().take();  // Read by `latest`, or of no interest: one job, one message.
  }
  for (std::size_t i = 0; i < here.inboxes.size(); ++i) {
    Inbox arrived = std::exchange(here.inboxes[i], std::move(job.unread[i]));
    while (const auto at = arrived.oldest_arrival()) {
      const bool counts = (here.has_trigger_inbox && i == 0) || arrived.capacity() > 1;
      drops += here.inboxes[i].add(arrived.take(), *at) && counts ? 1 : 0;
    }
  }
  running.erase(std::find(running.begin(), running.end(), node));
  here.state = PoolNode::State::idle;
  if (const auto next = here.has_trigger_inbox ? here.inboxes.front().oldest_arrival()
                                               : std::optional<MissionTime>{}) {
    release(node, *next);
  }
  job.record.ended = now;
  for (const auto& [topic, message] : job.outputs) {
    put(topic, message);
    news.push_back({topic, message, {}});
  }
  news.push_back({-1, nullptr, job.record});
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
    PoolJob job{spec(node), now};
    begin(node, job);
    lock.unlock();
    std::this_thread::sleep_for(job.pause);
    job.record.work = graph.nodes()[index(node)].body(job);
    for (const auto& action : job.last_actions) {
      action(job.now());
    }
    lock.lock();
    end(node, job);
  }
}

void PoolExecutor::Pool::trigger(int node) {
  const std::lock_guard lock{mutex};
  now = queue.now();
  if (nodes[index(node)].state == PoolNode::State::idle) {
    release(node, now);
  } else {
    ++drops;
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
  return pool_->drops.load(std::memory_order_relaxed);
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
