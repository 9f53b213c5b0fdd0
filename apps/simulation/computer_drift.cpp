// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/computer_drift.h"

#include "flyball/records/text_table.h"

#include "scenario/computer_strain.h"

namespace flyball {
namespace {

using namespace std::chrono_literals;

// Computers warm in minutes; kernels of Linux look about as often.
constexpr auto heat_period = 100ms;
constexpr std::uint64_t steps_per_record = 10;

std::string degrees(double temperature_c) {
  return rounded(temperature_c, 1) + " degrees Celsius";
}

}  // namespace

ComputerDrift::ComputerDrift(MissionLink& link,
                             const Scenario& scenario,
                             DriftingPlatform& platform,
                             Executor& executor,
                             EventQueue& queue,
                             const ClosedLoop& loop)
    : link_{link},
      scenario_{scenario},
      platform_{platform},
      executor_{executor},
      queue_{queue},
      loop_{loop} {}

void ComputerDrift::start(const std::optional<ThermalModel>& thermal) {
  nominal_ = thermal;
  if (thermal) {
    heat_.emplace(*thermal, platform_.power(executor_.operating_point(), 0.0));
    if (const double warm_c = scenario_.platform.start_temperature_c; warm_c != 0.0) {
      heat_->set_temperature(warm_c);
    }
    obey_trips();
    queue_.every(queue_.now() + heat_period, heat_period, EventOrder::sensor,
                 [this] { heat_step(); });
  }
  for (const ComputerEvent& event : scenario_.events) {
    if (event.kind != "bit_flip") {  // Those are of `SoftErrors`.
      schedule(event);
    }
  }
}

void ComputerDrift::schedule(const ComputerEvent& event) {
  queue_.schedule(begin_of(event), EventOrder::sensor, [this, &event] { change(event, true); });
  if (const auto end = end_of(event)) {
    queue_.schedule(*end, EventOrder::sensor, [this, &event] { change(event, false); });
  }
}

void ComputerDrift::change(const ComputerEvent& event, bool begins) {
  link_.event(describe(event, begins));
  cool();
  strain();
}

void ComputerDrift::strain() {
  Strain strain = strain_at(scenario_.events, queue_.now());
  strain.clock_cap = cap_;
  platform_.set(strain);
  executor_.platform_changed();
}

/// Of several, the last one in the scenario counts.
void ComputerDrift::cool() {
  if (!heat_) {
    return;
  }
  double ambient_c = nominal_->ambient_c;
  double resistance_k_w = nominal_->resistance_k_w;
  for (const ComputerEvent& event : scenario_.events) {
    if (event.kind == "cooling" && is_active(event, queue_.now())) {
      ambient_c = event.ambient_c;
      resistance_k_w = event.resistance_k_w;
    }
  }
  heat_->set_cooling(ambient_c, resistance_k_w);
}

void ComputerDrift::heat_step() {
  const double dt_s = to_seconds(Duration{heat_period});
  const double energy_j = loop_.log().energy_computer_j;
  heat_->step(Watts{(energy_j - last_energy_j_) / dt_s}, dt_s);
  last_energy_j_ = energy_j;
  obey_trips();
  if (++steps_ % steps_per_record == 0) {
    link_.log("heat", {{"temperature_c", heat_->temperature_c()},
                       {"granted_hz", executor_.operating_point().frequency.value()}});
  }
}

void ComputerDrift::obey_trips() {
  const std::optional<Hertz> cap = heat_->cap();
  if (cap == cap_) {
    return;
  }
  const bool is_lower = cap && (!cap_ || *cap < *cap_);
  throttle_events_ += is_lower ? 1 : 0;
  cap_ = cap;
  const std::string at = " at " + degrees(heat_->temperature_c());
  link_.event(cap ? (is_lower ? "throttled to " : "throttled less, to ") +
                        rounded(1e-9 * cap->value(), 3) + " GHz" + at
                  : "not throttled any more" + at);
  strain();
}

std::optional<double> ComputerDrift::hottest_c() const {
  return heat_ ? std::optional{heat_->hottest_c()} : std::nullopt;
}

}  // namespace flyball
