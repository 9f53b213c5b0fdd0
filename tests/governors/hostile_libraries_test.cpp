// SPDX-License-Identifier: BSD-3-Clause
// test-label: fault
//
// Libraries that somebody wrote to break a mission or its computer: each ends in a sentence that
// names what it did. The address sanitizer needs calls that a policy may not make.
#ifndef __SANITIZE_ADDRESS__
#include "libraries/isolated_policy.h"
#include "libraries/library_policy.h"
#include "libraries/policy_packets.h"
#include "policy_start.h"
#include "scratch_folder.h"
#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

static_assert(sizeof(AnswerPacket) == 1432, "as plugins/hostile.c sends it");
static_assert(sizeof(OpeningPacket) == 536, "as plugins/hostile.c sends it");

struct Hostile {
  std::string name;
  std::string sentence;  ///< Part of it.
};

constexpr const char* process = "reached for another process, which a policy may not";
constexpr const char* network = "reached for the network, which a policy may not use";
constexpr const char* file = "reached for a file, which a policy may only read, and only until";
constexpr const char* shared = "reached for shared memory, which a policy may not have";
constexpr const char* other = "asked the system for what a policy may not have";

/// What is said when it is opened, started, or asked at last.
std::string end_of(const std::string& name, const IsolationLimits& limits) {
  const ScratchFolder scratch;
  const std::string path = scratch.path(name + ".so");
  std::filesystem::copy_file(std::string{FLYBALL_TEST_PLUGINS} + "/hostile.so", path);
  const PolicyMaker make = [path] { return LibraryPolicy::open(path, 1); };
  const auto declaration = declaration_of(make, limits);
  if (!declaration) {
    return declaration.error().message;
  }
  EXPECT_TRUE(declaration->is_confined) << "this test needs a kernel with seccomp filters";
  IsolatedPolicy policy{path, make, *declaration, limits};
  const auto given = Parameters::resolve(path, policy.parameters(), {});
  if (const auto* errors = std::get_if<std::vector<Error>>(&given)) {
    return errors->front().message;
  }
  if (const Status started = policy.start(std::get<Parameters>(given), conformance_knobs(), {});
      !started) {
    EXPECT_NE(std::string::npos, started.error().message.find(path)) << started.error().message;
    return started.error().message;
  }
  static_cast<void>(policy.decide({}));
  const std::string trouble{policy.trouble()};
  static_cast<void>(policy.decide({}));
  EXPECT_EQ(trouble, policy.trouble()) << "and stays so";
  EXPECT_TRUE(trouble.empty() || trouble.find(path) == 0) << trouble;
  return trouble;
}

void expect_ends(const std::vector<Hostile>& libraries, const IsolationLimits& limits = {}) {
  for (const auto& [name, sentence] : libraries) {
    const std::string said = end_of(name, limits);
    EXPECT_NE(std::string::npos, said.find(sentence)) << name << ": " << said;
    EXPECT_TRUE(std::all_of(said.begin(), said.end(), [](char c) { return c >= ' '; })) << said;
  }
}

TEST(HostileLibraries, that_reach_for_processes_are_ended) {
  expect_ends({{"decide-fork", process},
               {"decide-vfork", process},
               {"decide-clone", process},
               {"decide-system", other},
               {"decide-exec", process},
               {"decide-kill", process},
               {"decide-killall", process},
               {"decide-setsid", process},
               {"decide-setpgid", process},
               {"decide-ptrace", process},
               {"decide-readmem", process},
               {"decide-outlive", process},
               {"decide-handler", process},
               {"decide-orphan", process},
               {"decide-sigio", process},
               {"decide-threadfork", process},
               {"load-fork", process},
               {"create-exec", process}});
}

TEST(HostileLibraries, that_reach_for_files_and_the_network_are_ended) {
  expect_ends({{"decide-socket", network},
               {"decide-udp", network},
               {"decide-unix", network},
               {"load-socket", network},
               {"decide-read", file},
               {"decide-write", file},
               {"decide-append", file},
               {"decide-fopen", file},
               {"decide-unlink", file},
               {"decide-rename", file},
               {"decide-mkdir", file},
               {"decide-chmod", file},
               {"load-write", file},
               {"entry-fopen", file},
               {"create-append", file},
               {"decide-mount", file},
               {"decide-uring", other}});
}

TEST(HostileLibraries, that_read_files_before_they_decide_may) {
  for (const char* name : {"load-read", "entry-read", "create-read", "none"}) {
    EXPECT_EQ("", end_of(name, {})) << name;
  }
}

TEST(HostileLibraries, that_take_memory_get_little) {
  IsolationLimits limits;
  limits.memory_bytes = std::size_t{64} << 20U;
  limits.answer = 60s;  // On a busy host pages come slowly.
  expect_ends({{"decide-shm", shared},
               {"decide-memfd", shared},
               {"decide-shared", shared},
               {"load-shared", shared},
               {"decide-memory", "its process was ended by signal 6"},
               {"decide-recurse", "its process was ended by signal 11"}},
              limits);
}

TEST(HostileLibraries, that_end_or_never_answer_are_told) {
  IsolationLimits impatient;
  impatient.answer = 50ms;
  expect_ends({{"decide-hang", "did not answer within 0.05 s"},
               {"decide-sleep", "did not answer within 0.05 s"},
               {"decide-stop", "did not answer within 0.05 s"}},
              impatient);
  impatient.start = 300ms;
  expect_ends({{"load-hang", "did not answer within 0.3 s"},
               {"create-hang", "did not answer within 0.3 s"}},
              impatient);
  expect_ends({{"decide-segv", "ended by signal 11 (Segmentation fault)"},
               {"decide-abort", "ended by signal 6 (Aborted)"},
               {"decide-exit", "ended by itself with exit code 7"},
               {"decide-closed", "its process "},
               {"load-abort", "ended by signal 6 (Aborted)"},
               {"entry-exit", "ended by itself with exit code 7"}});
}

TEST(HostileLibraries, that_write_to_the_host_themselves_are_not_believed) {
  expect_ends({{"decide-shortpacket", "sent a packet of another size than was agreed on"},
               {"decide-longpacket", "sent a packet of another size than was agreed on"},
               {"decide-badpacket", "sent a text that does not end"},
               {"decide-zeropacket", "answered another question than it was asked"},
               {"load-badopening", "sent a text that does not end"},
               {"create-longpacket", "sent a packet of another size than was agreed on"}});
}

TEST(HostileLibraries, that_declare_or_answer_nonsense_are_told_so) {
  expect_ends({{"entry-null", "flyball_policy() returns NULL"},
               {"entry-small", "its FlyballPolicy has 8 bytes"},
               {"entry-undecided", "create, destroy and decide must not be NULL"},
               {"entry-nolist", "parameters must not be NULL"},
               {"entry-many", "declares 1000000 parameters, at most 100"},
               {"entry-twice", "declares \"one\" twice"},
               {"entry-nameless", "parameter 0 is NULL, has no name"},
               {"entry-bounds", "declares \"one\" from 2 to 1; its minimum must not be above"},
               {"entry-nan", "declares \"one\" from 0 to nan; its minimum must not be above"},
               {"entry-default", "declares \"one\" with a default that is no number"},
               {"create-silent", "does not start and does not say why"},
               {"create-endless", "AAAAAAAA"},
               {"period-tiny", "period_s is 1e-05; it must be a number of seconds, 0.001 to 3600"},
               {"period-nan", "period_s is nan; it must be a number of seconds"},
               {"period-negative", "period_s is -1; it must be a number of seconds"},
               {"decide-silent", "cannot decide and does not say why"},
               {"decide-escape", "\\x1b]0;owned\\x07\\x1b[2J"}});
}

}  // namespace
}  // namespace flyball
#endif
