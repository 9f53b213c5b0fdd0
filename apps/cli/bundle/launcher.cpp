// SPDX-License-Identifier: BSD-3-Clause
//
// `bin/flyball` of a tarball for systems whose libraries are older than ours: starts the real
// program with the libraries, and the loader for them, in `lib/bundle` beside it. Linked
// statically, so that it starts everywhere.

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <unistd.h>

namespace {

/// Where this file lies: as the kernel says, or, without /proc, as it was called, or, called by the
/// program that it started, as that was told.
std::string own_file(const std::string& called) {
  std::array<char, 4096> path{};
  const ssize_t length = readlink("/proc/self/exe", path.data(), path.size() - 1);
  if (length > 0) {
    return {path.data(), static_cast<std::size_t>(length)};
  }
  const char* told = std::getenv("FLYBALL_PROGRAM");  // NOLINT(concurrency-mt-unsafe): one thread
  return called.find('/') == std::string::npos && told != nullptr ? told : called;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string file = own_file(argc > 0 ? argv[0] : "");
  const std::size_t slash = file.rfind('/');
  const std::string libraries =
      (slash == std::string::npos ? "." : file.substr(0, slash)) + "/../lib/bundle";
  const std::string loader = libraries + "/loader";
  const std::string program = libraries + "/flyball";
  setenv("FLYBALL_PROGRAM", file.c_str(), 1);  // NOLINT(concurrency-mt-unsafe): one thread
  std::vector<const char*> words{"flyball", "--library-path", libraries.c_str(), program.c_str()};
  words.insert(words.end(), argv + (argc > 0 ? 1 : 0), argv + argc);
  words.push_back(nullptr);
  execv(loader.c_str(), const_cast<char* const*>(words.data()));
  std::perror(loader.c_str());
  return 127;
}
