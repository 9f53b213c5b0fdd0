// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/board/settings_keeper.h"

#include "board/settings_journal.h"
#include "fake_kernel.h"
#include "fake_trees.h"
#include "killed_session.h"
#include <csignal>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

namespace flyball {
namespace {

const std::string policy0 = "/sys/devices/system/cpu/cpufreq/policy0/";

/// A Pi 5's files, and a folder for the lock.
class SettingsKeeperTest : public testing::Test {
 protected:
  SettingsKeeperTest() { fake::plant_pi5(tree_); }
  [[nodiscard]] KeeperOptions options(bool adopt = false) const {
    return {tree_.root() + "/run", adopt};
  }
  [[nodiscard]] std::string journal() const { return tree_.get("/run/board.journal"); }

  fake::Tree tree_{};
  fake::Kernel kernel_{tree_.root()};
};

void change_everything(SettingsKeeper& keeper) {
  EXPECT_TRUE(keeper.keep(policy0 + "scaling_setspeed").ok());
  EXPECT_TRUE(keeper.write(policy0 + "scaling_governor", "userspace").ok());
  EXPECT_TRUE(keeper.write(policy0 + "scaling_max_freq", "1600000").ok());
  EXPECT_TRUE(keeper.write(policy0 + "scaling_min_freq", "1600000").ok());
  EXPECT_TRUE(keeper.write(policy0 + "scaling_setspeed", "1600000").ok());
  EXPECT_TRUE(keeper.write("/sys/devices/system/cpu/cpu3/online", "0").ok());
}

TEST_F(SettingsKeeperTest, restores_every_file_byte_for_byte) {
  const auto before = tree_.all();
  auto keeper = SettingsKeeper::open(kernel_, options());
  ASSERT_TRUE(keeper.ok()) << keeper.error().message;
  change_everything(**keeper);
  EXPECT_NE(tree_.all(), before);
  EXPECT_TRUE((*keeper)->restore().empty());
  auto after = tree_.all();
  after[policy0 + "scaling_cur_freq"] = before.at(policy0 + "scaling_cur_freq");  // a reading
  EXPECT_EQ(after, before);
  EXPECT_EQ(journal(), "");
  EXPECT_FALSE((*keeper)->write(policy0 + "scaling_governor", "userspace").ok());
}

TEST_F(SettingsKeeperTest, restores_at_its_end) {
  const auto before = tree_.get(policy0 + "scaling_governor");
  {
    auto keeper = SettingsKeeper::open(kernel_, options());
    ASSERT_TRUE((*keeper)->write(policy0 + "scaling_governor", "userspace").ok());
  }
  EXPECT_EQ(tree_.get(policy0 + "scaling_governor"), before);
}

TEST_F(SettingsKeeperTest, restores_after_any_signal) {
  const auto before = tree_.get(policy0 + "scaling_governor");
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGKILL, SIGABRT}) {
    const int status = fake::run_apart(options().run_folder, [&] {
      auto keeper = SettingsKeeper::open(kernel_, options());
      if ((*keeper)->write(policy0 + "scaling_governor", "userspace").ok()) {
        (void)signal(number, SIG_DFL);  // `nohup` has it ignored.
        kill(getpid(), number);
      }
    });
    EXPECT_EQ(WTERMSIG(status), number);
    EXPECT_EQ(tree_.get(policy0 + "scaling_governor"), before) << number;
    EXPECT_EQ(journal(), "");
  }
}

TEST_F(SettingsKeeperTest, restores_though_a_child_of_the_dead_process_lives_on) {
  const auto before = tree_.get(policy0 + "scaling_governor");
  int ends[2] = {-1, -1};  // NOLINT(modernize-avoid-c-arrays): pipe's
  ASSERT_EQ(pipe(static_cast<int*>(ends)), 0);
  // The child holds copies of all files, also of the lock: its hand must not be waited for.
  const pid_t process = fork();
  if (process == 0) {
    auto keeper = SettingsKeeper::open(kernel_, options());
    (void)(*keeper)->write(policy0 + "scaling_governor", "userspace");
    if (fork() == 0) {
      char end = 0;
      close(ends[1]);
      (void)!read(ends[0], &end, 1);  // Until the test lets it go.
      _exit(0);
    }
    kill(getpid(), SIGKILL);
  }
  waitpid(process, nullptr, 0);
  const int lock = ::open((options().run_folder + "/board.lock").c_str(), O_RDWR | O_CLOEXEC);
  flock(lock, LOCK_EX);
  close(lock);
  EXPECT_EQ(tree_.get(policy0 + "scaling_governor"), before);
  close(ends[0]);
  close(ends[1]);
}

TEST_F(SettingsKeeperTest, watches_anew_when_the_other_process_was_killed) {
  const auto before = tree_.get(policy0 + "scaling_governor");
  const int status = fake::run_apart(options().run_folder, [&] {
    auto keeper = SettingsKeeper::open(kernel_, options());
    kill((*keeper)->watchdog(), SIGKILL);
    siginfo_t ended{};  // Wait until it is gone, and leave it to be found.
    waitid(P_PID, static_cast<id_t>((*keeper)->watchdog()), &ended, WEXITED | WNOWAIT);
    if ((*keeper)->write(policy0 + "scaling_governor", "userspace").ok()) {
      kill(getpid(), SIGKILL);
    }
  });
  EXPECT_TRUE(fake::was_killed(status));
  EXPECT_EQ(tree_.get(policy0 + "scaling_governor"), before);
}

TEST_F(SettingsKeeperTest, refuses_a_board_that_another_process_has) {
  auto keeper = SettingsKeeper::open(kernel_, options());
  ASSERT_TRUE(keeper.ok());
  for (const bool adopt : {false, true}) {
    const auto second = SettingsKeeper::open(kernel_, options(adopt));
    ASSERT_FALSE(second.ok());
    EXPECT_EQ(second.error().message,
              "process " + std::to_string(getpid()) + " has this board (" + tree_.root() +
                  "/run/board.lock), or its settings are just being restored; end it first");
  }
  EXPECT_TRUE((*keeper)->restore().empty());
  EXPECT_TRUE(SettingsKeeper::open(kernel_, options()).ok());
}

/// A session whose two processes are killed.
void leave_unrestored(LinuxSystem& system, const KeeperOptions& options) {
  fake::run_apart(options.run_folder, [&] {
    auto keeper = SettingsKeeper::open(system, options);
    (void)(*keeper)->write(policy0 + "scaling_governor", "userspace");
    kill((*keeper)->watchdog(), SIGKILL);
    kill(getpid(), SIGKILL);
  });
}

TEST_F(SettingsKeeperTest, refuses_what_an_earlier_session_left_unless_it_adopts_that) {
  leave_unrestored(kernel_, options());
  EXPECT_EQ(tree_.get(policy0 + "scaling_governor"), "userspace\n");
  const auto refused = SettingsKeeper::open(kernel_, options());
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message, "a session that ended has left 1 settings unrestored (" +
                                         tree_.root() + "/run/board.journal), the first of them " +
                                         policy0 + "scaling_governor; try: flyball board restore");
  auto adopted = SettingsKeeper::open(kernel_, options(true));
  ASSERT_TRUE(adopted.ok());
  EXPECT_TRUE((*adopted)->write(policy0 + "scaling_governor", "performance").ok());
  EXPECT_TRUE((*adopted)->restore().empty());
  EXPECT_EQ(tree_.get(policy0 + "scaling_governor"), "ondemand\n");
  EXPECT_TRUE(SettingsKeeper::open(kernel_, options()).ok());
}

TEST_F(SettingsKeeperTest, adopts_a_journal_that_ends_with_a_part_of_a_record) {
  leave_unrestored(kernel_, options());
  tree_.put("/run/board.journal", journal() + "52\n/sys/devices/system/cpu");
  fake::run_apart(options().run_folder, [&] {
    auto adopted = SettingsKeeper::open(kernel_, options(true));
    (void)(*adopted)->write(policy0 + "scaling_max_freq", "1600000");
    kill(getpid(), SIGKILL);
  });
  EXPECT_EQ(tree_.get(policy0 + "scaling_governor"), "ondemand\n");
  EXPECT_EQ(tree_.get(policy0 + "scaling_max_freq"), "2400000\n");
}

TEST_F(SettingsKeeperTest, restores_after_a_program_that_has_closed_its_standard_files) {
  const int status = fake::run_apart(options().run_folder, [&] {
    close(STDIN_FILENO);
    close(STDOUT_FILENO);
    auto keeper = SettingsKeeper::open(kernel_, options());
    (void)(*keeper)->write(policy0 + "scaling_max_freq", "1600000");
    kill(getpid(), SIGKILL);
  });
  EXPECT_TRUE(fake::was_killed(status));
  EXPECT_EQ(tree_.get(policy0 + "scaling_max_freq"), "2400000\n");
  EXPECT_EQ(journal(), "");
}

TEST_F(SettingsKeeperTest, goes_on_after_a_file_that_refuses_and_names_it) {
  auto keeper = SettingsKeeper::open(kernel_, options());
  change_everything(**keeper);
  kernel_.refused["scaling_min_freq"] = EACCES;
  const std::vector<Error> errors = (*keeper)->restore();
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_EQ(errors[0].message, "not restored: \"1500000\" cannot be written to " + policy0 +
                                   "scaling_min_freq: Permission denied; it held 8 bytes: 1500000");
  EXPECT_EQ(tree_.get(policy0 + "scaling_governor"), "ondemand\n");
  EXPECT_EQ(tree_.get(policy0 + "scaling_max_freq"), "2400000\n");
  EXPECT_EQ(tree_.get("/sys/devices/system/cpu/cpu3/online"), "1\n");
}

TEST_F(SettingsKeeperTest, leaves_what_nobody_could_restore_to_the_next_session) {
  tree_.put(policy0 + "scaling_governor", "of a module that has gone\n");
  auto keeper = SettingsKeeper::open(kernel_, options());
  ASSERT_TRUE((*keeper)->write(policy0 + "scaling_governor", "userspace").ok());
  EXPECT_EQ((*keeper)->restore().size(), 1U);
  EXPECT_NE(journal(), "");
  EXPECT_FALSE(SettingsKeeper::open(kernel_, options()).ok());
}

TEST_F(SettingsKeeperTest, restores_limits_whose_order_matters) {
  const std::vector<KeptSetting> kept{{policy0 + "scaling_max_freq", "2400000\n"},
                                      {policy0 + "scaling_min_freq", "2000000\n"}};
  tree_.put(policy0 + "scaling_max_freq", "1600000\n");
  tree_.put(policy0 + "scaling_min_freq", "1500000\n");
  EXPECT_TRUE(restore_settings(kernel_, kept).empty());
  EXPECT_EQ(tree_.get(policy0 + "scaling_min_freq"), "2000000\n");
  EXPECT_EQ(tree_.get(policy0 + "scaling_max_freq"), "2400000\n");
}

TEST_F(SettingsKeeperTest, restores_limits_while_heat_shows_lower_ones) {
  tree_.put(policy0 + "scaling_min_freq", "2000000\n");
  auto keeper = SettingsKeeper::open(kernel_, options());
  ASSERT_TRUE((*keeper)->write(policy0 + "scaling_min_freq", "1600000").ok());
  ASSERT_TRUE((*keeper)->write(policy0 + "scaling_max_freq", "1600000").ok());
  kernel_.cooled_khz = 1800000;
  for (const Error& error : (*keeper)->restore()) {
    ADD_FAILURE() << error.message;
  }
  EXPECT_EQ(tree_.get(policy0 + "scaling_min_freq"), "2000000\n");
  EXPECT_EQ(tree_.get(policy0 + "scaling_max_freq"), "2400000\n");
  EXPECT_TRUE(SettingsKeeper::open(kernel_, options()).ok());
}

TEST_F(SettingsKeeperTest, says_which_limit_is_wider_than_it_was) {
  auto keeper = SettingsKeeper::open(kernel_, options());
  ASSERT_TRUE((*keeper)->write(policy0 + "scaling_max_freq", "1600000").ok());
  kernel_.lies["scaling_max_freq"] = "2500000\n";
  const std::vector<Error> errors = (*keeper)->restore();
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_EQ(errors[0].message, "not restored: " + policy0 +
                                   "scaling_max_freq does not take it; it held 8 bytes: 2400000");
}

TEST_F(SettingsKeeperTest, restores_only_what_it_has_written) {
  auto keeper = SettingsKeeper::open(kernel_, options());
  ASSERT_TRUE((*keeper)->keep(policy0 + "scaling_max_freq").ok());
  tree_.put(policy0 + "scaling_max_freq", "1600000\n");
  EXPECT_TRUE((*keeper)->restore().empty());
  EXPECT_TRUE(kernel_.writes.empty());
}

TEST_F(SettingsKeeperTest, writes_nothing_that_it_could_not_restore) {
  auto keeper = SettingsKeeper::open(kernel_, options());
  kernel_.unreadable["scaling_governor"] = EACCES;
  EXPECT_FALSE((*keeper)->write(policy0 + "scaling_governor", "userspace").ok());
  EXPECT_TRUE(kernel_.writes.empty());
}

TEST_F(SettingsKeeperTest, says_where_it_needs_a_folder) {
  const auto keeper = SettingsKeeper::open(kernel_, {tree_.root() + "/no/folder", false});
  ASSERT_FALSE(keeper.ok());
  EXPECT_EQ(keeper.error().code, ErrorCode::not_found);
  EXPECT_EQ(keeper.error().message,
            "the folder " + tree_.root() +
                "/no/folder for the board's lock and journal cannot be made: No such file or "
                "directory; run as root, or see: flyball board setup --print");
}

TEST_F(SettingsKeeperTest, lets_the_group_of_its_folder_use_the_lock) {
  const mode_t before = umask(077);
  const auto keeper = SettingsKeeper::open(kernel_, options());
  umask(before);
  struct stat lock {};
  ASSERT_EQ(stat((options().run_folder + "/board.lock").c_str(), &lock), 0);
  EXPECT_EQ(lock.st_mode & 0777U, 0660U);
}

TEST_F(SettingsKeeperTest, touches_nothing_but_settings_of_cores) {
  auto keeper = SettingsKeeper::open(kernel_, options());
  for (const char* path :
       {"/etc/passwd", "/sys/devices/system/cpu/../../../kernel/uevent_helper"}) {
    const Status written = (*keeper)->write(path, "0");
    ASSERT_FALSE(written.ok());
    EXPECT_EQ(written.error().message,
              path + std::string{" is no setting of a board: only files below "
                                 "/sys/devices/system/cpu/ are"});
  }
  EXPECT_TRUE(kernel_.writes.empty());
}

TEST(SettingsJournal, leaves_out_what_somebody_else_has_put_in) {
  const ScratchFolder folder;
  auto journal = SettingsJournal::lock(folder.path());
  ASSERT_TRUE(journal->append({"/etc/passwd", "root::0:0::/:/bin/sh\n"}).ok());
  ASSERT_TRUE(journal->append({policy0 + "a", "1\n"}).ok());
  ASSERT_EQ(journal->read().size(), 1U);
  EXPECT_EQ(journal->read()[0].path, policy0 + "a");
}

TEST(SettingsJournal, leaves_out_a_record_that_was_cut_off) {
  const ScratchFolder folder;
  auto journal = SettingsJournal::lock(folder.path());
  ASSERT_TRUE(journal->append({policy0 + "a", "1\n2\n"}).ok());
  const std::size_t first = folder.content("board.journal").size();
  ASSERT_TRUE(journal->append({policy0 + "b", ""}).ok());
  const std::string whole = folder.content("board.journal");
  ASSERT_EQ(journal->read().size(), 2U);
  EXPECT_EQ(journal->read()[0].content, "1\n2\n");
  for (std::size_t length = 0; length < whole.size(); ++length) {
    (void)folder.file("board.journal", whole.substr(0, length));
    EXPECT_EQ(journal->read().size(), length >= first ? 1U : 0U) << length;
  }
}

TEST(SettingsJournal, takes_back_what_a_full_disk_took_of_a_record) {
  const ScratchFolder folder;
  auto journal = SettingsJournal::lock(folder.path());
  ASSERT_TRUE(journal->append({policy0 + "a", "1\n"}).ok());
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto ignored = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{folder.content("board.journal").size() + 5, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_FALSE(journal->append({policy0 + "b", "2\n"}).ok());
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, ignored);
  ASSERT_TRUE(journal->append({policy0 + "c", "3\n"}).ok());
  ASSERT_EQ(journal->read().size(), 2U);
  EXPECT_EQ(journal->read()[1].path, policy0 + "c");
}

}  // namespace
}  // namespace flyball
