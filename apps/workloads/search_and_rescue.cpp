// SPDX-License-Identifier: BSD-3-Clause
//
// Search and rescue: explores as 3-D mapping does, while a detector looks for people; when somebody
// is found, flies home and lands. Dataflow as in MAVBench (MICRO 2018), figure of search and
// rescue.

#include "flyball/flight/workload.h"
#include "flyball/records/pictures.h"
#include "flyball/records/text_table.h"
#include "flyball/runtime/registry.h"
#include "flyball/sim/world.h"

#include "flight/exploration/exploration_flight.h"
#include "flight/people/person_search.h"
#include "simulation/exploration_judge.h"
#include <algorithm>
#include <memory>

namespace {

using namespace flyball;
using namespace std::chrono_literals;

constexpr auto judging_period = 1s;
constexpr double found_within_m = 1.0;  // Of a real person, along the ground.
constexpr double same_place_m = 1.0;    // A second look at what was taken for a person is no news.
constexpr std::size_t most_frames = 6;  // For the report; the person is the last of them.

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
    NodeSpec spec;
    spec.name = "mission";
    spec.trigger = OnPeriod{100ms, 200ms};
    spec.priority = 35;
    flight_->declare(spec);
    spec.reads.push_back(sightings_.index);
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
    std::map<std::string, double> figures{
        {"false_positives", static_cast<double>(mistaken_W_.size())},
        {"coverage_percent", coverage_percent_},
        {"views", static_cast<double>(flight_->views())}};
    if (found_s_) {
      figures["time_to_find_s"] = *found_s_;
      figures["position_error_m"] = found_error_m_;
    }
    return figures;
  }
  [[nodiscard]] std::vector<MissionFrame> frames() const override { return frames_; }

 private:
  void step(JobContext& job) {
    if (context_->is_over()) {
      return;
    }
    judge_map(job.now());
    judge_sightings(job);
    flight_->step(job);
    if (flight_->state() == ExplorationFlight::State::exhausted) {
      context_->finish(job.now(), MissionStatus::failed, MissionFailure::not_found);
    } else if (flight_->state() == ExplorationFlight::State::landed) {
      context_->finish(job.now(), MissionStatus::succeeded, MissionFailure::none);
    }
  }

  // For the record only: the search ends when somebody is found, or with nothing left to see.
  void judge_map(MissionTime now) {
    if (now < next_judging_) {
      return;
    }
    next_judging_ = now + judging_period;
    if (!judge_) {
      judge_ = make_judge(*context_);
    }
    coverage_percent_ = judge_->coverage_percent(context_->map());
    context_->recorder.record(now, "coverage", {{"coverage_percent", coverage_percent_}});
  }

  void judge_sightings(JobContext& job) {
    while (const auto seen = job.take(sightings_)) {
      for (const Sighting& sighting : seen->people) {
        judge(job.now(), seen->frame, sighting);
      }
    }
  }

  /// Who looks at the picture on the ground knows whether it shows a person.
  void judge(MissionTime now, const ColourFrame& frame, const Sighting& sighting) {
    const double error_m = distance_to_person_m(frame.captured, sighting.p_W);
    const bool is_real = error_m <= found_within_m;
    context_->recorder.record(now, "sighting",
                              {{"x_m", sighting.p_W.x()},
                               {"y_m", sighting.p_W.y()},
                               {"real", is_real ? 1.0 : 0.0},
                               {"score", sighting.score},
                               {"error_m", error_m},
                               {"captured_s", to_seconds(frame.captured)}});
    if (found_s_) {
      return;
    }
    if (is_real) {
      found_s_ = to_seconds(now);
      found_error_m_ = error_m;
      context_->event(now, "person found");
      keep(frame, sighting, "the person, " + rounded(error_m, 2) + " m from the place given");
      flight_->go_home(now);
    } else if (is_new(sighting.p_W)) {
      mistaken_W_.push_back(sighting.p_W);
      if (frames_.size() + 1 < most_frames) {
        keep(frame, sighting, "nobody");
      }
    }
  }

  void keep(const ColourFrame& frame, const Sighting& sighting, const std::string& what) {
    frames_.push_back(boxed(frame.image.value(), sighting.box, found_s_.has_value(),
                            "at " + rounded(to_seconds(frame.captured), 1) + " s: " + what));
  }

  [[nodiscard]] double distance_to_person_m(MissionTime at, const Vec3& p_W) const {
    double nearest_m = 1e3;
    for (const Person& person : context_->truth->people) {
      nearest_m = std::min(nearest_m, (person.at(at).foot_W - p_W).head<2>().norm());
    }
    return nearest_m;
  }

  [[nodiscard]] bool is_new(const Vec3& p_W) const {
    return std::none_of(mistaken_W_.begin(), mistaken_W_.end(),
                        [&](const Vec3& old_W) { return (old_W - p_W).norm() < same_place_m; });
  }

  MissionContext* context_{};
  std::unique_ptr<Navigator> navigator_;
  std::unique_ptr<ExplorationFlight> flight_;
  std::unique_ptr<ExplorationJudge> judge_;
  Topic<Sightings> sightings_{};
  MissionTime next_judging_{};
  double coverage_percent_{};
  std::optional<double> found_s_{};
  double found_error_m_{};
  std::vector<Vec3> mistaken_W_{};
  std::vector<MissionFrame> frames_{};
};

}  // namespace

FLYBALL_PLUGIN(search_and_rescue) {
  registry.add<flyball::Workload>("search_and_rescue",
                                  [] { return std::make_unique<SearchAndRescue>(); });
}
