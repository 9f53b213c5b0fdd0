// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/scenario/kernel_library.h"

#include "flyball/scenario/plugins.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <system_error>

#include <dlfcn.h>

namespace flyball {
namespace {

namespace fs = std::filesystem;

/// The function that FLYBALL_PLUGIN defines.
struct Entry {
  void (*add)(Registry&){};
};

/// With `all_plugins`: what is loaded stays loaded, too.
std::vector<std::string>& loaded() {
  static std::vector<std::string> files;
  return files;
}

Error broken(const std::string& path, const std::string& what) {
  return {ErrorCode::invalid_input, "library \"" + path + "\" " + what};
}

/// `mine` of ./libmine.so
std::string stem_of(const std::string& path) {
  const std::string name = fs::path{path}.stem().string();
  return name.rfind("lib", 0) == 0 ? name.substr(3) : name;
}

Result<Entry> open_library(const std::string& path, const std::string& file) {
  // Never closed: what it adds lives as long as the program.
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    const char* why = dlerror();  // NOLINT(concurrency-mt-unsafe): one thread loads kernels
    return broken(path, std::string{"cannot be loaded: "} + (why == nullptr ? "" : why));
  }
  const std::string name = "flyball_plugin_" + stem_of(path);
  void* function = dlsym(library, name.c_str());
  if (function == nullptr) {
    return broken(path, "exports no function " + name + "; write FLYBALL_PLUGIN(" + stem_of(path) +
                            ") in it, or give the file the name that stands there");
  }
  return Entry{reinterpret_cast<void (*)(Registry&)>(function)};  // NOLINT: what dlsym is for
}

/// What the library adds, apart from all others.
Result<Registry> brought_by(const std::string& path, Entry entry) {
  Registry own;
  try {
    entry.add(own);
  } catch (const std::exception& error) {
    return broken(path, std::string{"throws: "} + error.what());
  } catch (...) {
    return broken(path, "throws an exception of no known type");
  }
  if (own.is_empty()) {
    return broken(path, "adds nothing; call registry.add in its FLYBALL_PLUGIN");
  }
  return own;
}

}  // namespace

Status load_kernels(const std::string& path) {
  std::error_code failed;
  if (!fs::is_regular_file(path, failed)) {
    return Error{ErrorCode::not_found,
                 "library \"" + path + "\" is not there; give a path to a file like ./libmine.so"};
  }
  // The loader searches its own folders for a name without a slash.
  const std::string file = fs::canonical(path, failed).string();
  if (std::find(loaded().begin(), loaded().end(), file) != loaded().end()) {
    return Done{};
  }
  const auto entry = open_library(path, file);
  if (!entry) {
    return entry.error();
  }
  auto own = brought_by(path, *entry);
  if (!own) {
    return own.error();
  }
  std::string refusal;
  add_plugins([&](Registry& all) {
    const Status merged = all.merge(std::move(*own));
    refusal = merged ? "" : merged.error().message;
  });
  if (!refusal.empty()) {
    return broken(path, "cannot be added: " + refusal);
  }
  loaded().push_back(file);
  return Done{};
}

const std::vector<std::string>& loaded_kernel_libraries() {
  return loaded();
}

}  // namespace flyball
