// SPDX-License-Identifier: BSD-3-Clause
//
// An airframe's file. What it is read to is finite.

#include "flyball/sim/airframe.h"

#include "input_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const InputFolder folder;
  const auto airframe = flyball::load_airframe(folder.write("own.toml", text_of(bytes, size)));
  if (!airframe) {
    require(!airframe.error().message.empty(), "what is refused is refused in words");
    return 0;
  }
  require(airframe->inertia_kg_m2().allFinite(), "its inertia is finite");
  require(std::isfinite(airframe->drag_area_m2), "its drag is finite");
  require(std::isfinite(airframe->power_b[0] + airframe->power_b[1]), "its power is finite");
  return 0;
}
