// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/conformance/point_cloud_conformance.h"

#include "kernel_trials.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

class CloudCulprit final : public PointCloudBuilder {
 public:
  explicit CloudCulprit(std::string crime) : crime_{std::move(crime)} {}

  PointCloudFrame build(const DepthFrame& frame, double range_m, Work& work) override {
    DepthFrame asked = frame;
    if (crime_ == "one_eyed") {
      asked.sides.clear();
    }
    Work honest;
    PointCloudFrame built =
        honest_->build(asked, crime_ == "far" ? 2.0 * range_m : range_m, honest);
    PointCloud cloud = built.cloud_C.value();
    if (crime_ == "scale") {
      for (Eigen::Vector3f& p : cloud.hits_C) {
        p *= 1.01F;
      }
    } else if (crime_ == "blind") {
      cloud.clear_C.clear();
    } else if (crime_ == "invents") {
      cloud.hits_C.emplace_back(0.0F, 0.0F, 1.0F);
    } else if (crime_ == "timeless") {
      built.captured = {};
    } else if (crime_ == "one_image") {
      built.pixels = RangeImage{frame.image, range_m};
    } else if (crime_ == "remembers") {
      cloud.hits_C.insert(cloud.hits_C.end(), last_.begin(), last_.end());
      last_ = cloud.hits_C;
    }
    built.cloud_C = Deferred<PointCloud>::of(cloud);
    const double pixels = honest.count("pixels");
    work.add("pixels", crime_ == "idle" ? 0.0 : crime_ == "shrinking" ? 1e4 / pixels : pixels);
    return built;
  }

 private:
  std::string crime_;
  std::unique_ptr<PointCloudBuilder> honest_{
      kit::kernels().make<PointCloudBuilder>("depth_to_points")};
  std::vector<Eigen::Vector3f> last_{};
};

TEST(PointClouds, keep_their_contract) {
  kit::try_all_registered<PointCloudConformance, PointCloudBuilder>();
}

TEST(PointCloudConformance, finds_each_kind_of_breach) {
  kit::expect_crimes_found<PointCloudConformance, PointCloudBuilder>(
      [](const std::string& crime) { return std::make_unique<CloudCulprit>(crime); },
      {{"one_eyed", "does not put each pixel at its depth"},
       {"far", "beyond the range, into a clear ray"},
       {"scale", "does not put each pixel at its depth"},
       {"blind", "into a clear ray"},
       {"invents", "does not put each pixel at its depth"},
       {"timeless", "does not keep time and number"},
       {"one_image", "calls the points of several cameras the pixels of one"},
       {"remembers", "answers differently after other frames"},
       {"idle", "counts no pixels"},
       {"shrinking", "counts less work for a larger input"}});
}

}  // namespace
}  // namespace flyball
