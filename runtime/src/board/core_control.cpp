// SPDX-License-Identifier: BSD-3-Clause
#include "board/core_control.h"

#include "board/sysfs_text.h"
#include <algorithm>

namespace flyball {
namespace {

std::string switch_of(int core) {
  return "/sys/devices/system/cpu/cpu" + std::to_string(core) + "/online";
}

}  // namespace

CoreControl::CoreControl(LinuxSystem& system,
                         SettingsKeeper& keeper,
                         const std::vector<BoardCore>& cores,
                         const std::vector<int>& order,
                         bool unplugs)
    : system_{system}, keeper_{keeper}, unplugs_{unplugs} {
  for (const int id : order) {
    const auto core = std::find_if(cores.begin(), cores.end(),
                                   [id](const BoardCore& one) { return one.id == id; });
    const bool is_usable =
        core != cores.end() && (core->is_online || (unplugs && core->has_switch));
    if (is_usable) {
      order_.push_back({id, core->is_online, core->has_switch, false});
    }
  }
  for (const Core& core : order_) {
    if (core.is_online) {
      active_.push_back(core.id);
    }
  }
}

bool CoreControl::is_active(int id) const {
  return std::find(active_.begin(), active_.end(), id) != active_.end();
}

Status CoreControl::attach(pid_t thread) {
  threads_.push_back(thread);
  return system_.set_affinity(thread, active_);
}

bool CoreControl::has_changed() {
  bool has = false;
  for (Core& core : order_) {
    const auto now = core.has_switch ? integer_in(system_, switch_of(core.id)) : std::nullopt;
    if (now && (*now != 0) != core.is_online) {
      core.is_online = *now != 0;
      has = true;
    }
  }
  return has;
}

Status CoreControl::write_switch(Core& core, bool on) {
  const std::string path = switch_of(core.id);
  const Status written = keeper_.write(path, on ? "1" : "0");
  const auto now = integer_in(system_, path);
  core.is_online = now ? *now != 0 : core.is_online;
  if (written && core.is_online == on) {
    return Done{};
  }
  core.stays = !on;
  const std::string what = "core " + std::to_string(core.id) +
                           (on ? " does not come on-line" : " stays on-line") +
                           (written ? "" : " (" + written.error().message + ")");
  return Error{ErrorCode::failed,
               what + (on ? "; the others do its work" : "; it is left idle by affinity instead")};
}

std::vector<Error> CoreControl::plug_in(int count) {
  std::vector<Error> errors;
  active_.clear();
  for (Core& core : order_) {
    if (static_cast<int>(active_.size()) >= count) {
      break;
    }
    if (!core.is_online && unplugs_) {
      if (const Status on = write_switch(core, true); !on) {
        errors.push_back(on.error());
      }
    }
    if (core.is_online) {
      active_.push_back(core.id);
    }
  }
  return errors;
}

std::vector<Error> CoreControl::bind() {
  std::vector<Error> errors;
  std::vector<pid_t> living;
  for (const pid_t thread : threads_) {
    const Status bound = system_.set_affinity(thread, active_);
    if (!bound && bound.error().code == ErrorCode::not_found) {
      continue;
    }
    living.push_back(thread);
    if (!bound) {
      errors.push_back(bound.error());
    }
  }
  threads_ = std::move(living);
  return errors;
}

std::vector<Error> CoreControl::unplug_rest(Duration now) {
  constexpr Duration pause = std::chrono::seconds{1};
  std::vector<Error> errors;
  if (!unplugs_ || (unplugged_ && now - *unplugged_ < pause)) {
    return errors;
  }
  for (auto core = order_.rbegin(); core != order_.rend(); ++core) {
    if (is_active(core->id) || !core->is_online || !core->has_switch || core->stays) {
      continue;
    }
    unplugged_ = now;
    if (const Status off = write_switch(*core, false); !off) {
      errors.push_back(off.error());
    }
  }
  return errors;
}

std::vector<int> core_order_of(const std::vector<BoardCore>& cores,
                               const BoardFile& board,
                               bool with_cores_if_asked) {
  std::vector<int> present;
  present.reserve(cores.size());
  for (const BoardCore& core : cores) {
    present.push_back(core.id);
  }
  return cores_in_order(board, present, with_cores_if_asked);
}

}  // namespace flyball
