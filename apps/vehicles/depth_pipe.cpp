// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/file_handle.h"
#include "flyball/vehicles/depth_source.h"

#include "vehicles/pgm_reader.h"
#include <array>
#include <atomic>
#include <cerrno>
#include <limits>
#include <mutex>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto first_within = 15s;  // Chosen: a camera and its driver start in some seconds.
constexpr auto without_image = 1s;  // Chosen: 20 frames of an ordinary camera.
constexpr auto read_wait = 100ms;
constexpr auto no_writer_wait = 10ms;
constexpr int pipe_bytes = 1 << 20;  // As much as anybody may ask for: an image of 640 x 480.

std::vector<float> metres(const PgmImage& image) {
  constexpr float mm = 1e-3F;
  constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
  std::vector<float> depth_m;
  depth_m.reserve(image.values.size());
  for (const std::uint16_t value : image.values) {
    depth_m.push_back(value == 0 ? unknown : mm * static_cast<float>(value));
  }
  return depth_m;
}

std::string size_text(int width_px, int height_px) {
  return std::to_string(width_px) + " x " + std::to_string(height_px) + " pixels";
}

class DepthPipe final : public DepthSource {
 public:
  DepthPipe(std::unique_ptr<FileHandle> pipe, DepthPipeSettings settings)
      : pipe_{std::move(pipe)},
        settings_{std::move(settings)},
        last_{settings_.clock()},
        thread_{[this] { run(); }} {}
  ~DepthPipe() override {
    is_ending_ = true;
    thread_.join();
  }

  Status await(const std::function<bool()>& stop) override {
    const Duration until = now() + first_within;
    while (now() < until) {
      {
        const std::lock_guard lock{mutex_};
        if (newest_ || !failure_.message.empty()) {
          return newest_ ? Status{Done{}} : Status{failure_};
        }
      }
      if (stop && stop()) {
        return Error{ErrorCode::unavailable, "stopped while waiting for the depth camera"};
      }
      std::this_thread::sleep_for(no_writer_wait);
    }
    return Error{ErrorCode::unavailable, "the depth camera has sent no image within 15 s"};
  }

  std::optional<DepthReading> take() override {
    std::optional<DepthReading> taken;
    std::string failure;
    {
      const std::lock_guard lock{mutex_};
      taken = std::exchange(newest_, std::nullopt);
      failure = failure_.message;
    }
    last_ = taken ? taken->arrived : last_;
    tell_silence(failure);
    return taken;
  }

  [[nodiscard]] Duration now() const override { return settings_.clock(); }

 private:
  void tell_silence(const std::string& failure) {
    const bool is_silent = now() - last_ > without_image;
    if (is_silent == is_silent_) {
      return;
    }
    is_silent_ = is_silent;
    if (!is_silent) {
      settings_.tell("the depth camera sends images again");
    } else {
      settings_.tell("the depth camera has sent no image for 1 s" +
                     (failure.empty() ? "" : ": " + failure));
    }
  }

  void run() {
    pthread_setname_np(pthread_self(), "depth-camera");
    while (!is_ending_ && read_on()) {
    }
  }

  /// False once nothing more can come.
  bool read_on() {
    (void)pipe_->wait(read_wait);
    const auto got = ::read(pipe_->number(), room_.data(), room_.size());
    if (got < 0) {
      return errno == EAGAIN || errno == EINTR || fail(system_error("cannot read the pipe", errno));
    }
    if (got == 0) {
      if (has_begun_) {
        return fail({ErrorCode::unavailable, "the depth camera's pipe was closed by its sender"});
      }
      std::this_thread::sleep_for(no_writer_wait);  // Nobody has opened its other end yet.
      return true;
    }
    has_begun_ = true;
    if (const Status read = reader_.read(room_.data(), static_cast<std::size_t>(got)); !read) {
      return fail({read.error().code, "from the depth camera's pipe " + read.error().message});
    }
    const auto image = reader_.take();
    return !image || keep(*image);
  }

  bool keep(const PgmImage& image) {
    if (image.width_px != settings_.width_px || image.height_px != settings_.height_px) {
      return fail({ErrorCode::invalid_input,
                   "the depth camera sends " + size_text(image.width_px, image.height_px) +
                       ", and the scenario says " +
                       size_text(settings_.width_px, settings_.height_px) +
                       "; set camera.width_px and camera.height_px"});
    }
    DepthReading reading{now(), metres(image)};
    const std::lock_guard lock{mutex_};
    newest_ = std::move(reading);
    return true;
  }

  bool fail(Error why) {
    const std::lock_guard lock{mutex_};
    failure_ = std::move(why);
    return false;
  }

  std::unique_ptr<FileHandle> pipe_;
  DepthPipeSettings settings_;
  Duration last_;  ///< When the last image came that was taken.
  bool is_silent_{};

  // Of the thread.
  std::array<std::uint8_t, std::size_t{1} << 16U> room_{};
  PgmReader reader_{};
  bool has_begun_{};

  std::mutex mutex_{};
  std::optional<DepthReading> newest_{};
  Error failure_{ErrorCode::unavailable, {}};  ///< Without a message: none yet.
  std::atomic<bool> is_ending_{false};
  std::thread thread_;
};

}  // namespace

Result<std::unique_ptr<DepthSource>> open_depth_pipe(const std::string& name,
                                                     const DepthPipeSettings& settings) {
  const std::string called = name == "-" ? "standard input" : "\"" + name + "\"";
  // A name of its own, so that reads do not wait here and go on waiting elsewhere.
  const char* const path = name == "-" ? "/proc/self/fd/0" : name.c_str();
  auto pipe = std::make_unique<FileHandle>(::open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  struct stat found {};
  if (!pipe->is_open() || ::fstat(pipe->number(), &found) != 0) {
    return system_error("cannot open " + called, errno);
  }
  if (!S_ISFIFO(found.st_mode)) {
    return Error{ErrorCode::invalid_input,
                 called +
                     " is no pipe; have a program write the camera's images into one, as 16-bit "
                     "PGM in millimetres"};
  }
  (void)::fcntl(pipe->number(), F_SETPIPE_SZ, pipe_bytes);  // Smaller ones only cost wake-ups.
  return std::unique_ptr<DepthSource>{std::make_unique<DepthPipe>(std::move(pipe), settings)};
}

}  // namespace flyball
