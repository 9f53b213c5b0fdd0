// SPDX-License-Identifier: BSD-3-Clause
//
// 3-D mapping of an unknown volume: take off, fly from next-best view to next-best view until
// enough of what can be known is known, or nothing is left to see; then fly home and land. Dataflow
// as in MAVBench (MICRO 2018), figure of 3-D mapping.

#include "flyball/flight/exploration/exploration_flight.h"
#include "flyball/flight/exploration/known_share.h"
#include "flyball/flight/workload.h"
#include "flyball/runtime/registry.h"

#include <memory>

namespace {

using namespace flyball;
using namespace std::chrono_literals;

constexpr auto estimating_period = 1s;
constexpr double cell_m = 0.15;  // Of the estimate: as thin as walls are.

class Mapping final : public Workload {
 public:
  void build(Graph& graph, const VehicleTopics& vehicle, MissionContext& context) override {
    context_ = &context;
    navigator_ = std::make_unique<Navigator>(context);
    flight_ = std::make_unique<ExplorationFlight>(context, *navigator_);
    known_ = std::make_unique<KnownShare>(context.brief.volume_W, cell_m);
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
    return {{"known_percent", known_percent_}, {"views", static_cast<double>(flight_->views())}};
  }

 private:
  void step(JobContext& job) {
    if (context_->is_over()) {
      return;
    }
    estimate(job.now());
    flight_->step(job);
    if (flight_->state() == ExplorationFlight::State::exhausted) {
      flight_->go_home(job.now());
    } else if (flight_->state() == ExplorationFlight::State::landed) {
      context_->finish(job.now(), MissionStatus::succeeded, MissionFailure::none);
    }
  }

  void estimate(MissionTime now) {
    if (now < next_estimate_ || flight_->state() != ExplorationFlight::State::exploring) {
      return;
    }
    next_estimate_ = now + estimating_period;
    known_percent_ = known_->percent(context_->map());
    context_->recorder.record(now, "known", {{"known_percent", known_percent_}});
    if (known_percent_ >= context_->settings.explore.coverage_percent) {
      flight_->go_home(now);
    }
  }

  MissionContext* context_{};
  std::unique_ptr<Navigator> navigator_;
  std::unique_ptr<ExplorationFlight> flight_;
  std::unique_ptr<KnownShare> known_;
  MissionTime next_estimate_{};
  double known_percent_{};
};

}  // namespace

FLYBALL_PLUGIN(mapping) {
  registry.add<flyball::Workload>("mapping", [] { return std::make_unique<Mapping>(); });
}
