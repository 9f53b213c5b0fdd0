// SPDX-License-Identifier: BSD-3-Clause
//
// MAVBench's two-level switch (MICRO 2018): a coarse map in the open, where it is cheap and lets
// the vehicle fly fast, a fine one where obstacles stand close, so that it fits through a door.
// Nothing but the density of obstacles decides.

#include "flyball/governors/policy.h"
#include "flyball/governors/required_knobs.h"
#include "flyball/runtime/registry.h"
#include "flyball/runtime/text/number_text.h"

#include <optional>
#include <string>
#include <vector>

namespace {

class Density final : public flyball::Policy {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    // Share of .8 m columns within 6 m, measured in delivery_outdoor_to_indoor (seed 2, both maps):
    // beside a single block .034 (three quarters) to .051 (nine tenths), 4 m before a facade .068
    // and more, in rooms .085-.20. The thresholds stand between the first two.
    return {{"fine_m", 0.15, 0.05, 2.0, "Resolution where obstacles are dense."},
            {"coarse_m", 0.80, 0.05, 2.0, "Resolution in the open."},
            {"enter_density", 0.06, 0.0, 1.0, "At or above this share of columns: fine."},
            {"leave_density", 0.045, 0.0, 1.0, "At or below this share of columns: coarse."},
            {"min_fine_s", 2.0, 0.0, 3600.0, "Fine lasts at least this long."},
            {"failures_to_fine", 3.0, 0.0, 1000.0,
             "After so many searches without a path: fine, whatever the density. 0: never."},
            // The first plan in fine cells leads through a gap that coarse cells close, so a switch
            // back before that gap would block the path again. 15 s at some 2 m/s are more than the
            // 20 m range of a long sensor.
            {"stuck_fine_s", 15.0, 0.0, 3600.0, "Then fine lasts at least this long."},
            {"fine_range_m", 0.0, 0.0, 100.0, "Range where fine; 0: as the scenario says."},
            {"coarse_range_m", 0.0, 0.0, 100.0, "Range where coarse; 0: as the scenario says."}};
  }

  flyball::Status start(const flyball::Parameters& given,
                        const flyball::KnobSettings& knobs,
                        const flyball::BoardModel& /*board*/) override {
    fine_m_ = given.number("fine_m");
    coarse_m_ = given.number("coarse_m");
    enter_ = given.number("enter_density");
    leave_ = given.number("leave_density");
    min_fine_ = flyball::from_seconds(given.number("min_fine_s"));
    stuck_fine_ = flyball::from_seconds(given.number("stuck_fine_s"));
    failures_to_fine_ = given.number("failures_to_fine");
    fine_range_m_ = given.number("fine_range_m");
    coarse_range_m_ = given.number("coarse_range_m");
    fine_since_.reset();
    fine_until_ = flyball::MissionTime{};
    if (fine_m_ >= coarse_m_) {
      return refused("fine_m = " + flyball::short_number_text(fine_m_) +
                     " must be below coarse_m = " + flyball::short_number_text(coarse_m_));
    }
    if (leave_ > enter_) {
      return refused("leave_density = " + flyball::short_number_text(leave_) +
                     " must not be above enter_density = " + flyball::short_number_text(enter_));
    }
    const bool sets_range = fine_range_m_ > 0.0 || coarse_range_m_ > 0.0;
    const auto needed =
        sets_range ? std::vector<std::string>{knob, range_knob} : std::vector<std::string>{knob};
    if (flyball::Status status = flyball::require_knobs("policy \"density\"", knobs, needed);
        !status) {
      return status;
    }
    if (sets_range) {  // With one of them given, the other one must come back.
      const double usual_m = knobs.value(range_knob);
      fine_range_m_ = fine_range_m_ > 0.0 ? fine_range_m_ : usual_m;
      coarse_range_m_ = coarse_range_m_ > 0.0 ? coarse_range_m_ : usual_m;
    }
    return flyball::Done{};
  }

  [[nodiscard]] flyball::Decision decide(const flyball::Observation& seen) noexcept override {
    const bool is_stuck =
        failures_to_fine_ > 0.0 && static_cast<double>(seen.planner_failures) >= failures_to_fine_;
    if (is_stuck) {
      fine_until_ = seen.now + stuck_fine_;
    }
    if (!fine_since_ && (is_stuck || seen.obstacle_density >= enter_)) {
      fine_since_ = seen.now;
    } else if (fine_since_ && !is_stuck && seen.now >= fine_until_ &&
               seen.obstacle_density <= leave_ && seen.now - *fine_since_ >= min_fine_) {
      fine_since_.reset();
    }
    flyball::Decision wish;
    wish.reason = flyball::Reason::density;
    wish.set(knob, fine_since_ ? fine_m_ : coarse_m_);
    if (fine_range_m_ > 0.0) {
      wish.set(range_knob, fine_since_ ? fine_range_m_ : coarse_range_m_);
    }
    return wish;
  }

 private:
  static constexpr const char* knob = "map.resolution_m";
  static constexpr const char* range_knob = "map.range_m";
  static flyball::Error refused(const std::string& why) {
    return {flyball::ErrorCode::invalid_input, "policy \"density\": " + why};
  }

  double fine_m_{};
  double coarse_m_{};
  double enter_{};
  double leave_{};
  double failures_to_fine_{};
  double fine_range_m_{};  ///< Both 0, or neither.
  double coarse_range_m_{};
  flyball::Duration min_fine_{};
  flyball::Duration stuck_fine_{};
  flyball::MissionTime fine_until_{};               ///< At least.
  std::optional<flyball::MissionTime> fine_since_;  ///< Empty: coarse.
};

}  // namespace

FLYBALL_PLUGIN(density) {
  registry.add<flyball::Policy>("density", [] { return std::make_unique<Density>(); });
}
