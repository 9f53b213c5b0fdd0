// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Writes frames as the TUM RGB-D benchmark lays them out.

#include "flyball/kernels/visual_frame.h"

#include "png_writer.h"
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

namespace flyball::kit {

class TumSequence {
 public:
  explicit TumSequence(std::string folder) : folder_{std::move(folder)} {
    for (const char* name : {"/rgb", "/depth"}) {
      std::filesystem::create_directories(folder_ + name);
    }
    std::ofstream{folder_ + "/groundtruth.txt"} << "# timestamp tx ty tz qx qy qz qw\n";
  }

  /// Depth in units of 1/5000 m, as TUM has it; the time is that of the frame.
  void add(const VisualFrame& frame, const Pose& X_WC) {
    std::vector<std::uint16_t> depth;
    for (const float depth_m : frame.depth_m) {
      const double units = 5000.0 * static_cast<double>(depth_m);
      depth.push_back(units < 65535.0 ? static_cast<std::uint16_t>(std::lround(units))
                                      : std::uint16_t{0});
    }
    const std::string stamp = text(frame.captured);
    const int width_px = frame.camera.width_px;
    const int height_px = frame.camera.height_px;
    write_png(folder_ + "/rgb/" + stamp + ".png", width_px, height_px, frame.grey);
    write_png(folder_ + "/depth/" + stamp + ".png", width_px, height_px, depth);
    append("rgb.txt", stamp + " rgb/" + stamp + ".png");
    append("depth.txt", stamp + " depth/" + stamp + ".png");
    append("associations.txt",
           stamp + " rgb/" + stamp + ".png " + stamp + " depth/" + stamp + ".png");
    const Vec3 p = X_WC.translation();
    const Eigen::Quaterniond q{X_WC.linear()};
    char line[160];
    std::snprintf(line, sizeof line, "%s %.6f %.6f %.6f %.9f %.9f %.9f %.9f", stamp.c_str(), p.x(),
                  p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
    append("groundtruth.txt", line);
  }

  static std::string text(MissionTime t) {
    char out[40];
    std::snprintf(out, sizeof out, "%.6f", to_seconds(t));
    return out;
  }

 private:
  void append(const std::string& name, const std::string& line) const {
    std::ofstream{folder_ + "/" + name, std::ios::app} << line << "\n";
  }
  std::string folder_;
};

}  // namespace flyball::kit
