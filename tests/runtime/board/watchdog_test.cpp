// SPDX-License-Identifier: BSD-3-Clause
#include "board/watchdog.h"

#include "scratch_folder.h"
#include <array>
#include <csignal>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace flyball {
namespace {

TEST(Watchdog, works_once_when_it_is_told_to_end) {
  const ScratchFolder folder;
  const int file = open(folder.path("out").c_str(), O_CREAT | O_WRONLY | O_APPEND, 0600);
  auto dog = Watchdog::start({file}, [file] { (void)!write(file, "done", 4); });
  ASSERT_TRUE(dog.ok());
  EXPECT_TRUE(dog->is_alive());
  EXPECT_EQ(folder.content("out"), "");
  dog->end();
  EXPECT_EQ(folder.content("out"), "done");
  EXPECT_FALSE(dog->is_alive());
  dog->end();
  EXPECT_EQ(folder.content("out"), "done");
  close(file);
}

TEST(Watchdog, outlives_the_signals_of_a_terminal) {
  const ScratchFolder folder;
  const int file = open(folder.path("out").c_str(), O_CREAT | O_WRONLY, 0600);
  auto dog = Watchdog::start({file}, [file] { (void)!write(file, "done", 4); });
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
    kill(dog->process(), number);
  }
  EXPECT_TRUE(dog->is_alive());
  dog->end();
  EXPECT_EQ(folder.content("out"), "done");
  close(file);
}

TEST(Watchdog, keeps_no_other_file_open) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  auto dog = Watchdog::start({}, [] {});
  close(ends[1]);
  char byte = 0;
  EXPECT_EQ(read(ends[0], &byte, 1), 0);  // Nobody else holds the other end.
  close(ends[0]);
  EXPECT_NE(getsid(dog->process()), getsid(0));
}

TEST(Watchdog, notices_that_it_was_killed) {
  auto dog = Watchdog::start({}, [] {});
  kill(dog->process(), SIGKILL);
  siginfo_t ended{};
  waitid(P_PID, static_cast<id_t>(dog->process()), &ended, WEXITED | WNOWAIT);
  EXPECT_FALSE(dog->is_alive());
}

}  // namespace
}  // namespace flyball
