// SPDX-License-Identifier: BSD-3-Clause
//
// Watching a place: the vehicle hovers, or stands with its rotors off, and keeps its map of what
// the camera sees up to date for a time. Then nothing that it computes makes it any faster: all
// that is asked of the computer is that the news is not too old. Graph of nodes as in package
// delivery, so that it could depart at once.

#include "flyball/flight/legs.h"
#include "flyball/flight/navigation/navigation_nodes.h"
#include "flyball/flight/workload.h"
#include "flyball/runtime/registry.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

namespace {

using namespace flyball;
using namespace std::chrono_literals;

constexpr double least_height_m = 0.5;  // Below it, the ground's cells reach into the body.

class Watch final : public Workload {
 public:
  [[nodiscard]] Status check(const FlightSettings& settings,
                             const MissionBrief& brief) const override {
    const double height_m = settings.watch.height_m;
    const double ceiling_m = brief.bounds_W.max.z() - brief.ground_z_m;
    if (height_m == 0.0 || (height_m >= least_height_m && height_m <= ceiling_m)) {
      return Done{};
    }
    char text[160];
    std::snprintf(text, sizeof text,
                  "watch.height_m = %g must be 0, to stand on the ground, or from %g to %g, the "
                  "ceiling of world \"%s\"",
                  height_m, least_height_m, ceiling_m, brief.place.c_str());
    return Error{ErrorCode::invalid_input, text};
  }

  void build(Graph& graph, const VehicleTopics& vehicle, MissionContext& context) override {
    context_ = &context;
    navigator_ = std::make_unique<Navigator>(context);
    perception_ = add_perception(graph, vehicle, context);
    add_navigation(graph, vehicle, perception_, context, *navigator_);
    NodeSpec spec;
    spec.name = "mission";
    spec.trigger = OnPeriod{100ms, 200ms};
    spec.priority = 35;
    spec.reads = {perception_.pose.index, perception_.map.index};
    legs_.emplace(context, vehicle);
    legs_->declare(spec);
    graph.node(std::move(spec), [this](JobContext& job) {
      const auto pose = job.latest(perception_.pose);
      if (pose && !context_->is_over()) {
        advance(job, *pose);
      }
      return Work{};
    });
  }

  [[nodiscard]] const Navigator* navigator() const override { return navigator_.get(); }

  [[nodiscard]] std::map<std::string, double> quality() const override {
    return {{"longest_without_map_s", longest_s_}, {"maps_watched", static_cast<double>(maps_)}};
  }

 private:
  enum class Stage : std::uint8_t { ready, climbing, watching, landing };

  void advance(JobContext& job, const PoseEstimate& pose) {
    switch (stage_) {
      case Stage::ready:
        begin(job, pose);
        break;
      case Stage::climbing:
        if (legs_->are_done(job)) {
          watch_from(job.now());
        }
        break;
      case Stage::watching:
        watch(job);
        break;
      case Stage::landing:
        if (legs_->are_done(job)) {
          end(job.now());
        }
        break;
    }
  }

  [[nodiscard]] double height_m() const { return context_->settings.watch.height_m; }

  void begin(JobContext& job, const PoseEstimate& pose) {
    const Vec3 place_W = context_->brief.start_W + Vec3::UnitZ() * height_m();
    navigator_->hover_at(place_W, yaw_of(pose.X_WB.linear().col(0)));
    if (height_m() == 0.0) {
      watch_from(job.now());
      return;
    }
    legs_->take_off(job, height_m());
    stage_ = Stage::climbing;
  }

  void watch_from(MissionTime now) {
    context_->phase = MissionPhase::wait;
    context_->event(now, "watching");
    stage_ = Stage::watching;
    since_ = news_ = now;
  }

  void watch(JobContext& job) {
    const auto map = job.latest(perception_.map);
    if (map && map->number != newest_) {
      newest_ = map->number;
      news_ = job.now();
      ++maps_;
    }
    longest_s_ = std::max(longest_s_, to_seconds(job.now() - news_));
    if (to_seconds(job.now() - since_) < context_->settings.watch.time_s) {
      return;
    }
    if (height_m() == 0.0) {
      end(job.now());
      return;
    }
    legs_->land(job);
    stage_ = Stage::landing;
  }

  void end(MissionTime now) {
    if (longest_s_ > context_->settings.watch.longest_s) {
      context_->finish(now, MissionStatus::failed, MissionFailure::incomplete);
    } else {
      context_->finish(now, MissionStatus::succeeded, MissionFailure::none);
    }
  }

  MissionContext* context_{};
  std::unique_ptr<Navigator> navigator_;
  std::optional<Legs> legs_{};
  PerceptionTopics perception_{};
  Stage stage_{Stage::ready};
  MissionTime since_{};
  MissionTime news_{};
  std::uint64_t newest_{};
  std::uint64_t maps_{};
  double longest_s_{};
};

}  // namespace

FLYBALL_PLUGIN(watch) {
  registry.add<flyball::Workload>("watch", [] { return std::make_unique<Watch>(); });
}
