// SPDX-License-Identifier: BSD-3-Clause
#include "mission_energy/view_budget.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double half_nodes = 3.0;

/// A decision right after a search that took so long.
Observation searched(double t_s, double search_s) {
  Observation seen;
  seen.now = MissionTime{from_seconds(t_s)};
  seen.stage(Stage::explore).latency = from_seconds(search_s);
  seen.stage(Stage::explore).load = search_s / 0.25;
  return seen;
}

/// A decision while nothing is searched for: the newest search's latency still stands there.
Observation flying(double t_s, double last_search_s) {
  Observation seen = searched(t_s, last_search_s);
  seen.stage(Stage::explore).load = 0.0;
  return seen;
}

/// Of a vehicle that searches for so long for each node, and needs so long for all else.
double settled_nodes(double node_s, double else_s) {
  ViewBudget views{half_nodes};
  double t_s = 0.0;
  for (int view = 0; view < 50; ++view) {
    const double search_s = node_s * views.nodes();
    t_s += search_s + else_s;
    views.note(searched(t_s, search_s));
  }
  return views.nodes();
}

TEST(ViewBudget, is_as_usual_until_two_searches_are_over) {
  ViewBudget views{half_nodes};
  const double usual = views.nodes();
  EXPECT_DOUBLE_EQ(usual, 9.0);
  views.note(flying(0.0, 0.0));
  views.note(searched(4.0, 1.8));
  views.note(flying(4.25, 1.8));
  EXPECT_EQ(views.nodes(), usual);
  views.note(searched(21.8, 1.8));
  // .2 s for each of 9 nodes, 16 s for all else.
  EXPECT_DOUBLE_EQ(views.nodes(), 15.0);
}

TEST(ViewBudget, shows_the_most_a_second) {
  for (const double node_s : {0.05, 0.2, 1.0}) {
    const double found = settled_nodes(node_s, 6.0);
    const auto shown_1_s = [&](double nodes) {
      return nodes / ((nodes + half_nodes) * (6.0 + node_s * nodes));
    };
    EXPECT_GE(shown_1_s(found), shown_1_s(found - 1.0)) << node_s;
    EXPECT_GE(shown_1_s(found), shown_1_s(found + 1.0)) << node_s;
  }
}

TEST(ViewBudget, grows_on_a_faster_computer_and_where_flights_are_long) {
  EXPECT_GT(settled_nodes(0.05, 6.0), settled_nodes(0.2, 6.0));
  EXPECT_GT(settled_nodes(0.2, 20.0), settled_nodes(0.2, 6.0));
}

TEST(ViewBudget, is_never_below_one_node) {
  EXPECT_EQ(settled_nodes(100.0, 0.0), 1.0);
}

TEST(ViewBudget, stays_as_it_is_while_nothing_is_searched_for) {
  ViewBudget views{half_nodes};
  const double usual = views.nodes();
  for (int i = 0; i < 100; ++i) {
    views.note(flying(i, 0.0));
  }
  EXPECT_EQ(views.nodes(), usual);
}

}  // namespace
}  // namespace flyball
