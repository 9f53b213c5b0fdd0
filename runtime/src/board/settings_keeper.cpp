// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/board/settings_keeper.h"

#include "board/settings_journal.h"
#include "board/sysfs_text.h"
#include "board/watchdog.h"
#include <algorithm>

#include <unistd.h>

namespace flyball {
namespace {

/// A file that cannot be read because its core is off-line holds nothing that could be wrong.
bool holds(const LinuxSystem& system, const KeptSetting& kept, bool was_written) {
  const auto now = system.read(kept.path);
  return now ? *now == kept.content : was_written;
}

/// One of the settings as it is being restored.
struct Pending {
  const KeptSetting* kept{};
  bool is_written{};
  std::string error{};
};

/// Writes those that do not hold what they held; returns whether one more of them was written.
bool restore_once(LinuxSystem& system, std::vector<Pending>& pending) {
  bool made_progress = false;
  for (Pending& one : pending) {
    if (one.is_written || holds(system, *one.kept, false)) {
      made_progress = made_progress || !one.is_written;
      one.is_written = true;
      continue;
    }
    const Status written = system.write(one.kept->path, one.kept->content);
    one.is_written = written.ok();
    one.error = written.ok() ? "" : written.error().message;
    made_progress = made_progress || one.is_written;
  }
  return made_progress;
}

/// Those that were written and hold something else now: the kernel cut the value to a limit that
/// has been restored since. They are written anew.
bool has_lost_some(const LinuxSystem& system, std::vector<Pending>& pending) {
  bool has = false;
  for (Pending& one : pending) {
    if (one.is_written && !holds(system, *one.kept, true)) {
      one.is_written = false;
      has = true;
    }
  }
  return has;
}

bool is_file(const std::string& path, const std::string& name) {
  return path.size() > name.size() &&
         path.compare(path.size() - name.size(), name.size(), name) == 0;
}

/// Limits of a clock, and `scaling_setspeed`, show what is in force, which is less than what was
/// written while heat or the firmware limits the clock too. The kernel keeps what was written and
/// returns to it afterwards, so that there is nothing more to restore.
bool is_limited_further(const LinuxSystem& system, const KeptSetting& kept) {
  const std::string upper = "/scaling_max_freq";
  const std::string lower = "/scaling_min_freq";
  const auto now = clock_in(system, kept.path);
  const auto before = clock_of(trimmed(kept.content));
  if (!now || !before) {
    return false;
  }
  if (is_file(kept.path, upper) || is_file(kept.path, "/scaling_setspeed")) {
    return *now < *before;
  }
  const std::string folder = kept.path.substr(0, kept.path.rfind('/'));
  // A lower limit follows an upper one that comes below it.
  return is_file(kept.path, lower) && (*before < *now || clock_in(system, folder + upper) == now);
}

/// What a setting that could not be restored held, for whoever restores it by hand.
Error not_restored(const Pending& one) {
  const std::string why = one.error.empty() ? one.kept->path + " does not take it" : one.error;
  std::string text = "not restored: " + why + "; it held " +
                     std::to_string(one.kept->content.size()) + " bytes: " + one.kept->content;
  while (!text.empty() && text.back() == '\n') {
    text.pop_back();
  }
  return {ErrorCode::failed, std::move(text)};
}

}  // namespace

std::vector<Error> restore_settings(LinuxSystem& system, const std::vector<KeptSetting>& kept) {
  std::vector<Pending> pending;
  for (auto setting = kept.rbegin(); setting != kept.rend(); ++setting) {
    pending.push_back({&*setting, false, {}});
  }
  const auto is_pending = [](const Pending& one) { return !one.is_written; };
  // In the worst order each pass writes one more file.
  for (std::size_t pass = 0; pass <= 2 * kept.size(); ++pass) {
    const bool made_progress = restore_once(system, pending);
    const bool lost_some = has_lost_some(system, pending);
    const bool is_done = std::none_of(pending.begin(), pending.end(), is_pending);
    if (is_done || (!made_progress && !lost_some)) {
      break;
    }
  }
  std::vector<Error> errors;
  for (const Pending& one : pending) {
    const bool is_accepted = one.error.empty() && is_limited_further(system, *one.kept);
    if (!one.is_written && !is_accepted) {
      errors.push_back(not_restored(one));
    }
  }
  return errors;
}

struct SettingsKeeper::State {
  explicit State(LinuxSystem& of) : system{of} {}

  LinuxSystem& system;
  std::optional<SettingsJournal> journal{};  ///< Empty: it was closed from the beginning.
  std::optional<Watchdog> watchdog{};
  std::vector<KeptSetting> kept{};  ///< As the journal has it.
  std::vector<KeptSetting> seen{};  ///< Not written so far: there is nothing to restore.
  std::optional<Error> closed{};    ///< Why nothing may be written.
  pid_t owner{getpid()};

  Status watch() {
    auto started = Watchdog::start(journal->descriptors(), [this] {
      // The journal and not `kept`: that is a copy from before the first write.
      if (restore_settings(system, journal->read()).empty()) {
        journal->clear();
      }
      journal->unlock();
    });
    if (!started) {
      return started.error();
    }
    watchdog.emplace(std::move(*started));
    return Done{};
  }

  Status keep(const std::string& path) {
    if (!is_board_setting(path)) {
      return Error{ErrorCode::invalid_input,
                   path + " is no setting of a board: only files below " + board_settings + " are"};
    }
    if (find_in(kept, path) != kept.end() || find_in(seen, path) != seen.end()) {
      return Done{};
    }
    const auto content = system.read(path);
    if (!content) {
      return content.error();
    }
    seen.push_back({path, *content});
    return Done{};
  }

  /// Before the first write to a file that has been kept.
  Status enter_in_journal(const std::string& path) {
    const auto setting = find_in(seen, path);
    if (setting == seen.end()) {
      return Done{};  // It is there.
    }
    if (Status appended = journal->append(*setting); !appended) {
      return appended;
    }
    kept.push_back(std::move(*setting));
    seen.erase(setting);
    return Done{};
  }

  static std::vector<KeptSetting>::iterator find_in(std::vector<KeptSetting>& settings,
                                                    const std::string& path) {
    return std::find_if(settings.begin(), settings.end(),
                        [&path](const KeptSetting& setting) { return setting.path == path; });
  }
};

Result<std::unique_ptr<SettingsKeeper>> SettingsKeeper::open(LinuxSystem& system,
                                                             const KeeperOptions& options) {
  auto journal = SettingsJournal::lock(options.run_folder);
  if (!journal) {
    return journal.error();
  }
  const std::vector<KeptSetting> left = journal->read();
  if (!left.empty() && !options.adopt) {
    journal->unlock();
    return Error{ErrorCode::unavailable,
                 "a session that ended has left " + std::to_string(left.size()) +
                     " settings unrestored (" + journal->path() + "), the first of them " +
                     left.front().path + "; try: flyball board restore"};
  }
  if (left.empty()) {
    journal->clear();  // Of a record that was cut off.
  }
  auto state = std::make_unique<State>(system);
  state->journal.emplace(std::move(*journal));
  state->kept = left;
  if (const Status watched = state->watch(); !watched) {
    return watched.error();
  }
  return std::unique_ptr<SettingsKeeper>{new SettingsKeeper{std::move(state)}};
}

std::unique_ptr<SettingsKeeper> SettingsKeeper::closed(LinuxSystem& system, Error why) {
  auto state = std::make_unique<State>(system);
  state->closed = std::move(why);
  return std::unique_ptr<SettingsKeeper>{new SettingsKeeper{std::move(state)}};
}

SettingsKeeper::SettingsKeeper(std::unique_ptr<State> state) : state_{std::move(state)} {}

SettingsKeeper::~SettingsKeeper() {
  if (state_->owner == getpid()) {  // A forked copy must leave the board alone.
    restore();
  }
}

Status SettingsKeeper::keep(const std::string& path) {
  return state_->keep(path);
}

Status SettingsKeeper::write(const std::string& path, const std::string& text) {
  if (const auto& closed = state_->closed) {
    return Error{closed->code, path + " is not written: " + closed->message};
  }
  if (!state_->watchdog->is_alive()) {
    if (const Status watched = state_->watch(); !watched) {
      return Error{ErrorCode::failed, path + " is not written: " + watched.error().message};
    }
  }
  Status kept = state_->keep(path);
  if (kept) {
    kept = state_->enter_in_journal(path);
  }
  if (!kept) {
    return kept;
  }
  return state_->system.write(path, text);
}

std::vector<Error> SettingsKeeper::restore() {
  if (state_->closed) {
    return {};
  }
  state_->closed = Error{ErrorCode::failed, "the settings have been restored"};
  std::vector<Error> errors = restore_settings(state_->system, state_->kept);
  if (errors.empty()) {
    state_->journal->clear();
  }
  state_->watchdog->end();
  state_->journal->unlock();
  return errors;
}

const std::vector<KeptSetting>& SettingsKeeper::kept() const {
  return state_->kept;
}

pid_t SettingsKeeper::watchdog() const {
  return state_->watchdog ? state_->watchdog->process() : 0;
}

}  // namespace flyball
