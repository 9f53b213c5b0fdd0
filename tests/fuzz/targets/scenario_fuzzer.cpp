// SPDX-License-Identifier: BSD-3-Clause
//
// A scenario; behind a line of dashes, one `--set` a line. What is read must be read again from
// what is written.

#include "flyball/scenario/scenario.h"

#include "input_folder.h"
#include <sstream>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const InputFolder folder;
  const auto pieces = pieces_of(text_of(bytes, size));
  std::vector<std::string> overrides;
  if (pieces.size() > 1) {
    std::istringstream lines{std::string{pieces[1]}};
    for (std::string line; std::getline(lines, line);) {
      overrides.push_back(line);
    }
  }
  const auto read = flyball::load_scenario(folder.write("a.toml", pieces.front()), overrides);
  if (const auto* loaded = std::get_if<flyball::LoadedScenario>(&read)) {
    const std::string text = flyball::to_toml(loaded->scenario);
    const auto again = flyball::load_scenario(folder.write("b.toml", text), {});
    const auto* loaded_again = std::get_if<flyball::LoadedScenario>(&again);
    require(loaded_again != nullptr, "what is written can be read");
    require(flyball::to_toml(loaded_again->scenario) == text, "it comes back as it was");
  } else {
    require(!std::get<std::vector<flyball::Error>>(read).empty(), "refused with a reason");
  }
  return 0;
}
