// SPDX-License-Identifier: BSD-3-Clause
//
// A rule that Flyball does not have: look as far as the vehicle needs to stop, and not farther.

#include <flyball/governors/plugin_policy.h>

class LookToStop final : public flyball::PluginPolicy {
 public:
  static flyball::PluginDescription description() {
    return {"look_to_stop",
            "Range in proportion to the distance of a stop",
            {{"times", 2.0, 1.0, 10.0, "Stopping distances that the map reaches."}}};
  }

  LookToStop(const flyball::PluginHost& /*host*/, const flyball::PluginStart& start)
      : range_{start.knob("map.range_m")},
        resolution_{start.knob("map.resolution_m")},
        times_{start.parameter("times")} {}

  void decide(const FlyballObservation& seen, flyball::PluginWishes& wishes) override {
    constexpr double deceleration_m_s2 = 6.0;
    const double reaction_s = 1e-9 * static_cast<double>(seen.latency_bound_ns);
    const double stop_m =
        seen.speed_m_s * (reaction_s + seen.speed_m_s / (2.0 * deceleration_m_s2));
    wishes.because(flyball_reason_deadline);
    wishes.set(range_, 4.0 + times_ * stop_m);
    wishes.set(resolution_, seen.obstacle_density > 0.06 ? 0.15 : 0.60);
  }

 private:
  flyball::PluginKnob range_;
  flyball::PluginKnob resolution_;
  double times_;
};

const FlyballPolicy* flyball_policy() {
  return flyball::PluginEntry<LookToStop>::policy();
}
