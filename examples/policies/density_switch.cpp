// SPDX-License-Identifier: BSD-3-Clause
//
// The two-level switch as a shared library: a fine map where obstacles stand close, a coarse one in
// the open. It is built against two headers and links nothing of Flyball.
//   flyball policy check build/ci/examples/libdensity_switch.so
//   flyball run delivery_forest --policy build/ci/examples/libdensity_switch.so

#include "flyball/governors/plugin_policy.h"

namespace {

class DensitySwitch final : public flyball::PluginPolicy {
 public:
  static flyball::PluginDescription description() {
    return {"density_switch",
            "Fine among obstacles, coarse in the open",
            {{"fine_m", 0.15, 0.05, 2.0, "Resolution where obstacles are dense."},
             {"coarse_m", 0.60, 0.05, 2.0, "Resolution in the open."},
             {"enter_density", 0.06, 0.0, 1.0, "At or above: fine."},
             {"leave_density", 0.045, 0.0, 1.0, "At or below: coarse."},
             {"min_fine_s", 2.0, 0.0, 3600.0, "Fine lasts at least this long."}}};
  }

  DensitySwitch(const flyball::PluginHost& /*host*/, const flyball::PluginStart& start)
      : resolution_{start.knob("map.resolution_m")},
        fine_m_{start.parameter("fine_m")},
        coarse_m_{start.parameter("coarse_m")},
        enter_{start.parameter("enter_density")},
        leave_{start.parameter("leave_density")},
        min_fine_ns_{static_cast<std::int64_t>(1e9 * start.parameter("min_fine_s"))} {
    if (fine_m_ >= coarse_m_) {
      throw std::invalid_argument{"fine_m must be below coarse_m"};
    }
  }

  void decide(const FlyballObservation& seen, flyball::PluginWishes& wishes) override {
    if (!fine_since_ns_ && seen.obstacle_density >= enter_) {
      fine_since_ns_ = seen.now_ns;
    } else if (fine_since_ns_ && seen.obstacle_density <= leave_ &&
               seen.now_ns - *fine_since_ns_ >= min_fine_ns_) {
      fine_since_ns_.reset();
    }
    wishes.because(flyball_reason_density);
    wishes.set(resolution_, fine_since_ns_ ? fine_m_ : coarse_m_);
  }

 private:
  flyball::PluginKnob resolution_;
  double fine_m_;
  double coarse_m_;
  double enter_;
  double leave_;
  std::int64_t min_fine_ns_;
  std::optional<std::int64_t> fine_since_ns_{};  ///< Empty: coarse.
};

}  // namespace

const FlyballPolicy* flyball_policy() {
  return flyball::PluginEntry<DensitySwitch>::policy();
}
