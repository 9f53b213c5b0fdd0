// SPDX-License-Identifier: BSD-3-Clause
//
// OctoMap's .bt and .ot as the kernels read them: into OctoMap's own tree, and into bricks.

#include "bricks/map_file.h"
#include "input_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const InputFolder folder;
  const std::string file = folder.write("map.bt", text_of(bytes, size));
  const auto map = flyball::read_map_file(file);
  require(map.ok() || !map.error().message.empty(), "what is refused is refused in words");
  return 0;
}
