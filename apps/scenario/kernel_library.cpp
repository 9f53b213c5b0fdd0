// SPDX-License-Identifier: BSD-3-Clause
#include "scenario/kernel_library.h"

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

/// `mine` of ./libmine.so
std::string stem_of(const std::string& path) {
  const std::string name = fs::path{path}.stem().string();
  return name.rfind("lib", 0) == 0 ? name.substr(3) : name;
}

Result<Entry> open_library(const std::string& path, const std::string& file) {
  // Never closed: kernels that it made may live as long as the program.
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    const char* why = dlerror();  // NOLINT(concurrency-mt-unsafe): one thread loads kernels
    return broken_library(path, std::string{"cannot be loaded: "} + (why == nullptr ? "" : why));
  }
  const std::string name = "flyball_plugin_" + stem_of(path);
  void* function = dlsym(library, name.c_str());
  if (function == nullptr) {
    return broken_library(path, "exports no function " + name + "; write FLYBALL_PLUGIN(" +
                                    stem_of(path) +
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
    return broken_library(path, std::string{"throws: "} + error.what());
  } catch (...) {
    return broken_library(path, "throws an exception of no known type");
  }
  if (own.is_empty()) {
    return broken_library(path, "adds nothing; call registry.add in its FLYBALL_PLUGIN");
  }
  return own;
}

}  // namespace

Result<Registry> load_kernel_library(const std::string& path) {
  std::error_code failed;
  if (!fs::is_regular_file(path, failed)) {
    return Error{ErrorCode::not_found,
                 "library \"" + path + "\" is not there; give a path to a file like ./libmine.so"};
  }
  // The loader searches its own folders for a name without a slash.
  const auto entry = open_library(path, fs::canonical(path, failed).string());
  return entry ? brought_by(path, *entry) : entry.error();
}

Error broken_library(const std::string& path, const std::string& what) {
  return {ErrorCode::invalid_input, "library \"" + path + "\" " + what};
}

}  // namespace flyball
