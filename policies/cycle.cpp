// SPDX-License-Identifier: BSD-3-Clause
//
// The map's resolution goes to and fro at a fixed period, whatever is seen: to find out what
// switching itself does to a map and to a flight.

#include "flyball/governors/policy.h"
#include "flyball/runtime/registry.h"

#include <cmath>

namespace {

class Cycle final : public flyball::Policy {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"fine_m", 0.15, 0.05, 2.0, "Resolution of the first period, the third, ..."},
            {"coarse_m", 0.60, 0.05, 2.0, "Resolution of the second period, the fourth, ..."},
            {"period_s", 5.0, 0.1, 3600.0, "Time between two changes."}};
  }

  flyball::Status start(const flyball::Parameters& given,
                        const flyball::KnobSettings& knobs,
                        const flyball::BoardModel& /*board*/) override {
    fine_m_ = given.number("fine_m");
    coarse_m_ = given.number("coarse_m");
    period_s_ = given.number("period_s");
    if (knobs.spec(knob) == nullptr) {
      return flyball::Error{
          flyball::ErrorCode::invalid_input,
          "policy \"cycle\": there is no knob " + std::string{knob} + "; try: flyball list knobs"};
    }
    return flyball::Done{};
  }

  [[nodiscard]] flyball::Decision decide(const flyball::Observation& seen) noexcept override {
    const double elapsed_s = flyball::to_seconds(seen.now.time_since_epoch());
    const bool is_fine = std::fmod(elapsed_s, 2.0 * period_s_) < period_s_;
    flyball::Decision wish;
    wish.reason = flyball::Reason::fixed;
    wish.set(knob, is_fine ? fine_m_ : coarse_m_);
    return wish;
  }

 private:
  static constexpr const char* knob = "map.resolution_m";

  double fine_m_{};
  double coarse_m_{};
  double period_s_{};
};

}  // namespace

FLYBALL_PLUGIN(cycle) {
  registry.add<flyball::Policy>("cycle", [] { return std::make_unique<Cycle>(); });
}
