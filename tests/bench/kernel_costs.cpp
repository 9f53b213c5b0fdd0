// SPDX-License-Identifier: BSD-3-Clause
//
// What single operations of the kernels cost on this host: the c_i of the platform files. Prints
// nanoseconds, for stock OctoMap and SLAM by non-negative least squares of relative errors.
//
//     ninja kernel_costs && bin/kernel_costs

#include "flyball/flight/exploration/known_share.h"
#include "flyball/flight/governing/surroundings.h"
#include "flyball/flight/navigation/gap_scan.h"
#include "flyball/flight/perception/counted_map.h"
#include "flyball/flight/perception/perception_nodes.h"
#include "flyball/kernels/localizer.h"
#include "flyball/kernels/mapper.h"
#include "flyball/kernels/path_planner.h"
#include "flyball/kernels/point_cloud.h"
#include "flyball/scenario/files.h"
#include "flyball/scenario/plugins.h"
#include "flyball/sim/depth_camera.h"
#include "flyball/sim/platform_file.h"
#include "flyball/studies/cost_fit.h"

#include "maps/octomap_tree.h"
#include "scenario/kernel_choice.h"
#include "simulation/mission_setup.h"
#include "studies/fit_localizer.h"
#include "studies/fit_scenes.h"
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <map>

namespace {

using namespace flyball;

/// CPU time: other programs on the host do not count.
template <class Run>
double seconds(Run&& run) {
  const auto now = [] {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  const double start = now();
  run();
  return now() - start;
}

void print_fit(const std::string& kernel,
               const std::vector<std::string>& names,
               const std::vector<CostSample>& samples,
               double factor = 1.0) {
  const CostFit fit = non_negative_fit(samples);
  std::printf("%s: root mean square error %.1f %% of %zu samples\n%s:", kernel.c_str(),
              100.0 * fit.error, samples.size(), kernel.c_str());
  for (std::size_t k = 0; k < names.size(); ++k) {
    std::printf(" %s %.3g", names[k].c_str(), 1e9 * factor * fit.seconds_per[k]);
  }
  std::printf(" ns\n");
}

struct Look {
  PointCloud cloud;
  Pose X_WC;
};

octomap::Pointcloud to_world(const Look& view) {
  octomap::Pointcloud points;
  for (const auto* part : {&view.cloud.hits_C, &view.cloud.clear_C}) {
    for (const Eigen::Vector3f& p_C : *part) {
      const Eigen::Vector3f p = (view.X_WC * p_C.cast<double>()).cast<float>();
      points.push_back(p.x(), p.y(), p.z());
    }
  }
  return points;
}

PointCloud every_fourth(const PointCloud& cloud) {
  PointCloud fewer;
  const auto take = [](const auto& from, auto& to) {
    for (std::size_t i = 0; i < from.size(); i += 4) {
      to.push_back(from[i]);
    }
  };
  take(cloud.hits_C, fewer.hits_C);
  take(cloud.clear_C, fewer.clear_C);
  return fewer;
}

std::vector<Look> look_around(const Scenario& scenario, const World& world) {
  const DepthCamera camera{world, scenario.camera, scenario.seed};
  const auto builder = Plugins{}.make<PointCloudBuilder>(scenario.kernels.point_cloud);
  const Clearance clearance{world};
  std::vector<Look> views;
  double host_s = 0.0;
  double pixels = 0.0;
  // 1.6 m are MAVBench's 2.5 m/s for the .63 s that a frame takes: most cells are known already.
  for (int i = 0; i < 60; ++i) {
    const double x_m = i < 40 ? 1.6 * i : 300.0 + 1.6 * (i - 40);  // The building begins at 300 m.
    const Vec3 p_W{x_m, 0.0, world.cruise_height_m};
    if (clearance.distance_m(p_W, {0.4, 0.2}, 1.0, true) <= 0.0) {
      continue;
    }
    Pose X_WB = Pose::Identity();
    X_WB.translation() = p_W;
    Look view{{}, camera_pose(X_WB, {})};
    const DepthFrame frame = camera.frame(view.X_WC, MissionTime{}, views.size());
    (void)frame.image.value();  // The sensor's time is not the kernel's.
    Work work;
    host_s += seconds(
        [&] { view.cloud = builder->build(frame, scenario.map.range_m, work).cloud_C.value(); });
    pixels += work.count("pixels");
    views.push_back(std::move(view));
  }
  std::printf("depth_to_points: %.2f ns a pixel\n", 1e9 * host_s / pixels);
  return views;
}

void measure_octomap(const std::vector<Look>& views, double range_m) {
  std::vector<CostSample> samples;
  for (const double resolution_m : {0.15, 0.2, 0.3, 0.5, 0.8, 0.98}) {
    const auto counter = Plugins{}.make<Mapper>("octomap");
    octomap::OcTree full{resolution_m};
    octomap::OcTree sparse{resolution_m};
    for (octomap::OcTree* tree : {&full, &sparse}) {
      tree->setClampingThresMin(0.12);  // both as in MAVBench's code
      tree->setClampingThresMax(0.97);
    }
    double total_s = 0.0;
    for (const Look& view : views) {
      for (const bool is_full : {true, false}) {
        const Look seen{is_full ? view.cloud : every_fourth(view.cloud), view.X_WC};
        const auto work = counter->prepare(seen.cloud, seen.X_WC, {resolution_m, range_m});
        const octomap::Pointcloud points = to_world(seen);
        const Eigen::Vector3f eye = seen.X_WC.translation().cast<float>();
        octomap::OcTree& tree = is_full ? full : sparse;
        const double host_s = seconds([&] {
          tree.insertPointCloud(points, {eye.x(), eye.y(), eye.z()}, range_m);
        });
        samples.push_back(
            {{1.0, work->count("rays"), work->count("traversals"), work->count("updates")},
             host_s});
        total_s += is_full ? host_s : 0.0;
      }
    }
    std::printf("octomap, stock insertPointCloud at %.2f m: %.2f ms a frame\n", resolution_m,
                1e3 * total_s / static_cast<double>(views.size()));
  }
  print_fit("octomap", {"frame", "rays", "traversals", "updates"}, samples);
}

/// Stock OctoMap beside another mapper on the same frames: its time on this host, and by the
/// platform file's prices of single operations.
struct StockTime {
  double host_s{};
  double priced_s{};

  void insert(const Look& view, double range_m, Mapper& counter, octomap::OcTree& tree) {
    const auto work =
        counter.prepare(view.cloud, view.X_WC, {tree.getResolution(), range_m}).value();
    for (const WorkItem& item : work.items()) {
      priced_s += item.count * prices.at(std::string{item.name});
    }
    const octomap::Pointcloud points = to_world(view);
    const Eigen::Vector3f eye = view.X_WC.translation().cast<float>();
    host_s += seconds([&] { tree.insertPointCloud(points, {eye.x(), eye.y(), eye.z()}, range_m); });
  }

  std::map<std::string, double, std::less<>> prices;
};

/// The brick map, frame by frame in turns with stock OctoMap, so that both see the same host. The
/// prices are in seconds of that host on which stock takes as long as the platform file says: then
/// the file's scale for stock serves both.
/// @return Those prices over what was measured here.
double measure_flyball(const std::vector<Look>& views, double range_m, const PlatformModel& model) {
  const std::vector<std::string> names{"frame", "rays", "traversals", "blocks", "updates"};
  StockTime stock;
  stock.prices = model.kernels.at("octomap").seconds_per;
  std::vector<CostSample> samples;
  for (const double resolution_m : {0.15, 0.3, 0.6, 1.2}) {
    octomap::OcTree tree{resolution_m};
    const auto counter = Plugins{}.make<Mapper>("octomap");
    for (const char* front_end : {"pyramid", "exact", "rays"}) {
      KernelSettings chosen;
      chosen.mapper = "flyball";
      chosen.mapper_parameters["front_end"] = std::string{front_end};
      const auto mapper = std::move(make_kernel<Mapper>(Plugins{}, chosen).value());
      double total_s = 0.0;
      for (const Look& view : views) {
        CostSample sample;
        Work work;
        sample.time_s = seconds([&] {
          work = mapper->prepare(view.cloud, view.X_WC, {resolution_m, range_m}).value();
          mapper->commit();
        });
        for (const std::string& name : names) {
          sample.counts.push_back(work.count(name));
        }
        total_s += sample.time_s;
        samples.push_back(std::move(sample));
        if (front_end == std::string{"pyramid"}) {
          stock.insert(view, range_m, *counter, tree);
        }
      }
      std::printf("flyball, %s at %.2f m: %.3f ms a frame\n", front_end, resolution_m,
                  1e3 * total_s / static_cast<double>(views.size()));
    }
  }
  const double factor = stock.priced_s / stock.host_s;
  std::printf("flyball: stock by the file's prices took %.2f of its time here\n", factor);
  print_fit("flyball, in seconds of the file's stock", names, samples, factor);
  return factor;
}

/// The body's box by stock iterators, as a check by poses does it.
void measure_body_query(const std::vector<Look>& views, double range_m) {
  octomap::OcTree tree{0.15};
  for (const Look& view : views) {
    const Eigen::Vector3f eye = view.X_WC.translation().cast<float>();
    tree.insertPointCloud(to_world(view), {eye.x(), eye.y(), eye.z()}, range_m);
  }
  int occupied = 0;
  int poses = 0;
  const double host_s = seconds([&] {
    for (float x = 0.0F; x < 64.0F; x += 0.05F, ++poses) {
      const octomap::point3d low{x - 0.36F, -0.36F, 1.05F};
      const octomap::point3d high{x + 0.36F, 0.36F, 1.35F};
      for (auto leaf = tree.begin_leafs_bbx(low, high); leaf != tree.end_leafs_bbx(); ++leaf) {
        occupied += tree.isNodeOccupied(*leaf) ? 1 : 0;
      }
    }
  });
  std::printf("swept_cylinder: %.0f ns a pose (%d occupied leaves at %d poses)\n",
              1e9 * host_s / poses, occupied, poses);
}

/// What one question of a kind takes that `ask` puts to the map at each place.
template <class Ask>
void print_price(const char* name, const OccupancyView& view, double factor, Ask&& ask) {
  const CountedMap map{view};
  const double host_s = seconds([&] { ask(map); });
  Work work;
  map.add_to(work);
  std::printf("map_queries: %s %.0f ns, %.0f of them\n", name,
              1e9 * factor * host_s / work.count(name), work.count(name));
}

/// What nodes ask the map beside its kernels, in the brick map of these frames, in seconds of the
/// host on which stock takes what the platform file says (`factor`, see `measure_flyball`).
void measure_map_queries(const std::vector<Look>& views, double range_m, double factor) {
  KernelSettings chosen;
  chosen.mapper = "flyball";
  const auto mapper = std::move(make_kernel<Mapper>(Plugins{}, chosen).value());
  for (const Look& view : views) {
    (void)mapper->prepare(view.cloud, view.X_WC, {0.15, range_m});
    mapper->commit();
  }
  const auto print_at_places = [&](const char* name, auto&& ask) {
    print_price(name, mapper->view(), factor, [&](const OccupancyView& map) {
      for (const Look& view : views) {
        ask(map, view.X_WC.translation());
      }
    });
  };
  GapScan scan;
  scan.half_band_m = density_half_band_m;
  scan.bounds_W = {Vec3::Constant(-1e3), Vec3::Constant(1e3)};
  print_at_places("distances", [&](const OccupancyView& map, const Vec3& p_W) {
    (void)gaps_ahead(map, p_W, p_W + Vec3{50.0, 0.0, 0.0}, scan);
  });
  print_at_places("densities", [](const OccupancyView& map, const Vec3& p_W) {
    (void)map.obstacle_density(p_W, density_radius_m, density_half_band_m);
  });
  print_at_places("collision_queries", [](const OccupancyView& map, const Vec3& p_W) {
    (void)headroom_m(p_W, {0.36, 0.15}, map);
  });
  print_at_places("cells", [](const OccupancyView& map, const Vec3& p_W) {
    KnownShare share{{p_W - Vec3{0.0, 5.0, 1.0}, p_W + Vec3{10.0, 5.0, 2.0}}, 0.15};
    (void)share.percent(map);
  });
}

/// What visual SLAM took for frames whose work is known.
void see_and_time(const std::vector<VisualFrame>& frames,
                  const Pose& X_WB,
                  double weak_corner,
                  const std::vector<std::string>& names,
                  std::vector<CostSample>& samples) {
  KernelSettings kernels;
  kernels.localizer = "visual_slam";
  kernels.localizer_parameters = {{"weak_corner", weak_corner}};
  const auto localizer = std::move(make_kernel<Localizer>(Plugins{}, kernels).value());
  localizer->start({});
  localizer->set_initial_pose(X_WB);
  for (const VisualFrame& frame : frames) {
    Work work;
    CostSample sample;
    sample.time_s = seconds([&] { (void)localizer->track_frame(frame, work); });
    for (const std::string& name : names) {
      sample.counts.push_back(work.count(name));
    }
    samples.push_back(std::move(sample));
  }
}

/// Short flights over the open ground and in the rooms, with few and with many corners.
void measure_slam(const Scenario& scenario, const World& world) {
  const std::vector<std::string> names{"pixels", "features", "matches", "patches",
                                       "ransac_iterations"};
  std::vector<CostSample> samples;
  for (int i = 0; i < 20; ++i) {
    const bool is_outdoors = i < 10;
    Pose X_WB = Pose::Identity();
    X_WB.translation() = is_outdoors ? Vec3{28.0 * i, 0.0, world.cruise_height_m}
                                     : Vec3{304.5 + 9.0 * (i % 4), 10.2 * (i / 4 - 3), 1.2};
    const auto frames = frames_of({X_WB, is_outdoors ? 4.0 : 1.0, 1.5}, scenario, world).value();
    for (const double weak_corner : {5.0, 10.0, 20.0}) {
      see_and_time(frames, X_WB, weak_corner, names, samples);
    }
  }
  print_fit("visual_slam_frames", names, samples);
}

}  // namespace

int main() {
  const Scenario scenario = scene_a().scenario;
  const auto setup = set_up(scenario);
  if (!setup) {
    std::printf("%s\n", setup.error().message.c_str());
    return 1;
  }
  const std::vector<Look> views = look_around(scenario, setup->things.world);
  measure_octomap(views, scenario.map.range_m);
  const auto file = find_shipped("platforms", scenario.platform.name);
  const double factor =
      measure_flyball(views, scenario.map.range_m, load_platform(file.value()).value());
  measure_map_queries(views, scenario.map.range_m, factor);
  measure_body_query(views, scenario.map.range_m);
  measure_slam(scenario, setup->things.world);
  return 0;
}
