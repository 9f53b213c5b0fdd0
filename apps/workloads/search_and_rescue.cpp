// SPDX-License-Identifier: BSD-3-Clause
//
// Search and rescue: explores as 3-D mapping does, while a detector looks for people; when enough
// sightings agree that somebody is found, flies home and lands. Dataflow as in MAVBench (MICRO
// 2018), figure of search and rescue.

#include "flyball/flight/exploration/exploration_flight.h"
#include "flyball/flight/people/person_finding.h"
#include "flyball/flight/people/person_search.h"
#include "flyball/flight/workload.h"
#include "flyball/runtime/registry.h"

#include <memory>

namespace {

using namespace flyball;
using namespace std::chrono_literals;

class SearchAndRescue final : public Workload {
 public:
  void build(Graph& graph, const VehicleTopics& vehicle, MissionContext& context) override {
    context_ = &context;
    navigator_ = std::make_unique<Navigator>(context);
    flight_ = std::make_unique<ExplorationFlight>(context, *navigator_);
    const PerceptionTopics perception = add_perception(graph, vehicle, context);
    add_navigation(graph, vehicle, perception, context, *navigator_);
    flight_->add_nodes(graph, vehicle, perception);
    sightings_ = add_person_search(graph, vehicle, perception, context);
    finding_ = std::make_unique<PersonFinding>(context.settings.search);
    found_ = graph.topic<Finding>("finding");
    NodeSpec spec;
    spec.name = "mission";
    spec.trigger = OnPeriod{100ms, 200ms};
    spec.priority = 35;
    flight_->declare(spec);
    spec.reads.push_back(sightings_.index);
    spec.writes.push_back(found_.index);
    graph.node(std::move(spec), [this](JobContext& job) {
      step(job);
      return Work{};
    });
  }

  [[nodiscard]] Status check(const FlightSettings&, const MissionBrief& brief) const override {
    return check_volume(brief);
  }
  [[nodiscard]] bool looks_for_people() const override { return true; }
  [[nodiscard]] const Navigator* navigator() const override { return navigator_.get(); }

  [[nodiscard]] std::map<std::string, double> quality() const override {
    return {{"views", static_cast<double>(flight_->views())}};
  }

 private:
  void step(JobContext& job) {
    if (context_->is_over()) {
      return;
    }
    while (const auto seen = job.take(sightings_)) {
      look_at(job, *seen);
    }
    flight_->step(job);
    if (flight_->state() == ExplorationFlight::State::exhausted) {
      context_->finish(job.now(), MissionStatus::failed, MissionFailure::not_found);
    } else if (flight_->state() == ExplorationFlight::State::landed) {
      context_->finish(job.now(), MissionStatus::succeeded, MissionFailure::none);
    }
  }

  void look_at(JobContext& job, const Sightings& seen) {
    for (const Sighting& sighting : seen.people) {
      if (auto found = finding_->add(job.now(), sighting, seen.frame, seen.from_W)) {
        context_->event(job.now(), "person found");
        job.publish(found_, std::move(*found));
        flight_->go_home(job.now());
      }
    }
  }

  MissionContext* context_{};
  std::unique_ptr<Navigator> navigator_;
  std::unique_ptr<ExplorationFlight> flight_;
  std::unique_ptr<PersonFinding> finding_;
  Topic<Sightings> sightings_{};
  Topic<Finding> found_{};
};

}  // namespace

FLYBALL_PLUGIN(search_and_rescue) {
  registry.add<flyball::Workload>("search_and_rescue",
                                  [] { return std::make_unique<SearchAndRescue>(); });
}
