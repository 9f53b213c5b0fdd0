// SPDX-License-Identifier: BSD-3-Clause
#include "records/fingerprint.h"

#include "flyball/runtime/recorder.h"
#include "flyball/sim/depth_camera.h"

#include <cmath>

#include <Eigen/Dense>

namespace flyball {
namespace {

// glibc picks its implementations by CPU class; their last bits differ.
void probe_libm(TraceHash& hash) {
  for (int i = 1; i <= 64; ++i) {
    const double x = 0.137 * i;
    for (const double y : {std::sin(x), std::cos(x), std::exp(x), std::log(x), std::pow(x, 1.7),
                           std::atan2(x, 3.1)}) {
      hash.add(y);
    }
  }
}

void probe_camera(TraceHash& hash) {
  World world;
  world.boxes.push_back({Vec3{3.0, -0.4, 0.0}, Vec3{3.7, 0.9, 2.1}});
  DepthCameraSpec spec;
  spec.width_px = 32;
  spec.height_px = 24;
  spec.rgbd_noise = false;
  const DepthCamera camera{world, spec, 1};
  Pose X_WC = Pose::Identity();
  X_WC.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  X_WC.translation() = Vec3{0.1, 0.05, 1.3};
  for (const float depth : camera.capture(X_WC, MissionTime{}, 0).depth_m) {
    hash.add(static_cast<double>(depth));
  }
}

void probe_eigen(TraceHash& hash) {
  Eigen::Matrix<double, 8, 8> hilbert;
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) {
      hilbert(i, j) = 1.0 / (i + j + 1);
    }
  }
  const Eigen::Matrix<double, 8, 1> x =
      hilbert.partialPivLu().solve(Eigen::Matrix<double, 8, 1>::Ones());
  for (const double value : x) {
    hash.add(value);
  }
}

}  // namespace

std::string numeric_fingerprint() {
  TraceHash hash;
  probe_libm(hash);
  probe_camera(hash);
  probe_eigen(hash);
  return hash.hex();
}

}  // namespace flyball
