// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/conformance/coverage_planner_conformance.h"

#include "kernel_trials.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

class CoverageCulprit final : public CoveragePlanner {
 public:
  explicit CoverageCulprit(std::string crime) : crime_{std::move(crime)} {}

  Result<CoveragePath> cover(const CoverageRequest& request) override {
    CoverageRequest asked = request;
    if (crime_ == "credulous") {
      asked.lanes = std::max(asked.lanes, 1);
    }
    auto path = honest_->cover(asked);
    if (!path) {
      return path;
    }
    auto& points_W = path->waypoints_W;
    if (crime_ == "lazy") {
      points_W.erase(points_W.begin() + 1, points_W.begin() + 3);
    } else if (crime_ == "elsewhere") {
      points_W.back().x() += 1.0;
    } else if (crime_ == "sinks") {
      points_W[1].z() -= 2.0;
    } else if (crime_ == "boasts") {
      path->out_m = 0.0;
    } else if (crime_ == "idle") {
      path->work = {};
    } else if (crime_ == "shrinking") {
      path->work = {};
      path->work.add("waypoints", 100.0 / request.lanes);
    } else if (crime_ == "remembers") {
      points_W[1].x() += 1e-3 * answered_++;
    }
    return path;
  }

 private:
  std::string crime_;
  std::unique_ptr<CoveragePlanner> honest_{kit::kernels().make<CoveragePlanner>("lawnmower")};
  int answered_{};
};

TEST(CoveragePlanners, keep_their_contract) {
  kit::try_all_registered<CoveragePlannerConformance, CoveragePlanner>();
}

TEST(CoveragePlannerConformance, finds_each_kind_of_breach) {
  kit::expect_crimes_found<CoveragePlannerConformance, CoveragePlanner>(
      [](const std::string& crime) { return std::make_unique<CoverageCulprit>(crime); },
      {{"credulous", "accepts an area without extent"},
       {"lazy", "leaves a part of the area out"},
       {"elsewhere", "does not lead from the start to the end"},
       {"sinks", "leaves the height of flight"},
       {"boasts", "is wrong about how far the area is"},
       {"idle", "counts no waypoints"},
       {"shrinking", "counts less work for a larger input"},
       {"remembers", "answers differently after other questions"}});
}

}  // namespace
}  // namespace flyball
