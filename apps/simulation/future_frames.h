// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What frames will cost that have not been taken yet. Only the simulator knows this, so policies
/// that ask for it cannot fly on a vehicle.

#include "flyball/flight/governing/governor_loop.h"
#include "flyball/governors/foresight.h"
#include "flyball/kernels/mapper.h"
#include "flyball/kernels/point_cloud.h"
#include "flyball/scenario/plugins.h"
#include "flyball/sim/depth_camera.h"

#include <array>
#include <map>
#include <memory>
#include <vector>

namespace flyball {

/// Takes frames in the true world, at places ahead, and lets the mission's own mapper say what work
/// each would be with each setting; nothing of them gets into the map. Places in the same cell of
/// 4 m that are looked at from in nearly the same direction share a frame.
class FutureFrames final : public ForesightSource {
 public:
  /// `world` and `computer` outlive this. @pre The mapper of `brief` is one of `plugins`.
  FutureFrames(std::shared_ptr<const Brief> brief,
               const Plugins& plugins,
               const World& world,
               const Platform& computer,
               std::vector<MapSetting> settings);

  [[nodiscard]] const Foresight& look(const NavigatorState& navigator,
                                      const Situation& situation) override;
  [[nodiscard]] std::size_t frames_taken() const { return durations_s_.size(); }

 private:
  struct Spot {
    Vec3 p_W{Vec3::Zero()};
    Vec3 tangent_W{Vec3::Zero()};
  };
  [[nodiscard]] static Spot spot(const NavigatorState& navigator, double ahead_m);
  [[nodiscard]] static PlaceAhead place(const NavigatorState& navigator,
                                        const Situation& situation,
                                        const Spot& spot,
                                        double ahead_m);
  [[nodiscard]] const std::vector<double>& durations_s(const Spot& spot);
  [[nodiscard]] std::vector<double> taken_at(const Spot& spot);
  [[nodiscard]] double duration_s(const Work& points, const Work& map, Hertz clock) const;

  std::shared_ptr<const Brief> brief_;              ///< Owners: the nodes and this.
  std::shared_ptr<PointCloudBuilder> point_cloud_;  ///< Of its own.
  const Platform& computer_;                        ///< With its drift.
  std::vector<MapSetting> settings_;
  DepthCamera camera_;
  std::unique_ptr<Mapper> mapper_;
  std::map<std::array<int, 4>, std::vector<double>> durations_s_{};  ///< By cell and direction.
  Foresight foresight_{};
};

}  // namespace flyball
