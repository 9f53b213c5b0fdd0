// SPDX-License-Identifier: BSD-3-Clause
//
// A message's way from one job to the next: on one thread, to another one that spins, to one that
// sleeps; beside oneTBB's flow graph and threads with condition variables, in one run. Or a graph
// of a delivery's shape for as long as one likes:
//
//     ninja hop_bench && bin/hop_bench
//     bin/hop_bench --soak 3600 --fifo 50
//
// What it prints depends on kernel, scheduling and host: these stand above the table.

#include "flyball/runtime/realtime/cpus.h"
#include "flyball/runtime/realtime/realtime_executor.h"

#include "bench/delivery_soak.h"
#include "bench/hop_times.h"
#include "counting_new.h"
#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <optional>
#include <thread>

#include <sys/utsname.h>

#ifdef FLYBALL_HAS_TBB
#include <oneapi/tbb/flow_graph.h>
#include <oneapi/tbb/task_arena.h>
#endif

namespace flyball::bench {
namespace {

constexpr std::size_t hops = 20000;

struct Row {
  std::string name;
  double median_us{};
  double p99_us{};
  std::optional<double> allocations{};  ///< A hop, where they are counted.
};

Row row_of(const std::string& name, const HopTimes& times) {
  return {name, times.quantile_us(0.5), times.quantile_us(0.99), std::nullopt};
}

/// Two nodes that start one another, on one thread or on two.
class Rally {
 public:
  Rally(bool on_one_thread, Duration spin) : on_one_thread_{on_one_thread} {
    const auto to = graph_.topic<Ball>("to", 2);
    const auto fro = graph_.topic<Ball>("fro", 2);
    add("one", 1, to, fro);
    add("other", on_one_thread ? 1 : 0, fro, to);
    settings_.spin = spin;
    if (on_one_thread) {
      settings_.cpus = {usable_cpus().front()};
    }
    settings_.lock_memory = true;
    first_ = to;
  }

  Row play(const std::string& name) {
    RealtimeExecutor executor{
        graph_, {static_cast<int>(usable_cpus().size()), Hertz{1e9}}, settings_};
    executor.publish(first_, Ball{now_ns()});
    while (!is_over_) {
      executor.serve_until(executor.now() + std::chrono::milliseconds{20});
    }
    executor.stop();
    Row row = row_of(name, times_);
    if (on_one_thread_) {
      row.allocations = static_cast<double>(allocated_) / static_cast<double>(hops);
    }
    return row;
  }

 private:
  void add(const std::string& name, int priority, Topic<Ball> in, Topic<Ball> out) {
    NodeSpec spec;
    spec.name = name;
    spec.priority = priority;
    spec.trigger = OnMessage{in.index};
    spec.writes = {out.index};
    graph_.node(spec, [this, in, out](JobContext& context) {
      const auto ball = context.take(in);
      const bool was_warm = times_.is_warm();
      if (times_.note(*ball)) {
        // Its predecessor's work lies between this job and the last one of this thread.
        allocated_ += was_warm ? allocation_count() - seen_ : 0;
        seen_ = allocation_count();
        context.publish(out, Ball{now_ns()});
      } else {
        is_over_ = true;
      }
      return Work{};
    });
  }

  bool on_one_thread_;
  Graph graph_{"rally"};
  RealtimeSettings settings_{};
  Topic<Ball> first_{};
  HopTimes times_{hops};
  std::atomic<bool> is_over_{};
  std::size_t allocated_{};
  std::size_t seen_{};
};

/// What anybody would write: a thread for each player, a lock and a condition.
Row with_conditions(const std::string& name) {
  struct Box {
    std::mutex mutex{};
    std::condition_variable filled{};
    std::optional<Ball> ball{};
    void put(const Ball& sent) {
      {
        const std::lock_guard lock{mutex};
        ball = sent;
      }
      filled.notify_one();
    }
    Ball take() {
      std::unique_lock lock{mutex};
      filled.wait(lock, [this] { return ball.has_value(); });
      return *std::exchange(ball, std::nullopt);
    }
  };
  std::array<Box, 2> boxes;
  HopTimes times{hops};
  std::atomic<bool> is_over{};
  const auto player = [&](std::size_t own) {
    while (true) {
      const Ball ball = boxes.at(own).take();
      if (is_over) {
        return;
      }
      is_over = !times.note(ball);
      boxes.at(1 - own).put(Ball{now_ns()});
      if (is_over) {
        return;
      }
    }
  };
  std::thread one{player, 0};
  std::thread other{player, 1};
  boxes[0].put(Ball{now_ns()});
  one.join();
  other.join();
  return row_of(name, times);
}

#ifdef FLYBALL_HAS_TBB
/// Its successors are tasks, which the thread that spawned them usually takes itself.
Row with_flow_graph(const std::string& name) {
  namespace flow = oneapi::tbb::flow;
  HopTimes times{hops};
  oneapi::tbb::task_arena arena{static_cast<int>(usable_cpus().size())};
  arena.execute([&] {
    flow::graph graph;
    using Player = flow::multifunction_node<Ball, std::tuple<Ball>>;
    const auto play = [&times](const Ball& ball, Player::output_ports_type& out) {
      if (times.note(ball)) {
        std::get<0>(out).try_put(Ball{now_ns()});
      }
    };
    Player one{graph, flow::serial, play};
    Player other{graph, flow::serial, play};
    flow::make_edge(flow::output_port<0>(one), other);
    flow::make_edge(flow::output_port<0>(other), one);
    one.try_put(Ball{now_ns()});
    graph.wait_for_all();
  });
  return row_of(name, times);
}
#endif

/// Where it runs, and what else does: processes that want a core, a mean of five minutes.
void print_machine() {
  utsname system{};
  uname(&system);
  std::array<double, 2> load{};
  (void)getloadavg(load.data(), 2);
  std::printf("Linux %s, %s, %zu cores, load %.1f", system.release, system.machine,
              usable_cpus().size(), load[1]);
}

void print_conditions() {
  print_machine();
  std::printf(", ordinary scheduling; %zu hops each, microseconds\n\n", hops);
}

void print(const Row& row) {
  std::printf("| %-42s | %8.2f | %8.2f | %11s |\n", row.name.c_str(), row.median_us, row.p99_us,
              row.allocations ? std::to_string(*row.allocations).substr(0, 6).c_str() : "");
  std::fflush(stdout);
}

void measure_all() {
  using std::chrono::microseconds;
  print_conditions();
  std::printf("| %-42s | %8s | %8s | %11s |\n|---|---|---|---|\n", "hop", "median", "99 %",
              "allocations");
  print(Rally{true, {}}.play("real-time executor, same thread"));
#ifdef FLYBALL_HAS_TBB
  print(with_flow_graph("oneTBB flow graph"));
#endif
  print(Rally{false, microseconds{200}}.play("real-time executor, thread that spins"));
  print(Rally{false, {}}.play("real-time executor, thread that sleeps"));
  print(with_conditions("threads with condition variables"));
}

}  // namespace
}  // namespace flyball::bench

int main(int argc, char** argv) {
  const bool is_soak = (argc == 3 || argc == 5) && std::strcmp(argv[1], "--soak") == 0;
  const bool is_fifo = argc == 5 && std::strcmp(argv[3], "--fifo") == 0;
  if (argc != 1 && (!is_soak || std::atof(argv[2]) <= 0.0 || is_fifo != (argc == 5) ||
                    (is_fifo && std::atoi(argv[4]) <= 0))) {
    std::fprintf(stderr, "usage: hop_bench [--soak SECONDS [--fifo PRIORITY]], both more than 0\n");
    return 2;
  }
  if (is_soak) {
    const auto priority = is_fifo ? std::optional{std::atoi(argv[4])} : std::nullopt;
    flyball::bench::soak(std::atof(argv[2]), priority);
    flyball::bench::print_machine();
    std::printf(", %s\n", is_fifo ? "real-time priorities" : "ordinary scheduling");
    return 0;
  }
  flyball::bench::measure_all();
  return 0;
}
