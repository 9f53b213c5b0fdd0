// SPDX-License-Identifier: BSD-3-Clause
//
// Search and rescue: the vehicle explores as in 3-D mapping, while a detector looks for people.
// Whoever was seen once is looked at from another place at once. When enough sightings agree that
// somebody is found, it flies home and lands. When no view is left that shows anything new, it goes
// through all of them once more before it flies home without. The dataflow is that of MAVBench
// (MICRO 2018), figure of search and rescue.

#include "flyball/flight/exploration/exploration_flight.h"
#include "flyball/flight/exploration/known_share.h"
#include "flyball/flight/flight_parts.h"
#include "flyball/flight/people/person_finding.h"
#include "flyball/flight/people/person_search.h"
#include "flyball/flight/people/second_look.h"
#include "flyball/flight/perception/counted_map.h"
#include "flyball/flight/workload.h"
#include "flyball/runtime/registry.h"

#include <memory>
#include <optional>

namespace {

using namespace flyball;
using namespace std::chrono_literals;

constexpr auto searched_area_period = 1s;
constexpr double square_m = 0.3;  // Chosen: half a doorway.

class SearchAndRescue final : public Workload {
 public:
  void build(Graph& graph, const FlightParts& parts) override {
    brief_ = parts.brief;
    mission_ = parts.mission;
    flight_ = std::make_unique<ExplorationFlight>(graph, parts);
    sightings_ = add_person_search(graph, parts, flight_->perception().localization);
    finding_ = std::make_unique<PersonFinding>(parts.brief->settings.search);
    found_ = graph.topic<Finding>("finding");
    NodeSpec spec;
    spec.name = "mission";
    spec.cost = map_queries_cost;
    spec.trigger = OnPeriod{100ms, 200ms};
    spec.priority = 35;
    spec.reads = {sightings_.index};
    spec.writes = {found_.index, mission_.progress.index, mission_.end.index};
    flight_->declare(spec);
    graph.node(std::move(spec), [this](JobContext& job) {
      Work asked;
      step(job, asked);
      return asked;
    });
  }

  [[nodiscard]] Status check(const FlightSettings&, const Site& site) const override {
    return check_volume(site);
  }
  [[nodiscard]] bool looks_for_people() const override { return true; }

  [[nodiscard]] std::map<std::string, double> quality() const override {
    return {{"views", static_cast<double>(flight_->views())}};
  }

 private:
  void step(JobContext& job, Work& asked) {
    if (is_done_) {
      return;
    }
    while (const auto seen = job.take(sightings_)) {
      look_at(job, *seen);
    }
    tell_area(job, asked);
    look_once_more(job, asked);
    flight_->step(job);
    if (flight_->state() == ExplorationFlight::State::exhausted) {
      look_again_or_give_up(job);
    } else if (flight_->state() == ExplorationFlight::State::landed) {
      end(job);
    }
  }

  /// A sighting alone finds nobody. Left to chance, the next one of the same person came 18 s later
  /// in the mean of seven flights of search_collapsed_building, or never.
  void look_once_more(JobContext& job, Work& asked) {
    doubt_ = doubt_ ? doubt_ : finding_->take_doubt();
    const auto revision = job.latest(flight_->perception().map);
    if (finding_->has_found() || !doubt_ || !revision || !flight_->takes_view(job)) {
      return;
    }
    const CountedMap map{*revision->map};
    const auto view = second_look(map, brief_->narrow_body(), brief_->site.bounds_W, *doubt_,
                                  brief_->settings.search.apart_m);
    map.add_to(asked);
    doubt_.reset();
    if (view) {
      flight_->fly_to(job, *view);
      log_event(job, mission_, "perhaps somebody: looks from another place");
    }
  }

  void look_again_or_give_up(JobContext& job) {
    if (flight_->look_again()) {
      log_event(job, mission_, "nobody found: looks again");
    } else {
      log_event(job, mission_, "nobody found: gives up");
      flight_->go_home(job);
    }
  }

  /// Somebody who lies there shows in the colour image where the depth image has made space known.
  void tell_area(JobContext& job, Work& asked) {
    const auto revision = job.latest(flight_->perception().map);
    if (!revision || job.now() < next_estimate_) {
      return;
    }
    next_estimate_ = job.now() + searched_area_period;
    const Site& site = brief_->site;
    const CountedMap map{*revision->map};
    tell_progress(
        job, mission_, ProgressUnit::square_metre,
        known_area_m2(map, site.volume_W, site.cruise_height_m + site.ground_z_m, square_m));
    map.add_to(asked);
  }

  void end(JobContext& job) {
    if (finding_->has_found()) {
      end_mission(job, mission_, MissionStatus::succeeded, MissionFailure::none);
    } else {
      end_mission(job, mission_, MissionStatus::failed, MissionFailure::not_found);
    }
    is_done_ = true;
  }

  void look_at(JobContext& job, const Sightings& seen) {
    for (const Sighting& sighting : seen.people) {
      if (auto found = finding_->add(job.now(), sighting, seen.frame, seen.from_W)) {
        log_event(job, mission_, "person found");
        job.publish(found_, std::move(*found));
        flight_->go_home(job);
      }
    }
  }

  std::shared_ptr<const Brief> brief_{};  ///< Owners: all nodes.
  MissionTopics mission_{};
  std::unique_ptr<ExplorationFlight> flight_;
  std::unique_ptr<PersonFinding> finding_;
  Topic<Sightings> sightings_{};
  Topic<Finding> found_{};
  MissionTime next_estimate_{};
  std::optional<Doubt> doubt_{};  ///< To be looked at from another place.
  bool is_done_{};
};

}  // namespace

FLYBALL_PLUGIN(search_and_rescue) {
  registry.add<flyball::Workload>("search_and_rescue",
                                  [] { return std::make_unique<SearchAndRescue>(); });
}
