// SPDX-License-Identifier: BSD-3-Clause
#include "library_policy.h"

#include "flyball/governors/plugin_policy.h"
#include "flyball/governors/policy_period.h"

#include "policy_packets.h"
#include <array>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <utility>

#include <dlfcn.h>

namespace flyball {
namespace {

static_assert(flyball_wish_capacity <= Decision::capacity, "what a library wishes fits");
static_assert(flyball_phase_wait == static_cast<int>(MissionPhase::wait), "in the same order");
static_assert(flyball_reason_fallback == static_cast<int>(Reason::fallback), "in the same order");

/// The sizes that the first version of the header had: what a library must have at least.
constexpr std::size_t first_policy_size = offsetof(FlyballPolicy, period_s);
constexpr std::size_t first_parameter_size = sizeof(FlyballParameter);

std::string last_loader_error() {
  const char* text = dlerror();  // NOLINT(concurrency-mt-unsafe): one thread loads policies
  return text == nullptr ? "unknown reason" : text;
}

Error broken(const std::string& path, const std::string& what) {
  return {ErrorCode::invalid_input, path + ": " + what};
}

/// What is wrong with the description that a library hands out; empty: nothing.
std::string fault_of(const FlyballPolicy* given) {
  if (given == nullptr) {
    return "flyball_policy() returns NULL";
  }
  if (given->struct_size < first_policy_size) {
    return "its FlyballPolicy has " + std::to_string(given->struct_size) +
           " bytes, the oldest that this program knows has " + std::to_string(first_policy_size) +
           "; build it against the installed flyball/governors/plugin_abi.h";
  }
  if (given->create == nullptr || given->destroy == nullptr || given->decide == nullptr) {
    return "create, destroy and decide must not be NULL";
  }
  if (given->parameter_count > 0 && given->parameters == nullptr) {
    return "parameters must not be NULL, because parameter_count is not 0";
  }
  if (given->parameter_count > most_parameters) {
    return "declares " + std::to_string(given->parameter_count) + " parameters, at most " +
           std::to_string(most_parameters) + " are possible";
  }
  for (std::uint32_t i = 0; i < given->parameter_count; ++i) {
    const FlyballParameter* one = given->parameters[i];
    if (one == nullptr || one->struct_size < first_parameter_size || one->name == nullptr) {
      return "parameter " + std::to_string(i) +
             " is NULL, has no name or was built against another flyball/governors/plugin_abi.h";
    }
  }
  return {};
}

FlyballObservation observation_of(const Observation& seen) {
  FlyballObservation told{};
  told.struct_size = sizeof told;
  told.phase = static_cast<std::uint32_t>(seen.phase);
  told.now_ns = seen.now.time_since_epoch().count();
  told.speed_m_s = seen.speed_m_s;
  told.known_free_m = seen.known_free_m;
  told.obstacle_density = seen.obstacle_density;
  told.density_ahead = seen.density_ahead;
  told.nearest_obstacle_m = seen.nearest_obstacle_m;
  told.distance_to_goal_m = seen.distance_to_goal_m;
  told.tracking_error_m = seen.tracking_error_m;
  told.speed_limit_m_s = seen.speed_limit_m_s;
  told.map_resolution_m = seen.map_resolution_m;
  told.map_revision = seen.map_revision;
  told.latency_ns = seen.latency.count();
  told.latency_bound_ns = seen.latency_bound.count();
  told.deadline_misses = seen.deadline_misses;
  told.queue_drops = seen.queue_drops;
  told.planner_failures = seen.planner_failures;
  told.cores = seen.cores;
  told.frequency_hz = seen.frequency.value();
  told.busy_cores = seen.busy_cores;
  told.busiest_core_load = seen.busiest_core_load;
  told.computer_power_w = seen.computer_power.value();
  told.rotor_power_w = seen.rotor_power.value();
  told.battery_percent = seen.battery_percent;
  told.max_deceleration_m_s2 = seen.max_deceleration_m_s2;
  told.narrowest_gap_m = seen.narrowest_gap_m;
  told.gap_distance_m = seen.gap_distance_m;
  told.mean_gap_m = seen.mean_gap_m;
  told.temperature_c = seen.temperature_c;
  told.trip_c = seen.trip_c;
  told.map_age_ns = seen.map_age.count();
  told.headroom_m = seen.headroom_m;
  told.progress_unit = static_cast<std::uint32_t>(seen.progress_unit);
  told.progress = seen.progress;
  told.cpu_power_w = seen.cpu_power.value();
  told.gpu_power_w = seen.gpu_power.value();
  told.memory_power_w = seen.memory_power.value();
  told.soc_power_w = seen.soc_power.value();
  told.map_within_ns = seen.map_within.count();
  told.slower_zone_m = seen.slower_zone_m;
  told.map_range_m = seen.map_range_m;
  static_assert(flyball_stage_count == stage_count);
  for (std::size_t i = 0; i < stage_count; ++i) {
    const StageUse& stage = seen.stages[i];
    told.stages[i] = {stage.latency.count(), stage.load, stage.gigacycles};
  }
  return told;
}

/// The knobs as C structures; lives as long as the call that they are made for.
struct KnobList {
  explicit KnobList(const KnobSettings& knobs) {
    for (const KnobSpec& spec : knobs.specs()) {
      list.push_back({sizeof(FlyballKnob), static_cast<std::uint32_t>(spec.legal.size()),
                      spec.name.c_str(), spec.unit.c_str(), spec.legal.data(), spec.min, spec.max,
                      spec.fallback, knobs.value(spec.name)});
    }
    for (const FlyballKnob& knob : list) {
      pointers.push_back(&knob);
    }
  }
  std::vector<FlyballKnob> list;
  std::vector<const FlyballKnob*> pointers;
};

/// The computer as C structures; lives as long as the call that it is made for.
struct BoardList {
  explicit BoardList(const BoardModel& board) {
    for (const Hertz clock : board.frequencies) {
      const double idle_w = board.power ? board.power->power(clock, 0.0).value() : 0.0;
      const double busy_w = board.power ? board.power->power(clock, 1.0).value() : 0.0;
      clocks.push_back({sizeof(FlyballClock), 0, clock.value(), idle_w, busy_w - idle_w});
    }
    const ThermalModel heat = board.thermal.value_or(ThermalModel{0.0, 0.0, 0.0});
    for (const ThermalTrip& trip : heat.trips) {
      trips.push_back({sizeof(FlyballTrip), 0, trip.at_c, trip.hysteresis_k, trip.cap.value()});
    }
    for (const FlyballClock& one : clocks) {
      clock_pointers.push_back(&one);
    }
    for (const FlyballTrip& one : trips) {
      trip_pointers.push_back(&one);
    }
    told = {sizeof(FlyballBoard),
            static_cast<std::uint32_t>(board.max_cores),
            static_cast<std::uint32_t>(clocks.size()),
            static_cast<std::uint32_t>(trips.size()),
            clock_pointers.data(),
            trip_pointers.data(),
            to_seconds(board.switching_time),
            heat.ambient_c,
            heat.resistance_k_w,
            heat.time_constant_s};
  }
  std::vector<FlyballClock> clocks;
  std::vector<FlyballTrip> trips;
  std::vector<const FlyballClock*> clock_pointers;
  std::vector<const FlyballTrip*> trip_pointers;
  FlyballBoard told{};
};

const char* text_or_nothing(const char* text) {
  return text == nullptr ? "" : text;
}

}  // namespace

void LibraryPolicy::Unload::operator()(void* library) const {
  dlclose(library);
}

Result<std::unique_ptr<Policy>> LibraryPolicy::open(const std::string& path, std::uint64_t seed) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed)) {
    return Error{ErrorCode::not_found, "no policy library " + path};
  }
  // The loader searches its own folders for a name without a slash.
  const std::string absolute = std::filesystem::absolute(path, failed).string();
  Library library{dlopen(absolute.c_str(), RTLD_NOW | RTLD_LOCAL)};
  if (library == nullptr) {
    return broken(path, "cannot be loaded: " + last_loader_error());
  }
  using Entry = const FlyballPolicy* (*)();
  const auto entry = reinterpret_cast<Entry>(dlsym(library.get(), "flyball_policy"));
  if (entry == nullptr) {
    return broken(path,
                  "exports no function flyball_policy; see flyball/governors/plugin_abi.h, and "
                  "mind its extern \"C\"");
  }
  const FlyballPolicy* given = entry();
  if (const std::string fault = fault_of(given); !fault.empty()) {
    return broken(path, fault);
  }
  return std::unique_ptr<Policy>{
      new LibraryPolicy{path, std::move(library), readable_copy(given), seed}};
}

LibraryPolicy::LibraryPolicy(std::string path,
                             Library library,
                             const FlyballPolicy& policy,
                             std::uint64_t seed)
    : path_{std::move(path)},
      library_{std::move(library)},
      policy_{policy},
      random_{seed, "policy"},
      seed_{seed} {
  host_.struct_size = sizeof host_;
  host_.abi_version = flyball_abi_version;
  host_.context = this;
  host_.now_ns = [](void* self) -> std::int64_t {
    return static_cast<LibraryPolicy*>(self)->now_.time_since_epoch().count();
  };
  host_.random = [](void* self) -> std::uint64_t {
    return static_cast<LibraryPolicy*>(self)->random_.next();
  };
  host_.log = [](void* self, const char* text) {
    std::string& remark = static_cast<LibraryPolicy*>(self)->remark_;
    constexpr std::size_t longest = 400;  // A line for the record, not a place to store things.
    if (remark.size() < longest) {
      remark += (remark.empty() ? "" : "; ") + std::string{text_or_nothing(text)};
    }
  };
}

LibraryPolicy::~LibraryPolicy() {
  if (state_ != nullptr) {
    policy_.destroy(state_);
  }
}

std::vector<ParameterSpec> LibraryPolicy::parameters() const {
  std::vector<ParameterSpec> specs;
  for (std::uint32_t i = 0; i < policy_.parameter_count; ++i) {
    const FlyballParameter one = readable_copy(policy_.parameters[i]);
    specs.push_back({one.name,
                     one.fallback,
                     one.min,
                     one.max,
                     text_or_nothing(one.description),
                     {},
                     one.required != 0});
  }
  return specs;
}

Status LibraryPolicy::start(const Parameters& given,
                            const KnobSettings& knobs,
                            const BoardModel& board) {
  knobs_ = knobs;
  random_ = RandomStream{seed_, "policy"};
  const KnobList list{knobs_};
  const BoardList computer{board};
  std::vector<double> values;
  for (const ParameterSpec& spec : parameters()) {
    values.push_back(given.number(spec.name));
  }
  std::array<char, 400> refusal{};
  const FlyballStart told{sizeof(FlyballStart),
                          static_cast<std::uint32_t>(list.pointers.size()),
                          list.pointers.data(),
                          values.data(),
                          static_cast<std::uint32_t>(values.size()),
                          static_cast<std::uint32_t>(refusal.size()),
                          refusal.data(),
                          &computer.told};
  if (state_ != nullptr) {
    policy_.destroy(std::exchange(state_, nullptr));
  }
  state_ = policy_.create(&host_, &told);
  if (state_ == nullptr) {
    refusal.back() = '\0';
    return broken(path_, refusal[0] == '\0' ? "does not start and does not say why"
                                            : std::string{refusal.data()});
  }
  return ask_period();
}

Status LibraryPolicy::ask_period() {
  const double period_s = policy_.period_s == nullptr ? 0.0 : policy_.period_s(state_);
  period_ = std::nullopt;
  if (period_s == 0.0) {
    return Done{};
  }
  if (const auto fault = fault_of_period(period_s); fault[0] != '\0') {
    return broken(path_, fault.data());
  }
  period_ = from_seconds(period_s);
  return Done{};
}

Decision LibraryPolicy::decide(const Observation& seen) noexcept {
  trouble_.clear();
  remark_.clear();
  now_ = seen.now;
  if (state_ == nullptr) {
    trouble_ = path_ + ": was not started";
    return {};
  }
  const FlyballObservation told = observation_of(seen);
  FlyballDecision answer{};
  answer.struct_size = sizeof answer;
  std::string thrown;
  std::int32_t failed = 1;
  try {  // C++ without the wrapper may throw through the C function.
    failed = policy_.decide(state_, &told, &answer);
  } catch (const std::exception& error) {
    thrown = std::string{"threw: "} + error.what();
  } catch (...) {
    thrown = "threw an exception of no known type";
  }
  if (failed != 0) {
    const std::string why = thrown.empty() ? remark_ : thrown;
    trouble_ = path_ + ": " + (why.empty() ? "cannot decide and does not say why" : why);
    return {};
  }
  return decision_of(answer);
}

Decision LibraryPolicy::decision_of(const FlyballDecision& answer) const noexcept {
  Decision decision;
  decision.reason =
      answer.reason <= flyball_reason_fallback ? static_cast<Reason>(answer.reason) : Reason::fixed;
  const auto& specs = knobs_.specs();
  const bool is_too_many = answer.wish_count > flyball_wish_capacity;
  for (std::uint32_t i = 0; i < answer.wish_count && i < flyball_wish_capacity; ++i) {
    const FlyballWish& wish = answer.wishes[i];
    decision.set(
        wish.knob < specs.size() ? std::string_view{specs[wish.knob].name} : "(no such place)",
        wish.value);
  }
  while (is_too_many && !decision.overflowed()) {
    decision.set("", 0.0);  // The governor sees it.
  }
  return decision;
}

}  // namespace flyball
