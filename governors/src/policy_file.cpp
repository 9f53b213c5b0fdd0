// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/policy_file.h"

#include "flyball/governors/preset.h"

#include "libraries/isolated_policy.h"
#include "libraries/library_policy.h"
#include "scripts/lua_policy.h"
#include <filesystem>
#include <utility>

namespace flyball {
namespace {

namespace fs = std::filesystem;

enum class Kind : std::uint8_t { none, preset, script, library };

Kind kind_of(const std::string& text) {
  const std::string ending = fs::path{text}.extension().string();
  return ending == ".toml"  ? Kind::preset
         : ending == ".lua" ? Kind::script
         : ending == ".so"  ? Kind::library
                            : Kind::none;
}

/// Where the file lies that a preset names; empty: it names a policy.
std::string file_named_in(const std::string& preset_path, const Preset& preset) {
  if (kind_of(preset.policy) == Kind::none) {
    return {};
  }
  return (fs::path{preset_path}.parent_path() / preset.policy).lexically_normal().string();
}

Result<PolicyChoice> load_script(const std::string& path, std::uint64_t seed) {
  if (const auto tried = open_lua_policy(path, seed); !tried) {
    return tried.error();
  }
  return PolicyChoice{path, [path, seed] { return open_lua_policy(path, seed); }};
}

Result<PolicyChoice> load_library(const std::string& path, std::uint64_t seed) {
  const PolicyMaker make = [path, seed] { return LibraryPolicy::open(path, seed); };
  const IsolationLimits limits;
  auto declaration = declaration_of(make, limits);
  if (!declaration) {
    const Error& error = declaration.error();
    const bool is_named = error.message.find(path) != std::string::npos;
    return Error{error.code, is_named ? error.message : path + ": " + error.message};
  }
  PolicyChoice choice;
  choice.name = path;
  if (!declaration->is_confined) {
    choice.caution = path +
                     ": this kernel has no seccomp filters, so nothing keeps this library from "
                     "files and the network; run it only if you trust it";
  }
  choice.make = [path, make, limits, declared = std::move(*declaration)] {
    return Result<std::unique_ptr<Policy>>{
        std::make_unique<IsolatedPolicy>(path, make, declared, limits)};
  };
  return choice;
}

Result<PolicyChoice> load_named(const std::string& path,
                                const Preset& preset,
                                const Registry& known) {
  if (preset.is_combination()) {
    return Error{ErrorCode::invalid_input, path + ": is a combination; name one policy here"};
  }
  if (known.make<Policy>(preset.policy) == nullptr) {
    return Error{ErrorCode::not_found,
                 path + ": no policy \"" + preset.policy + "\"; try: flyball list policies"};
  }
  return PolicyChoice{"policy \"" + preset.policy + "\"", [&known, name = preset.policy] {
                        return Result<std::unique_ptr<Policy>>{known.make<Policy>(name)};
                      }};
}

Result<PolicyChoice> load_one(const std::string& path, std::uint64_t seed) {
  switch (kind_of(path)) {
    case Kind::script:
      return load_script(path, seed);
    case Kind::library:
      return load_library(path, seed);
    case Kind::preset:
    case Kind::none:
      break;
  }
  return Error{ErrorCode::invalid_input,
               "\"" + path + "\" is no policy: a file that ends in .lua or .so is needed here"};
}

}  // namespace

Result<std::unique_ptr<Policy>> PolicyChoice::started(const KnobSettings& knobs,
                                                      const BoardModel& board) const {
  auto policy = make();
  if (!policy) {
    return policy;
  }
  auto given = Parameters::resolve(name, (*policy)->parameters(), parameters);
  if (const auto* errors = std::get_if<std::vector<Error>>(&given)) {
    Error all{ErrorCode::invalid_input, ""};
    for (const Error& error : *errors) {
      all.message += (all.message.empty() ? "" : "\n") + error.message;
    }
    return all;
  }
  if (const Status started = (*policy)->start(std::get<Parameters>(given), knobs, board);
      !started) {
    return started.error();
  }
  return policy;
}

bool is_policy_file(const std::string& text) {
  return kind_of(text) != Kind::none;
}

Result<PolicyChoice> load_policy(const std::string& path,
                                 const Registry& known,
                                 std::uint64_t seed) {
  if (kind_of(path) != Kind::preset) {
    return load_one(path, seed);
  }
  const auto preset = load_preset(path);
  if (!preset) {
    return preset.error();
  }
  const std::string file = file_named_in(path, *preset);
  auto choice = file.empty() ? load_named(path, *preset, known) : load_one(file, seed);
  if (choice) {
    choice->parameters = preset->parameters;
  }
  return choice;
}

std::vector<std::string> files_of_policy(const std::string& path) {
  std::vector<std::string> files{path};
  if (kind_of(path) == Kind::preset) {
    const auto preset = load_preset(path);
    const std::string file = preset ? file_named_in(path, *preset) : std::string{};
    if (!file.empty()) {
      files.push_back(file);
    }
  }
  return files;
}

}  // namespace flyball
