// SPDX-License-Identifier: BSD-3-Clause
#include "cli/computer/service_notice.h"

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <string>

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace flyball {
namespace {

std::string variable(const char* name) {
  const char* given = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): one thread so far
  return given == nullptr ? "" : given;
}

}  // namespace

struct ServiceNotice::Manager {
  int socket{-1};
  sockaddr_un address{};
  socklen_t address_size{};
  std::chrono::microseconds interval{};  ///< Of the watchdog; 0: there is none.
};

ServiceNotice::ServiceNotice() {
  const std::string name = variable("NOTIFY_SOCKET");
  Manager manager;
  if (name.empty() || name.size() >= sizeof manager.address.sun_path) {
    return;
  }
  manager.address.sun_family = AF_UNIX;
  std::memcpy(static_cast<char*>(manager.address.sun_path), name.data(), name.size());
  if (name.front() == '@') {  // A name that is no file begins with a zero byte.
    manager.address.sun_path[0] = '\0';
  }
  manager.address_size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
  manager.interval =
      std::chrono::microseconds{std::strtoll(variable("WATCHDOG_USEC").c_str(), nullptr, 10)};
  manager.socket = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (manager.socket >= 0) {
    manager_ = std::make_unique<Manager>(manager);
  }
}

ServiceNotice::~ServiceNotice() {
  if (manager_) {
    ::close(manager_->socket);
  }
}

void ServiceNotice::step() {
  if (!manager_) {
    return;
  }
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) {
    return;
  }
  const bool is_first = next_ == std::chrono::steady_clock::time_point{};
  if (is_first) {
    tell("READY=1");
  }
  if (manager_->interval.count() > 0) {
    tell("WATCHDOG=1");
    next_ = now + manager_->interval / 3;
  } else {
    next_ = std::chrono::steady_clock::time_point::max();
  }
}

void ServiceNotice::end() {
  if (manager_ && manager_->interval.count() > 0) {
    // A century: some versions of systemd do not take 0 for "no longer".
    tell("WATCHDOG_USEC=3155760000000000");
    next_ = std::chrono::steady_clock::time_point::max();
  }
}

/// A manager that does not listen any more is not the flight's concern.
void ServiceNotice::tell(const char* what) const {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): as sendto wants it
  const auto* address = reinterpret_cast<const sockaddr*>(&manager_->address);
  (void)::sendto(manager_->socket, what, std::strlen(what), MSG_NOSIGNAL, address,
                 manager_->address_size);
}

}  // namespace flyball
