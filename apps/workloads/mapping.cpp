// SPDX-License-Identifier: BSD-3-Clause
//
// 3-D mapping of an unknown volume: the vehicle takes off and flies from next-best view to
// next-best view until enough of what can be known is known, or no view would show more. Then it
// flies home and lands. The dataflow is that of MAVBench (MICRO 2018), figure of 3-D mapping.

#include "flyball/flight/exploration/exploration_flight.h"
#include "flyball/flight/exploration/known_share.h"
#include "flyball/flight/flight_parts.h"
#include "flyball/flight/perception/counted_map.h"
#include "flyball/flight/workload.h"
#include "flyball/runtime/registry.h"

#include <memory>

namespace {

using namespace flyball;
using namespace std::chrono_literals;

constexpr auto known_share_period = 1s;
constexpr double cell_m = 0.15;  // Cells of the estimate are as thin as the walls.

struct ShareQuery {};

struct ShareAnswer {
  double known_percent{};
  double known_m3{};
};

/// Asks the map for each cell of the volume, which takes long: so it is a node of its own, and
/// all others come first.
void add_known_share(Graph& graph,
                     const FlightParts& parts,
                     Topic<MapRevision> newest_map,
                     const Service<ShareQuery, ShareAnswer>& share) {
  NodeSpec spec;
  spec.name = "known_share";
  spec.cost = map_queries_cost;
  spec.trigger = OnMessage{share.request.index};
  spec.priority = 5;
  spec.reads = {newest_map.index};
  spec.writes = {share.response.index};
  auto known =
      std::make_shared<KnownShare>(parts.brief->site.volume_W, cell_m);  // Owner: the node.
  graph.node(std::move(spec), [=](JobContext& job) {
    Work work;
    const auto revision = job.latest(newest_map);
    if (job.take(share.request) && revision) {
      const CountedMap map{*revision->map};
      const double percent = known->percent(map);
      job.publish(share.response, ShareAnswer{percent, known->known_m3()});
      map.add_to(work);
    }
    return work;
  });
}

class Mapping final : public Workload {
 public:
  void build(Graph& graph, const FlightParts& parts) override {
    brief_ = parts.brief;
    mission_ = parts.mission;
    flight_ = std::make_unique<ExplorationFlight>(graph, parts);
    share_ = graph.service<ShareQuery, ShareAnswer>("known_share");
    add_known_share(graph, parts, flight_->perception().map, share_);
    NodeSpec spec;
    spec.name = "mission";
    spec.trigger = OnPeriod{100ms, 200ms};
    spec.priority = 35;
    spec.reads = {share_.response.index};
    spec.writes = {mission_.progress.index, mission_.end.index, share_.request.index};
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
    if (flight_->state() == ExplorationFlight::State::exploring) {
      watch_share(job);
    }
    flight_->step(job);
    if (flight_->state() == ExplorationFlight::State::exhausted) {
      flight_->go_home(job);
    } else if (flight_->state() == ExplorationFlight::State::landed) {
      end_mission(job, mission_, MissionStatus::succeeded, MissionFailure::none);
      is_done_ = true;
    }
  }

  void watch_share(JobContext& job) {
    if (job.latest(flight_->perception().map) && job.now() >= next_query_) {
      next_query_ = job.now() + known_share_period;
      job.publish(share_.request, ShareQuery{});
    }
    const auto share = job.take(share_.response);
    if (!share) {
      return;
    }
    known_percent_ = share->known_percent;
    log(job, mission_, "known", {{"known_percent", known_percent_}});
    tell_progress(job, mission_, ProgressUnit::cubic_metre, share->known_m3);
    if (known_percent_ >= brief_->settings.explore.coverage_percent) {
      flight_->go_home(job);
    }
  }

  std::shared_ptr<const Brief> brief_{};  ///< Owners: all nodes.
  MissionTopics mission_{};
  std::unique_ptr<ExplorationFlight> flight_;
  Service<ShareQuery, ShareAnswer> share_{};
  MissionTime next_query_{};
  double known_percent_{};
  bool is_done_{};
};

}  // namespace

FLYBALL_PLUGIN(mapping) {
  registry.add<flyball::Workload>("mapping", [] { return std::make_unique<Mapping>(); });
}
