// SPDX-License-Identifier: BSD-3-Clause
// tested-in: byte_stream
#include "vehicles/serial_stream.h"

#include "flyball/runtime/file_handle.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

namespace flyball {
namespace {

constexpr std::size_t room_bytes = 4096;  // More than a line carries between two calls.

constexpr std::array<std::pair<const char*, speed_t>, 8> speeds{{{"57600", B57600},
                                                                 {"115200", B115200},
                                                                 {"230400", B230400},
                                                                 {"460800", B460800},
                                                                 {"921600", B921600},
                                                                 {"1000000", B1000000},
                                                                 {"1500000", B1500000},
                                                                 {"3000000", B3000000}}};

/// Bytes as they are: no echo, no line ends, no flow control by characters.
bool set_raw(int line, speed_t speed) {
  termios settings{};
  if (tcgetattr(line, &settings) != 0) {
    return false;
  }
  cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~static_cast<tcflag_t>(CRTSCTS | CSTOPB);
  settings.c_cc[VMIN] = 1;  // So that reading no byte means that the line has hung up.
  settings.c_cc[VTIME] = 0;
  return cfsetspeed(&settings, speed) == 0 && tcsetattr(line, TCSANOW, &settings) == 0;
}

Result<std::unique_ptr<FileHandle>> open_line(const std::string& device, speed_t speed) {
  auto line = std::make_unique<FileHandle>(
      open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (!line->is_open()) {
    return system_error("cannot open " + device, errno);
  }
  if (!set_raw(line->number(), speed)) {
    return system_error(device + " is no serial line", errno);
  }
  (void)ioctl(line->number(), TIOCEXCL);  // Where it fails, somebody else may open it as well.
  return line;
}

class SerialStream final : public ByteStream {
 public:
  SerialStream(std::unique_ptr<FileHandle> line, std::string device, speed_t speed)
      : line_{std::move(line)}, device_{std::move(device)}, speed_{speed} {}

  /// Of a message that is half sent the rest goes first; new ones are lost while it waits.
  Status send(const std::vector<std::uint8_t>& bytes) override {
    if (!line_->is_open()) {
      return Error{ErrorCode::unavailable, device_ + " has hung up"};
    }
    if (rest_.empty()) {
      rest_ = bytes;
    }
    const auto sent = rest_.empty() ? 0 : write(line_->number(), rest_.data(), rest_.size());
    if (sent < 0) {
      return is_passing(errno) ? Status{Done{}}
                               : give_up(system_error("cannot write to " + device_, errno).message);
    }
    rest_.erase(rest_.begin(), rest_.begin() + sent);
    return Done{};
  }

  Status receive(std::vector<std::uint8_t>& bytes) override {
    if (!line_->is_open()) {
      auto line = open_line(device_, speed_);
      if (!line) {
        return Error{ErrorCode::unavailable, line.error().message};
      }
      line_ = std::move(*line);
    }
    std::array<std::uint8_t, room_bytes> room{};
    const auto got = read(line_->number(), room.data(), room.size());
    if (got == 0) {
      return give_up(device_ + " has hung up; is its cable loose?");
    }
    if (got < 0) {
      return is_passing(errno)
                 ? Status{Done{}}
                 : give_up(system_error("cannot read from " + device_, errno).message);
    }
    bytes.insert(bytes.end(), room.begin(), room.begin() + got);
    return Done{};
  }

  Duration wait(Duration at_most) override { return line_->wait(at_most); }

 private:
  static bool is_passing(int error) { return error == EAGAIN || error == EINTR; }

  /// A descriptor that has hung up never works again, and as long as it is open its device comes
  /// back under another number.
  Status give_up(std::string why) {
    line_ = std::make_unique<FileHandle>(-1);
    rest_.clear();
    return Error{ErrorCode::unavailable, std::move(why)};
  }

  std::unique_ptr<FileHandle> line_;  ///< Not open while the device is gone.
  std::string device_;
  speed_t speed_;
  std::vector<std::uint8_t> rest_{};
};

}  // namespace

Result<std::unique_ptr<ByteStream>> open_serial(const std::string& device,
                                                const std::string& baud) {
  const auto* const speed = std::find_if(speeds.begin(), speeds.end(),
                                         [&baud](const auto& one) { return baud == one.first; });
  if (speed == speeds.end()) {
    std::string known;
    for (const auto& one : speeds) {
      known += (known.empty() ? "" : ", ") + std::string{one.first};
    }
    return Error{ErrorCode::invalid_input,
                 "\"" + baud + "\" is no speed of a serial line; there are: " + known};
  }
  auto line = open_line(device, speed->second);
  if (!line) {
    return line.error();
  }
  return std::unique_ptr<ByteStream>{
      std::make_unique<SerialStream>(std::move(*line), device, speed->second)};
}

}  // namespace flyball
