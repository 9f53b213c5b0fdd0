// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/studies/calibration.h"

#include "flyball/records/report.h"
#include "flyball/runtime/text/number_text.h"
#include "flyball/scenario/scenario.h"
#include "flyball/scenario/shipped_platform.h"
#include "flyball/simulation/mission.h"

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <iterator>
#include <set>
#include <string>
#include <variant>

namespace flyball {
namespace {

double cpu_s(clockid_t whose) {
  timespec used{};
  clock_gettime(whose, &used);
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

/// One round of flights: on which platform, with which seed, and how long.
struct Round {
  std::string platform;
  std::uint64_t seed{};
  double flight_s{};
  std::string name;
};

class Calibrator {
 public:
  explicit Calibrator(const CalibrationOptions& options) : options_{options} {}

  Result<std::vector<MeasuredJob>> fly_all(const Round& round) {
    std::vector<MeasuredJob> jobs;
    const std::vector<CalibrationFlight>& flights = options_.flights;
    for (std::size_t i = 0; i < flights.size(); ++i) {
      if (options_.progress) {
        options_.progress(round.name + ", flight " + std::to_string(i + 1) + " of " +
                          std::to_string(flights.size()) + ": " + flights[i].scenario);
      }
      const Status flown = fly_one(flights[i], round, jobs);
      if (!flown && flown.error().code != ErrorCode::not_found) {
        return flown.error();
      }
      if (!flown) {
        left_out_.insert(flights[i].scenario + " was left out: " + flown.error().message);
      }
    }
    if (jobs.empty() && !left_out_.empty()) {
      return Error{ErrorCode::not_found, *left_out_.begin()};
    }
    return jobs;
  }

  /// At each clock that may be set, the highest first.
  Result<std::vector<MeasuredJob>> fly_at_all_clocks(const Round& round) {
    std::vector<MeasuredJob> jobs;
    std::vector<Hertz> clocks{options_.clock.settable.rbegin(), options_.clock.settable.rend()};
    if (clocks.empty()) {
      clocks.push_back(options_.clock.current);
    }
    for (const Hertz clock : clocks) {
      if (const Status set = change_clock(clock); !set) {
        return set.error();
      }
      auto some = fly_all(round);
      if (!some) {
        return some.error();
      }
      std::move(some->begin(), some->end(), std::back_inserter(jobs));
    }
    return jobs;
  }

  Status change_clock(Hertz clock) {
    clock_ = clock;
    return options_.clock.settable.empty() ? Done{} : options_.clock.set(clock);
  }

  /// CPU time of other threads over that of the one that ran the kernels.
  [[nodiscard]] double other_threads() const {
    return own_s_ > 0.0 ? std::max(0.0, all_s_ / own_s_ - 1.0) : 0.0;
  }

  [[nodiscard]] std::vector<std::string> left_out() const {
    return {left_out_.begin(), left_out_.end()};
  }

 private:
  Status fly_one(const CalibrationFlight& flight,
                 const Round& round,
                 std::vector<MeasuredJob>& jobs) {
    std::vector<std::string> settings = flight.settings;
    const auto found = load_scenario(flight.scenario, with_common(std::move(settings), round));
    if (const auto* errors = std::get_if<std::vector<Error>>(&found)) {
      return errors->front();
    }
    MissionHooks hooks;
    hooks.rendering = Rendering::at_once;  // The camera's work is none of a kernel's.
    hooks.stop = options_.stop;
    hooks.job = [&](const NodeSpec& node, const JobRecord& job) {
      const std::string& kernel = job.work.charged_as();
      jobs.push_back({kernel.empty() ? node.cost : kernel, job.work, job.host_s, clock_});
    };
    const double all_s = cpu_s(CLOCK_PROCESS_CPUTIME_ID);
    const double own_s = cpu_s(CLOCK_THREAD_CPUTIME_ID);
    const auto record = fly(std::get<LoadedScenario>(found).scenario, hooks);
    all_s_ += cpu_s(CLOCK_PROCESS_CPUTIME_ID) - all_s;
    own_s_ += cpu_s(CLOCK_THREAD_CPUTIME_ID) - own_s;
    if (!record) {
      return record.error();
    }
    return options_.stop && options_.stop()
               ? Status{Error{ErrorCode::unavailable, "the calibration was interrupted"}}
               : Status{Done{}};
  }

  [[nodiscard]] std::vector<std::string> with_common(std::vector<std::string> settings,
                                                     const Round& round) const {
    for (const std::string& one :
         {"platform.name=" + round.platform, std::string{"platform.cores=1"},
          "platform.frequency_hz=" + number_text(clock_.value()),
          "seed=" + std::to_string(round.seed),
          "mission.time_limit_s=" + number_text(round.flight_s),
          std::string{"kernels.slam_load=false"}}) {
      settings.push_back(one);
    }
    return settings;
  }

  const CalibrationOptions& options_;
  Hertz clock_{options_.clock.current};
  double all_s_{};
  double own_s_{};
  std::set<std::string> left_out_{};  ///< A sentence for each flight whose files are not here.
};

/// The platform whose prices are to be replaced, with the clocks and cores of this computer.
Result<PlatformModel> draft_of(const CalibrationOptions& options) {
  auto model = find_platform(options.like);
  if (model) {
    model->max_cores = options.cores;
    model->power.idle_core_w = 0.0;  // That of another computer's cores.
    model->frequencies = options.clock.settable;
    if (model->frequencies.empty()) {
      model->frequencies.push_back(options.clock.current);
    }
  }
  return model;
}

}  // namespace

std::vector<CalibrationFlight> calibration_flights() {
  const std::string ours = "kernels.mapper=flyball";
  return {{"delivery_outdoor_to_indoor", {}},
          {"delivery_outdoor_to_indoor", {"map.resolution_m=0.6", "map.range_m=15"}},
          {"delivery_outdoor_to_indoor", {ours}},
          {"delivery_forest", {ours, "map.resolution_m=0.3"}},
          {"delivery_forest", {ours, "map.resolution_m=0.6", "map.range_m=15"}},
          {"delivery_forest", {ours, "kernels.planner=rrt", "kernels.smoother=minimum_jerk"}},
          {"delivery_forest", {ours, "kernels.planner=rrt_star"}},
          {"delivery_forest", {ours, "kernels.planner=prm"}},
          {"delivery_forest", {ours, "kernels.planner=bit_star"}},
          {"delivery_forest", {ours, "kernels.localizer=visual_slam"}},
          {"delivery_forest", {ours, "kernels.localizer=visual_inertial"}},
          {"mapping_office", {"kernels.mapper_parameters.cost_of=flyball"}},
          {"search_collapsed_building",
           {"kernels.mapper_parameters.cost_of=flyball", "detector.cost_of=own"}},
          {"photography_park", {"detector.cost_of=own"}},
          {"photography_park", {"detector.cost_of=own", "kernels.detector=haar"}},
          {"scanning_farm", {}}};
}

Result<Calibration> calibrate(const CalibrationOptions& options) {
  const auto draft = draft_of(options);
  if (!draft) {
    return draft.error();
  }
  Calibrator calibrator{options};
  const auto fly_priced = [&](const PlatformModel& model, const Round& round) {
    const Status written = write_file(options.draft, to_toml(model, {"a draft"}));
    auto jobs = written ? calibrator.fly_at_all_clocks(round)
                        : Result<std::vector<MeasuredJob>>{written.error()};
    std::error_code ignored;
    std::filesystem::remove(options.draft, ignored);
    return jobs;
  };
  const auto first = fly_priced(*draft, {options.draft, 1, 0.5 * options.flight_s, "first round"});
  if (!first) {
    return first.error();
  }
  const PlatformModel rough = with_prices(*draft, *first);
  const auto second = fly_priced(rough, {options.draft, 1, options.flight_s, "second round"});
  if (!second) {
    return second.error();
  }
  Calibration calibration;
  calibration.model = with_prices(*draft, *second);
  const auto others = fly_priced(calibration.model, {options.draft, 2, options.flight_s, "check"});
  if (!others) {
    return others.error();
  }
  calibration.kernels = check_prices(calibration.model, *second, *others);
  calibration.other_threads = calibrator.other_threads();
  calibration.left_out = calibrator.left_out();
  return calibration;
}

}  // namespace flyball
