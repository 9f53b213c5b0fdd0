// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/scenario/shipped_platform.h"

#include "flyball/scenario/files.h"

namespace flyball {

Result<PlatformModel> find_platform(const std::string& name_or_path) {
  const Result<std::string> file = find_shipped("platforms", name_or_path);
  return file ? load_platform(*file) : Result<PlatformModel>{file.error()};
}

}  // namespace flyball
