// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/module.h"

#include <filesystem>

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(Module, lies_beside_the_programs_folder) {
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
  EXPECT_EQ(module_path("geodesy"),
            (program.parent_path().parent_path() / "lib/flyball/geodesy.so").string());
}

TEST(Module, gives_its_functions) {
  EXPECT_NE(module_function("geodesy", "flyball_geodetic_to_enu"), nullptr);
}

TEST(Module, gives_nothing_that_is_not_there) {
  EXPECT_EQ(module_function("geodesy", "no_such_function"), nullptr);
  EXPECT_EQ(module_function("no_such_module", "flyball_geodetic_to_enu"), nullptr);
}

}  // namespace
}  // namespace flyball
