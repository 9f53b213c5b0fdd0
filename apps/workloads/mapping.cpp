// SPDX-License-Identifier: BSD-3-Clause
//
// 3-D mapping of an unknown volume: the vehicle takes off and flies from next-best view to
// next-best view until enough of what can be known is known, or no view would show more. Then it
// flies home and lands. The dataflow is that of MAVBench (MICRO 2018), figure of 3-D mapping.

#include "flyball/flight/exploration/exploration_flight.h"
#include "flyball/flight/exploration/known_share.h"
#include "flyball/flight/flight_parts.h"
#include "flyball/flight/workload.h"
#include "flyball/runtime/registry.h"

#include <memory>

namespace {

using namespace flyball;
using namespace std::chrono_literals;

constexpr auto known_share_period = 1s;
constexpr double cell_m = 0.15;  // Cells of the estimate are as thin as the walls.

class Mapping final : public Workload {
 public:
  void build(Graph& graph, const FlightParts& parts) override {
    brief_ = parts.brief;
    mission_ = parts.mission;
    flight_ = std::make_unique<ExplorationFlight>(graph, parts);
    known_ = std::make_unique<KnownShare>(parts.brief->site.volume_W, cell_m);
    NodeSpec spec;
    spec.name = "mission";
    spec.trigger = OnPeriod{100ms, 200ms};
    spec.priority = 35;
    spec.writes = {mission_.progress.index, mission_.end.index};
    flight_->declare(spec);
    graph.node(std::move(spec), [this](JobContext& job) {
      step(job);
      return Work{};
    });
  }

  [[nodiscard]] Status check(const FlightSettings&, const Site& site) const override {
    return check_volume(site);
  }

  [[nodiscard]] std::map<std::string, double> quality() const override {
    return {{"known_percent", known_percent_}, {"views", static_cast<double>(flight_->views())}};
  }

 private:
  void step(JobContext& job) {
    if (is_done_) {
      return;
    }
    estimate(job);
    flight_->step(job);
    if (flight_->state() == ExplorationFlight::State::exhausted) {
      flight_->go_home(job);
    } else if (flight_->state() == ExplorationFlight::State::landed) {
      end_mission(job, mission_, MissionStatus::succeeded, MissionFailure::none);
      is_done_ = true;
    }
  }

  void estimate(JobContext& job) {
    const auto revision = job.latest(flight_->perception().map);
    if (!revision || job.now() < next_estimate_ ||
        flight_->state() != ExplorationFlight::State::exploring) {
      return;
    }
    next_estimate_ = job.now() + known_share_period;
    known_percent_ = known_->percent(*revision->map);
    log(job, mission_, "known", {{"known_percent", known_percent_}});
    tell_progress(job, mission_, ProgressUnit::cubic_metre, known_->known_m3());
    if (known_percent_ >= brief_->settings.explore.coverage_percent) {
      flight_->go_home(job);
    }
  }

  std::shared_ptr<const Brief> brief_{};  ///< Owners: all nodes.
  MissionTopics mission_{};
  std::unique_ptr<ExplorationFlight> flight_;
  std::unique_ptr<KnownShare> known_;
  MissionTime next_estimate_{};
  double known_percent_{};
  bool is_done_{};
};

}  // namespace

FLYBALL_PLUGIN(mapping) {
  registry.add<flyball::Workload>("mapping", [] { return std::make_unique<Mapping>(); });
}
