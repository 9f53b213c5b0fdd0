// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/board/linux_board.h"

#include "flyball/runtime/board/clock_meter.h"

#include "board/board_meters.h"
#include "board/clock_control.h"
#include "board/core_control.h"
#include "board/sysfs_text.h"
#include <algorithm>
#include <ctime>
#include <set>
#include <utility>

namespace flyball {
namespace {

double process_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Duration switching_time_of(const LinuxSystem& system, const std::vector<CpufreqPolicy>& policies) {
  constexpr long long unknown_ns = 4294967295;  // CPUFREQ_ETERNAL
  if (policies.empty()) {
    return {};
  }
  const auto ns = integer_in(system, policies.front().folder + "/cpuinfo_transition_latency");
  return ns && *ns > 0 && *ns < unknown_ns ? Duration{*ns} : Duration{};
}

}  // namespace

struct LinuxBoard::State {
  State(LinuxSystem& of,
        const LinuxBoardOptions& given,
        BoardInventory what_is_there,
        std::unique_ptr<SettingsKeeper> opened)
      : system{of},
        options{given},
        found{std::move(what_is_there)},
        keeper{std::move(opened)},
        order{core_order_of(found.cores, options.file, options.use_cores_if_asked)},
        cores{system, *keeper, found.cores, order,
              options.unplug_cores && options.file.may_unplug_cores},
        power{system, found, options.file} {}

  LinuxSystem& system;
  LinuxBoardOptions options;
  BoardInventory found;
  std::unique_ptr<SettingsKeeper> keeper;
  std::vector<int> order;
  CoreControl cores;
  PowerMeter power;
  std::vector<ClockControl> controls{};  ///< Of the policies that `order` has cores of.
  std::vector<Hertz> clocks{};           ///< Of the first of them.
  std::optional<ClockMeter> meter{};
  ClockReport clock{};
  BoardReading reading{};
  Duration now{};
  double busy_before_s{process_seconds()};
  double busy_at_refresh_s{busy_before_s};
  double busy_cores{};  ///< Of this process, between the last two refreshes.
  int wanted_cores{cores.max_cores()};
  bool may_set_clock{true};
  bool has_set_clock{};  ///< Once at least.
  std::string power_source{};
  std::vector<std::string> notes{};
  std::set<std::string> noted{};

  void note(const std::string& topic, const std::string& sentence) {
    if (noted.insert(topic).second) {
      notes.push_back(sentence);
    }
  }
  void note_all(const std::string& topic, const std::vector<Error>& errors) {
    for (const Error& error : errors) {
      note(topic + error.message, error.message);
    }
  }
  void note_rivals(const std::vector<Rival>& rivals);
  void note_meters();
  void add_controls();
  void set_clock(Hertz wanted);
  void look_after_clock();
  void look_after_cores();
  void read_reported_clock();
  [[nodiscard]] std::optional<Hertz> measured_clock();
  void read_clock();
  void read_power();
  void read_heat();
  [[nodiscard]] Hertz believed_clock() const;
  void fill_reading();
};

void LinuxBoard::State::add_controls() {
  for (const CpufreqPolicy& policy : found.policies) {
    const bool is_used = std::any_of(policy.cpus.begin(), policy.cpus.end(), [this](int id) {
      return std::find(order.begin(), order.end(), id) != order.end();
    });
    if (is_used || policy.cpus.empty()) {
      controls.emplace_back(system, *keeper, policy, clocks_of(policy, options.file));
    }
  }
  if (!controls.empty()) {
    clocks = controls.front().clocks();
    return;
  }
  may_set_clock = false;
  note("clock",
       "no clock can be set: there is no cpufreq folder with limits below /sys/devices/system/cpu "
       "(a virtual machine, or a kernel without a driver for this processor); cores are the only "
       "knob");
}

void LinuxBoard::State::note_rivals(const std::vector<Rival>& rivals) {
  for (const Rival& rival : rivals) {
    note("rival " + rival.name, rival.name + " (process " + std::to_string(rival.pid) +
                                    ") sets clocks too; " + rival.advice);
  }
}

void LinuxBoard::State::note_meters() {
  power_source = power.source();
  if (!power_source.empty()) {
    return;
  }
  const bool is_hidden = std::any_of(found.counters.begin(), found.counters.end(),
                                     [](const EnergyCounter& one) { return !one.is_readable; });
  const std::string why =
      is_hidden
          ? "RAPL's counters may not be read; run as root, or see: flyball board setup --print"
          : "it has no input rail (" +
                (options.file.input_rails.empty() ? std::string{"VDD_IN, VIN"}
                                                  : options.file.input_rails.front()) +
                ") and no RAPL";
  power_source = options.power_prior ? "estimate" : "none";
  note("power", "the board's power is not measured: " + why +
                    (options.power_prior ? "; it is estimated from clock and work"
                                         : "; it is 0 W in all records"));
}

void LinuxBoard::State::set_clock(Hertz wanted) {
  const bool is_new = wanted != clock.requested;
  clock.requested = wanted;
  for (ClockControl& control : controls) {
    const Status set = control.set(wanted);
    if (set) {
      has_set_clock = true;
      continue;
    }
    const ErrorCode code = set.error().code;
    std::string sentence = set.error().message;
    if (code == ErrorCode::unavailable && has_set_clock) {
      sentence += "; it is tried again";  // The files of a core are made anew when it comes back.
    } else if (code == ErrorCode::unavailable) {
      may_set_clock = false;
      sentence +=
          "; the clock stays as it is; run as root, or let a group write it: flyball board "
          "setup --print";
    } else if (code == ErrorCode::not_found) {
      continue;  // Its cores are off-line: a state, not an error.
    }
    note("set " + control.policy().folder + std::to_string(static_cast<int>(code)), sentence);
  }
  if (is_new) {  // The next measurement is a mean from here on, not of the clock before.
    clock.measured.reset();
    (void)measured_clock();
  }
}

std::optional<Hertz> LinuxBoard::State::measured_clock() {
  std::optional<Hertz> measured = meter ? meter->measure() : std::nullopt;
  if (options.measure_clock) {
    measured = options.measure_clock();
  }
  // The meter measures where this thread runs, which may be a core of another kind.
  return tells_set_clock(controls, system.current_cpu()) ? measured : std::nullopt;
}

/// Daemons and heat change limits behind one's back.
void LinuxBoard::State::look_after_clock() {
  if (!may_set_clock || clock.requested == Hertz{}) {
    return;
  }
  const auto is_as_set = [](const ClockControl& one) { return one.is_as_set(); };
  if (std::all_of(controls.begin(), controls.end(), is_as_set)) {
    return;
  }
  const auto was_changed = [](const ClockControl& one) { return one.is_set() && !one.is_as_set(); };
  if (std::any_of(controls.begin(), controls.end(), was_changed)) {
    note("changed",
         "somebody else has changed the limits or the governor of the clock; it is set again");
    note_rivals(find_rivals(system));
  }
  set_clock(clock.requested);
}

/// A change of the power mode, or a person, switches cores off and on.
void LinuxBoard::State::look_after_cores() {
  if (cores.has_changed()) {
    note("cores", "somebody else has switched cores off or on");
    note_all("core", cores.plug_in(wanted_cores));
    note_all("bind", cores.bind());
  }
}

void LinuxBoard::State::read_reported_clock() {
  clock.reported.reset();
  for (const ClockControl& control : controls) {
    clock.reported = clock.reported ? clock.reported : control.reported();
  }
}

void LinuxBoard::State::read_clock() {
  read_reported_clock();
  if (const auto measured = measured_clock()) {
    clock.measured = nearest_listed(*measured, clocks);
  }
  if (clock.reported && clock.measured && differ(*clock.measured, *clock.reported)) {
    note("lie", "scaling_cur_freq says " + mhz_of(*clock.reported) + " and the cores run at " +
                    mhz_of(*clock.measured) + "; the measured clock is believed");
  }
  const bool is_lower = clock.requested > Hertz{} && believed_clock() > Hertz{} &&
                        believed_clock() < clock.requested &&
                        differ(believed_clock(), clock.requested);
  if (is_lower && may_set_clock) {
    note("less", "the board grants " + mhz_of(believed_clock()) + " where " +
                     mhz_of(clock.requested) +
                     " are requested: heat, the power mode or the firmware limits it");
  }
}

Hertz LinuxBoard::State::believed_clock() const {
  if (clock.measured && (!clock.reported || differ(*clock.measured, *clock.reported))) {
    return *clock.measured;
  }
  return clock.reported.value_or(clock.requested);
}

void LinuxBoard::State::read_power() {
  reading.rails = power_by_rail(system, found.rails);
  power.sample(now);
  if (const auto drawn = power.power()) {
    reading.computer_power = *drawn;
    return;
  }
  if (!power.source().empty() && reading.computer_power > Watts{}) {
    note("power lost", power.source() + " can no longer be read; the board's power is " +
                           (options.power_prior ? "estimated from clock and work from now on"
                                                : "the last one that was read"));
  }
  if (options.power_prior) {
    reading.computer_power = options.power_prior->power(believed_clock(), busy_cores);
  }
}

void LinuxBoard::State::read_heat() {
  const auto heat = closest_heat(system, found.zones, options.file);
  reading.temperature_c = heat ? heat->temperature_c : 0.0;
  reading.trip_c = heat ? heat->trip_c.value_or(0.0) : 0.0;
}

void LinuxBoard::State::fill_reading() {
  reading.granted = {static_cast<int>(cores.active().size()), believed_clock()};
  reading.busy_core_s = process_seconds() - busy_before_s;
}

Result<std::unique_ptr<LinuxBoard>> LinuxBoard::open(LinuxSystem& system,
                                                     const LinuxBoardOptions& options) {
  auto keeper = SettingsKeeper::open(system, options.keeper);
  const std::string no_journal = keeper ? "" : keeper.error().message;
  if (!keeper && keeper.error().code == ErrorCode::not_found) {
    keeper = SettingsKeeper::closed(system, keeper.error());
  }
  if (!keeper) {
    return keeper.error();
  }
  BoardInventory found = discover_board(system);
  for (CpufreqPolicy& policy : found.policies) {
    undo_adopted(policy, (*keeper)->kept());
    const bool is_locked = policy.min == policy.max && policy.lowest < policy.highest;
    if (is_locked && !options.keeper.adopt && no_journal.empty()) {
      return Error{ErrorCode::unavailable, "the clock of " + policy.folder + " is locked at " +
                                               mhz_of(policy.max) +
                                               " already, which jetson_clocks does; release it "
                                               "(jetson_clocks --restore)"};
    }
  }
  auto state = std::make_unique<State>(system, options, std::move(found), std::move(*keeper));
  state->add_controls();
  if (!no_journal.empty()) {
    state->may_set_clock = false;
    state->note("clock",
                "the clock stays as it is, because nothing could restore it: " + no_journal);
  }
  state->note_rivals(state->found.rivals);
  state->note_meters();
  if (options.unplug_cores && !options.file.may_unplug_cores) {
    state->note("unplug", "cores stay on-line: the file of board " + options.file.name +
                              " does not allow to switch them off");
  }
  if (!options.measure_clock) {
    state->meter.emplace(options.file.cycles_per_addition);
  }
  state->read_clock();
  state->fill_reading();
  return std::unique_ptr<LinuxBoard>{new LinuxBoard{std::move(state)}};
}

LinuxBoard::LinuxBoard(std::unique_ptr<State> state) : state_{std::move(state)} {}

LinuxBoard::~LinuxBoard() = default;

BoardModel LinuxBoard::model() const {
  BoardModel model;
  model.max_cores = state_->cores.max_cores();
  model.frequencies = state_->may_set_clock ? state_->clocks : std::vector<Hertz>{};
  model.switching_time = switching_time_of(state_->system, state_->found.policies);
  model.power = state_->options.power_prior;
  return model;
}

BoardReading LinuxBoard::read() const {
  return state_->reading;
}

void LinuxBoard::request(const OperatingPoint& point) {
  State& state = *state_;
  const int most = std::max(1, state.cores.max_cores());
  state.wanted_cores = std::clamp(point.cores, 1, most);
  state.note_all("core", state.cores.plug_in(state.wanted_cores));
  if (state.may_set_clock && point.frequency > Hertz{}) {
    state.set_clock(point.frequency);
  }
  state.note_all("bind", state.cores.bind());
  state.note_all("core", state.cores.unplug_rest(state.now));
  state.read_reported_clock();
  state.fill_reading();
}

void LinuxBoard::refresh(Duration now) {
  const double passed_s = to_seconds(now - state_->now);
  const double busy_s = process_seconds();
  if (passed_s > 0.0) {
    state_->busy_cores = std::max(0.0, (busy_s - state_->busy_at_refresh_s) / passed_s);
    state_->busy_at_refresh_s = busy_s;
  }
  state_->now = now;
  state_->look_after_cores();
  state_->look_after_clock();
  state_->read_clock();
  state_->read_power();
  state_->read_heat();
  state_->fill_reading();
}

ClockReport LinuxBoard::clock() const {
  return state_->clock;
}

const std::string& LinuxBoard::power_source() const {
  return state_->power_source;
}

const std::vector<int>& LinuxBoard::active_cpus() const {
  return state_->cores.active();
}

Status LinuxBoard::attach(pid_t thread) {
  return state_->cores.attach(thread);
}

const std::vector<std::string>& LinuxBoard::notes() const {
  return state_->notes;
}

std::vector<Error> LinuxBoard::close() {
  return state_->keeper->restore();
}

}  // namespace flyball
