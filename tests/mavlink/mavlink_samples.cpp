// SPDX-License-Identifier: BSD-3-Clause
//
// For check.sh: `mavlink_samples write FILE` flies with both kinds of stand-in autopilot, writes
// all bytes that Flyball sent, and prints "id length crc_extra" of each message that it knows.
// `mavlink_samples read FILE` prints the fields of each message in a file, one line each.

#include "autopilot/offboard_rig.h"
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <type_traits>

namespace {

using namespace flyball;
using namespace std::chrono_literals;

/// Prints each field with the digits that tell floats apart.
struct FieldPrinter {
  template <class T>
  void operator()(const T& field) const {
    std::printf(" %.9g", static_cast<double>(field));
  }
  template <class T, std::size_t n>
  void operator()(const std::array<T, n>& fields) const {
    if constexpr (std::is_same_v<T, char>) {
      std::printf(" %s", mavlink_text(fields).c_str());
    } else {
      for (const T& field : fields) {
        (*this)(field);
      }
    }
  }
};

template <class Message>
void print_if(const MavlinkFrame& frame) {
  if (frame.id == Message::kind.id) {
    std::printf("%u", frame.id);
    mavlink_message<Message>(frame).visit(FieldPrinter{});
    std::printf("%s\n", frame.is_signed ? " signed" : "");
  }
}

int read_file(const char* name) {
  std::ifstream file{name, std::ios::binary};
  const std::vector<char> bytes{std::istreambuf_iterator<char>{file}, {}};
  MavlinkReader reader{kinds_from_autopilot()};
  const auto* first = reinterpret_cast<const std::uint8_t*>(bytes.data());
  for (const MavlinkFrame& frame : reader.read(first, bytes.size())) {
    print_if<MavHeartbeat>(frame);
    print_if<MavSystemStatus>(frame);
    print_if<MavParamValue>(frame);
    print_if<MavAttitudeQuaternion>(frame);
    print_if<MavLocalPosition>(frame);
    print_if<MavCommandAck>(frame);
    print_if<MavExtendedState>(frame);
    print_if<MavStatusText>(frame);
  }
  return reader.counts().skipped_bytes == 0 ? 0 : 1;
}

template <class Message>
void print_kind() {
  const MavlinkKind& kind = Message::kind;
  std::printf("%u %d %d\n", kind.id, int{kind.length}, int{kind.crc_extra});
}

int write_file(const char* name) {
  print_kind<MavHeartbeat>();
  print_kind<MavSystemStatus>();
  print_kind<MavParamRequestRead>();
  print_kind<MavParamValue>();
  print_kind<MavAttitudeQuaternion>();
  print_kind<MavLocalPosition>();
  print_kind<MavCommandLong>();
  print_kind<MavCommandAck>();
  print_kind<MavPositionTarget>();
  print_kind<MavExtendedState>();
  print_kind<MavStatusText>();
  std::ofstream file{name, std::ios::binary};
  for (const AutopilotKind kind : {AutopilotKind::px4, AutopilotKind::ardupilot}) {
    kit::StandInRules rules;
    rules.kind = kind;
    kit::OffboardRig rig{rules};
    if (!rig.connect() || !rig.take_off(2.0)) {
      std::fprintf(stderr, "%s\n", rig.control.failure().c_str());
      return 1;
    }
    rig.fly({1.0, -0.5, 0.0}, 3s);
    if (!rig.land()) {
      return 1;
    }
    file.write(reinterpret_cast<const char*>(rig.sent.data()),
               static_cast<std::streamsize>(rig.sent.size()));
  }
  return file.good() ? 0 : 1;
}

}  // namespace

int main(int count, char** arguments) {
  if (count == 3 && std::strcmp(arguments[1], "write") == 0) {
    return write_file(arguments[2]);
  }
  if (count == 3 && std::strcmp(arguments[1], "read") == 0) {
    return read_file(arguments[2]);
  }
  std::fprintf(stderr, "mavlink_samples write|read FILE\n");
  return 2;
}
