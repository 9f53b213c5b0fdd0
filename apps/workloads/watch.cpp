// SPDX-License-Identifier: BSD-3-Clause
//
// Watching a place: the vehicle hovers, or stands with its rotors off, and keeps its map of what
// the camera sees up to date for a time. Lower latency does not make it any faster, so the computer
// only has to keep the map recent enough. The place is the start, or the goal, to which the vehicle
// flies and from where it comes home. The graph of nodes is that of package delivery.

#include "flyball/flight/legs.h"
#include "flyball/flight/navigation/round_trip.h"
#include "flyball/flight/workload.h"
#include "flyball/runtime/registry.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

namespace {

using namespace flyball;
using namespace std::chrono_literals;

constexpr double least_height_m = 0.5;  // Below it, cells of the ground overlap the body.

class Watch final : public Workload {
 public:
  [[nodiscard]] Status check(const FlightSettings& settings, const Site& site) const override {
    const double height_m = settings.watch.height_m;
    if (settings.watch.at_goal && height_m != 0.0) {
      char text[160];
      std::snprintf(text, sizeof text,
                    "watch.height_m = %g must be 0 with watch.at_goal = true: the vehicle lands at "
                    "the goal",
                    height_m);
      return Error{ErrorCode::invalid_input, text};
    }
    const double ceiling_m = site.bounds_W.max.z() - site.ground_z_m;
    constexpr double rounding_m = 1e-6;  // Of a bound, which is told with six digits.
    if (height_m == 0.0 || (height_m >= least_height_m && height_m <= ceiling_m + rounding_m)) {
      return Done{};
    }
    char text[160];
    std::snprintf(text, sizeof text,
                  "watch.height_m = %g must be 0, to stand on the ground, or from %g to %g, the "
                  "ceiling of world \"%s\"",
                  height_m, least_height_m, ceiling_m, site.place.c_str());
    return Error{ErrorCode::invalid_input, text};
  }

  void build(Graph& graph, const FlightParts& parts) override {
    brief_ = parts.brief;
    mission_ = parts.mission;
    perception_ = add_perception(graph, parts);
    guidance_.emplace(add_navigation(graph, parts, perception_).guidance);
    trip_.emplace(parts, perception_, *guidance_);
    legs_.emplace(parts.vehicle, parts.mission);
    NodeSpec spec;
    spec.name = "mission";
    spec.trigger = OnPeriod{100ms, 200ms};
    spec.priority = 35;
    spec.reads = {perception_.localization.pose.index, perception_.map.index};
    spec.writes = {mission_.progress.index, mission_.end.index};
    trip_->declare(spec);
    graph.node(std::move(spec), [this](JobContext& job) {
      if (const auto pose = job.latest(perception_.localization.pose)) {
        advance(job, *pose);
      }
      return Work{};
    });
  }

  [[nodiscard]] bool flies_to_goal() const override {
    return brief_ != nullptr && brief_->settings.watch.at_goal;
  }

  [[nodiscard]] std::map<std::string, double> quality() const override {
    return {{"longest_without_map_s", longest_s_}, {"maps_watched", static_cast<double>(maps_)}};
  }

 private:
  enum class Stage : std::uint8_t {
    ready,
    climbing,
    on_trip,  ///< To the goal, or home from there.
    watching,
    landing,
    done
  };

  void advance(JobContext& job, const PoseEstimate& pose) {
    switch (stage_) {
      case Stage::ready:
        begin(job, pose);
        break;
      case Stage::climbing:
        if (legs_->are_done(job)) {
          watch_from(job);
        }
        break;
      case Stage::on_trip:
        travel(job, pose);
        break;
      case Stage::watching:
        watch(job);
        break;
      case Stage::landing:
        if (legs_->are_done(job)) {
          end(job);
        }
        break;
      case Stage::done:
        break;
    }
  }

  [[nodiscard]] double height_m() const { return brief_->settings.watch.height_m; }

  void travel(JobContext& job, const PoseEstimate& pose) {
    switch (trip_->step(job, pose)) {
      case RoundTrip::Landed::no:
        break;
      case RoundTrip::Landed::at_goal:
        watch_from(job);
        break;
      case RoundTrip::Landed::at_home:
        end(job);
        break;
    }
  }

  void begin(JobContext& job, const PoseEstimate& pose) {
    if (brief_->settings.watch.at_goal) {
      stage_ = Stage::on_trip;
      travel(job, pose);
      return;
    }
    const Vec3 place_W = brief_->site.start_W + Vec3::UnitZ() * height_m();
    guidance_->hover_at(job, place_W, yaw_of(pose.X_WB.linear().col(0)));
    if (height_m() == 0.0) {
      watch_from(job);
      return;
    }
    legs_->take_off(job, height_m());
    stage_ = Stage::climbing;
  }

  void watch_from(JobContext& job) {
    legs_->enter(job, MissionPhase::wait);
    log_event(job, mission_, "watching");
    stage_ = Stage::watching;
    since_ = news_ = job.now();
  }

  void watch(JobContext& job) {
    const auto map = job.latest(perception_.map);
    if (map && map->number != newest_) {
      newest_ = map->number;
      news_ = job.now();
      ++maps_;
    }
    longest_s_ = std::max(longest_s_, to_seconds(job.now() - news_));
    tell_progress(job, mission_, ProgressUnit::second, to_seconds(job.now() - since_),
                  from_seconds(brief_->settings.watch.longest_s));
    if (to_seconds(job.now() - since_) < brief_->settings.watch.time_s) {
      return;
    }
    if (brief_->settings.watch.at_goal) {
      trip_->go_home();
      stage_ = Stage::on_trip;
      return;
    }
    if (height_m() == 0.0) {
      end(job);
      return;
    }
    legs_->land(job);
    stage_ = Stage::landing;
  }

  void end(JobContext& job) {
    const bool is_late = longest_s_ > brief_->settings.watch.longest_s;
    end_mission(job, mission_, is_late ? MissionStatus::failed : MissionStatus::succeeded,
                is_late ? MissionFailure::incomplete : MissionFailure::none);
    stage_ = Stage::done;
  }

  std::shared_ptr<const Brief> brief_{};  ///< Owners: all nodes.
  MissionTopics mission_{};
  std::optional<Guidance> guidance_{};
  std::optional<Legs> legs_{};
  std::optional<RoundTrip> trip_{};
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
