// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
#include "flyball/runtime/board/linux_board.h"

#include "fake_kernel.h"
#include "fake_trees.h"
#include "killed_session.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

using Plant = void (*)(const fake::Tree&);

struct Planted {
  const char* name;
  Plant plant;
};

class KilledBoard : public testing::TestWithParam<Planted> {};

/// Changes clocks and cores twice, and ends properly.
void fly(LinuxSystem& system, const std::string& run_folder) {
  LinuxBoardOptions options;
  options.keeper.run_folder = run_folder;
  options.file.may_unplug_cores = true;
  options.unplug_cores = true;
  options.measure_clock = [] { return std::optional<Hertz>{}; };
  auto board = LinuxBoard::open(system, options);
  if (board) {
    const std::vector<Hertz> clocks = (*board)->model().frequencies;
    (*board)->request({2, clocks.front()});
    (*board)->refresh(std::chrono::seconds{2});
    (*board)->request({3, clocks[clocks.size() / 2]});
    (void)(*board)->close();
  }
}

TEST_P(KilledBoard, has_every_file_back_byte_for_byte_whichever_write_it_is_killed_at) {
  const fake::Tree tree;
  GetParam().plant(tree);
  const auto before = tree.all();
  int kills = 0;
  for (const bool is_after : {false, true}) {
    bool was_killed = true;
    for (int n = 1; was_killed; ++n) {
      const std::string run_folder = tree.root() + "/run";
      was_killed = fake::was_killed(fake::run_apart(run_folder, [&] {
        fake::Kernel kernel{tree.root()};
        (is_after ? kernel.die_after : kernel.die_before) = n;
        fly(kernel, run_folder);
      }));
      kills += was_killed ? 1 : 0;
      for (const auto& [path, content] : tree.all()) {
        if (path.find("scaling_cur_freq") == std::string::npos) {  // a reading
          ASSERT_EQ(content, before.at(path)) << path << ", killed at write " << n;
        }
      }
      ASSERT_EQ(tree.get("/run/board.journal"), "");
    }
  }
  EXPECT_GE(kills, 2 * 8);
}

INSTANTIATE_TEST_SUITE_P(Boards,
                         KilledBoard,
                         testing::Values(Planted{"tx2_r28", fake::plant_tx2_r28},
                                         Planted{"tx2_r32", fake::plant_tx2_r32},
                                         Planted{"orin", fake::plant_orin},
                                         Planted{"pi5", fake::plant_pi5},
                                         Planted{"x86", fake::plant_x86}),
                         [](const auto& one) { return std::string{one.param.name}; });

}  // namespace
}  // namespace flyball
