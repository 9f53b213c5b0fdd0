// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop
//
// Kernels that are exchanged in flight, and cameras and localizers that work less often: what is
// turned counts from the next job on, and what follows from it is charged and flown.
#ifdef FLYBALL_HAS_LUA

#include "flyball/simulation/mission.h"

#include "short_delivery.h"
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr const char* to_and_fro = FLYBALL_CLOSED_LOOP_TESTS "/switched_kernels.lua";

/// A value of a row; the type's own zero where there is none.
template <class T>
T value_of(const MemoryRecorder::Row& row, std::string_view name) {
  for (const Field& field : row.fields) {
    if (field.name == name) {
      return std::get<T>(field.value);
    }
  }
  return {};
}

struct Turn {
  double at_s;
  double value;
};

std::vector<Turn> turns_of(const MissionRecord& record, const std::string& knob) {
  std::vector<Turn> turns;
  for (const auto& row : record.trace->rows()) {
    if (row.channel == "decision" && value_of<std::string>(row, "knob") == knob) {
      turns.push_back({to_seconds(row.at), value_of<double>(row, "value")});
    }
  }
  return turns;
}

struct FlownJob {
  double started_s;
  double ended_s;
  double busy_s;
  std::string kernel;
  double switches;
};

std::vector<FlownJob> jobs_of(const MissionRecord& record, const std::string& node) {
  std::vector<FlownJob> jobs;
  for (const auto& row : record.trace->rows()) {
    if (row.channel == "job" && value_of<std::string>(row, "node") == node) {
      jobs.push_back({value_of<double>(row, "started_s"), to_seconds(row.at),
                      value_of<double>(row, "busy_s"), value_of<std::string>(row, "kernel"),
                      value_of<double>(row, "switches")});
    }
  }
  return jobs;
}

/// The knob's value when something happens; the turn of the same moment does not count yet.
double in_force(const std::vector<Turn>& turns, double first, double at_s) {
  double value = first;
  for (const Turn& turn : turns) {
    value = turn.at_s < at_s ? turn.value : value;
  }
  return value;
}

bool is_turned_between(const std::vector<Turn>& turns, double from_s, double until_s) {
  return std::any_of(turns.begin(), turns.end(),
                     [=](const Turn& turn) { return from_s < turn.at_s && turn.at_s < until_s; });
}

/// Each job is of the kind that was chosen when it began, and pays for a switch when the job before
/// it was of another one.
void check_kinds_of(const std::vector<FlownJob>& jobs,
                    const std::vector<Turn>& turns,
                    const std::vector<std::string>& kinds) {
  std::string before = kinds.front();
  for (const FlownJob& job : jobs) {
    const auto chosen = static_cast<std::size_t>(in_force(turns, 0.0, job.started_s));
    EXPECT_EQ(job.kernel, kinds[chosen]) << job.started_s;
    EXPECT_EQ(job.switches, job.kernel == before ? 0.0 : 1.0) << job.started_s;
    before = job.kernel;
  }
}

Scenario delivery(const std::string& policy) {
  Scenario scenario = kit::short_delivery(40.0);
  scenario.governor.policy = policy;
  return scenario;
}

TEST(SwitchedKernels, plan_by_the_kind_in_force_and_arrive) {
  Scenario scenario = delivery(to_and_fro);
  scenario.planner.horizon_m = 8.0;  // A plan every few metres.
  scenario.knobs.planner_kinds = "rrt_star";
  const MissionRecord record = kit::flown(scenario);
  EXPECT_EQ(record.summary.status, MissionStatus::succeeded);
  EXPECT_EQ(record.summary.policy_faults, 0U) << record.summary.policy_trouble;
  const auto jobs = jobs_of(record, "plan");
  check_kinds_of(jobs, turns_of(record, "planner.kind"), {"rrt_connect", "rrt_star"});
  for (const char* kernel : {"rrt_connect", "rrt_star"}) {
    const auto found = record.summary.kernels.find(kernel);
    ASSERT_NE(found, record.summary.kernels.end()) << kernel;
    EXPECT_EQ(found->second.calls, static_cast<std::uint64_t>(std::count_if(
                                       jobs.begin(), jobs.end(),
                                       [=](const FlownJob& job) { return job.kernel == kernel; })));
  }
}

TEST(SwitchedKernels, leave_a_mission_as_it_is_while_no_policy_turns_their_knobs) {
  Scenario scenario = kit::short_delivery();
  const MissionRecord plain = kit::flown(scenario);
  scenario.knobs = {"rrt_star", "haar", true, true};
  const MissionRecord with_knobs = kit::flown(scenario);
  EXPECT_EQ(with_knobs.summary.mission_time_s, plain.summary.mission_time_s);
  EXPECT_EQ(with_knobs.summary.energy_rotor_j, plain.summary.energy_rotor_j);
  EXPECT_EQ(with_knobs.summary.energy_computer_j, plain.summary.energy_computer_j);
}

TEST(SwitchedKernels, fly_with_mission_energy) {
  Scenario scenario = delivery("mission_energy");
  scenario.knobs = {"rrt_star,prm", "haar", true, true};
  const Summary summary = kit::flown(scenario).summary;
  EXPECT_EQ(summary.status, MissionStatus::succeeded);
  EXPECT_EQ(summary.policy_faults, 0U) << summary.policy_trouble;
}

/// Photographs a person for some seconds; fails where this machine has no meshes of people.
Result<MissionRecord> photograph() {
  auto loaded = load_scenario(
      "photography_park",
      {"mission.time_limit_s=90", "photography.limit_s=8", "photography.success_s=3",
       "photography.lost_after_detections=90", "kernels.slam_load=false", "detector.cost_of=own",
       "knobs.detector_kinds=haar", "governor.policy=" + std::string{to_and_fro}});
  if (const auto* errors = std::get_if<std::vector<Error>>(&loaded)) {
    return errors->front();
  }
  return fly(std::get<LoadedScenario>(loaded).scenario, {});
}

TEST(SwitchedKernels, never_change_within_a_job_and_the_first_one_pays_for_the_switch) {
  const auto record = photograph();
  if (!record && record.error().message.find("morse-simulator-data") != std::string::npos) {
    GTEST_SKIP() << record.error().message;
  }
  ASSERT_TRUE(record.ok()) << record.error().message;
  const auto turns = turns_of(*record, "detector.kind");
  const auto jobs = jobs_of(*record, "detect");
  check_kinds_of(jobs, turns, {"hog", "haar"});
  EXPECT_GE(std::count_if(jobs.begin(), jobs.end(),
                          [&](const FlownJob& job) {
                            return is_turned_between(turns, job.started_s, job.ended_s);
                          }),
            3)
      << "else nothing is shown about jobs during which the knob is turned";
  // Images of one size are the same work for HOG.
  double usual_s = 0.0;
  double with_switch_s = 0.0;
  for (const FlownJob& job : jobs) {
    double& of_its_kind = job.switches > 0.0 ? with_switch_s : usual_s;
    of_its_kind = job.kernel == "hog" ? job.busy_s : of_its_kind;
  }
  EXPECT_GT(usual_s, 0.0);
  EXPECT_NEAR(with_switch_s - usual_s, 0.5e-3, 0.01e-3) << "the platform's price of a switch";
}

/// Each pair of jobs between which the knob is not turned is as far apart as the rate says.
int check_rate_of(const std::vector<FlownJob>& jobs,
                  const std::vector<Turn>& turns,
                  double first_hz) {
  int checked = 0;
  for (std::size_t i = 1; i < jobs.size(); ++i) {
    const double from_s = jobs[i - 1].started_s;
    const double until_s = jobs[i].started_s;
    constexpr double moment_s = 0.06;  // A frame, and a turn that comes together with one.
    if (from_s > 1.0 && !is_turned_between(turns, from_s - moment_s, until_s + moment_s)) {
      EXPECT_NEAR(until_s - from_s, 1.0 / in_force(turns, first_hz, until_s), 0.01) << from_s;
      ++checked;
    }
  }
  return checked;
}

TEST(SwitchedKernels, a_camera_takes_frames_at_the_rate_in_force_and_the_bound_follows_at_once) {
  Scenario scenario = delivery(to_and_fro);
  scenario.knobs.camera_rate = true;
  const MissionRecord record = kit::flown(scenario);
  EXPECT_EQ(record.summary.status, MissionStatus::succeeded);
  const auto turns = turns_of(record, "camera.rate_hz");
  EXPECT_GE(turns.size(), 6U);
  EXPECT_GT(check_rate_of(jobs_of(record, "points"), turns, 20.0), 50);
  int slow = 0;
  for (const auto& row : record.trace->rows()) {
    const double bound_s = value_of<double>(row, "latency_bound_s");
    const double rate_hz = in_force(turns, 20.0, to_seconds(row.at));
    if (row.channel == "state" && bound_s > 0.0 && rate_hz < 20.0) {
      EXPECT_GT(bound_s, 1.1 / rate_hz) << to_seconds(row.at);
      ++slow;
    }
  }
  EXPECT_GT(slow, 20);
}

TEST(SwitchedKernels, a_lower_camera_rate_is_a_lower_speed) {
  Scenario scenario = kit::short_delivery(60.0);
  const double usual_m_s = kit::flown(scenario).summary.max_speed_m_s;
  scenario.governor.policy = FLYBALL_CLOSED_LOOP_TESTS "/slow_camera.lua";
  scenario.knobs.camera_rate = true;
  const Summary slow = kit::flown(scenario).summary;
  EXPECT_EQ(slow.status, MissionStatus::succeeded);
  EXPECT_LT(slow.max_speed_m_s, 0.95 * usual_m_s);
}

TEST(SwitchedKernels, a_localizer_looks_at_frames_at_the_rate_in_force) {
  Scenario scenario = delivery(to_and_fro);
  scenario.knobs.localizer_rate = true;
  const MissionRecord record = kit::flown(scenario);
  EXPECT_EQ(record.summary.status, MissionStatus::succeeded);
  const auto turns = turns_of(record, "localizer.rate_hz");
  EXPECT_GE(turns.size(), 6U);
  // A frame of SLAM takes longer than the camera's interval, so a job may begin that much late.
  constexpr double late_s = 0.06;
  const auto jobs = jobs_of(record, "slam_load");
  int in_slow_times = 0;
  for (std::size_t i = 1; i < jobs.size(); ++i) {
    const double from_s = jobs[i - 1].started_s;
    const double until_s = jobs[i].started_s;
    const double rate_hz = in_force(turns, 20.0, until_s);
    if (rate_hz < 20.0 && from_s > 1.0 && !is_turned_between(turns, from_s, until_s + late_s)) {
      EXPECT_GT(until_s - from_s, 1.0 / rate_hz - late_s) << until_s;
      ++in_slow_times;
    }
  }
  EXPECT_GE(in_slow_times, 5);
}

TEST(SwitchedKernels, that_are_not_there_are_refused) {
  Scenario scenario = kit::short_delivery();
  scenario.knobs.planner_kinds = "crayon";
  const auto record = fly(scenario, {});
  ASSERT_FALSE(record.ok());
  EXPECT_NE(record.error().message.find("planner.kind for \"crayon\""), std::string::npos)
      << record.error().message;
}

}  // namespace
}  // namespace flyball

#endif
