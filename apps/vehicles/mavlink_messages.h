// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The messages that are exchanged with an autopilot, after MAVLink's common.xml. Each says its id,
/// length and CRC extra, and names its fields in the order in which they are sent. Fields without
/// use here are called `unused`.

#include "vehicles/mavlink_frame.h"
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace flyball {

/// Writes fields, little end first.
class MavlinkFieldWriter {
 public:
  template <class T>
  void operator()(const T& field) {
    if constexpr (std::is_floating_point_v<T>) {
      static_assert(sizeof(T) == sizeof(std::uint32_t), "MAVLink's messages here have floats only");
      std::uint32_t bits{};
      std::memcpy(&bits, &field, sizeof bits);
      (*this)(bits);
    } else {
      const auto bits = static_cast<std::make_unsigned_t<T>>(field);
      for (std::size_t i = 0; i < sizeof(T); ++i) {
        bytes.push_back(static_cast<std::uint8_t>((std::uint64_t{bits} >> (8U * i)) & 0xffU));
      }
    }
  }
  template <class T, std::size_t n>
  void operator()(const std::array<T, n>& fields) {
    for (const T& field : fields) {
      (*this)(field);
    }
  }
  std::vector<std::uint8_t> bytes{};
};

/// Reads them.
class MavlinkFieldReader {
 public:
  explicit MavlinkFieldReader(const std::uint8_t* bytes) : next_{bytes} {}
  template <class T>
  void operator()(T& field) {
    if constexpr (std::is_floating_point_v<T>) {
      std::uint32_t bits{};
      (*this)(bits);
      std::memcpy(&field, &bits, sizeof bits);
    } else {
      std::uint64_t bits{};
      for (std::size_t i = 0; i < sizeof(T); ++i) {
        bits |= std::uint64_t{*next_++} << (8U * i);
      }
      field = static_cast<T>(bits);
    }
  }
  template <class T, std::size_t n>
  void operator()(std::array<T, n>& fields) {
    for (T& field : fields) {
      (*this)(field);
    }
  }

 private:
  const std::uint8_t* next_;
};

constexpr std::uint16_t mav_unknown_voltage = 0xffff;

struct MavHeartbeat {
  static constexpr MavlinkKind kind{0, 9, 50};
  std::uint32_t custom_mode{};
  std::uint8_t type{};
  std::uint8_t autopilot{};
  std::uint8_t base_mode{};
  std::uint8_t system_status{};
  std::uint8_t mavlink_version{3};  ///< Of the dialect; the standard says that it is sent as 3.
  template <class Fields>
  void visit(Fields&& field) {
    field(custom_mode), field(type), field(autopilot), field(base_mode), field(system_status);
    field(mavlink_version);
  }
};

/// Newer ones carry more sensors behind this, which nobody here looks at.
struct MavSystemStatus {
  static constexpr MavlinkKind kind{1, 31, 124};
  std::array<std::uint32_t, 3> unused_sensors{};
  std::uint16_t unused_load{};
  std::uint16_t battery_mv{mav_unknown_voltage};
  std::int16_t battery_ca{-1};  ///< Hundredths of amperes; -1: not measured.
  std::array<std::uint16_t, 6> unused_errors{};
  std::int8_t battery_percent{-1};  ///< -1: not known.
  template <class Fields>
  void visit(Fields&& field) {
    field(unused_sensors), field(unused_load), field(battery_mv), field(battery_ca);
    field(unused_errors), field(battery_percent);
  }
};

struct MavParamRequestRead {
  static constexpr MavlinkKind kind{20, 20, 214};
  std::int16_t index{-1};  ///< The name counts.
  std::uint8_t target_system{};
  std::uint8_t target_component{};
  std::array<char, 16> name{};
  template <class Fields>
  void visit(Fields&& field) {
    field(index), field(target_system), field(target_component), field(name);
  }
};

struct MavParamValue {
  static constexpr MavlinkKind kind{22, 25, 220};
  float value{};
  std::uint16_t count{};
  std::uint16_t index{};
  std::array<char, 16> name{};
  std::uint8_t type{};
  template <class Fields>
  void visit(Fields&& field) {
    field(value), field(count), field(index), field(name), field(type);
  }
};

/// Attitude of forward-right-down in north-east-down.
struct MavAttitudeQuaternion {
  static constexpr MavlinkKind kind{31, 48, 246};
  std::uint32_t time_boot_ms{};
  std::array<float, 4> q{};              ///< w, x, y, z
  std::array<float, 3> rates_rad_s{};    ///< About forward, right, down.
  std::array<float, 4> unused_offset{};  ///< For vehicles that sit on their tail.
  template <class Fields>
  void visit(Fields&& field) {
    field(time_boot_ms), field(q), field(rates_rad_s), field(unused_offset);
  }
};

struct MavLocalPosition {
  static constexpr MavlinkKind kind{32, 28, 185};
  std::uint32_t time_boot_ms{};
  std::array<float, 3> p_m{};    ///< North, east, down from the autopilot's own origin.
  std::array<float, 3> v_m_s{};  ///< North, east, down.
  template <class Fields>
  void visit(Fields&& field) {
    field(time_boot_ms), field(p_m), field(v_m_s);
  }
};

struct MavCommandLong {
  static constexpr MavlinkKind kind{76, 33, 152};
  std::array<float, 7> parameters{};
  std::uint16_t command{};
  std::uint8_t target_system{};
  std::uint8_t target_component{};
  std::uint8_t confirmation{};  ///< 0 at first; each repetition counts on.
  template <class Fields>
  void visit(Fields&& field) {
    field(parameters), field(command), field(target_system), field(target_component);
    field(confirmation);
  }
};

struct MavCommandAck {
  static constexpr MavlinkKind kind{77, 10, 143};
  std::uint16_t command{};
  std::uint8_t result{};
  std::uint8_t unused_progress{};
  std::int32_t unused_detail{};
  std::uint8_t target_system{};  ///< 0, as senders of MAVLink 1 leave it: everybody.
  std::uint8_t target_component{};
  template <class Fields>
  void visit(Fields&& field) {
    field(command), field(result), field(unused_progress), field(unused_detail);
    field(target_system), field(target_component);
  }
};

struct MavPositionTarget {
  static constexpr MavlinkKind kind{84, 53, 143};
  std::uint32_t time_boot_ms{};
  std::array<float, 3> p_m{};  ///< North, east, down, as all three.
  std::array<float, 3> v_m_s{};
  std::array<float, 3> a_m_s2{};
  float yaw_rad{};  ///< From north, clockwise.
  float yaw_rate_rad_s{};
  std::uint16_t type_mask{};  ///< Which of them do not count.
  std::uint8_t target_system{};
  std::uint8_t target_component{};
  std::uint8_t frame{1};  ///< MAV_FRAME_LOCAL_NED
  template <class Fields>
  void visit(Fields&& field) {
    field(time_boot_ms), field(p_m), field(v_m_s), field(a_m_s2), field(yaw_rad);
    field(yaw_rate_rad_s), field(type_mask), field(target_system), field(target_component);
    field(frame);
  }
};

struct MavExtendedState {
  static constexpr MavlinkKind kind{245, 2, 130};
  std::uint8_t unused_vtol_state{};
  std::uint8_t landed_state{};
  template <class Fields>
  void visit(Fields&& field) {
    field(unused_vtol_state), field(landed_state);
  }
};

struct MavStatusText {
  static constexpr MavlinkKind kind{253, 54, 83};
  std::uint8_t severity{};
  std::array<char, 50> text{};  ///< Without a zero where it has 50 letters.
  std::uint16_t id{};           ///< Not 0: one of several pieces of a longer text.
  std::uint8_t piece{};
  template <class Fields>
  void visit(Fields&& field) {
    field(severity), field(text), field(id), field(piece);
  }
};

/// Numbers of common.xml that are used here.
namespace mav {
constexpr std::uint8_t autopilot_ardupilot = 3;
constexpr std::uint8_t autopilot_none = 8;
constexpr std::uint8_t autopilot_px4 = 12;
constexpr std::uint8_t type_onboard_controller = 18;
constexpr std::uint8_t component_autopilot = 1;
constexpr std::uint8_t component_onboard_computer = 191;
constexpr std::uint8_t state_active = 4;
constexpr std::uint8_t flag_armed = 128;
constexpr std::uint16_t command_land = 21;
constexpr std::uint16_t command_take_off = 22;
constexpr std::uint16_t command_set_mode = 176;
constexpr std::uint16_t command_arm = 400;
constexpr std::uint16_t command_message_interval = 511;
constexpr std::uint8_t result_accepted = 0;
constexpr std::uint8_t result_try_later = 1;  ///< MAV_RESULT_TEMPORARILY_REJECTED
constexpr std::uint8_t result_in_progress = 5;
constexpr std::uint8_t landed_on_ground = 1;
constexpr std::uint8_t severity_warning = 4;  ///< Smaller ones are worse.
constexpr std::uint16_t ignore_yaw_rate = 0x800;
}  // namespace mav

/// The payload of a message.
template <class Message>
[[nodiscard]] std::vector<std::uint8_t> mavlink_payload(Message message) {
  MavlinkFieldWriter writer;
  message.visit(writer);
  return writer.bytes;
}

/// @pre The frame has the kind of `Message`.
template <class Message>
[[nodiscard]] Message mavlink_message(const MavlinkFrame& frame) {
  Message message;
  message.visit(MavlinkFieldReader{frame.payload.data()});
  return message;
}

/// Up to the first zero, or all of it.
template <std::size_t n>
[[nodiscard]] std::string mavlink_text(const std::array<char, n>& field) {
  std::size_t length = 0;
  while (length < n && field[length] != '\0') {
    ++length;
  }
  return {field.data(), length};
}

/// "DENIED" and the like: MAV_RESULT without its prefix, or the number where the standard has no
/// name for it.
[[nodiscard]] std::string mavlink_result_name(std::uint8_t result);

/// What an autopilot sends that is listened to.
[[nodiscard]] std::vector<MavlinkKind> kinds_from_autopilot();

}  // namespace flyball
