// SPDX-License-Identifier: BSD-3-Clause
//
// 3-D mapping of an unknown volume: take off, fly from next-best view to next-best view until
// enough of what can be seen is known, fly home, land. Dataflow as in MAVBench (MICRO 2018), figure
// of 3-D mapping.

#include "flyball/flight/workload.h"
#include "flyball/runtime/registry.h"

#include "flight/exploration/exploration_flight.h"
#include "simulation/exploration_judge.h"
#include <memory>

namespace {

using namespace flyball;
using namespace std::chrono_literals;

constexpr auto judging_period = 1s;

class Mapping final : public Workload {
 public:
  void build(Graph& graph, const VehicleTopics& vehicle, MissionContext& context) override {
    context_ = &context;
    navigator_ = std::make_unique<Navigator>(context);
    flight_ = std::make_unique<ExplorationFlight>(context, *navigator_);
    const PerceptionTopics perception = add_perception(graph, vehicle, context);
    add_navigation(graph, vehicle, perception, context, *navigator_);
    flight_->add_nodes(graph, vehicle, perception);
    NodeSpec spec;
    spec.name = "mission";
    spec.trigger = OnPeriod{100ms, 200ms};
    spec.priority = 35;
    flight_->declare(spec);
    graph.node(std::move(spec), [this](JobContext& job) {
      step(job);
      return Work{};
    });
  }

  [[nodiscard]] Status check(const FlightSettings&, const MissionBrief& brief) const override {
    return check_volume(brief);
  }

  [[nodiscard]] const Navigator* navigator() const override { return navigator_.get(); }

  [[nodiscard]] std::map<std::string, double> quality() const override {
    if (!judge_) {
      return {};
    }
    const MapAgreement agreement = judge_->agreement(*context_->kernels.mapper);
    return {{"coverage_percent", coverage_percent_},
            {"map_precision", agreement.precision},
            {"map_recall", agreement.recall},
            {"views", static_cast<double>(flight_->views())}};
  }

 private:
  void step(JobContext& job) {
    if (context_->is_over()) {
      return;
    }
    judge(job.now());
    flight_->step(job);
    if (flight_->state() == ExplorationFlight::State::exhausted) {
      context_->finish(job.now(), MissionStatus::failed, MissionFailure::incomplete);
    } else if (flight_->state() == ExplorationFlight::State::landed) {
      context_->finish(job.now(), MissionStatus::succeeded, MissionFailure::none);
    }
  }

  // The judge sees the true world and ends the exploration; the explorer does not know how much
  // there is to see.
  void judge(MissionTime now) {
    if (now < next_judging_) {
      return;
    }
    next_judging_ = now + judging_period;
    if (!judge_) {
      judge_ = make_judge(*context_);
    }
    coverage_percent_ = judge_->coverage_percent(context_->map());
    context_->recorder.record(now, "coverage", {{"coverage_percent", coverage_percent_}});
    if (flight_->state() == ExplorationFlight::State::exploring &&
        coverage_percent_ >= context_->settings.explore.coverage_percent) {
      flight_->go_home(now);
    }
  }

  MissionContext* context_{};
  std::unique_ptr<Navigator> navigator_;
  std::unique_ptr<ExplorationFlight> flight_;
  std::unique_ptr<ExplorationJudge> judge_;
  MissionTime next_judging_{};
  double coverage_percent_{};
};

}  // namespace

FLYBALL_PLUGIN(mapping) {
  registry.add<flyball::Workload>("mapping", [] { return std::make_unique<Mapping>(); });
}
