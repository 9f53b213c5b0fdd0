// SPDX-License-Identifier: BSD-3-Clause
//
// Govern a node whose loop belongs to somebody else, as in ROS 2: subscriptions and a timer, called
// back by an executor. ROS is not needed here: `Node` below is a stand-in of some twenty lines for
// what such a node uses of rclcpp, with a clock of its own as under `use_sim_time`.
// The node runs a mapper and a planner, and the policy `ondemand` sets the clock of the processor,
// which gets hot after 40 s and then grants less. The program checks that the clock is low while
// scans are small and at its most while they are large, that the governor does not take the lower
// grant for a broken computer for long, and that scans are mapped in time.
//
// All that the governor adds stands between lines `governor {` and `governor }`.

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <functional>
#include <utility>
#include <vector>

// governor {
#include <flyball/governors/governor.h>
// governor }

namespace {

/// Stand-in for rclcpp::Node and its executor: callbacks at times of a simulated clock.
class Node {
 public:
  void create_timer(double period_s, std::function<void()> callback) {
    timers_.push_back({period_s, 0.0, std::move(callback)});
  }
  [[nodiscard]] double now() const { return now_s_; }
  /// What a computation does to a simulated clock.
  void spend(double duration_s) { now_s_ += duration_s; }
  void spin_until(double end_s) {
    while (now_s_ < end_s) {
      auto next = std::min_element(timers_.begin(), timers_.end(),
                                   [](auto& a, auto& b) { return a.next_s < b.next_s; });
      now_s_ = std::max(now_s_, next->next_s);
      next->next_s += next->period_s;
      next->callback();
    }
  }

 private:
  struct Timer {
    double period_s;
    double next_s;
    std::function<void()> callback;
  };
  std::vector<Timer> timers_;
  double now_s_{};
};

/// Clocks while something lasted.
struct Span {
  int decisions{};
  double sum_hz{};
  void add(double clock_hz) {
    ++decisions;
    sum_hz += clock_hz;
  }
  [[nodiscard]] double mean_hz() const { return sum_hz / decisions; }
};

class MappingNode : public Node {
 public:
  MappingNode() {
    create_timer(0.1, [this] { on_scan(); });
    // governor {
    open_governor();
    create_timer(0.25, [this] { on_decision(); });
    // governor }
  }
  // governor {
  ~MappingNode() { flyball_governor_close(governor_); }
  MappingNode(const MappingNode&) = delete;
  MappingNode& operator=(const MappingNode&) = delete;
  // governor }

  Span small{};
  Span large{};
  Span hot{};
  int fallbacks{};
  bool falls_back{};   ///< At the last decision.
  double longest_s{};  ///< Of a large scan, once the clock has followed.

 private:
  static constexpr double top_hz = 2.0e9;

  /// The processor: what was set, but for a limit while it is hot, from 40 s on.
  [[nodiscard]] double clock_hz() const { return std::min(set_hz_, now() > 40.0 ? 1.8e9 : top_hz); }

  /// Small scans until 20 s, large ones afterwards: so many cycles to map, and some to plan.
  void on_scan() {
    const double begin_s = now();
    // governor {
    flyball_governor_begin(governor_, 0, now());
    // governor }
    spend((now() < 20.0 ? 20e6 : 175e6) / clock_hz());
    // governor {
    flyball_governor_end(governor_, 0, now(), nullptr, 0);
    flyball_governor_begin(governor_, 1, now());
    // governor }
    spend(5e6 / clock_hz());
    // governor {
    flyball_governor_end(governor_, 1, now(), nullptr, 0);
    // governor }
    longest_s = begin_s > 22.0 ? std::max(longest_s, now() - begin_s) : 0.0;
  }

  // governor {
  void open_governor() {
    static constexpr double clocks_hz[] = {0.5e9, 1.0e9, 1.5e9, top_hz};
    const auto set_clock = [](void* set_hz, double wished_hz) {
      *static_cast<double*>(set_hz) = wished_hz;
      return 0;
    };
    const FlyballGovernorKnob knob{
        sizeof knob, 4,       "cpu.frequency_hz", "Hz",     "Clock", clocks_hz, 0.0,
        0.0,         set_hz_, set_clock,          &set_hz_, 0.0,     nullptr};
    const FlyballGovernorStage mapping{sizeof mapping, 0, "mapping", nullptr, 0.1, 0, 0};
    const FlyballGovernorStage planning{sizeof planning, 0, "planning", nullptr, 0.0, 0, 0};
    FlyballGovernorSettings settings{};
    settings.struct_size = sizeof settings;
    settings.policy = "ondemand";
    settings.parameters = "sampling_period_s = 0.25";
    if (flyball_governor_add_knob(governor_, &knob) != 0 ||
        flyball_governor_add_stage(governor_, &mapping) != 0 ||
        flyball_governor_add_stage(governor_, &planning) != 0 ||
        flyball_governor_open(governor_, &settings) != 0) {
      std::printf("wrong: %s\n", flyball_governor_last_error(governor_));
    }
    flyball_governor_observe(governor_, "phase", flyball_governor_cruise);
  }

  void on_decision() {
    flyball_governor_granted(governor_, "cpu.frequency_hz", clock_hz());
    FlyballGovernorDecision decision{sizeof decision, 0, 0, 0, "", "", "", 0.0, 0.0, 0.0, {}, {}};
    flyball_governor_decide(governor_, now(), &decision);
    // governor }
    falls_back = std::strcmp(decision.fallback, "none") != 0;
    fallbacks += falls_back ? 1 : 0;
    (now() < 20.0 ? small : now() < 40.0 ? large : hot).add(clock_hz());
    // governor {
  }
  FlyballGovernor* governor_{flyball_governor_create()};
  // governor }
  double set_hz_{top_hz};
};

}  // namespace

int main() {
  MappingNode node;
  node.spin_until(60.0);
  std::printf("mean clock: small scans %.2f GHz, large ones %.2f GHz, hot %.2f GHz\n",
              1e-9 * node.small.mean_hz(), 1e-9 * node.large.mean_hz(), 1e-9 * node.hot.mean_hz());
  std::printf("longest large scan: %.0f ms; %d decisions for the unexpected clock\n",
              1e3 * node.longest_s, node.fallbacks);
  const bool right = node.small.mean_hz() < 1.1e9 && node.large.mean_hz() > 1.9e9 &&
                     node.hot.mean_hz() > 1.7e9 && node.longest_s < 0.11 && node.fallbacks > 0 &&
                     node.fallbacks < 20 && !node.falls_back;
  std::puts(right ? "right" : "wrong");
  return right ? 0 : 1;
}
