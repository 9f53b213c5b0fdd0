// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Stands in for the kernel behind a copy of a board's files: refuses limits in the wrong order and
/// clocks without `userspace`, cuts what is too high, and can be told to be read-only, to grant
/// less, to be hot, to lie, or to kill the process at a write. All state is in the files, so that a
/// forked copy sees it too.

#include "flyball/runtime/board/linux_system.h"
#include "flyball/runtime/file_handle.h"

#include "board/sysfs_text.h"
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <unistd.h>

namespace flyball::fake {

class Kernel final : public LinuxSystem {
 public:
  explicit Kernel(const std::string& root) : files_{linux_system(root)} {}

  std::map<std::string, int> refused{};       ///< Ends of paths, and the errno that writing yields.
  std::map<std::string, int> unreadable{};    ///< The same of reading.
  std::map<std::string, std::string> lies{};  ///< What files say whatever they hold.
  long long cap_khz{};                        ///< Clocks above are not granted; 0: all are.
  long long cooled_khz{};                     ///< The limit that heat sets; 0: it is cool.
  std::set<int> staying_cores{};              ///< Take `0` and stay.
  int current_core{};                         ///< That the calling thread runs on.
  int refused_affinity{};                     ///< errno; 0: every mask is taken.
  int die_before{};                           ///< The process's n-th write; 0: never.
  int die_after{};

  std::vector<std::string> writes{};  ///< "FILE=TEXT", the last two parts of the path only.
  std::vector<std::vector<int>> affinities{};

  Result<std::string> read(const std::string& path) const override {
    for (const auto& [end, number] : unreadable) {
      if (ends_in(path, end)) {
        return system_error(path + " cannot be read", number);
      }
    }
    for (const auto& [end, text] : lies) {
      if (ends_in(path, end)) {
        return text;
      }
    }
    if (is_gone(path)) {
      return system_error(path + " cannot be read", ENODEV);
    }
    const auto content = files_->read(path);
    const bool is_clock = cooled_khz > 0 && content && path.find("/scaling_") != std::string::npos;
    const bool is_cut = is_clock && integer_of(trimmed(*content)).value_or(0) > cooled_khz;
    return is_cut ? std::to_string(cooled_khz) + "\n" : content;  // What was written is not shown.
  }

  Status write(const std::string& path, const std::string& text) override {
    ++count_;
    die_if(count_ == die_before);
    writes.push_back(short_path(path) + "=" + trimmed(text));
    const int number = apply(path, trimmed(text));
    die_if(count_ == die_after);
    if (number != 0) {
      return system_error("\"" + trimmed(text) + "\" cannot be written to " + path, number);
    }
    return Done{};
  }

  Status may_write(const std::string& path) const override {
    const int number = refusal_of(path);
    if (number == EACCES || number == EROFS) {
      return system_error(path + " cannot be written", number);
    }
    return files_->may_write(path);
  }
  std::vector<std::string> entries(const std::string& folder) const override {
    return files_->entries(folder);
  }
  Status set_affinity(pid_t thread, const std::vector<int>& cpus) override {
    if (refused_affinity != 0) {
      return system_error("thread " + std::to_string(thread) + " cannot be bound",
                          refused_affinity);
    }
    affinities.push_back(cpus);
    return Done{};
  }
  int current_cpu() const override { return current_core; }

 private:
  static bool ends_in(const std::string& path, const std::string& end) {
    return path.size() >= end.size() &&
           path.compare(path.size() - end.size(), end.size(), end) == 0;
  }
  static std::string short_path(const std::string& path) {
    const std::size_t last = path.rfind('/');
    const std::size_t before = path.rfind('/', last - 1);
    const std::string folder = path.substr(before + 1, last - before - 1);
    // R28's folders have all the same name.
    return (folder == "cpufreq" ? path.substr(path.rfind('/', before - 1) + 1)
                                : path.substr(before + 1));
  }
  void die_if(bool is_time) const {
    if (is_time && getpid() == owner_) {
      kill(owner_, SIGKILL);
    }
  }
  [[nodiscard]] int refusal_of(const std::string& path) const {
    for (const auto& [end, number] : refused) {
      if (ends_in(path, end)) {
        return number;
      }
    }
    return 0;
  }
  [[nodiscard]] long long number(const std::string& path) const {
    const auto text = files_->read(path);
    return text ? integer_of(trimmed(*text)).value_or(-1) : -1;
  }
  int put(const std::string& path, const std::string& text) {
    return files_->write(path, text + "\n").ok() ? 0 : EACCES;
  }
  /// The files of a clock are gone while all its cores are off-line.
  [[nodiscard]] bool is_gone(const std::string& path) const {
    const std::size_t begin = path.find("/scaling_");
    if (begin == std::string::npos) {
      return false;
    }
    const auto cpus = files_->read(path.substr(0, begin) + "/related_cpus");
    const std::vector<int> all = cpu_list_of(cpus ? *cpus : "");
    return std::none_of(all.begin(), all.end(), [this](int id) {
      return number("/sys/devices/system/cpu/cpu" + std::to_string(id) + "/online") != 0;
    });
  }

  int apply(const std::string& path, const std::string& text) {
    if (const int number = refusal_of(path); number != 0) {
      return number;
    }
    if (is_gone(path)) {
      return ENODEV;
    }
    const std::string folder = path.substr(0, path.rfind('/'));
    const std::string file = path.substr(folder.size() + 1);
    if (file == "online") {
      return apply_switch(path, text);
    }
    if (file == "scaling_governor") {
      return apply_governor(folder, text);
    }
    return apply_clock(folder, file, text);
  }

  int apply_switch(const std::string& path, const std::string& text) {
    const std::string name = path.substr(0, path.rfind('/'));
    const int id = number_behind("cpu", name.substr(name.rfind('/') + 1)).value_or(-1);
    return staying_cores.count(id) != 0 ? 0 : put(path, text);
  }

  int apply_governor(const std::string& folder, const std::string& text) {
    const auto all = files_->read(folder + "/scaling_available_governors");
    const std::vector<std::string> known = words_of(all ? *all : "");
    if (std::find(known.begin(), known.end(), text) == known.end()) {
      return EINVAL;
    }
    const bool is_by_hand = text == "userspace";
    put(folder + "/scaling_setspeed",
        is_by_hand ? std::to_string(number(folder + "/scaling_cur_freq")) : "<unsupported>");
    return put(folder + "/scaling_governor", text);
  }

  int apply_clock(const std::string& folder, const std::string& file, const std::string& text) {
    auto khz = integer_of(text).value_or(-1);
    if (khz < 0) {
      return EINVAL;
    }
    khz = std::max(khz, number(folder + "/cpuinfo_min_freq"));
    khz = std::min(khz, number(folder + "/cpuinfo_max_freq"));
    const long long min = number(folder + "/scaling_min_freq");
    const long long max = number(folder + "/scaling_max_freq");
    if ((file == "scaling_min_freq" && khz > max) || (file == "scaling_max_freq" && khz < min)) {
      return EINVAL;
    }
    const auto governor = files_->read(folder + "/scaling_governor");
    if (file == "scaling_setspeed") {
      if (!governor || trimmed(*governor) != "userspace") {
        return EINVAL;
      }
      khz = std::clamp(khz, min, max);
    }
    const int result = put(folder + "/" + file, std::to_string(khz));
    if (file == "scaling_setspeed" || khz == number(folder + "/scaling_min_freq")) {
      const long long granted = cap_khz > 0 ? std::min(cap_khz, khz) : khz;
      put(folder + "/scaling_cur_freq", std::to_string(granted));
    }
    return result;
  }

  std::unique_ptr<LinuxSystem> files_;
  int count_{};
  pid_t owner_{getpid()};
};

}  // namespace flyball::fake
