// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/mcap/record_thread.h"

#include "flyball/runtime/assert.h"
#include "flyball/runtime/realtime/cpus.h"
#include "flyball/runtime/realtime/parking.h"

#include "mcap/byte_queue.h"
#include <atomic>
#include <chrono>
#include <csignal>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include <pthread.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

// How long a row may lie in a queue that is not half full. Chosen: short beside a chunk.
constexpr auto look_period = 50ms;

/// All signals go to other threads while it lives.
class WithoutSignals {
 public:
  WithoutSignals() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~WithoutSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  WithoutSignals(const WithoutSignals&) = delete;
  WithoutSignals& operator=(const WithoutSignals&) = delete;

 private:
  sigset_t before_{};
};

MissionTime time_of(const RowHead& head) {
  return MissionTime{Duration{head.at_ns}};
}

}  // namespace

struct RecordThread::Parts {
  Parts(const RecordThreadSettings& wanted, std::unique_ptr<McapWriter> out)
      : settings{wanted},
        writer{std::move(out)},
        queue{wanted.queue_bytes},
        later(wanted.most_later),
        sequences(wanted.file.channels.size()),
        dropped(wanted.file.channels.size()),
        unwritten(wanted.file.channels.size()),
        open(wanted.file.channels.size()) {}

  RecordThreadSettings settings;
  std::unique_ptr<McapWriter> writer;  // Of the writing thread while it runs.
  ByteQueue queue;
  std::vector<std::function<std::string()>> later;  // A ring; its slots follow the queue's order.
  std::atomic<std::uint64_t> later_added{};
  std::atomic<std::uint64_t> later_made{};
  Parking news;
  Parking room;
  std::atomic<bool> is_closing{};
  std::thread thread{};
  bool is_closed{};

  // Of the thread that adds rows, by channel.
  std::vector<std::uint32_t> sequences;
  std::vector<std::uint64_t> dropped;
  // Of the writing thread.
  std::vector<std::uint64_t> unwritten;  // After a write that failed, or in it.
  std::vector<std::uint64_t> open;       // In the chunk that is not closed yet.
  std::uint64_t written{};
  std::chrono::steady_clock::time_point chunk_begun{};

  bool push(std::size_t channel, MissionTime at, std::string_view row, bool is_later);
  template <class Try>
  bool retry_if_it_may(const Try& attempt);
  void run();
  void drain();
  void write(const RowHead& head, const std::string& row);
  void close_old_chunk();
  void settle_chunk();
  [[nodiscard]] std::map<std::string, std::string> counts_as_text() const;
  [[nodiscard]] RecordCounts counts() const;
};

/// Calls `attempt` until it is true, if waiting is allowed; otherwise once.
template <class Try>
bool RecordThread::Parts::retry_if_it_may(const Try& attempt) {
  for (;;) {
    const std::uint32_t ticket = room.ticket();
    if (attempt()) {
      return true;
    }
    if (settings.when_full == WhenFull::drop) {
      return false;
    }
    news.wake();
    room.wait(ticket);
  }
}

bool RecordThread::Parts::push(std::size_t channel,
                               MissionTime at,
                               std::string_view row,
                               bool is_later) {
  FLYBALL_ASSERT(channel < sequences.size(), "no channel %zu", channel);
  const RowHead head{at.time_since_epoch().count(), static_cast<std::uint32_t>(row.size()),
                     sequences[channel]++, static_cast<std::uint16_t>(channel), is_later};
  if (is_closed || !queue.could_hold(row.size()) ||
      !retry_if_it_may([&] { return queue.push(head, row); })) {
    ++dropped[channel];
    return false;
  }
  if (queue.is_half_full()) {
    news.wake();
  }
  return true;
}

void RecordThread::Parts::run() {
  pthread_setname_np(pthread_self(), "flyball_mcap");
  if (settings.when_full == WhenFull::drop) {
    step_back();
  }
  for (;;) {
    const std::uint32_t ticket = news.ticket();
    const bool is_last = is_closing.load(std::memory_order_acquire);
    drain();
    if (is_last) {
      return;
    }
    close_old_chunk();
    news.wait(ticket, {}, Parking::Clock::now() + look_period);
  }
}

void RecordThread::Parts::drain() {
  RowHead head;
  std::string row;
  while (queue.pop(head, row)) {
    if (head.is_later) {
      const std::uint64_t place = later_made.load(std::memory_order_relaxed);
      row = std::exchange(later[place % later.size()], nullptr)();
      later_made.store(place + 1, std::memory_order_release);
    }
    room.wake();
    write(head, row);
  }
}

void RecordThread::Parts::write(const RowHead& head, const std::string& row) {
  if (!writer->status()) {
    ++unwritten[head.channel];
    return;
  }
  const bool had_chunk = writer->has_open_chunk();
  const std::size_t chunks = writer->chunks();
  writer->add(head.channel, head.sequence, time_of(head), row);
  // The row also begins a chunk where its time closes the one before.
  const bool begins = !had_chunk || writer->chunks() > chunks || !writer->status();
  if (begins) {
    settle_chunk();
    chunk_begun = std::chrono::steady_clock::now();
  }
  ++open[head.channel];
  if (!writer->has_open_chunk()) {
    settle_chunk();
  }
}

/// The rows of a chunk that has just been closed: they are in the file, or lost with it.
void RecordThread::Parts::settle_chunk() {
  const bool is_written = writer->status().ok();
  for (std::size_t channel = 0; channel < open.size(); ++channel) {
    (is_written ? written : unwritten[channel]) += std::exchange(open[channel], 0);
  }
}

/// Without it the rows of the last second would stay in memory when no further ones come. Not in
/// simulated time: the host's clock would decide where a chunk ends.
void RecordThread::Parts::close_old_chunk() {
  if (settings.when_full == WhenFull::drop && writer->has_open_chunk() &&
      std::chrono::steady_clock::now() - chunk_begun >= settings.file.chunk_time) {
    writer->close_chunk();
    settle_chunk();
  }
}

RecordCounts RecordThread::Parts::counts() const {
  RecordCounts all;
  for (std::size_t channel = 0; channel < dropped.size(); ++channel) {
    const std::uint64_t lost = dropped[channel] + (is_closed ? unwritten[channel] : 0);
    if (lost > 0) {
      all.dropped += lost;
      all.dropped_by_topic[settings.file.channels[channel].topic] += lost;
    }
  }
  all.written = is_closed ? written : 0;
  return all;
}

std::map<std::string, std::string> RecordThread::Parts::counts_as_text() const {
  const RecordCounts all = counts();
  std::map<std::string, std::string> text{{"messages", std::to_string(all.written)},
                                          {"dropped", std::to_string(all.dropped)}};
  for (const auto& [topic, lost] : all.dropped_by_topic) {
    text["dropped " + topic] = std::to_string(lost);
  }
  return text;
}

Result<std::unique_ptr<RecordThread>> RecordThread::open(
    const std::string& path,
    const RecordThreadSettings& settings,
    const std::map<std::string, std::map<std::string, std::string>>& metadata) {
  FLYBALL_ASSERT(settings.queue_bytes > sizeof(RowHead) &&
                     (settings.queue_bytes & (settings.queue_bytes - 1)) == 0,
                 "%zu bytes are no power of two", settings.queue_bytes);
  auto writer = McapWriter::open(path, settings.file);
  if (!writer) {
    return writer.error();
  }
  for (const auto& [name, values] : metadata) {
    (*writer)->add_metadata(name, values);
  }
  auto parts = std::make_unique<Parts>(settings, std::move(*writer));
  {
    const WithoutSignals in_the_thread_too;
    parts->thread = std::thread{[&all = *parts] { all.run(); }};
  }
  return std::unique_ptr<RecordThread>{new RecordThread{std::move(parts)}};
}

RecordThread::RecordThread(std::unique_ptr<Parts> parts) : parts_{std::move(parts)} {}

RecordThread::~RecordThread() {
  if (!parts_->is_closed) {
    (void)close();
  }
}

bool RecordThread::add(std::size_t channel, MissionTime at, std::string_view message) {
  return parts_->push(channel, at, message, false);
}

bool RecordThread::add_later(std::size_t channel,
                             MissionTime at,
                             std::function<std::string()> make) {
  Parts& p = *parts_;
  const std::uint64_t place = p.later_added.load(std::memory_order_relaxed);
  const auto has_slot = [&] {
    return place - p.later_made.load(std::memory_order_acquire) < p.later.size();
  };
  if (p.is_closed || !p.retry_if_it_may(has_slot)) {
    ++p.sequences[channel];
    ++p.dropped[channel];
    return false;
  }
  // The slot is filled before the row that leads to it can be seen.
  p.later[place % p.later.size()] = std::move(make);
  if (!p.push(channel, at, {}, true)) {
    p.later[place % p.later.size()] = nullptr;
    return false;
  }
  p.later_added.store(place + 1, std::memory_order_relaxed);
  return true;
}

Status RecordThread::close() {
  Parts& p = *parts_;
  if (p.is_closed) {
    return p.writer->status();
  }
  p.is_closing.store(true, std::memory_order_release);
  p.news.wake();
  p.thread.join();
  p.writer->close_chunk();
  p.settle_chunk();
  p.is_closed = true;
  p.writer->add_metadata("flyball.record", p.counts_as_text());
  return p.writer->close();
}

RecordCounts RecordThread::counts() const {
  return parts_->counts();
}

}  // namespace flyball
