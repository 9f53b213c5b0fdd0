// SPDX-License-Identifier: BSD-3-Clause
#include "scans/depth_view.h"

#include "synthetic_scans.h"
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double range_m = 7.0;
constexpr double finest_m = 0.15;

/// A block somewhere in the view or beside it, in C.
Eigen::Vector3f random_block(std::mt19937& generator) {
  std::uniform_real_distribution<float> across{-6.0F, 6.0F};
  std::uniform_real_distribution<float> along{-0.5F, 8.0F};
  return {across(generator), 0.5F * across(generator), along(generator)};
}

class ScanView {
 public:
  ScanView(kit::Place place, int frame, Simd simd) : view_{finest_m, inner_loops(simd)} {
    const auto scan = kit::synthetic_scan(place, frame, range_m, 160);
    view_.look(scan.cloud_C, scan.X_WC, range_m);
  }
  [[nodiscard]] const DepthView& operator*() const { return view_; }

 private:
  DepthView view_;
};

TEST(DepthView, says_of_eight_cubes_at_once_no_more_than_of_each) {
  for (const auto place : {kit::Place::indoor, kit::Place::outdoor}) {
    const ScanView view{place, 3, widest_simd()};
    std::mt19937 generator{17};
    int same = 0;
    int of_each[3] = {};
    for (int i = 0; i < 4000; ++i) {
      const int level = 2 + i % 4;
      const Eigen::Vector3f centre_C = random_block(generator);
      const OctantVisibility visible = (*view).visibility_of_octants(centre_C, level);
      ASSERT_EQ(visible.whole & visible.part, 0U);
      ASSERT_EQ((*view).whole_octants(centre_C, level), visible.whole);
      for (unsigned octant = 0; octant < 8; ++octant) {
        const BlockVisibility expected =
            (*view).visibility_of(centre_C + (*view).to_octant(level, octant), level - 1);
        const BlockVisibility seen = (visible.whole >> octant & 1U) != 0  ? BlockVisibility::whole
                                     : (visible.part >> octant & 1U) != 0 ? BlockVisibility::part
                                                                          : BlockVisibility::none;
        // One scale for all eight: for the smaller ones it may be too coarse to be sure.
        ASSERT_TRUE(seen == expected || seen == BlockVisibility::part) << "level " << level;
        same += seen == expected ? 1 : 0;
        ++of_each[static_cast<int>(expected)];
      }
    }
    EXPECT_GT(same, 4000 * 8 * 98 / 100);
    EXPECT_GT(*std::min_element(of_each, of_each + 3), 300);
  }
}

TEST(DepthView, says_of_eight_cubes_the_same_with_all_vector_instructions) {
  for (const Simd simd : supported_simd()) {
    const ScanView portable{kit::Place::indoor, 5, Simd::portable};
    const ScanView wide{kit::Place::indoor, 5, simd};
    std::mt19937 generator{23};
    for (int i = 0; i < 2000; ++i) {
      const Eigen::Vector3f centre_C = random_block(generator);
      const OctantVisibility a = (*portable).visibility_of_octants(centre_C, 2 + i % 4);
      const OctantVisibility b = (*wide).visibility_of_octants(centre_C, 2 + i % 4);
      ASSERT_EQ(a.whole, b.whole);
      ASSERT_EQ(a.part, b.part);
      ASSERT_EQ((*wide).whole_octants(centre_C, 2 + i % 4), a.whole);
    }
  }
}

TEST(DepthView, sees_through_a_cube_only_where_every_pixel_behind_it_is_farther) {
  const auto scan = kit::synthetic_scan(kit::Place::indoor, 2, range_m, 160);
  const ScanView view{kit::Place::indoor, 2, widest_simd()};
  const Eigen::Matrix3d R_CW = scan.X_WC.linear().transpose();
  const Intrinsics& camera = *scan.cloud_C.camera;
  std::mt19937 generator{29};
  int whole = 0;
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3f centre_C = random_block(generator);
    const OctantVisibility visible = (*view).visibility_of_octants(centre_C, 2);
    for (unsigned octant = 0; octant < 8; ++octant) {
      if ((visible.whole >> octant & 1U) == 0) {
        continue;
      }
      ++whole;
      const Vec3 middle_C = (centre_C + (*view).to_octant(2, octant)).cast<double>();
      for (unsigned corner = 0; corner < 8; ++corner) {
        const auto side = [&](unsigned axis) {
          return (corner >> axis & 1U) != 0 ? finest_m : -finest_m;
        };
        const Vec3 p_C = middle_C + R_CW * (0.999 * Vec3{side(0), side(1), side(2)});
        const double u = camera.focal_px * p_C.x() / p_C.z() + camera.centre_x_px + 0.5;
        const double v = camera.focal_px * p_C.y() / p_C.z() + camera.centre_y_px + 0.5;
        ASSERT_TRUE(u >= 0.0 && v >= 0.0 && u < camera.width_px && v < camera.height_px);
        const float depth_m =
            (*view).probe().depth_m[static_cast<int>(v) * camera.width_px + static_cast<int>(u)];
        ASSERT_GE(depth_m, p_C.z());
        ASSERT_LE(p_C.norm(), range_m);
      }
    }
  }
  EXPECT_GT(whole, 500);
}

}  // namespace
}  // namespace flyball
