// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/module.h"

#include "flyball/runtime/program.h"

#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <vector>

#include <dlfcn.h>

namespace flyball {
namespace {

namespace fs = std::filesystem;

/// Those that may hold modules, in the order in which they are asked.
std::vector<fs::path> module_folders() {
  const fs::path program = program_file();
  std::vector<fs::path> folders{program.parent_path().parent_path() / "lib" / "flyball",
                                fs::path{FLYBALL_MODULE_FOLDER}};
  // Read before any thread is started.
  const char* data = std::getenv("FLYBALL_DATA");  // NOLINT(concurrency-mt-unsafe)
  if (data != nullptr && *data != '\0') {
    folders.insert(folders.begin(), (fs::path{data} / ".." / ".." / "lib" / "flyball"));
  }
  return folders;
}

}  // namespace

std::string module_path(const std::string& name) {
  std::error_code failed;
  const std::vector<fs::path> folders = module_folders();
  for (const fs::path& folder : folders) {
    if (const fs::path file = folder / (name + ".so"); fs::is_regular_file(file, failed)) {
      return file.string();
    }
  }
  return (folders.front() / (name + ".so")).string();
}

void* module_function(const std::string& name, const char* function) {
  // Never closed: the libraries behind it do not like to be unloaded.
  void* module = dlopen(module_path(name).c_str(), RTLD_NOW | RTLD_LOCAL);
  return module == nullptr ? nullptr : dlsym(module, function);
}

}  // namespace flyball
