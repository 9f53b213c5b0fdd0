// SPDX-License-Identifier: BSD-3-Clause
// tested-in: settings_keeper
#include "board/settings_journal.h"

#include "flyball/runtime/file_handle.h"

#include "board/sysfs_text.h"
#include "board/watchdog.h"
#include <array>
#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace flyball {
namespace {

/// Of a folder that is not to be had.
Error no_folder(const std::string& what, int number) {
  return {ErrorCode::not_found, system_error(what, number).message +
                                    "; run as root, or see: flyball board setup --print"};
}

/// From its beginning, without moving what others append.
std::string content_of(int file) {
  std::string content;
  std::array<char, 4096> part{};
  ssize_t count = 0;
  while ((count = pread(file, part.data(), part.size(), static_cast<off_t>(content.size()))) > 0) {
    content.append(part.data(), static_cast<std::size_t>(count));
  }
  return content;
}

/// `LENGTH NEWLINE TEXT NEWLINE` from `at` on; empty: it is cut off.
std::optional<std::string> next_part(const std::string& text, std::size_t& at) {
  const std::size_t line_end = text.find('\n', at);
  if (line_end == std::string::npos) {
    return std::nullopt;
  }
  const auto length = integer_of(std::string_view{text}.substr(at, line_end - at));
  if (!length || *length < 0) {
    return std::nullopt;
  }
  const std::size_t begin = line_end + 1;
  const auto size = static_cast<std::size_t>(*length);
  if (size >= text.size() || begin + size >= text.size() || text[begin + size] != '\n') {
    return std::nullopt;
  }
  at = begin + size + 1;
  return text.substr(begin, size);
}

std::string part_of(const std::string& text) {
  return std::to_string(text.size()) + "\n" + text + "\n";
}

/// Whatever the mask of whoever made it: in a folder of the group all of its members may have it.
void share_with_group(int file) {
  [[maybe_unused]] const int result = fchmod(file, 0660);  // Only the owner may, and only he needs.
}

void note_owner(int lock) {
  const std::string pid = std::to_string(getpid()) + "\n";
  if (ftruncate(lock, 0) == 0) {
    // Only for the sentence that another process says: nothing depends on it.
    [[maybe_unused]] const ssize_t count = pwrite(lock, pid.data(), pid.size(), 0);
  }
}

/// The settings in whole records.
/// @param end  Where the last whole record ends.
std::vector<KeptSetting> settings_of(const std::string& text, std::size_t& end) {
  std::vector<KeptSetting> kept;
  end = 0;
  for (std::size_t at = 0; at < text.size(); end = at) {
    const auto path = next_part(text, at);
    const auto content = path ? next_part(text, at) : std::nullopt;
    if (!content) {
      break;
    }
    if (is_board_setting(*path)) {
      kept.push_back({*path, *content});
    }
  }
  return kept;
}

/// What is written behind a part of a record could not be read. That record's setting was not
/// written yet.
void remove_cut_record(int journal) {
  const std::string text = content_of(journal);
  std::size_t end = 0;
  (void)settings_of(text, end);
  if (end < text.size()) {
    [[maybe_unused]] const int result = ftruncate(journal, static_cast<off_t>(end));
  }
}

}  // namespace

bool is_board_setting(const std::string& path) {
  return path.rfind(board_settings, 0) == 0 && path.find("/../") == std::string::npos;
}

Result<SettingsJournal> SettingsJournal::lock(const std::string& folder) {
  if (mkdir(folder.c_str(), 0775) != 0 && errno != EEXIST) {
    return no_folder("the folder " + folder + " for the board's lock and journal cannot be made",
                     errno);
  }
  const std::string lock_path = folder + "/board.lock";
  constexpr int flags = O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW;
  const int lock = above_standard(::open(lock_path.c_str(), flags, 0660));
  if (lock < 0) {
    return no_folder("the lock " + lock_path + " cannot be opened", errno);
  }
  if (flock(lock, LOCK_EX | LOCK_NB) != 0) {
    const std::string owner = trimmed(content_of(lock));
    close(lock);
    return Error{ErrorCode::unavailable, "process " + (owner.empty() ? "?" : owner) +
                                             " has this board (" + lock_path +
                                             "), or its settings are just being restored; end it "
                                             "first"};
  }
  const std::string path = folder + "/board.journal";
  const int journal = above_standard(::open(path.c_str(), flags | O_APPEND, 0660));
  if (journal < 0) {
    const Error error = no_folder("the journal " + path + " cannot be opened", errno);
    close(lock);
    return error;
  }
  share_with_group(lock);
  share_with_group(journal);
  note_owner(lock);
  remove_cut_record(journal);
  return SettingsJournal{lock, journal, path};
}

SettingsJournal::SettingsJournal(int lock, int journal, std::string path)
    : lock_{lock}, journal_{journal}, path_{std::move(path)} {}

SettingsJournal::SettingsJournal(SettingsJournal&& other) noexcept
    : lock_{std::exchange(other.lock_, -1)},
      journal_{std::exchange(other.journal_, -1)},
      path_{std::move(other.path_)} {}

SettingsJournal::~SettingsJournal() {
  for (const int file : {lock_, journal_}) {
    if (file >= 0) {
      close(file);
    }
  }
}

std::vector<KeptSetting> SettingsJournal::read() const {
  std::size_t end = 0;
  return settings_of(content_of(journal_), end);
}

Status SettingsJournal::append(const KeptSetting& kept) {
  if (is_broken_) {
    return Error{ErrorCode::failed, "the journal " + path_ + " ends with a part of a record"};
  }
  const std::string record = part_of(kept.path) + part_of(kept.content);
  // One call, so that a kill leaves the whole record or none of it.
  const off_t before = lseek(journal_, 0, SEEK_END);
  const ssize_t count = ::write(journal_, record.data(), record.size());
  if (count != static_cast<ssize_t>(record.size())) {
    const int number = count < 0 ? errno : ENOSPC;
    // A part of it would hide whatever is written behind it.
    is_broken_ = is_broken_ || (count > 0 && ftruncate(journal_, before) != 0);
    return system_error("the journal " + path_ + " cannot be written", number);
  }
  return Done{};
}

// NOLINTNEXTLINE(readability-make-member-function-const): the file behind the descriptor changes
void SettingsJournal::clear() {
  [[maybe_unused]] const int result = ftruncate(journal_, 0);
}

// NOLINTNEXTLINE(readability-make-member-function-const): so does the lock behind this one
void SettingsJournal::unlock() {
  flock(lock_, LOCK_UN);
}

}  // namespace flyball
