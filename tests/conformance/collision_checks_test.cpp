// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/conformance/collision_check_conformance.h"

#include "kernel_trials.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// An honest checker whose answer is spoilt.
class Culprit final : public CollisionChecker {
 public:
  explicit Culprit(std::string crime) : crime_{std::move(crime)} {}

  PathCheck check(const OccupancyView& map,
                  const PathSpan& span,
                  const Cylinder& body,
                  Work& work) override {
    if (crime_ == "sampling") {
      return sampled(map, span, body, work);
    }
    PathSpan asked = span;
    asked.from_m = crime_ == "behind" ? 0.0 : span.from_m;
    asked.horizon_m = crime_ == "horizon" ? 99.0 : span.horizon_m;
    Work honest;
    const Cylinder thin{0.5 * body.radius_m, body.half_height_m};
    PathCheck found = honest_->check(map, asked, crime_ == "thin" ? thin : body, honest);
    if (crime_ == "timid" && found.blocked_at_m) {
      found.blocked_at_m = std::max(0.0, *found.blocked_at_m - 1.0);
    }
    if (crime_ == "unknown" && !found.blocked_at_m && found.known_free_m < span.horizon_m) {
      found.blocked_at_m = found.known_free_m;
    }
    if (crime_ == "optimist") {
      found.known_free_m = span.horizon_m;
    }
    if (crime_ == "remembers") {
      std::swap(found, last_);
    }
    work.add("poses", crime_ == "idle"        ? 0.0
                      : crime_ == "shrinking" ? 1e3 / (1.0 + honest.count("poses"))
                                              : honest.count("poses"));
    return found;
  }

 private:
  static PathCheck sampled(const OccupancyView& map,
                           const PathSpan& span,
                           const Cylinder& body,
                           Work& work) {
    PathCheck found;
    if (span.path == nullptr || span.path->empty()) {
      return found;
    }
    for (double s_m = span.from_m; s_m < span.path->length_m(); s_m += 0.9) {
      work.add("poses", 1.0);
      if (map.body_state(span.path->at(s_m).p_W, body) == CellState::occupied) {
        found.blocked_at_m = s_m;
        break;
      }
    }
    return found;
  }

  std::string crime_;
  std::unique_ptr<CollisionChecker> honest_{
      kit::kernels().make<CollisionChecker>("swept_cylinder")};
  PathCheck last_{};
};

TEST(CollisionChecks, keep_their_contract) {
  kit::try_all_registered<CollisionCheckConformance, CollisionChecker>();
}

TEST(CollisionCheckConformance, finds_each_kind_of_breach) {
  kit::expect_crimes_found<CollisionCheckConformance, CollisionChecker>(
      [](const std::string& crime) { return std::make_unique<Culprit>(crime); },
      {{"sampling", "misses an obstacle that is thinner than its steps"},
       {"behind", "looks behind the span's beginning"},
       {"horizon", "does not keep to the horizon"},
       {"thin", "misses an occupied cell that the body hits"},
       {"timid", "reports a collision where there is none"},
       {"unknown", "reports a collision with unknown space"},
       {"optimist", "calls space free that is not known to be"},
       {"remembers", "answers differently after other questions"},
       {"idle", "counts no poses"},
       {"shrinking", "counts less work for a larger input"}});
}

}  // namespace
}  // namespace flyball
