// SPDX-License-Identifier: BSD-3-Clause
//
// A format of Lua's string.format, asked for a text of things that have addresses: it must be the
// same in two states, whose addresses differ.

#include "input_folder.h"
#include "scripts/lua_sandbox.h"

namespace {

/// Any bytes as a text of Lua's.
std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    char code[8];
    std::snprintf(code, sizeof code, "\\%03d", static_cast<unsigned char>(c));
    out += code;
  }
  return out + "\"";
}

struct Logged {
  flyball::LuaSandbox sandbox;
  std::string text{};

  explicit Logged(const std::string& file) : sandbox{file, 1} {
    const auto loaded = sandbox.load();
    text = loaded ? sandbox.logged() : loaded.error().message;
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const InputFolder folder;
  const std::string format = quoted(text_of(bytes, size));
  const std::string file =
      folder.write("format.lua", "log(string.format(" + format +
                                     ", 'a text', 1.5, 7, true, nil, 'b', -3, 1e308))");
  const Logged one{file};
  const Logged other{file};  // While the first one lives, so elsewhere.
  require(one.text == other.text, "a format gives the same text in each run");
  return 0;
}
