// SPDX-License-Identifier: BSD-3-Clause
//
// What single operations of the kernels cost on this host: the c_i of the platform files. Prints
// nanoseconds, for stock OctoMap by non-negative least squares of relative errors.
//
//     ninja kernel_costs && bin/kernel_costs

#include "flyball/apps/mission.h"
#include "flyball/kernels/mapper.h"
#include "flyball/kernels/path_planner.h"
#include "flyball/kernels/point_cloud.h"
#include "flyball/sim/depth_camera.h"

#include "fit_scenes.h"
#include "mission_setup.h"
#include "perception_nodes.h"
#include <algorithm>
#include <cstdio>
#include <ctime>

#include <octomap/OcTree.h>

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

struct Sample {
  Eigen::Vector4d counts;  ///< frame, rays, traversals, updates
  double host_s;
};

/// Least squares of relative errors over the best subset of non-negative coefficients.
Eigen::Vector4d non_negative_fit(const std::vector<Sample>& samples) {
  Eigen::Vector4d best = Eigen::Vector4d::Zero();
  double best_error = 1e300;
  for (unsigned subset = 1; subset < 16; ++subset) {
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(samples.size()), 4);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      for (unsigned k = 0; k < 4; ++k) {
        if ((subset >> k & 1U) != 0) {
          a(static_cast<Eigen::Index>(i), k) = samples[i].counts[k] / samples[i].host_s;
        }
      }
    }
    const Eigen::VectorXd one = Eigen::VectorXd::Ones(a.rows());
    const Eigen::Vector4d c = a.completeOrthogonalDecomposition().solve(one);
    const double error = (a * c - one).squaredNorm();
    if (c.minCoeff() >= 0.0 && error < best_error) {
      best = c;
      best_error = error;
    }
  }
  std::printf("octomap: root mean square error %.1f %% of %zu samples\n",
              100.0 * std::sqrt(best_error / static_cast<double>(samples.size())), samples.size());
  return best;
}

struct View {
  PointCloud cloud;
  Pose X_WC;
};

octomap::Pointcloud to_world(const View& view) {
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

std::vector<View> look_around(const Scenario& scenario, const World& world) {
  const DepthCamera camera{world, scenario.camera, scenario.seed};
  const auto builder = all_plugins().make<PointCloudBuilder>(scenario.kernels.point_cloud);
  const Clearance clearance{world};
  std::vector<View> views;
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
    View view{{}, camera_pose(X_WB)};
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

void measure_octomap(const std::vector<View>& views, double range_m) {
  std::vector<Sample> samples;
  for (const double resolution_m : {0.15, 0.2, 0.3, 0.5, 0.8, 0.98}) {
    const auto counter = all_plugins().make<Mapper>("octomap");
    octomap::OcTree full{resolution_m};
    octomap::OcTree sparse{resolution_m};
    for (octomap::OcTree* tree : {&full, &sparse}) {
      tree->setClampingThresMin(0.12);  // both as in MAVBench's code
      tree->setClampingThresMax(0.97);
    }
    double total_s = 0.0;
    for (const View& view : views) {
      for (const bool is_full : {true, false}) {
        const View seen{is_full ? view.cloud : every_fourth(view.cloud), view.X_WC};
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
  const Eigen::Vector4d c = 1e9 * non_negative_fit(samples);
  std::printf("octomap: frame %.0f rays %.2f traversals %.2f updates %.1f ns\n", c[0], c[1], c[2],
              c[3]);
}

/// The body's box by stock iterators, as a check by poses does it.
void measure_body_query(const std::vector<View>& views, double range_m) {
  octomap::OcTree tree{0.15};
  for (const View& view : views) {
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

}  // namespace

int main() {
  const Scenario scenario = scene_a().scenario;
  const auto setup = set_up(scenario);
  if (!setup) {
    std::printf("%s\n", setup.error().message.c_str());
    return 1;
  }
  const std::vector<View> views = look_around(scenario, setup->world);
  measure_octomap(views, scenario.map.range_m);
  measure_body_query(views, scenario.map.range_m);
  return 0;
}
