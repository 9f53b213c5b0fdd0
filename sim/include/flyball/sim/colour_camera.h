// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Colour camera: Embree rays into the true world, with its people, in sunlight.

#include "flyball/runtime/colour_frame.h"
#include "flyball/sim/world.h"

#include <memory>
#include <optional>
#include <string>

namespace flyball {

struct ColourCameraSpec {
  int width_px{384};
  int height_px{288};
  double horizontal_field_rad{1.1344640137963142};  ///< 65 degrees: a usual wide lens.
  double rate_hz{20.0};                             ///< MAVBench: 20-25.
  double delay_s{};             ///< From the moment that a picture shows to its message.
  double sun_azimuth_rad{0.9};  ///< Where it stands, from x towards y.
  double sun_elevation_rad{0.8};
  /// Of the people's meshes: package morse-simulator-data.
  std::string people_folder{"/usr/share/morse/data/robots"};

  [[nodiscard]] Intrinsics intrinsics() const;
};

/// Pose of the camera and where its gimbal held it (see `ColourFrame`).
struct CameraPose {
  Pose X_WC{Pose::Identity()};
  Pose X_LC{Pose::Identity()};
};

/// Fixed instruction set, one thread for one image: the same image on every host of a CPU class.
/// Whoever looks, on whatever thread, a camera renders one image at a time.
class ColourCamera {
 public:
  /// @error `not_found`, `invalid_input`: the mesh of somebody in the world (see `Person::look`).
  [[nodiscard]] static Result<std::unique_ptr<ColourCamera>> make(const World& world,
                                                                  const ColourCameraSpec& spec);
  ~ColourCamera();
  ColourCamera(const ColourCamera&) = delete;
  ColourCamera& operator=(const ColourCamera&) = delete;

  /// The image seen from `X_WC` (C: x right, y down, z forward), with everybody where they are at
  /// `now`. A function of these alone. Pixels look as those of `DepthCamera` do.
  ///
  /// @cost About 20 ms for 384 x 288 pixels on one x86 core.
  [[nodiscard]] ColourImage capture(const Pose& X_WC,
                                    MissionTime now,
                                    std::uint64_t sequence) const;
  /// The same image, rendered when it is read and only as far as it is read: a pixel is the same as
  /// in the whole image. @pre The camera lives until then.
  [[nodiscard]] ColourFrame frame(const CameraPose& pose,
                                  MissionTime now,
                                  std::uint64_t sequence) const;
  [[nodiscard]] const ColourCameraSpec& spec() const;

 private:
  void render(const Pose& X_WC, const std::vector<PixelRegion>& regions, ColourImage& into) const;

  struct Scene;
  explicit ColourCamera(std::unique_ptr<Scene> scene);
  std::unique_ptr<Scene> scene_;
};

/// The box around a person in the image, as the person's upright cylinder projects; empty when it
/// is behind the camera or outside of the image altogether. What is in between is not looked at.
[[nodiscard]] std::optional<ImageBox> box_of(const Person& person,
                                             MissionTime now,
                                             const Pose& X_WC,
                                             const Intrinsics& camera);

}  // namespace flyball
