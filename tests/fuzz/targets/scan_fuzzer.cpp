// SPDX-License-Identifier: BSD-3-Clause
//
// OctoMap's .bt and .ot as the simulator reads them: a grid of solid cells.

#include "input_folder.h"
#include "world/scan_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const InputFolder folder;
  const auto grid = flyball::read_scan(folder.write("scan.bt", text_of(bytes, size)));
  require(grid.ok() || !grid.error().message.empty(), "what is refused is refused in words");
  return 0;
}
