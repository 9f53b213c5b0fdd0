// SPDX-License-Identifier: BSD-3-Clause
//
// The largest cells that leave the narrowest gap ahead open, and a fixed range for each size: the
// opponent that a policy with a search has to beat. Nothing is learned, nothing is compared, and
// the clock stays where it is.

#include "flyball/governors/policy.h"
#include "flyball/governors/required_knobs.h"
#include "flyball/runtime/registry.h"

#include <algorithm>
#include <array>

namespace {

using flyball::Observation;

class GapSwitch final : public flyball::Policy {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"fine_m", 0.0, 0.0, 2.0, "Smallest cells; 0: the mapper's finest, or .15 m."},
            // 1.2 m, the fourth level, blocks starts that lie near the ground or below a ceiling.
            {"levels", 3.0, 2.0, 4.0, "Number of levels."},
            // The first two are those of the preset two_level_tuned, where the command stands. The
            // others are chosen: the fourth is what RoboRun's cameras see.
            {"range_m", 10.0, 2.0, 100.0, "Range with the smallest cells."},
            {"range_2_m", 15.0, 2.0, 100.0, "Range at the second level."},
            {"range_3_m", 22.0, 2.0, 100.0, "Range at the third level."},
            {"range_4_m", 25.0, 2.0, 100.0, "Range at the fourth level."},
            {"body_m", 0.0, 0.0, 5.0, "Width with the tube at a crawl; 0: the vehicle's own."},
            {"narrow_m_s", 2.0, 0.0, 50.0, "A speed limit that means narrow gaps; 0: none does."},
            {"near_m", 8.0, 0.0, 100.0, "From farther on, gaps are looked at on the second level."},
            // As of density.
            {"min_fine_s", 2.0, 0.0, 3600.0, "Smaller cells last at least this long."}};
  }

  flyball::Status start(const flyball::Parameters& given,
                        const flyball::KnobSettings& knobs,
                        const flyball::BoardModel& board) override {
    if (flyball::Status status = flyball::require_knobs("policy \"gap_switch\"", knobs,
                                                        {"map.resolution_m", "map.range_m"});
        !status) {
      return status;
    }
    // The other levels are 2, 4 and 8 times as large.
    cells_m_.front() =
        flyball::smallest_cells_m(*knobs.spec("map.resolution_m"), given.number("fine_m"));
    for (std::size_t i = 1; i < cells_m_.size(); ++i) {
      cells_m_[i] = 2.0 * cells_m_[i - 1];
    }
    ranges_m_ = {given.number("range_m"), given.number("range_2_m"), given.number("range_3_m"),
                 given.number("range_4_m")};
    top_ = static_cast<std::size_t>(given.number("levels")) - 1;
    const double given_m = given.number("body_m");
    body_m_ = given_m > 0.0 ? given_m : board.vehicle.narrow_width_m;
    narrow_m_s_ = given.number("narrow_m_s");
    near_m_ = given.number("near_m");
    min_fine_ = flyball::from_seconds(given.number("min_fine_s"));
    level_ = top_;
    needed_at_ = last_ = flyball::MissionTime{};
    finest_on_m_ = 0.0;
    return flyball::Done{};
  }

  [[nodiscard]] flyball::Decision decide(const Observation& seen) noexcept override {
    const double flown_m = std::max(0.0, seen.speed_m_s) * flyball::to_seconds(seen.now - last_);
    finest_on_m_ = std::max(0.0, finest_on_m_ - flown_m);
    last_ = seen.now;
    move_to(wanted(seen), seen);
    flyball::Decision wish;
    wish.reason = flyball::Reason::density;
    wish.set("map.resolution_m", cells_m_[level_]);
    wish.set("map.range_m", ranges_m_[level_]);
    return wish;
  }

 private:
  // An occupied cell blocks with its full cube, so cells of size r take up to 2 r from a gap, and
  // the map has taken its own share already. A plan through it wants another 2 r.
  [[nodiscard]] std::size_t open_level(const Observation& seen) const {
    constexpr double rounding_m = 1e-9;
    std::size_t level = top_;
    while (level > 0) {
      const double lost_m = 2.0 * std::max(0.0, cells_m_[level] - seen.map_resolution_m);
      if (seen.narrowest_gap_m - lost_m >= body_m_ + 2.0 * cells_m_[level] - rounding_m) {
        break;
      }
      --level;
    }
    return level;
  }

  // A gap that needs the finest cells, and a place where a plan has failed, need them until the
  // vehicle is past: their range is short, and what they do not show yet looks open.
  [[nodiscard]] std::size_t wanted(const Observation& seen) {
    constexpr double past_the_gap_m = 3.0;  // Chosen, as in mission_energy.
    const std::size_t open = open_level(seen);
    const bool is_far = open == 0 && seen.gap_distance_m > near_m_;
    std::size_t level = is_far ? 1 : open;
    if (open == 0 && !is_far) {
      finest_on_m_ = std::max(finest_on_m_, seen.gap_distance_m + past_the_gap_m);
    }
    if (seen.planner_failures > 0) {
      finest_on_m_ = std::max(finest_on_m_, near_m_);
    }
    if (seen.speed_limit_m_s <= narrow_m_s_) {
      // Inside, larger cells would close the door through which the path leads.
      const bool is_within = level_ == 0 && seen.speed_m_s <= narrow_m_s_;
      level = is_within ? 0 : std::min(level, std::size_t{1});
    }
    return finest_on_m_ > 0.0 || seen.planner_failures > 0 ? 0 : level;
  }

  // Smaller cells come at once. Larger ones come later, and not where their cells beside an
  // obstacle would hold the vehicle itself.
  void move_to(std::size_t wanted, const Observation& seen) {
    if (wanted <= level_) {
      needed_at_ = seen.now;
      level_ = wanted;
    } else if (seen.now - needed_at_ >= min_fine_) {
      while (wanted > level_ &&
             !(seen.nearest_obstacle_m >= 0.5 * body_m_ + 2.0 * cells_m_[wanted])) {
        --wanted;
      }
      level_ = wanted;
    }
  }

  std::array<double, 4> cells_m_{};
  std::array<double, 4> ranges_m_{};
  std::size_t top_{};  ///< The coarsest level.
  double body_m_{};
  double narrow_m_s_{};
  double near_m_{};
  flyball::Duration min_fine_{};

  std::size_t level_{};
  double finest_on_m_{};              ///< Distance for which the finest cells are still needed.
  flyball::MissionTime needed_at_{};  ///< The last time that larger cells were not wanted.
  flyball::MissionTime last_{};
};

}  // namespace

FLYBALL_PLUGIN(gap_switch) {
  registry.add<flyball::Policy>("gap_switch", [] { return std::make_unique<GapSwitch>(); });
}
