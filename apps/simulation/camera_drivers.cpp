// SPDX-License-Identifier: BSD-3-Clause
// tested-in: closed_loop
#include "simulation/camera_drivers.h"

#include "flyball/flight/perception/perception_nodes.h"

#include <utility>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto live_period = 5ms;  // A fraction of a frame: an image waits so long at most.

}  // namespace

CameraDrivers::CameraDrivers(const Scenario& scenario,
                             const SimulatedThings& things,
                             Executor& executor,
                             EventQueue& queue,
                             const VehicleTopics& topics)
    : scenario_{scenario},
      colour_cameras_{things.cameras},
      executor_{executor},
      queue_{queue},
      topics_{topics},
      depth_camera_{things.world, scenario.camera, scenario.seed} {}

void CameraDrivers::start(const Vehicle& vehicle) {
  if (live_depth_ != nullptr) {
    queue_.every(MissionTime{live_period}, live_period, EventOrder::sensor,
                 [this] { take_live_depth(); });
  } else {
    const Duration frame = from_seconds(1.0 / scenario_.camera.rate_hz);
    queue_.every(MissionTime{frame}, frame, EventOrder::sensor,
                 [this, &vehicle] { take_depth(vehicle.state().X_WB); });
  }
  if (has_gimbal()) {
    start_gimbal(vehicle);
  }
}

void CameraDrivers::start_gimbal(const Vehicle& vehicle) {
  const Duration picture = from_seconds(1.0 / scenario_.colour_camera.rate_hz);
  queue_.every(MissionTime{picture}, picture, EventOrder::sensor, [this, &vehicle] {
    // Behind a depth image of the same moment, which belongs to the picture.
    queue_.schedule(queue_.now(), EventOrder::sensor, [this, &vehicle] { take_colour(vehicle); });
  });
  if (rendering_ == Rendering::as_cameras_do) {
    pictures_ = std::make_unique<PictureThread>();
    const Duration step = from_seconds(scenario_.vehicle.physics_step_s);
    queue_.every(MissionTime{step}, step, EventOrder::sensor, [this] {
      for (const TakenPicture& ready : pictures_->take_ready()) {
        publish_colour(ready);
      }
    });
  }
}

void CameraDrivers::publish_at(MissionTime at, std::function<void()> publish) {
  if (at <= queue_.now()) {
    publish();
  } else {
    queue_.schedule(at, EventOrder::sensor, std::move(publish));
  }
}

void CameraDrivers::take_depth(const Pose& X_WB) {
  const Pose X_WC = camera_pose(X_WB, scenario_.camera);
  const std::uint64_t number = frame_count_++;
  newest_depth_ = depth_camera_.frame(X_WC, queue_.now(), number);
  const DepthFrame& depth = newest_depth_;
  if (rendering_ != Rendering::when_looked_at) {
    (void)depth.image.value();
    for (const SideView& side : depth.sides) {
      (void)side.image.value();
    }
  }
  std::optional<View> view;
  if (topics_.view) {
    const Pose X_LC = level_frame(X_WB).inverse() * X_WC;
    const ColourFrame colour = colour_cameras_.forward->frame({X_WC, X_LC}, queue_.now(), number);
    if (rendering_ != Rendering::when_looked_at) {
      (void)colour.image.value();
    }
    view = View{depth, colour, X_WB.inverse() * X_WC};
  }
  publish_at(queue_.now() + from_seconds(scenario_.camera.delay_s), [this, depth, view] {
    if (view) {
      executor_.publish(*topics_.view, *view);
    }
    executor_.publish(topics_.depth, depth);
  });
}

/// It shows what was there before its way to this computer began.
void CameraDrivers::take_live_depth() {
  live_clock_.note(queue_.now(), live_depth_->now());
  auto reading = live_depth_->take();
  if (!reading) {
    return;
  }
  const MissionTime captured =
      live_clock_.mission(reading->arrived) - from_seconds(scenario_.camera.delay_s);
  if (captured < MissionTime{}) {
    return;
  }
  const std::uint64_t number = frame_count_++;
  const auto pixels = static_cast<int>(reading->depth_m.size());
  newest_depth_ = {
      captured,
      number,
      pixels,
      Deferred<DepthImage>::of({captured, number, scenario_.camera.intrinsics(),
                                scenario_.camera.max_range_m, std::move(reading->depth_m)}),
      {}};
  executor_.publish(topics_.depth, newest_depth_);
}

void CameraDrivers::take_colour(const Vehicle& vehicle) {
  const Pose X_WC = vehicle.camera_pose();
  const Pose X_LC = level_frame(vehicle.state().X_WB).inverse() * X_WC;
  const TakenPicture picture{
      colour_cameras_.gimbal->frame({X_WC, X_LC}, queue_.now(), colour_count_++), newest_depth_};
  if (on_picture_) {
    on_picture_(picture.colour.sequence, X_WC);
  }
  switch (rendering_) {
    case Rendering::as_cameras_do:
      pictures_->draw(picture);
      return;
    case Rendering::at_once:
      (void)picture.colour.image.value();
      break;
    case Rendering::when_looked_at:
      break;
  }
  publish_colour(picture);
}

void CameraDrivers::publish_colour(const TakenPicture& picture) {
  const MissionTime due = picture.colour.captured + from_seconds(scenario_.colour_camera.delay_s);
  publish_at(due, [this, picture] {
    executor_.publish(topics_.colour_depth, picture.depth);
    executor_.publish(topics_.colour, picture.colour);
    executor_.publish(topics_.colour_buffer, picture.colour);
  });
}

}  // namespace flyball
