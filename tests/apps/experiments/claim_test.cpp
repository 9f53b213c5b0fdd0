// SPDX-License-Identifier: BSD-3-Clause

#include "experiments/framework/claim.h"

#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

Claim claim_of(double paper, const MedianInterval& ours) {
  Claim claim{"made"};
  claim.paper = PaperValue{paper, "table"};
  claim.ours = {ours, 3};
  return claim;
}

Claim claim_of(double paper, double ours) {
  return claim_of(paper, MedianInterval{ours, ours, ours});
}

TEST(Claim, is_reproduced_within_a_quarter_of_the_papers_number) {
  EXPECT_EQ(verdict_of(claim_of(4.0, 5.0)), Verdict::reproduced);
  EXPECT_EQ(verdict_of(claim_of(4.0, 3.0)), Verdict::reproduced);
  EXPECT_EQ(verdict_of(claim_of(4.0, 5.01)), Verdict::not_reproduced);
  EXPECT_EQ(verdict_of(claim_of(4.0, 2.99)), Verdict::not_reproduced);
  EXPECT_EQ(verdict_of(claim_of(-4.0, -5.0)), Verdict::reproduced);
  EXPECT_EQ(verdict_of(claim_of(-4.0, 4.0)), Verdict::not_reproduced);
}

TEST(Claim, near_zero_needs_a_slack) {
  Claim claim = claim_of(0.0, 3.0);
  EXPECT_EQ(verdict_of(claim), Verdict::not_reproduced);
  EXPECT_EQ(verdict_of(claim_of(0.0, 0.0)), Verdict::reproduced);
  claim.slack = 5.0;
  EXPECT_EQ(verdict_of(claim), Verdict::reproduced);
}

TEST(Claim, has_the_same_trend_only_with_its_whole_interval) {
  Claim claim = claim_of(4.8, MedianInterval{1.9, 1.2, 2.5});
  EXPECT_EQ(verdict_of(claim), Verdict::not_reproduced) << "nobody said what no effect is";
  claim.neutral = 1.0;
  EXPECT_EQ(verdict_of(claim), Verdict::same_trend);
  claim.ours.value->lo = 0.98;
  EXPECT_EQ(verdict_of(claim), Verdict::not_reproduced);

  Claim falling = claim_of(0.16, MedianInterval{0.54, 0.4, 0.8});
  falling.neutral = 1.0;
  EXPECT_EQ(verdict_of(falling), Verdict::same_trend);
  falling.ours.value->hi = 1.1;
  EXPECT_EQ(verdict_of(falling), Verdict::not_reproduced);

  Claim none = claim_of(1.0, 2.0);
  none.neutral = 1.0;
  EXPECT_EQ(verdict_of(none), Verdict::not_reproduced) << "no effect has no trend";
}

TEST(Claim, takes_limits_for_limits) {
  Claim least = claim_of(300.0, 290.0);
  least.match = PaperMatch::at_least;
  EXPECT_EQ(verdict_of(least), Verdict::not_reproduced);
  least.ours.value->median = 900.0;
  EXPECT_EQ(verdict_of(least), Verdict::reproduced);
  Claim most = claim_of(5.0, 5.1);
  most.match = PaperMatch::at_most;
  EXPECT_EQ(verdict_of(most), Verdict::not_reproduced);
  most.ours.value->median = 0.1;
  EXPECT_EQ(verdict_of(most), Verdict::reproduced);
}

TEST(Claim, says_what_is_missing) {
  Claim claim = claim_of(4.0, 4.0);
  claim.paper.reset();
  EXPECT_EQ(verdict_of(claim), Verdict::ours);
  claim.ours = {};
  EXPECT_EQ(verdict_of(claim), Verdict::not_measured);
  EXPECT_EQ(measured_text(claim.ours, "s"), "-");
}

TEST(Claim, turns_a_change_in_percent_into_a_ratio) {
  EXPECT_NEAR(paper_change(-84.0, "text").value, 0.16, 1e-12);
  EXPECT_NEAR(paper_change(267.0, "text").value, 3.67, 1e-12);
}

TEST(Claim, measures_how_much_of_the_gap_a_cause_closes) {
  const Claim claim = claim_of(0.16, 0.54);
  const auto share = [&claim](double changed) {
    return share_of_gap(claim, {"changed", computed(changed)});
  };
  EXPECT_NEAR(*share(0.16), 1.0, 1e-12);
  EXPECT_NEAR(*share(0.54), 0.0, 1e-12);
  EXPECT_NEAR(*share(std::sqrt(0.16 * 0.54)), 0.5, 1e-12);
  EXPECT_LT(*share(0.8), 0.0);
  EXPECT_FALSE(share_of_gap(claim, {"not flown", {}}));
  EXPECT_FALSE(share_of_gap(claim_of(0.0, 0.5), {"changed", computed(0.2)}));
  EXPECT_FALSE(share_of_gap(claim_of(0.5, 0.5), {"changed", computed(0.2)}));
}

TEST(Claim, tells_of_the_strongest_cause_first) {
  Claim claim = claim_of(4.0, 2.0);
  EXPECT_EQ(cause_text(claim), "");
  claim.causes = {
      {"wider", computed(1.0)}, {"slower", {MedianInterval{2.828427, 2.0, 3.0}, 3}}, {"other", {}}};
  EXPECT_EQ(cause_text(claim),
            "slower: 2.83 [2.00, 3.00], n 3, which closes 50 % of the gap. wider: 1.000, "
            "computed, which widens the gap by 100 %. other: -.");
}

TEST(Claim, says_nothing_of_the_gap_where_there_is_hardly_one) {
  Claim claim = claim_of(4.0, 3.9);
  claim.causes = {{"slower", computed(2.0)}};
  EXPECT_EQ(cause_text(claim), "slower: 2.00, computed.");
}

TEST(Claim, prints_a_number_with_its_interval_and_count) {
  EXPECT_EQ(measured_text({MedianInterval{123.4, 120.0, 130.0}, 5}, "W"),
            "123.4 [120.0, 130.0] W, n 5");
  EXPECT_EQ(measured_text(computed(17.25), "min"), "17.25 min, computed");
}

}  // namespace
}  // namespace flyball
