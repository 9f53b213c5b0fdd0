// SPDX-License-Identifier: BSD-3-Clause
// tested-in: recording

#include "recordings/recording_images.h"

#include "flyball/records/pictures.h"

#include "recordings/png_file.h"
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string_view>

namespace flyball {
namespace {

Status check_size(const std::string& file, const PngPixels& image, const CameraModel& camera) {
  if (image.width_px == camera.width_px && image.height_px == camera.height_px) {
    return Done{};
  }
  return Error{ErrorCode::invalid_input, "\"" + file + "\" has " + std::to_string(image.width_px) +
                                             " x " + std::to_string(image.height_px) +
                                             " pixels, but the recording's first image has " +
                                             std::to_string(camera.width_px) + " x " +
                                             std::to_string(camera.height_px)};
}

Status load_depth(const Recording& recording, const std::string& file, VisualFrame& frame) {
  const auto image = read_png(file);
  if (!image) {
    return image.error();
  }
  if (const Status sized = check_size(file, *image, frame.camera); !sized) {
    return sized.error();
  }
  if (image->channels != 1 || image->bits != 16) {
    return Error{ErrorCode::invalid_input, "\"" + file + "\" is no 16-bit grey image, as depth is"};
  }
  frame.depth_m.reserve(image->bytes.size() / 2);
  const auto unit_m = static_cast<float>(1.0 / recording.depth_factor);
  for (std::size_t i = 0; i + 1 < image->bytes.size(); i += 2) {
    const int value = 256 * image->bytes[i] + image->bytes[i + 1];
    frame.depth_m.push_back(value > 0 ? static_cast<float>(value) * unit_m
                                      : std::numeric_limits<float>::infinity());
  }
  return Done{};
}

/// The upper 8 bits; colour weighed as ITU-R BT.601 does.
std::vector<std::uint8_t> grey_of(const PngPixels& image) {
  const auto step = static_cast<std::size_t>(image.bits / 8);
  const auto channels = static_cast<std::size_t>(image.channels);
  std::vector<std::uint8_t> grey;
  grey.reserve(image.bytes.size() / (step * channels));
  for (std::size_t i = 0; i + step * channels <= image.bytes.size(); i += step * channels) {
    const unsigned red = image.bytes[i];
    const unsigned green = channels == 3 ? image.bytes[i + step] : red;
    const unsigned blue = channels == 3 ? image.bytes[i + 2 * step] : red;
    grey.push_back(
        static_cast<std::uint8_t>((299U * red + 587U * green + 114U * blue + 500U) / 1000U));
  }
  return grey;
}

bool begins_with(const std::string& file, std::string_view start) {
  std::error_code failed;
  std::ifstream in{file, std::ios::binary};
  std::string head(start.size(), '\0');
  return std::filesystem::is_regular_file(file, failed) &&
         in.read(head.data(), static_cast<std::streamsize>(head.size())) && head == start;
}

/// A JPEG image that was cut off would be shown grey from there on.
bool is_whole_jpeg(const std::string& file) {
  std::ifstream in{file, std::ios::binary};
  const std::string content{std::istreambuf_iterator<char>{in}, {}};
  constexpr std::size_t trailer = 64;  // Some cameras add a few bytes.
  const std::size_t from = content.size() > trailer ? content.size() - trailer : 0;
  return content.find("\xff\xd9", from) != std::string::npos;
}

/// By what the file begins with: names lie.
Result<PngPixels> read_grey_or_colour(const std::string& file) {
  if (!begins_with(file, "\xff\xd8\xff")) {
    auto image = read_png(file);
    return image ? std::move(image)
                 : Error{ErrorCode::invalid_input,
                         image.error().message + ", and it is no JPEG image either"};
  }
  if (!is_whole_jpeg(file)) {
    return Error{ErrorCode::invalid_input,
                 "cannot read \"" + file + "\": the JPEG image is cut off; copy it again"};
  }
  auto reader = open_pictures(file);
  if (!reader) {
    return reader.error();
  }
  auto picture = (*reader)->next();
  if (!picture) {
    return picture.error();
  }
  if (!*picture || !(**picture).trouble.empty()) {
    return Error{ErrorCode::invalid_input,
                 *picture ? (**picture).trouble : "\"" + file + "\" is no picture"};
  }
  ColourImage& image = (**picture).image;
  return PngPixels{image.camera.width_px, image.camera.height_px, 3, 8, std::move(image.rgb)};
}

}  // namespace

Status size_from_image(Recording& recording) {
  const auto image = read_grey_or_colour(recording.frames.front().grey_file);
  if (!image) {
    return image.error();
  }
  recording.camera.width_px = image->width_px;
  recording.camera.height_px = image->height_px;
  return Done{};
}

Result<VisualFrame> load_frame(const Recording& recording, std::size_t number) {
  const RecordedFrame& source = recording.frames.at(number);
  const auto image = read_grey_or_colour(source.grey_file);
  if (!image) {
    return image.error();
  }
  if (const Status sized = check_size(source.grey_file, *image, recording.camera); !sized) {
    return sized.error();
  }
  VisualFrame frame;
  frame.captured = source.stamp;
  frame.camera = recording.camera;
  frame.X_BC = recording.X_BC;
  frame.grey = grey_of(*image);
  if (!source.depth_file.empty()) {
    if (const Status loaded = load_depth(recording, source.depth_file, frame); !loaded) {
      return loaded.error();
    }
  }
  return frame;
}

}  // namespace flyball
