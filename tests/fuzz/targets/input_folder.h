// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a target of libFuzzer needs: our readers take files, libFuzzer gives bytes.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// A folder of this process, in memory where the system has that, and gone with it.
class InputFolder {
 public:
  InputFolder() {
    const std::filesystem::path memory = "/dev/shm";
    std::error_code failed;
    const auto in = std::filesystem::is_directory(memory, failed)
                        ? memory
                        : std::filesystem::temp_directory_path();
    std::string name = (in / "flyball_fuzz_XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~InputFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  InputFolder(const InputFolder&) = delete;
  InputFolder& operator=(const InputFolder&) = delete;

  [[nodiscard]] std::string path(const std::string& name = "") const {
    return (path_ / name).string();
  }
  std::string write(const std::string& name, std::string_view content) const {
    const std::string file = path(name);
    std::filesystem::create_directories(std::filesystem::path{file}.parent_path());
    std::ofstream{file, std::ios::binary}.write(content.data(),
                                                static_cast<std::streamsize>(content.size()));
    return file;
  }

 private:
  std::filesystem::path path_;
};

inline std::string_view text_of(const std::uint8_t* bytes, std::size_t size) {
  return {reinterpret_cast<const char*>(bytes), size};  // NOLINT: bytes are characters here
}

/// The pieces between lines of `----`: several files in one input.
inline std::vector<std::string_view> pieces_of(std::string_view text) {
  constexpr std::string_view between = "----\n";
  std::vector<std::string_view> pieces;
  for (std::size_t at = text.find(between); at != std::string_view::npos; at = text.find(between)) {
    pieces.push_back(text.substr(0, at));
    text.remove_prefix(at + between.size());
  }
  pieces.push_back(text);
  return pieces;
}

/// Ends the program where a property does not hold, so that libFuzzer keeps the input.
inline void require(bool holds, const char* what) {
  if (!holds) {
    std::fprintf(stderr, "does not hold: %s\n", what);
    std::abort();
  }
}
