// SPDX-License-Identifier: BSD-3-Clause
// tested-in: platform_fit
#include "studies/fit_scenes.h"

#include "flyball/flight/navigation/plan_with_tubes.h"

#include "simulation/mission_setup.h"
#include "studies/fit_localizer.h"
#include "studies/fit_perception.h"
#include <algorithm>

namespace flyball {
namespace {

constexpr int most_steps = 2000;  // A path that is blocked again and again ends here.

Scenario delivery() {
  Scenario scenario;
  scenario.name = "platform_fit";
  scenario.seed = 1;
  scenario.world.generator = "outdoor_to_indoor";
  scenario.world.parameters = {{"outdoors_m", 300.0}, {"indoors_m", 30.0}};
  scenario.camera.width_px = 256;
  scenario.camera.height_px = 144;
  scenario.camera.horizontal_field_rad = 1.5707963267948966;
  scenario.map.resolution_m = 0.15;
  scenario.map.range_m = 7.0;
  return scenario;
}

class Delivery {
 public:
  Delivery(const DeliveryScene& scene, const Workbench& bench, const World& world)
      : scene_{scene}, bench_{bench}, world_{world}, perception_{bench, world} {
    const Vec3 up = Vec3::UnitZ() * world.cruise_height_m;
    path_ = Path::polyline({world.start_W + up, world.goal_W + up});
    goal_W_ = world.goal_W + up;
    bench.kernels.mapper->declare_clear(world.start_W + Vec3::UnitZ() * 1.25, {1.0, 1.25});
  }

  Result<DeliveryLoads> go() {
    for (int step = 0; step < most_steps && !is_indoors(); ++step) {
      if (const Status seen = look(); !seen) {
        return seen.error();
      }
      if (const Status clear = check(); !clear) {
        return clear.error();
      }
      if (step % scene_.localizes_every == 0) {
        stretches_.push_back({pose(), scene_.speed_m_s, scene_.localizes_s});
      }
      s_m_ += scene_.step_m;
    }
    if (!is_indoors()) {
      return Error{ErrorCode::failed, "the recorded delivery does not reach its building"};
    }
    if (const Status tracked = track_stretches(stretches_, scene_.scenario, world_, loads_.kernels);
        !tracked) {
      return tracked.error();
    }
    return std::move(loads_);
  }

 private:
  [[nodiscard]] bool is_indoors() const { return bench_.situation().is_slow_at(here_W()); }
  [[nodiscard]] Vec3 here_W() const { return path_.at(s_m_).p_W; }
  [[nodiscard]] Pose pose() const { return looking(here_W(), yaw_of(path_.at(s_m_).tangent_W)); }

  Status look() {
    bench_.kernels.mapper->declare_clear(here_W(), bench_.brief.body);
    if (const Status seen = perception_.look(pose(), loads_.kernels); !seen) {
      return seen.error();
    }
    const auto coarse = perception_.prepare(scene_.coarse_resolution_m);
    if (!coarse) {
      return coarse.error();
    }
    loads_.coarse_map.calls.push_back(*coarse);
    return Done{};
  }

  /// Keeps a path that is clear as far as the map knows.
  Status check() {
    const double end_m = std::min(s_m_ + scene_.checked_m, path_.length_m());
    const Path ahead = Path::polyline({here_W(), path_.at(end_m).p_W});
    Work priced;
    check(ahead, 0.0, priced);
    loads_.kernels[bench_.brief.settings.kernels.collision_check].calls.push_back(priced);
    Work all;
    return check(path_, s_m_, all).blocked_at_m ? plan() : Done{};
  }

  PathCheck check(const Path& path, double from_m, Work& work) {
    const PathSpan span{&path, from_m, bench_.brief.settings.map.range_m};
    return bench_.kernels.collision_check->check(bench_.kernels.mapper->view(), span,
                                                 bench_.brief.narrow_body(), work);
  }

  /// A planner samples at random, so one plan says little about its mean work. Several are made,
  /// and the last one is flown.
  Status plan() {
    constexpr int plans_at_once = 8;
    PlanQuery query;
    query.start_W = here_W();
    query.goal_W = goal_W_;
    for (int i = 0; i < plans_at_once; ++i) {
      query.id = ++plans_;
      Cylinder body;
      const Plan plan = plan_with_tubes(bench_.situation(), *bench_.kernels.planner, query, body);
      if (plan.waypoints_W.empty()) {
        return Error{ErrorCode::failed, "in the recorded delivery: " + plan.failure};
      }
      loads_.kernels[bench_.brief.settings.kernels.planner].calls.push_back(plan.work);
      path_ = Path::polyline(plan.waypoints_W);
    }
    s_m_ = 0.0;
    return Done{};
  }

  const DeliveryScene& scene_;
  const Workbench& bench_;
  const World& world_;
  Perception perception_;
  std::vector<Stretch> stretches_{};
  DeliveryLoads loads_{};
  Path path_{};
  double s_m_{};
  Vec3 goal_W_{Vec3::Zero()};
  std::uint64_t plans_{};
};

/// Room by room, heading by heading.
Pose view_in(const RoomsScene& scene, int view) {
  const int room = view / scene.headings;
  const int row = room / scene.columns;
  const int column = room % scene.columns;
  return looking(
      scene.first_room_W + Vec3{row * scene.row_pitch_m, column * scene.column_pitch_m, 0.0},
      6.283185307179586 * (view % scene.headings) / scene.headings);
}

}  // namespace

Work KernelLoad::mean() const {
  Work sum;
  for (const Work& work : calls) {
    for (const WorkItem& item : work.items()) {
      sum.add(item.name, item.count / static_cast<double>(calls.size()));
    }
  }
  return sum;
}

DeliveryScene scene_a() {
  return {delivery(), 3.0, 7.0, 0.98, 10, 2.0, 4.0};
}

RoomsScene scene_b() {
  RoomsScene scene;
  scene.scenario = delivery();
  scene.first_room_W = {304.5, -10.2, 1.2};
  scene.rows = 4;
  scene.columns = 3;
  scene.row_pitch_m = 9.0;
  scene.column_pitch_m = 10.2;
  scene.headings = 4;
  scene.localizes_s = 1.5;
  scene.speed_m_s = 1.0;
  return scene;
}

Scenario paper_survey() {
  Scenario scenario;
  scenario.name = "platform_fit";
  scenario.world.generator = "farm";
  scenario.kernels.coverage = "lawnmower";
  scenario.scan.length_m = scenario.scan.width_m = 100.0;
  scenario.scan.lanes = 5;
  return scenario;
}

Result<KernelLoads> record(const Scenario& survey) {
  const auto setup = set_up(survey);
  if (!setup) {
    return setup.error();
  }
  const Vec3 up = Vec3::UnitZ() * survey.scan.height_m;
  const auto path = setup->equipment.kernels.coverage->cover(
      {up, survey.scan.length_m, survey.scan.width_m, survey.scan.lanes,
       setup->things.world.start_W + up, setup->things.world.start_W + up});
  if (!path) {
    return path.error();
  }
  KernelLoads loads;
  loads[survey.kernels.coverage].calls.push_back(path->work);
  return loads;
}

Result<DeliveryLoads> record(const DeliveryScene& scene) {
  auto setup = set_up(scene.scenario);
  if (!setup) {
    return setup.error();
  }
  const Workbench bench = workbench_of(scene.scenario, *setup);
  return Delivery{scene, bench, setup->things.world}.go();
}

Result<KernelLoads> record(const RoomsScene& scene) {
  auto setup = set_up(scene.scenario);
  if (!setup) {
    return setup.error();
  }
  const Workbench bench = workbench_of(scene.scenario, *setup);
  const Clearance clearance{setup->things.world};
  Perception perception{bench, setup->things.world};
  KernelLoads loads;
  std::vector<Stretch> stretches;
  for (int i = 0; i < scene.rows * scene.columns * scene.headings; ++i) {
    const Pose X_WB = view_in(scene, i);
    if (clearance.distance_m(X_WB.translation(), bench.brief.body, 1.0, true) <= 0.0) {
      continue;
    }
    if (const Status seen = perception.look(X_WB, loads); !seen) {
      return seen.error();
    }
    const int room = i / scene.headings;
    if (i % scene.headings == room % scene.headings) {
      stretches.push_back({X_WB, scene.speed_m_s, scene.localizes_s});
    }
  }
  if (const Status tracked = track_stretches(stretches, scene.scenario, setup->things.world, loads);
      !tracked) {
    return tracked.error();
  }
  return loads;
}

}  // namespace flyball
