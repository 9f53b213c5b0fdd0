// SPDX-License-Identifier: BSD-3-Clause

#include "experiments/framework/results.h"

#include "made_sweep.h"
#include <algorithm>

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// Two claims of a paper, one of them off, and one of ours.
Experiment made_experiment() {
  Experiment experiment{
      "Is it <so>?", "Paper (2018)", "One thing is swept.", {"scale of everything"}};
  experiment.evaluate = [](const Evidence& evidence) -> Result<Findings> {
    Claim time{"time, 2 over 1"};
    time.paper = PaperValue{2.0, "table 9"};
    time.ours = ratio(evidence.at("made", {"2"}), evidence.at("made", {"1"}),
                      flight_figure("mission_time_s"));
    Claim off = time;
    off.what = "off";
    off.paper->value = 9.0;
    off.neutral = 1.0;
    off.causes.push_back({"with less <wind>", computed(4.0)});
    Claim lost = off;
    lost.what = "lost";
    lost.neutral.reset();
    lost.causes.clear();
    Claim own{"own", "kJ"};
    own.ours = computed(7.0);
    return Findings{{time, off, lost, own},
                    {{"values", "n 2", DotPlot{"values", {{"x", MedianInterval{1.0, 1.0, 1.0}}}}}},
                    {"A note."}};
  };
  return experiment;
}

ExperimentResult made_result() {
  ExperimentResult result;
  result.named = {"made", made_experiment()};
  result.sweeps["made"] = made_sweep();
  result.commands["made"] = "flyball sweep made --over 'a=1,2'";
  evaluate(result);
  return result;
}

TEST(Results, count_their_verdicts) {
  const ExperimentResult result = made_result();
  EXPECT_EQ(verdict_counts(result.findings), "1 reproduced, 1 same trend, 1 not reproduced");
}

TEST(Results, show_one_line_for_each_experiment_on_a_terminal) {
  const std::string text = to_text({made_result()});
  EXPECT_NE(text.find("made        time, 2 over 1  2      1.985 [1.980, 1.990], n 2  reproduced"),
            std::string::npos)
      << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
}

TEST(Results, write_a_row_for_each_claim) {
  const std::string csv = claims_csv({made_result()});
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
  EXPECT_NE(csv.find("made,\"time, 2 over 1\",,2.0,table 9,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("made,own,kJ,,,7.0,7.0,7.0,0,ours,\n"), std::string::npos) << csv;
}

TEST(Results, make_a_page_of_markdown_that_stays_a_table_whatever_a_name_holds) {
  ExperimentResult result = made_result();
  result.findings.claims.back().what = "own | a\nb";
  const std::string page = experiments_markdown({result});
  EXPECT_NE(page.find("Written by `flyball reproduce made`"), std::string::npos) << page;
  EXPECT_NE(page.find("| time, 2 over 1 | 2 | 1.985 [1.980, 1.990], n 2 | reproduced |  |\n"),
            std::string::npos)
      << page;
  EXPECT_NE(page.find("| own \\| a b | - | 7.00 kJ, computed | ours |  |\n"), std::string::npos)
      << page;
  EXPECT_NE(page.find("A note.\n"), std::string::npos);
  EXPECT_NE(page.find("`flyball sweep made --over 'a=1,2'`\n"), std::string::npos);
}

TEST(Results, make_a_page_that_says_everything_and_needs_no_network) {
  const std::string page = experiments_page({made_result()}, 2);
  for (const char* part :
       {"Is it &lt;so&gt;?", "href=\"#made\"", "id=\"made\"", "table 9", "Paper (2018)",
        "scale of everything", "with less &lt;wind&gt;", "no cause tested", "A note.", "<svg",
        "flyball sweep made --over 'a=1,2'", "4 flights, seeds 1, 2",
        "class=\"verdict same_trend\"", "scale of octomap",
        "1 reproduced, 1 same trend, 1 not reproduced"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
  for (const char* outside : {"http://", "https://", "src=", "@import"}) {
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  }
  EXPECT_EQ(page, experiments_page({made_result()}, 2));
}

TEST(Results, say_why_an_experiment_found_nothing) {
  ExperimentResult result = made_result();
  result.findings = {};
  result.named.experiment.evaluate = [](const Evidence&) -> Result<Findings> {
    return Error{ErrorCode::not_found, "no platform \"x\"; try: flyball list platforms"};
  };
  evaluate(result);
  EXPECT_NE(to_text({result}).find("no platform \"x\""), std::string::npos);
  EXPECT_NE(experiments_page({result}, 1).find("no platform &quot;x&quot;"), std::string::npos);
  result.named.experiment.evaluate = [](const Evidence&) -> Result<Findings> { return Findings{}; };
  evaluate(result);
  EXPECT_EQ(result.trouble, "experiment \"made\" makes no claim");
}

}  // namespace
}  // namespace flyball
