// SPDX-License-Identifier: BSD-3-Clause
#include "world/import_process.h"

#include <cstdlib>
#include <iostream>
#include <new>
#include <stdexcept>

#include <gtest/gtest.h>
#include <sys/wait.h>

namespace flyball {
namespace {

constexpr ImportLimits limits{1, std::size_t{64} << 20U};

std::string refused(const std::function<Result<std::string>()>& work) {
  const auto read = read_in_process(limits, work);
  if (read) {
    return "read";
  }
  EXPECT_EQ(read.error().code, ErrorCode::invalid_input);
  return read.error().message;
}

TEST(ImportProcess, hands_over_every_byte_and_what_is_printed_there_is_gone) {
  std::string sent(3'000'000, 'a');  // More than a pipe holds.
  sent[1'234'567] = '\0';
  testing::internal::CaptureStdout();
  const auto read = read_in_process(limits, [&]() -> Result<std::string> {
    std::cout << "chatter" << std::flush;
    return sent;
  });
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(*read, sent);
}

TEST(ImportProcess, hands_over_errors_with_their_code) {
  for (const auto code : {ErrorCode::not_found, ErrorCode::invalid_input, ErrorCode::failed}) {
    const auto read = read_in_process(limits, [code]() -> Result<std::string> {
      return Error{code, "is not there"};
    });
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, code);
    EXPECT_EQ(read.error().message, "is not there");
  }
}

TEST(ImportProcess, outlives_what_aborts_throws_loops_or_eats_memory) {
  EXPECT_NE(refused([]() -> Result<std::string> { std::abort(); }).find("signal 6"),
            std::string::npos);
  EXPECT_NE(refused([]() -> Result<std::string> {
              throw std::runtime_error{"bad chunk"};
            }).find("bad chunk"),
            std::string::npos);
  EXPECT_NE(refused([]() -> Result<std::string> { std::_Exit(3); }).find("exit code 3"),
            std::string::npos);
  EXPECT_NE(refused([]() -> Result<std::string> {
              for (volatile bool forever = true; forever;) {
              }
              return std::string{};
            }).find("more than 1 s"),
            std::string::npos);
  EXPECT_NE(refused([]() -> Result<std::string> { throw std::bad_alloc{}; }).find("64 MB"),
            std::string::npos);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);  // Nobody is left.
}

TEST(ImportProcess, has_more_time_and_memory_for_a_larger_file) {
  const ImportLimits small = import_limits(1000);
  const ImportLimits large = import_limits(100'000'000);
  EXPECT_EQ(small.processor_s, 3U);
  EXPECT_EQ(large.processor_s, 28U);
  EXPECT_GT(large.memory_bytes, small.memory_bytes);
}

}  // namespace
}  // namespace flyball
