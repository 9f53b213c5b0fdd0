// SPDX-License-Identifier: BSD-3-Clause

#include "claimed_folder.h"

#include "flyball/records/report.h"

#include "console.h"
#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace flyball {
namespace {

/// On a file system without locks no process waits for another one. A signal ends a process that
/// waits: it has nothing to keep, and one that is only remembered might come just before the wait.
/// @return False where a signal came before.
bool lock(int folder, const std::string& path) {
  if (flock(folder, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) {
    return true;
  }
  const bool was_caught = release_interrupt();
  if (was_interrupted()) {
    return false;
  }
  note("another flyball flies into \"" + path + "\"; waiting until it has finished");
  while (flock(folder, LOCK_EX) != 0 && errno == EINTR) {
  }
  if (was_caught) {
    catch_interrupt();
  }
  return true;
}

/// The process that had the folder before may have removed it.
bool is_still_there(int folder, const std::string& path) {
  struct stat held {};
  struct stat named {};
  return fstat(folder, &held) == 0 && stat(path.c_str(), &named) == 0 &&
         held.st_ino == named.st_ino && held.st_dev == named.st_dev;
}

}  // namespace

Result<ClaimedFolder> ClaimedFolder::claim(const std::string& path) {
  while (true) {
    auto made = prepare_folder(path);
    if (!made) {
      return made.error();
    }
    const int folder = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0 && errno == ENOENT) {
      continue;  // The process that had it before has removed it since.
    }
    ClaimedFolder claimed{folder, std::move(*made)};
    if (folder >= 0 && !lock(folder, path)) {
      return Error{ErrorCode::unavailable,
                   "interrupted while another flyball flew into \"" + path + "\"; nothing flew"};
    }
    if (folder < 0 || is_still_there(folder, path)) {  // One that cannot be read can be written.
      return claimed;
    }
  }
}

ClaimedFolder::ClaimedFolder(int descriptor, std::vector<std::string> made)
    : descriptor_{descriptor}, made_{std::move(made)} {}

ClaimedFolder::ClaimedFolder(ClaimedFolder&& other) noexcept
    : descriptor_{std::exchange(other.descriptor_, -1)}, made_{std::move(other.made_)} {}

ClaimedFolder::~ClaimedFolder() {
  if (descriptor_ >= 0) {
    close(descriptor_);
  }
}

}  // namespace flyball
