// SPDX-License-Identifier: BSD-3-Clause
//
// The module behind `open_pictures`: OpenCV's readers of pictures and video.

#include "flyball/records/pictures.h"

#include <algorithm>
#include <cctype>
#include <exception>
#include <filesystem>
#include <vector>

#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

namespace {

namespace fs = std::filesystem;
using flyball::Picture;

Picture picture_of(const cv::Mat& bgr, const std::string& file, std::uint64_t frame) {
  cv::Mat rgb;
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  Picture picture{file, frame, {}};
  picture.image.sequence = frame;
  picture.image.camera.width_px = rgb.cols;
  picture.image.camera.height_px = rgb.rows;
  picture.image.rgb.assign(rgb.data, rgb.data + 3 * rgb.total());
  return picture;
}

class Files final : public flyball::PictureReader {
 public:
  explicit Files(std::vector<std::string> files) : files_{std::move(files)} {}

  flyball::Result<std::optional<Picture>> next() override {
    if (at_ == files_.size()) {
      return std::optional<Picture>{};
    }
    const std::string& file = files_[at_++];
    try {
      const cv::Mat image = cv::imread(file, cv::IMREAD_COLOR);
      if (!image.empty()) {
        return std::optional{picture_of(image, file, 0)};
      }
    } catch (const std::exception&) {  // Said below.
    }
    return std::optional{Picture{file, 0, {}, "\"" + file + "\" cannot be read as a picture"}};
  }

 private:
  std::vector<std::string> files_;
  std::size_t at_{};
};

class Video final : public flyball::PictureReader {
 public:
  /// With FFmpeg alone: the others that OpenCV could ask look for cameras on the USB bus.
  explicit Video(const std::string& file) : file_{file}, video_{file, cv::CAP_FFMPEG} {}

  [[nodiscard]] bool is_open() const { return video_.isOpened(); }

  flyball::Result<std::optional<Picture>> next() override {
    try {
      cv::Mat image;
      if (!video_.read(image) || image.empty()) {
        return std::optional<Picture>{};
      }
      return std::optional{picture_of(image, file_, frame_++)};
    } catch (const std::exception& error) {
      return flyball::Error{
          flyball::ErrorCode::failed,
          "video \"" + file_ + "\", frame " + std::to_string(frame_) + ": " + error.what()};
    }
  }

 private:
  std::string file_;
  cv::VideoCapture video_;
  std::uint64_t frame_{};
};

/// A file with such a name that cannot be read is a damaged picture; any other is none.
bool is_called_a_picture(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::vector<std::string> endings{".bmp", ".jp2", ".jpeg", ".jpg",  ".pbm", ".pgm",
                                         ".png", ".ppm", ".tif",  ".tiff", ".webp"};
  return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

std::vector<std::string> pictures_in(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator{folder}) {
    std::error_code failed;
    if (entry.is_regular_file(failed) &&
        (is_called_a_picture(entry.path()) || cv::haveImageReader(entry.path().string()))) {
      files.push_back(entry.path().string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::unique_ptr<flyball::PictureReader> open(const std::string& path) {
  if (fs::is_directory(path)) {
    auto files = pictures_in(path);
    return files.empty() ? nullptr : std::make_unique<Files>(std::move(files));
  }
  if (cv::haveImageReader(path)) {
    return std::make_unique<Files>(std::vector<std::string>{path});
  }
  auto video = std::make_unique<Video>(path);
  return video->is_open() ? std::move(video) : nullptr;
}

}  // namespace

/// Null when there is nothing to read; the caller owns the result.
extern "C" flyball::PictureReader* flyball_open_pictures(const char* path) {
  try {
    cv::setNumThreads(1);
    // The caller reports in one sentence what cannot be read.
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    return open(path).release();
  } catch (const std::exception&) {
    return nullptr;
  }
}
