// SPDX-License-Identifier: BSD-3-Clause

#include "flyball_program.h"
#include <string>

#include <gtest/gtest.h>

namespace {

TEST(WrongNames, are_answered_with_what_was_meant) {
  const FlyballProgram flyball;
  const struct {
    const char* arguments;
    const char* sentence;
  } refused[] = {
      {"run scaning_farm", "did you mean scanning_farm? try: flyball list scenarios"},
      {"config scanning_farm --set scan.heigth_m=1", "did you mean scan.height_m?"},
      {"fit jetson_tx", "did you mean jetson_tx2? try: flyball list platforms"},
      {"board --board jetson_tx", "did you mean jetson_tx2? try: flyball list boards"},
      {"graph package_delivry", "did you mean package_delivery? try: flyball list workloads"},
      {"reproduce resolution_enrgy", "did you mean resolution_energy? try: flyball list"},
      {"tune delivery_forest --try range_m=7 --preset x.txt", "--preset x.txt must end in .toml"},
      {"run delivery_forest --seed 18446744073709551615", "from 0 to 2^63 - 1"},
      {"tournament --worlds delivery_forest --policies two_level --ablate ''",
       "--ablate: is empty"},
      {"localize . --out ''", "--out: is empty"},
      {"map from . --out m.bt --poses ''", "--poses: is empty"},
      {"map from . --out m.bt --localizer ''", "--localizer: is empty"},
      {"board --board ''", "--board: is empty"},
      {"detect . --models ''", "--models: is empty"},
      {"models --folder ''", "--folder: is empty"},
  };
  for (const auto& [arguments, sentence] : refused) {
    const auto outcome = flyball.run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_NE(outcome.errors.find(sentence), std::string::npos) << outcome.errors;
    EXPECT_TRUE(flyball.place.is_empty()) << arguments;
  }
}

TEST(WrongNames, of_the_folder_with_all_data_are_no_empty_list) {
  const FlyballProgram flyball;
  setenv("FLYBALL_DATA", "/nonexistent", 1);
  const auto outcome = flyball.run("list scenarios");
  unsetenv("FLYBALL_DATA");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.errors,
            "flyball: no folder \"/nonexistent/scenarios\" to list; set FLYBALL_DATA to the folder "
            "share/flyball of the install, or of the build\n");
}

}  // namespace
