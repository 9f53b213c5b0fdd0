// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/file_handle.h"

#include <array>
#include <cerrno>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

TEST(FileHandle, closes_its_file_when_it_goes) {
  int number{};
  {
    const FileHandle file{open("/dev/null", O_RDONLY | O_CLOEXEC)};
    ASSERT_TRUE(file.is_open());
    number = file.number();
    EXPECT_GE(fcntl(number, F_GETFD), 0);
  }
  EXPECT_EQ(fcntl(number, F_GETFD), -1);
  EXPECT_FALSE(FileHandle{-1}.is_open());
}

TEST(FileHandle, waits_until_there_is_something_to_read_but_not_for_longer_than_it_may) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe2(ends.data(), O_CLOEXEC), 0);
  const FileHandle reading{ends[0]};
  const FileHandle writing{ends[1]};
  EXPECT_GE(reading.wait(20ms), 19ms) << "nothing comes";
  ASSERT_EQ(write(writing.number(), "x", 1), 1);
  EXPECT_LT(reading.wait(10min), 10min);
}

TEST(SystemError, tells_apart_what_is_not_permitted_and_what_is_refused) {
  EXPECT_EQ(system_error("x", EROFS).code, ErrorCode::unavailable);
  EXPECT_EQ(system_error("x", EACCES).code, ErrorCode::unavailable);
  EXPECT_EQ(system_error("x", EINVAL).code, ErrorCode::invalid_input);
  EXPECT_EQ(system_error("x", EBUSY).code, ErrorCode::failed);
  EXPECT_EQ(system_error("x cannot be read", EINVAL).message, "x cannot be read: Invalid argument");
}

}  // namespace
}  // namespace flyball
