// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/people/person_finding.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

class Search : public testing::Test {
 protected:
  std::optional<Finding> see(const Vec3& p_W, const Vec3& from_W) {
    now += 1s;
    Sighting sighting;
    sighting.p_W = p_W;
    return finding.add(now, sighting, ColourFrame{}, from_W);
  }
  MissionTime now{};
  PersonFinding finding{SearchSettings{2, 1.0, 0.5}};
};

TEST_F(Search, one_sighting_finds_nobody) {
  EXPECT_FALSE(see({5, 0, 1}, {0, 0, 1}));
}

TEST_F(Search, two_sightings_of_a_place_from_two_places_find_somebody_between_them) {
  EXPECT_FALSE(see({5.0, 0, 1}, {0, 0, 1}));
  const auto found = see({5.4, 0, 1}, {1, 0, 1});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->p_W.x(), 5.2, 1e-12);
  EXPECT_EQ(found->at, now);
}

TEST_F(Search, the_same_look_repeated_is_no_agreement) {
  EXPECT_FALSE(see({5, 0, 1}, {0, 0, 1}));
  for (int i = 0; i < 10; ++i) {
    EXPECT_FALSE(see({5, 0, 1}, {0.1, 0, 1}));
  }
}

TEST_F(Search, sightings_of_two_places_do_not_agree) {
  EXPECT_FALSE(see({5, 0, 1}, {0, 0, 1}));
  EXPECT_FALSE(see({8, 0, 1}, {1, 0, 1}));
  EXPECT_EQ(finding.places(), 2U);
}

TEST_F(Search, each_place_that_was_seen_once_is_doubtful_once) {
  EXPECT_FALSE(finding.take_doubt());
  (void)see({5, 0, 1}, {0, 0, 1});
  (void)see({8, 0, 1}, {0, 0, 1});
  const auto first = finding.take_doubt();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->p_W, Vec3(5, 0, 1));
  EXPECT_EQ(first->from_W, Vec3(0, 0, 1));
  EXPECT_EQ(finding.take_doubt().value_or(Doubt{}).p_W, Vec3(8, 0, 1));
  EXPECT_FALSE(finding.take_doubt());
}

TEST_F(Search, nothing_is_doubtful_once_somebody_is_found) {
  (void)see({5, 0, 1}, {0, 0, 1});
  (void)see({8, 0, 1}, {0, 0, 1});
  EXPECT_TRUE(see({5, 0, 1}, {1, 0, 1}));
  EXPECT_FALSE(finding.take_doubt());
}

TEST_F(Search, somebody_is_found_once) {
  (void)see({5, 0, 1}, {0, 0, 1});
  EXPECT_TRUE(see({5, 0, 1}, {1, 0, 1}));
  EXPECT_FALSE(see({5, 0, 1}, {2, 0, 1}));
}

}  // namespace
}  // namespace flyball
