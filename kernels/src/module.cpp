// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/module.h"

#include <filesystem>
#include <system_error>

#include <dlfcn.h>

namespace flyball {

std::string module_path(const std::string& name) {
  namespace fs = std::filesystem;
  std::error_code failed;
  const fs::path program = fs::read_symlink("/proc/self/exe", failed);
  return (program.parent_path().parent_path() / "lib" / "flyball" / (name + ".so")).string();
}

void* module_function(const std::string& name, const char* function) {
  // Never closed: the libraries behind it do not like to be unloaded.
  void* module = dlopen(module_path(name).c_str(), RTLD_NOW | RTLD_LOCAL);
  return module == nullptr ? nullptr : dlsym(module, function);
}

}  // namespace flyball
