// SPDX-License-Identifier: BSD-3-Clause
//
// A policy's preset.

#include "flyball/governors/preset.h"

#include "input_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const InputFolder folder;
  const auto preset = flyball::load_preset(folder.write("preset.toml", text_of(bytes, size)));
  require(preset.ok() || !preset.error().message.empty(), "what is refused is refused in words");
  return 0;
}
