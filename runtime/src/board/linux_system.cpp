// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/board/linux_system.h"

#include "flyball/runtime/file_handle.h"

#include <algorithm>
#include <array>
#include <cerrno>

#include <dirent.h>
#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

namespace flyball {
namespace {

constexpr std::size_t longest_file = 65536;

class RootedSystem final : public LinuxSystem {
 public:
  explicit RootedSystem(std::string root) : root_{std::move(root)} {
    while (!root_.empty() && root_.back() == '/') {
      root_.pop_back();
    }
  }

  Result<std::string> read(const std::string& path) const override {
    // A pipe in a copy of a system must not make its reader wait.
    const FileHandle file{open((root_ + path).c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
    if (!file.is_open()) {
      return system_error(path + " cannot be read", errno);
    }
    std::string content;
    std::array<char, 4096> part{};
    ssize_t count = 0;
    while (content.size() < longest_file &&
           (count = ::read(file.number(), part.data(), part.size())) > 0) {
      content.append(part.data(), static_cast<std::size_t>(count));
    }
    if (count < 0) {
      return system_error(path + " cannot be read", errno);
    }
    return content;
  }

  Status write(const std::string& path, const std::string& text) override {
    const FileHandle file{
        open((root_ + path).c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC | O_NONBLOCK)};
    if (!file.is_open()) {
      return system_error(path + " cannot be written", errno);
    }
    // One call: the kernel takes each call as a value of its own.
    const ssize_t count = ::write(file.number(), text.data(), text.size());
    if (count != static_cast<ssize_t>(text.size())) {
      return system_error("\"" + text + "\" cannot be written to " + path, count < 0 ? errno : EIO);
    }
    return Done{};
  }

  [[nodiscard]] Status may_write(const std::string& path) const override {
    if (access((root_ + path).c_str(), W_OK) != 0) {
      return system_error(path + " cannot be written", errno);
    }
    return Done{};
  }

  [[nodiscard]] std::vector<std::string> entries(const std::string& folder) const override {
    std::vector<std::string> names;
    DIR* open_folder = opendir((root_ + folder).c_str());
    if (open_folder == nullptr) {
      return names;
    }
    // NOLINTNEXTLINE(concurrency-mt-unsafe): no other thread reads this folder's stream
    while (const dirent* entry = readdir(open_folder)) {
      if (entry->d_name[0] != '.') {
        names.emplace_back(static_cast<const char*>(entry->d_name));
      }
    }
    closedir(open_folder);
    std::sort(names.begin(), names.end());
    return names;
  }

  Status set_affinity(pid_t thread, const std::vector<int>& cpus) override {
    const std::string what = "thread " + std::to_string(thread) + " cannot be bound to " +
                             std::to_string(cpus.size()) + (cpus.size() == 1 ? " core" : " cores");
    cpu_set_t wanted;
    CPU_ZERO(&wanted);
    for (const int cpu : cpus) {
      if (cpu >= 0 && cpu < CPU_SETSIZE) {
        CPU_SET(cpu, &wanted);
      }
    }
    if (sched_setaffinity(thread, sizeof wanted, &wanted) != 0) {
      return system_error(what, errno);
    }
    cpu_set_t granted;
    CPU_ZERO(&granted);
    if (sched_getaffinity(thread, sizeof granted, &granted) != 0) {
      return system_error(what, errno);
    }
    if (CPU_EQUAL(&wanted, &granted) == 0) {
      return Error{ErrorCode::failed,
                   what + ": the system grants " + std::to_string(CPU_COUNT(&granted)) +
                       "; look at the process's cpuset and at the cores that are on-line"};
    }
    return Done{};
  }

  [[nodiscard]] int current_cpu() const override { return sched_getcpu(); }

 private:
  std::string root_;
};

}  // namespace

std::unique_ptr<LinuxSystem> linux_system(const std::string& root) {
  return std::make_unique<RootedSystem>(root);
}

}  // namespace flyball
