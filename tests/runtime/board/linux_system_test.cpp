// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/board/linux_system.h"

#include "fake_trees.h"
#include <thread>

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/stat.h>

namespace flyball {
namespace {

TEST(LinuxSystem, reads_and_writes_below_its_root) {
  const fake::Tree tree;
  tree.put("/sys/file", "1\n");
  const auto system = linux_system(tree.root() + "/");
  EXPECT_EQ(*system->read("/sys/file"), "1\n");
  EXPECT_TRUE(system->may_write("/sys/file").ok());
  ASSERT_TRUE(system->write("/sys/file", "22").ok());
  EXPECT_EQ(tree.get("/sys/file"), "22");
}

TEST(LinuxSystem, makes_no_files) {
  const fake::Tree tree;
  const auto system = linux_system(tree.root());
  const Status written = system->write("/file", "1");
  ASSERT_FALSE(written.ok());
  EXPECT_EQ(written.error().code, ErrorCode::not_found);
  EXPECT_EQ(written.error().message, "/file cannot be written: No such file or directory");
  EXPECT_FALSE(system->read("/file").ok());
  EXPECT_FALSE(system->may_write("/file").ok());
}

TEST(LinuxSystem, does_not_wait_for_a_pipe) {
  const fake::Tree tree;
  ASSERT_EQ(mkfifo((tree.root() + "/pipe").c_str(), 0600), 0);
  EXPECT_EQ(*linux_system(tree.root())->read("/pipe"), "");
}

TEST(LinuxSystem, lists_folders_sorted_and_missing_ones_as_empty) {
  const fake::Tree tree;
  tree.put("/b", "");
  tree.put("/a", "");
  const auto system = linux_system(tree.root());
  EXPECT_EQ(system->entries("/"), (std::vector<std::string>{"a", "b"}));
  EXPECT_TRUE(system->entries("/c").empty());
}

TEST(LinuxSystem, binds_a_thread_to_cores_and_says_when_it_gets_fewer) {
  std::thread{[] {  // Its affinity dies with it.
    const auto system = linux_system();
    const int here = sched_getcpu();
    EXPECT_TRUE(system->set_affinity(0, {here}).ok());
    const Status fewer = system->set_affinity(0, {here, 1023});
    ASSERT_FALSE(fewer.ok());
    EXPECT_EQ(fewer.error().code, ErrorCode::failed);
    EXPECT_EQ(system->set_affinity(0, {1023}).error().code, ErrorCode::invalid_input);
  }}
      .join();
}

}  // namespace
}  // namespace flyball
