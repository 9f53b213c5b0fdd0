// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The vehicle's cameras: they take images of the true world, or a real camera does, and publish
/// them when these are due.

#include "flyball/flight/vehicle_port.h"
#include "flyball/runtime/event_queue.h"
#include "flyball/runtime/executor.h"
#include "flyball/scenario/scenario.h"
#include "flyball/sim/depth_camera.h"
#include "flyball/sim/vehicle.h"
#include "flyball/simulation/rendering.h"
#include "flyball/vehicles/clock_offset.h"
#include "flyball/vehicles/depth_source.h"

#include "simulation/picture_thread.h"
#include "simulation/simulated_things.h"
#include <functional>
#include <memory>
#include <utility>

namespace flyball {

/// A depth camera, the RGB camera beside it where there is one, and the colour camera on the gimbal
/// where there is one.
class CameraDrivers {
 public:
  /// Called with a colour picture's number and the camera's true pose, before the picture is
  /// published.
  using PictureListener = std::function<void(std::uint64_t, const Pose&)>;

  /// All arguments outlive the drivers.
  CameraDrivers(const Scenario& scenario,
                const SimulatedThings& things,
                Executor& executor,
                EventQueue& queue,
                const VehicleTopics& topics);

  void on_picture(PictureListener listener) { on_picture_ = std::move(listener); }
  /// @pre Before `start`.
  void render(Rendering when) { rendering_ = when; }
  /// The depth images come from this camera, which outlives the drivers; null: they are drawn.
  /// @pre Before `start`.
  void take_depth_from(DepthSource* live) { live_depth_ = live; }

  [[nodiscard]] bool has_gimbal() const { return colour_cameras_.gimbal != nullptr; }

  /// Puts the cameras of `vehicle` on the queue, which outlives the drivers.
  void start(const Vehicle& vehicle);

 private:
  void start_gimbal(const Vehicle& vehicle);
  void take_depth(const Pose& X_WB);
  void take_live_depth();
  void take_colour(const Vehicle& vehicle);
  void publish_colour(const TakenPicture& picture);
  void publish_at(MissionTime at, std::function<void()> publish);

  const Scenario& scenario_;
  const ColourCameras& colour_cameras_;
  Executor& executor_;
  EventQueue& queue_;
  VehicleTopics topics_;
  DepthCamera depth_camera_;
  PictureListener on_picture_{};
  Rendering rendering_{};
  std::unique_ptr<PictureThread> pictures_{};  ///< Null but for `Rendering::as_cameras_do`.
  DepthSource* live_depth_{};
  ClockOffset live_clock_{};
  DepthFrame newest_depth_{};
  std::uint64_t frame_count_{};
  std::uint64_t colour_count_{};
};

}  // namespace flyball
