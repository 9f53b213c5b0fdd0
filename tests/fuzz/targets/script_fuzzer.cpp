// SPDX-License-Identifier: BSD-3-Clause
//
// A Lua script, started and asked. It must do the same twice, within its budget.

#include "flyball/governors/policy.h"
#include "flyball/runtime/knob.h"

#include "input_folder.h"
#include "policy_start.h"
#include "scripts/lua_policy.h"

namespace {

std::string what_it_does(const std::string& file) {
  auto policy = flyball::open_lua_policy(file, 1);
  if (!policy) {
    return policy.error().message;
  }
  const flyball::KnobSettings knobs{{{"map.resolution_m", "m", "m", {0.15, 0.8}, 0.15, 0.8, 0.15}}};
  const auto given = flyball::Parameters::resolve("script", (*policy)->parameters(), {});
  if (!std::holds_alternative<flyball::Parameters>(given)) {
    return std::get<std::vector<flyball::Error>>(given).front().message;
  }
  if (const auto begun = (*policy)->start(std::get<flyball::Parameters>(given), knobs, {});
      !begun) {
    return begun.error().message;
  }
  std::string text;
  for (int i = 0; i < 3; ++i) {
    flyball::Observation seen;
    seen.speed_m_s = i;
    for (const auto& [knob, value] : (*policy)->decide(seen)) {
      text += std::string{knob} + "=" + std::to_string(value) + " ";
    }
    text += std::string{flyball::kit::trouble(**policy)} + "; " +
            std::string{flyball::kit::remark(**policy)} + "\n";
  }
  return text;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const InputFolder folder;
  const std::string file = folder.write("script.lua", text_of(bytes, size));
  const std::string once = what_it_does(file);
  require(what_it_does(file) == once, "a script does the same again");
  return 0;
}
