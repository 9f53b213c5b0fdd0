// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/scenario/files.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace flyball {
namespace {

namespace fs = std::filesystem;

bool looks_like_path(const std::string& kind, const std::string& text) {
  const std::string ending = fs::path{text}.extension().string();
  const bool is_program = kind == "presets" && (ending == ".lua" || ending == ".so");
  return text.find('/') != std::string::npos || ending == ".toml" || is_program;
}

}  // namespace

std::string share_folder(const std::string& kind) {
  std::error_code failed;
  const fs::path program = fs::read_symlink("/proc/self/exe", failed);
  return (program.parent_path().parent_path() / "share" / "flyball" / kind).string();
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

Result<std::string> find_shipped(const std::string& kind, const std::string& name_or_path) {
  std::error_code failed;
  const bool is_path = looks_like_path(kind, name_or_path);
  const std::string file =
      is_path ? name_or_path : (fs::path{share_folder(kind)} / (name_or_path + ".toml")).string();
  if (!name_or_path.empty() && fs::is_regular_file(file, failed)) {
    return file;
  }
  const bool is_preset =
      kind == "presets";  // People choose a policy; that it has a preset is ours.
  const std::string thing = is_preset ? "policy" : kind.substr(0, kind.size() - 1);
  const std::string list = is_preset ? "policies" : kind;
  const std::string endings = is_preset ? ".toml, .lua or .so" : ".toml";
  return Error{ErrorCode::not_found,
               is_path ? "no file \"" + name_or_path + "\" to read the " + thing +
                             " from; give a path to a " + endings +
                             " file, or a name from: flyball list " + list
                       : "no " + thing + " \"" + name_or_path + "\"; try: flyball list " + list};
}

}  // namespace flyball
