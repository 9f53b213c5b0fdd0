// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/vehicles/byte_stream.h"

#include "vehicles/serial_stream.h"
#include "vehicles/udp_stream.h"

namespace flyball {

Result<std::unique_ptr<ByteStream>> open_byte_stream(const std::string& address) {
  const std::size_t slashes = address.find("://");
  if (slashes != std::string::npos) {  // As others write it: udp://127.0.0.1:14540.
    return Error{ErrorCode::invalid_input, "\"" + address + "\" is written with \"://\"; write \"" +
                                               address.substr(0, slashes + 1) +
                                               address.substr(slashes + 3) + "\""};
  }
  const std::size_t first = address.find(':');
  const std::size_t last = address.rfind(':');
  if (first != std::string::npos && last > first + 1 && last + 1 < address.size()) {
    const std::string place = address.substr(first + 1, last - first - 1);
    const std::string number = address.substr(last + 1);
    const std::string way = address.substr(0, first);
    if (way == "udp") {
      return open_udp(place, number);
    }
    if (way == "serial") {
      return open_serial(place, number);
    }
  }
  return Error{ErrorCode::invalid_input, "\"" + address +
                                             "\" is no address of an autopilot; write "
                                             "udp:127.0.0.1:14540 or serial:/dev/ttyACM0:921600"};
}

}  // namespace flyball
