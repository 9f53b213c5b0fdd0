// SPDX-License-Identifier: BSD-3-Clause
//
// MAVBench's heat maps: five missions over cores and clock. The paper prints changes between the
// corners; the cells are only in its pictures, so nothing is said of them.

#include "experiments/framework/papers.h"
#include "experiments/framework/plots_of.h"
#include <cmath>

namespace flyball::experiments {
namespace {

constexpr const char* in_text = "between 2 cores at .8 GHz and 4 cores at 2.2 GHz: ";
// How much faster the clock alone makes a kernel that never waits for memory.
constexpr double clock_gain = 2.0352 / 0.8064;

enum class Explains { missions, kernels, both };

/// A change that was made to both corners, or to one of them.
struct Test {
  std::string mission{};
  std::string name{};
  std::string changed{};
  std::vector<std::string> slow{};  ///< Empty: this corner stays as it is.
  std::vector<std::string> fast{};  ///< As slow.
  Explains explains{Explains::missions};
  std::size_t most_seeds{few_seeds};
};

bool explains(const Test& test, bool is_of_kernel) {
  return test.explains == Explains::both || (test.explains == Explains::kernels) == is_of_kernel;
}

/// The paper's computer also ran ROS and the link to its simulator. Another program takes cores
/// that the operating point leaves idle first: two at the slow corner, none at the fast one.
Test crowded(const std::string& mission) {
  const auto with_busy_cores = [](const char* count) {
    return std::vector<std::string>{"events.1.kind=co_runner", "events.1.at_s=0",
                                    std::string{"events.1.cores="} + count};
  };
  Test test{mission,
            "crowded",
            "another program keeps one of the cores busy at both corners",
            with_busy_cores("3"),
            with_busy_cores("1"),
            Explains::both};
  if (mission == "mapping" || mission == "search") {
    // The slow corner would explore until its battery is empty.
    test.changed += ", for five minutes at the slow one";
    test.slow.emplace_back("mission.time_limit_s=300");
    test.explains = Explains::kernels;
  }
  if (mission == "search" || mission == "photography") {
    test.most_seeds = 1;  // A flight takes the host a minute.
  }
  return test;
}

/// As if two kernels gained what the paper says, which is more than clock and cores give: prices
/// are raised at the slow corner, or lowered at the fast one, where the slow one would run until
/// its battery is empty.
std::vector<std::string> both_slowed(const std::string& first,
                                     double first_factor,
                                     const std::string& second,
                                     double second_factor) {
  return joined(slowed(1, first, first_factor), slowed(2, second, second_factor));
}

std::vector<Test> tests() {
  const std::vector<std::string> quick_plans = slowed(1, "rrt_connect", 0.1);
  const std::vector<std::string> quick_maps = slowed(1, "octomap", 0.1);
  const std::vector<std::string> quick_views = slowed(1, "nbvp", 0.1);
  return {{"delivery", "quick_plans", "plans take a tenth of their time", quick_plans, quick_plans},
          {"delivery", "quick_maps", "maps take a tenth of their time", quick_maps, quick_maps},
          {"delivery",
           "paper_gains",
           "octomap and planner gain 2.9 and 9.2 times the clock's share, as in the paper",
           both_slowed("octomap", 2.9 / clock_gain, "rrt_connect", 9.2 / clock_gain),
           {}},
          {"mapping", "quick_views", "the next view is found in a tenth of the time", quick_views,
           quick_views},
          {"mapping",
           "paper_gains",
           "octomap and planner gain 6 and 6.3 times, as in the paper",
           {},
           both_slowed("octomap", clock_gain / 6.0, "nbvp", clock_gain / 6.3)},
          {"search",
           "paper_gains",
           "octomap and planner gain 6.6 and 6.8 times, as in the paper",
           {},
           both_slowed("octomap", clock_gain / 6.6, "nbvp", clock_gain / 6.8)},
          {"photography",
           "paper_gains",
           "tracking gains 10 times, as in the paper",
           slowed(1, "kcf_real_time", 10.0 / clock_gain),
           {}},
          crowded("delivery"),
          crowded("mapping"),
          crowded("search"),
          crowded("photography")};
}

const PaperMission& mission_of(const std::vector<PaperMission>& all, const std::string& name) {
  for (const PaperMission& mission : all) {
    if (mission.name == name) {
      return mission;
    }
  }
  return all.front();
}

/// `NAME_slow` and `NAME_fast`: a mission at both corners.
std::vector<ExperimentSweep> corner_sweeps(const std::string& name,
                                           const PaperMission& mission,
                                           const Test& test) {
  const auto at = [&](const char* corner, const std::vector<std::string>& point,
                      const std::vector<std::string>& change) {
    return ExperimentSweep{name + corner,
                           mission.scenario,
                           joined(joined(mission.settings, point), change),
                           {},
                           {"fixed_fine"}};
  };
  return {at("_slow", slow_corner(), test.slow), at("_fast", fast_corner(), test.fast)};
}

std::vector<ExperimentSweep> sweeps() {
  const std::vector<PaperMission> missions = paper_missions();
  std::vector<ExperimentSweep> all;
  for (const PaperMission& mission : missions) {
    ExperimentSweep cells{mission.name, mission.scenario, mission.settings};
    cells.axes = {{"platform.cores", {"2", "3", "4"}},
                  {"platform.frequency_hz", {"0.8064e9", "1.5744e9", "2.0352e9"}}};
    cells.policies = {"fixed_fine"};
    cells.one_seed_in = mission.takes_the_host_long ? 3 : 1;
    all.push_back(with_few_seeds(cells));
    for (const ExperimentSweep& corner : corner_sweeps(mission.name, mission, {})) {
      all.push_back(corner);
    }
  }
  for (const Test& test : tests()) {
    const PaperMission& mission = mission_of(missions, test.mission);
    for (ExperimentSweep& corner : corner_sweeps(test.mission + "_" + test.name, mission, test)) {
      corner.most_seeds = test.most_seeds;
      all.push_back(corner);
    }
  }
  return all;
}

/// Time that is not spent in hover.
std::optional<double> moving_time_s(const Summary& flight) {
  return flight.mission_time_s - flight.hover_time_s;
}

std::optional<double> moving_speed_m_s(const Summary& flight) {
  const double time_s = flight.mission_time_s - flight.hover_time_s;
  return time_s > 0.0 ? std::optional{flight.distance_m / time_s} : std::nullopt;
}

/// What the paper prints of a mission.
struct Printed {
  std::string mission{};
  std::string figure{};
  std::string what{};
  double value{};
  std::string text{};
  bool slow_over_fast{};
};

std::vector<Printed> printed() {
  const std::string time = "mission_time_s";
  const std::string energy = "energy_total_kj";
  const std::string speed = "mean_speed_m_s";
  return {
      {"delivery", time, "mission time", 0.16, "-84 %"},
      {"delivery", energy, "energy", 0.18, "-82 %"},
      {"delivery", speed, "mean speed", 4.8, "4.8 times"},
      {"delivery", "kernel.octomap.mean_ms", "gain of octomap", 2.9, "2.9 times", true},
      {"delivery", "kernel.rrt_connect.mean_ms", "gain of planning", 9.2, "9.2 times", true},
      {"mapping", time, "mission time", 0.14, "-86 %"},
      {"mapping", energy, "energy", 0.17, "-83 %"},
      {"mapping", speed, "mean speed", 5.3, "5.3 times"},
      {"mapping", "kernel.octomap.mean_ms", "gain of octomap", 6.0, "6 times", true},
      {"mapping", "kernel.nbvp.mean_ms", "gain of planning", 6.3, "6.3 times", true},
      {"search", time, "mission time", 0.33, "-67 %"},
      {"search", energy, "energy", 0.43, "-57 %"},
      {"search", speed, "mean speed", 2.2, "2.2 times"},
      {"search", "kernel.octomap.mean_ms", "gain of octomap", 6.6, "6.6 times", true},
      {"search", "kernel.nbvp.mean_ms", "gain of planning", 6.8, "6.8 times", true},
      {"search", "kernel.yolov2.mean_ms", "gain of detection", 1.8, "1.8 times", true},
      {"scanning", time, "mission time", 1.0, "about 0"},
      {"scanning", energy, "energy", 1.0, "about 0"},
      {"scanning", speed, "mean speed", 1.0, "about 0"},
      {"scanning", "kernel.lawnmower.mean_ms", "gain of planning", 3.0, "3 times", true},
      {"photography", "quality.tracked_s", "tracked time", 3.67, "+267 %"},
      {"photography", "quality.mean_centre_error_percent", "error", 0.47, "-53 %"},
      {"photography", "kernel.yolov2.mean_ms", "gain of detection", 2.49, "2.49 times", true},
      {"photography", "kernel.kcf_real_time.mean_ms", "gain of tracking", 10.0, "10 times", true},
  };
}

/// The two corners of one mission.
struct Corners {
  Point slow{};
  Point fast{};
};

/// @param test  Empty: as shipped.
Corners corners_of(const Evidence& evidence, const Printed& print, const std::string& test = "") {
  const std::string name = test.empty() ? print.mission : print.mission + "_" + test;
  Corners corners{evidence.at(name + "_slow", {}), evidence.at(name + "_fast", {})};
  // What a kernel takes does not hang on how the flight ends, and a person who is lost was tracked
  // until then.
  corners.slow.counts_failed = corners.fast.counts_failed =
      print.slow_over_fast || print.mission == "photography";
  return corners;
}

/// Eq. 2 at both ends of a response, a = 6 m/s^2 and d = 6.5 m: the paper's vehicle.
double speed_gain(double slow_s, double fast_s) {
  const auto speed = [](double response_s) {
    constexpr double a = 6.0;
    constexpr double d = 6.5;
    return a * (std::sqrt(response_s * response_s + 2.0 * d / a) - response_s);
  };
  return speed(fast_s) / speed(slow_s);
}

bool has_lost_the_person(const Summary& flight) {
  const auto is_censored = flight_figure("quality.is_censored")(flight);
  const bool was_followed_to_the_end = is_censored.value_or(0.0) != 0.0;
  return !was_followed_to_the_end && flight.failure != MissionFailure::time_limit;
}

/// Other figures of the same flights that may be what the paper measured.
void add_causes_in_photography(Claim& claim, const std::string& figure, const Corners& corners) {
  if (figure == "quality.tracked_s") {
    // A flight in which nobody was lost ends after two minutes of tracking, and at the fast corner
    // most flights do.
    const Measured life =
        mean_life_ratio(corners.fast, corners.slow, flight_figure(figure), has_lost_the_person);
    if (life.value) {
      claim.causes.push_back({"seconds for each time that the person is lost", life});
    }
  }
  if (figure == "quality.mean_centre_error_percent") {
    claim.causes.push_back(
        {"of the person's true place, in all pictures, also where the box is not on the person",
         ratio(corners.fast, corners.slow, flight_figure("quality.mean_person_error_percent"))});
  }
  if (figure == "kernel.kcf_real_time.mean_ms") {
    // A slow clock leaves more frames.
    claim.causes.push_back(
        {"of the tracker that goes through the frames that came while the detector worked",
         ratio(corners.slow, corners.fast, flight_figure("kernel.kcf_buffered.mean_ms"))});
  }
}

/// What the paper's own kernel times and gains come to by its eq. 2.
void add_computed_cause(Claim& claim, const std::string& mission) {
  if (mission == "delivery") {
    claim.causes.push_back(
        {"eq. 2 with the paper's own octomap and planner (630 and 182 ms) and their gains",
         computed(speed_gain(0.630 * 2.9 + 0.182 * 9.2, 0.630 + 0.182))});
  }
  if (mission == "mapping") {
    claim.causes.push_back({"eq. 2 with the paper's own octomap (482 ms) and its gain",
                            computed(speed_gain(0.482 * 6.0, 0.482))});
  }
}

Claim claim_of(const Evidence& evidence, const Printed& print) {
  const Corners corners = corners_of(evidence, print);
  const FlightFigure of = flight_figure(print.figure);
  const auto compared = [&](const Corners& both) {
    return print.slow_over_fast ? ratio(both.slow, both.fast, of) : ratio(both.fast, both.slow, of);
  };
  Claim claim{print.mission + ": " + print.what +
              (print.slow_over_fast ? ", slow over fast" : ", fast over slow")};
  claim.paper = PaperValue{print.value, std::string{in_text} + print.text};
  claim.ours = compared(corners);
  claim.neutral = 1.0;
  for (const Test& test : tests()) {
    if (test.mission == print.mission && explains(test, print.slow_over_fast)) {
      claim.causes.push_back({test.changed, compared(corners_of(evidence, print, test.name))});
    }
  }
  add_causes_in_photography(claim, print.figure, corners);
  if (print.figure == "mission_time_s" && print.mission != "scanning") {
    claim.causes.push_back(
        {"time in hover left out", ratio(corners.fast, corners.slow, moving_time_s)});
  }
  if (print.figure == "mean_speed_m_s" && print.mission != "scanning") {
    claim.causes.push_back(
        {"time in hover left out", ratio(corners.fast, corners.slow, moving_speed_m_s)});
    add_computed_cause(claim, print.mission);
  }
  return claim;
}

Figure heat_map(const Evidence& evidence,
                const std::string& mission,
                const std::string& figure,
                const std::string& title) {
  PlotOf wanted{mission, mission + ": " + title, flight_figure(figure)};
  wanted.x = {"clock, GHz", {"0.81", "1.57", "2.04"}};
  wanted.y = {"cores", {}};
  wanted.counts_failed = mission == "photography";
  std::string file = mission + "_" + figure;
  for (char& c : file) {
    c = c == '.' ? '_' : c;
  }
  return {file, "Median, 95 % interval and flights in each cell.", heat_map_of(evidence, wanted)};
}

Result<Findings> evaluate(const Evidence& evidence) {
  Findings findings;
  for (const Printed& print : printed()) {
    findings.claims.push_back(claim_of(evidence, print));
  }
  for (const char* mission : {"delivery", "mapping", "search", "scanning"}) {
    findings.figures.push_back(heat_map(evidence, mission, "mean_speed_m_s", "mean speed, m/s"));
    findings.figures.push_back(heat_map(evidence, mission, "mission_time_s", "mission time, s"));
    findings.figures.push_back(heat_map(evidence, mission, "energy_total_kj", "energy, kJ"));
  }
  findings.figures.push_back(
      heat_map(evidence, "photography", "quality.tracked_s", "tracked time, s"));
  findings.figures.push_back(heat_map(evidence, "photography", "quality.mean_centre_error_percent",
                                      "distance of the person from the centre, %"));
  findings.figures.push_back(heat_map(evidence, "photography", "energy_total_kj", "energy, kJ"));
  findings.notes.emplace_back(
      "2.52 times the clock and twice the cores make at most 5.05 times the speed; gains beyond "
      "that "
      "contain queues and contention in the paper.");
  return findings;
}

}  // namespace

Experiment operating_points() {
  return {"What do cores and clock do to a mission?",
          std::string{mavbench} + ", operating points of the TX2",
          "Five missions with 2, 3 and 4 cores at .8064, 1.5744 and 2.0352 GHz, a fine map "
          "throughout (fixed_fine). Ratios pair the seeds where both corners succeed; in "
          "photography, where a person who is lost was tracked until then, and for what kernels "
          "take, failed flights count, too.",
          {"The times of octomap, planner, detector and trackers at 4 cores and 2.0352 GHz; their "
           "gains and all missions are predicted."},
          sweeps(),
          evaluate};
}

}  // namespace flyball::experiments
