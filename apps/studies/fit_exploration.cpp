// SPDX-License-Identifier: BSD-3-Clause
// tested-in: platform_fit
#include "studies/fit_exploration.h"

#include "flyball/flight/exploration/exploration_flight.h"
#include "flyball/flight/navigation/plan_with_tubes.h"

#include "simulation/judging/exploration_judge.h"
#include "simulation/mission_setup.h"
#include "studies/fit_localizer.h"
#include "studies/fit_perception.h"

namespace flyball {
namespace {

constexpr double look_every_m = 1.0;  // A map a second at indoor speed.

class Exploration {
 public:
  Exploration(const ExplorationScene& scene, const Workbench& bench, const World& world)
      : scene_{scene},
        bench_{bench},
        world_{world},
        perception_{bench, world},
        judge_{make_exploration_judge(bench.brief, world)},
        here_{world.start_W + Vec3::UnitZ() * world.cruise_height_m,
              yaw_of(world.goal_W - world.start_W)} {
    bench.kernels.mapper->declare_clear(world.start_W + Vec3::UnitZ() * 1.25, {1.0, 1.25});
  }

  Result<ExplorationLoads> go() {
    if (const Status seen = look(here_); !seen) {
      return seen.error();
    }
    while (loads_.views < scene_.most_views && !is_done()) {
      const auto next = ask();
      if (!next) {
        break;
      }
      if (const Status seen = move_to(*next); !seen) {
        return seen.error();
      }
      ++loads_.views;
    }
    if (const Status tracked = track_stretches(stretches_, scene_.scenario, world_, loads_.kernels);
        !tracked) {
      return tracked.error();
    }
    return std::move(loads_);
  }

 private:
  Status look(const Viewpoint& from) {
    return perception_.look(looking(from.p_W, from.yaw_rad), loads_.kernels);
  }

  bool is_done() {
    loads_.coverage_percent = judge_.coverage_percent(bench_.kernels.mapper->view());
    return loads_.coverage_percent >= scene_.scenario.explore.coverage_percent;
  }

  std::optional<Viewpoint> ask() {
    ExploreRequest request = explore_request(bench_.brief, here_);
    request.taken = taken_;
    request.unreachable_W = unreachable_W_;
    request.seed = scene_.scenario.seed + static_cast<std::uint64_t>(++asked_);
    ExploreStep step = bench_.kernels.explorer->explore(request, bench_.kernels.mapper->view());
    loads_.kernels[scene_.scenario.kernels.explorer].calls.push_back(step.work);
    return step.next;
  }

  /// Flies along a plan and looks around at regular distances.
  Status move_to(const Viewpoint& next) {
    PlanQuery query;
    query.start_W = here_.p_W;
    query.goal_W = next.p_W;
    query.id = static_cast<std::uint64_t>(asked_);
    query.may_be_tight = true;
    Cylinder body;
    const Plan plan = plan_with_tubes(bench_.situation(), *bench_.kernels.planner, query, body);
    if (plan.waypoints_W.empty()) {
      unreachable_W_.push_back(next.p_W);
      return Done{};
    }
    const Path path = Path::polyline(plan.waypoints_W);
    for (double s_m = look_every_m; s_m < path.length_m(); s_m += look_every_m) {
      const Path::Sample on_path = path.at(s_m);
      const Viewpoint ahead{on_path.p_W, yaw_of(on_path.tangent_W)};
      if (Status seen = look(ahead); !seen) {
        return seen;
      }
      if (scene_.localizes_every > 0 && looks_++ % scene_.localizes_every == 0) {
        stretches_.push_back(
            {looking(ahead.p_W, ahead.yaw_rad), scene_.speed_m_s, scene_.localizes_s});
      }
    }
    here_ = next;
    taken_.push_back(next);
    return look(here_);
  }

  const ExplorationScene& scene_;
  const Workbench& bench_;
  const World& world_;
  Perception perception_;
  ExplorationJudge judge_;
  Viewpoint here_{};
  std::vector<Viewpoint> taken_{};
  std::vector<Vec3> unreachable_W_{};
  std::vector<Stretch> stretches_{};
  ExplorationLoads loads_{};
  int asked_{};
  int looks_{};  ///< Looks along paths.
};

Scenario exploration_of(const char* world) {
  Scenario scenario;
  scenario.name = "platform_fit";
  scenario.seed = 1;
  scenario.world.generator = world;
  scenario.kernels.mapper = "flyball";
  scenario.kernels.mapper_parameters = {{"cost_of", std::string{"octomap"}}};
  return scenario;
}

}  // namespace

ExplorationScene scene_c() {
  return {exploration_of("office"), 100, 0, 0.0, 0.0};
}

ExplorationScene scene_d() {
  ExplorationScene scene{exploration_of("collapsed_building"), 100, 4, 1.0, 1.0};
  // Three bays of 9 x 10.2 m, as much debris on a square metre as is shipped.
  scene.scenario.world.parameters = {
      {"length_m", 27.0}, {"width_m", 10.2}, {"slabs", 7.0}, {"rubble", 28.0}};
  return scene;
}

Result<ExplorationLoads> record(const ExplorationScene& scene) {
  auto setup = set_up(scene.scenario);
  if (!setup) {
    return setup.error();
  }
  const Workbench bench = workbench_of(scene.scenario, *setup);
  return Exploration{scene, bench, setup->things.world}.go();
}

}  // namespace flyball
