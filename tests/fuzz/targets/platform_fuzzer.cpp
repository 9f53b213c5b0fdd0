// SPDX-License-Identifier: BSD-3-Clause
//
// A platform's file, beside those that are shipped, which it may be like. What it is read to must
// be usable: no job takes a time that is none.

#include "flyball/runtime/platform.h"
#include "flyball/sim/platform_file.h"

#include "input_folder.h"
#include <fstream>
#include <iterator>

namespace {

void copy_shipped(const InputFolder& folder) {
  for (const auto& entry : std::filesystem::directory_iterator{FLYBALL_PLATFORMS}) {
    std::ifstream file{entry.path()};
    const std::string content{std::istreambuf_iterator<char>{file}, {}};
    folder.write(entry.path().filename().string(), content);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const InputFolder folder;
  static const bool copied = (copy_shipped(folder), true);
  require(copied, "copied");
  const std::string file = folder.write("own.toml", text_of(bytes, size));
  static_cast<void>(flyball::files_of_platform(file));
  const auto model = flyball::load_platform(file);
  if (!model) {
    require(!model.error().message.empty(), "what is refused is refused in words");
    return 0;
  }
  const flyball::ModeledPlatform platform{*model};
  for (const auto& [kernel, cost] : model->kernels) {
    flyball::Work work;
    for (const auto& [name, seconds] : cost.seconds_per) {
      work.add(name, 1e6);
    }
    for (const flyball::Hertz clock : platform.frequencies()) {
      require(platform.job_time(kernel, work, clock) >= flyball::Duration::zero(),
              "a job's time is no less than 0");
    }
  }
  return 0;
}
