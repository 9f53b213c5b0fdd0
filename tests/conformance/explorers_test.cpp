// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/conformance/explorer_conformance.h"

#include "kernel_trials.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// An honest explorer whose step is spoilt.
class ExplorerCulprit final : public Explorer {
 public:
  explicit ExplorerCulprit(std::string crime) : crime_{std::move(crime)} {}

  ExploreStep explore(const ExploreRequest& request, const OccupancyView& map) override {
    ExploreRequest asked = request;
    if (crime_ == "forgets") {
      asked.taken.clear();
    } else if (crime_ == "remembers") {
      asked.seed += all_missions_++;
    } else if (crime_ == "splits") {
      asked.seed += static_cast<std::uint64_t>(request.settings.threads);
    }
    ExploreStep step = honest_->explore(asked, map);
    spoil(step, request);
    return step;
  }

 private:
  void spoil(ExploreStep& step, const ExploreRequest& request) const {
    if (crime_ == "restless" && !step.next) {
      step.next = request.from;
    } else if (crime_ == "idle") {
      step.work = {};
    } else if (crime_ == "shrinking") {
      step.work = {};
      step.work.add("iterations", 100.0 / request.settings.iterations);
    } else if (crime_ == "tired") {
      step.next.reset();
    } else if (step.next) {
      spoil_view(*step.next, request, step);
    }
  }
  void spoil_view(Viewpoint& next, const ExploreRequest& request, ExploreStep& step) const {
    const Vec3 edge = next.p_W - request.from.p_W;
    if (crime_ == "leaps") {
      next.p_W = request.from.p_W + edge.normalized() * 20.0;
    } else if (crime_ == "long_edge" && !step.is_far) {
      next.p_W = request.from.p_W + Vec3{4.5, 0.0, 0.0};
    } else if (crime_ == "dives" && !step.is_far) {
      next.p_W = request.from.p_W + Vec3{0.1, 0.0, 0.6};
    } else if (crime_ == "bold") {
      next.p_W = {11.0, 3.0, 1.2};
    } else if (crime_ == "gainless") {
      step.gain_m3 = 0.0;
    }
  }

  inline static std::uint64_t all_missions_ = 0;
  std::string crime_;
  std::unique_ptr<Explorer> honest_{kit::kernels().make<Explorer>("nbvp")};
};

TEST(Explorers, keep_their_contract) {
  kit::try_all_registered<ExplorerConformance, Explorer>();
}

TEST(ExplorerConformance, finds_each_kind_of_breach) {
  kit::expect_crimes_found<ExplorerConformance, Explorer>(
      [](const std::string& crime) { return std::make_unique<ExplorerCulprit>(crime); },
      {{"forgets", "takes a view again that was had"},
       {"remembers", "explores differently in a second mission"},
       {"splits", "explores differently with several threads"},
       {"restless", "finds something to see where all is known"},
       {"idle", "counts no iterations"},
       {"shrinking", "counts less work for a larger input"},
       {"tired", "finds nothing to see where half of the volume is unknown"},
       {"leaps", "goes out of the bounds"},
       {"long_edge", "takes a longer edge than it may"},
       {"dives", "takes a steeper edge than it may"},
       {"bold", "stands where the body has no known-free room"},
       {"gainless", "goes where it gains nothing"}});
}

}  // namespace
}  // namespace flyball
