// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/governing/node_places.h"

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

class ToldBoard final : public Board {
 public:
  [[nodiscard]] BoardReading read() const override { return {}; }
  void request(const OperatingPoint& /*point*/) override {}
  void place(std::string_view node, bool on_edge) override { told.emplace_back(node, on_edge); }
  std::vector<std::pair<std::string, bool>> told{};
};

KnobSpec knob(const std::string& name, double fallback) {
  return {name, "place", "node", {0.0, 1.0}, 0.0, 1.0, fallback, "where"};
}

TEST(NodePlaces, tell_the_board_at_first_and_then_only_what_changes) {
  KnobSettings knobs{{knob("offload.map", 0.0), knob("offload.plan", 1.0), knob("map.other", 1.0)}};
  ToldBoard board;
  NodePlaces places;
  using Told = std::vector<std::pair<std::string, bool>>;
  places.apply(knobs, board);
  EXPECT_EQ(board.told, (Told{{"map", false}, {"plan", true}}));
  places.apply(knobs, board);
  EXPECT_EQ(board.told.size(), 2U);
  ASSERT_TRUE(knobs.set("offload.map", 1.0));
  places.apply(knobs, board);
  EXPECT_EQ(board.told.back(), (std::pair{std::string{"map"}, true}));
  EXPECT_EQ(board.told.size(), 3U);
}

}  // namespace
}  // namespace flyball
