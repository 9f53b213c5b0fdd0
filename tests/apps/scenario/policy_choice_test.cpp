// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/scenario/policy_choice.h"

#include "flyball/governors/policy_conformance.h"
#include "flyball/scenario/files.h"

#include "scratch_folder.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(PolicyChoice, is_a_preset_a_policy_or_a_file) {
  const ScratchFolder scratch;
  const std::string mine =
      scratch.file("mine.toml", "policy = 'fixed'\n[parameters]\nresolution_m = 0.3\n");
  for (const std::string& name : {std::string{"two_level"}, std::string{"density"}, mine}) {
    const auto choice = choose_policy(name, Plugins{}, 1);
    ASSERT_TRUE(choice.ok()) << choice.error().message;
    EXPECT_TRUE(choice->started(conformance_knobs(), conformance_board()).ok()) << name;
  }
}

TEST(PolicyChoice, that_does_not_exist_is_named_with_the_way_out) {
  EXPECT_EQ("no policy \"just_in_tme\"; try: flyball list policies",
            choose_policy("just_in_tme", Plugins{}, 1).error().message);
  const std::string message = choose_policy("./gone.lua", Plugins{}, 1).error().message;
  EXPECT_NE(std::string::npos, message.find("no file \"./gone.lua\" to read the policy from; give "
                                            "a path to a .toml, .lua or .so file"))
      << message;
}

TEST(PolicyChoice, says_which_library_would_run_without_loading_it) {
  const ScratchFolder scratch;
  const std::string library = scratch.file("mine.so", "nothing that could be loaded");
  EXPECT_EQ(library, library_of_policy(library));
  const std::string preset = scratch.file("mine.toml", "policy = 'mine.so'\n");
  EXPECT_EQ(library, library_of_policy(preset));
  for (const std::string& halves : {"application = '" + library + "'\nclock = 'schedutil_10ms'\n",
                                    "application = 'two_level'\nclock = '" + preset + "'\n"}) {
    EXPECT_EQ(library, library_of_policy(scratch.file("both.toml", halves)));
  }
  const std::string script = scratch.file("mine.lua", "function decide(seen) end\n");
  for (const std::string& harmless :
       {std::string{"two_level"}, std::string{"density"}, std::string{"just_in_tme"},
        std::string{"two_level_schedutil_10ms"}, std::string{"./gone.so"}, script}) {
    EXPECT_EQ("", library_of_policy(harmless)) << harmless;
  }
}

TEST(PolicyChoice, consists_of_all_files_that_a_combination_names) {
  const ScratchFolder folder;
  const std::string rule = folder.file("rule.lua", "function decide() return {} end");
  const std::string nested = folder.file("nested.toml", "policy = \"" + rule + "\"\n");
  const std::string both =
      folder.file("both.toml", "application = \"" + nested + "\"\nclock = \"schedutil_10ms\"\n");
  EXPECT_EQ(files_behind_policy(both),
            (std::vector<std::string>{both, nested, rule,
                                      find_shipped("presets", "schedutil_10ms").value()}));
  EXPECT_TRUE(files_behind_policy("nosuch").empty());
}

}  // namespace
}  // namespace flyball
