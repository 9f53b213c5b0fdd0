// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/scenario/files.h"

#include "flyball/runtime/program.h"

#include "scenario/scenario_keys.h"
#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include <unistd.h>

namespace flyball {
namespace {

namespace fs = std::filesystem;

/// Those that may hold what is shipped, in the order in which they are asked.
std::vector<fs::path> data_folders() {
  // Read before any thread is started.
  const char* given = std::getenv("FLYBALL_DATA");  // NOLINT(concurrency-mt-unsafe)
  if (given != nullptr && *given != '\0') {
    return {fs::path{given}};  // A path that is given excludes any other file.
  }
  const fs::path program = program_file();
  return {program.parent_path().parent_path() / "share" / "flyball", fs::path{FLYBALL_DATA_FOLDER}};
}

/// Why nothing that is shipped can be found by its name.
Error no_data(const std::string& thing, const std::string& name, const std::string& folder) {
  return {ErrorCode::not_found, "no " + thing + " \"" + name + "\", because there is no folder \"" +
                                    folder +
                                    "\"; set FLYBALL_DATA to the folder share/flyball of the "
                                    "install, or of the build"};
}

/// Of a file that is there and cannot be read; empty: it can, or there is none.
std::optional<Error> unreadable(const std::string& file) {
  std::error_code failed;
  int reason = fs::is_directory(file, failed) ? EISDIR : 0;
  if (reason == 0 && access(file.c_str(), R_OK) != 0) {
    reason = errno == ENOENT || errno == ENOTDIR ? 0 : errno;
  }
  if (reason == 0) {
    return std::nullopt;
  }
  return Error{ErrorCode::unavailable, "cannot read \"" + file +
                                           "\": " + std::generic_category().message(reason) +
                                           "; give a file that you may read"};
}

}  // namespace

std::string share_folder(const std::string& kind) {
  std::error_code failed;
  const std::vector<fs::path> folders = data_folders();
  for (const fs::path& folder : folders) {
    if (fs::is_directory(folder / kind, failed)) {
      return (folder / kind).string();
    }
  }
  return (folders.front() / kind).string();
}

std::vector<std::string> shipped(const std::string& kind) {
  std::vector<std::string> names;
  std::error_code failed;
  fs::directory_iterator entry{share_folder(kind), failed};
  // A loop by hand: the range-based one throws when the folder changes meanwhile.
  for (; !failed && entry != fs::directory_iterator{}; entry.increment(failed)) {
    if (entry->path().extension() == ".toml") {
      names.push_back(entry->path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

bool looks_like_path(const std::string& kind, const std::string& text) {
  const std::string ending = fs::path{text}.extension().string();
  const bool is_program = kind == "presets" && (ending == ".lua" || ending == ".so");
  return text.find('/') != std::string::npos || ending == ".toml" || is_program;
}

Result<std::string> find_shipped(const std::string& kind, const std::string& name_or_path) {
  std::error_code failed;
  const bool is_path = looks_like_path(kind, name_or_path);
  const std::string file =
      is_path ? name_or_path : (fs::path{share_folder(kind)} / (name_or_path + ".toml")).string();
  if (std::optional<Error> error = name_or_path.empty() ? std::nullopt : unreadable(file)) {
    return std::move(*error);
  }
  if (!name_or_path.empty() && fs::is_regular_file(file, failed)) {
    return file;
  }
  const bool is_preset =
      kind == "presets";  // People choose a policy; that it has a preset is ours.
  const std::string thing = is_preset ? "policy" : kind.substr(0, kind.size() - 1);
  const std::string list = is_preset ? "policies" : kind;
  if (const std::string folder = share_folder(kind);
      !is_path && !fs::is_directory(folder, failed)) {
    return no_data(thing, name_or_path, folder);
  }
  const std::string endings = is_preset ? ".toml, .lua or .so" : ".toml";
  return Error{ErrorCode::not_found, is_path ? "no file \"" + name_or_path + "\" to read the " +
                                                   thing + " from; give a path to a " + endings +
                                                   " file, or a name from: flyball list " + list
                                             : "no " + thing + " \"" + name_or_path + "\"; " +
                                                   name_meant(name_or_path, shipped(kind)) +
                                                   "try: flyball list " + list};
}

}  // namespace flyball
