// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/judging/tracking_score.h"

#include "flyball/records/pictures.h"
#include "flyball/records/text_table.h"
#include "flyball/sim/colour_camera.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

constexpr double least_overlap = 0.2;
constexpr std::size_t most_cameras = 512;  // 25 s at 20 Hz; no tracker is that late.
constexpr double keep_every_s = 15.0;

/// From the middle of the frame, 1 in its corners.
double centre_error(const ImageBox& box, const Intrinsics& camera) {
  const double half_x = 0.5 * camera.width_px;
  const double half_y = 0.5 * camera.height_px;
  const double x = box.centre_x_px() - half_x;
  const double y = box.centre_y_px() - half_y;
  return std::sqrt((x * x + y * y) / (half_x * half_x + half_y * half_y));
}

}  // namespace

void TrackingScore::note(std::uint64_t sequence, const Pose& X_WC) {
  cameras_.emplace_back(sequence, X_WC);
  if (cameras_.size() > most_cameras) {
    cameras_.pop_front();
  }
}

void TrackingScore::count(const Target& target) {
  double best_overlap = 0.0;
  double person_error = 1.0;
  const auto camera = std::find_if(cameras_.begin(), cameras_.end(), [&](const auto& noted) {
    return noted.first == target.frame.sequence;
  });
  if (camera != cameras_.end()) {
    frames_with_box_ += target.box ? 1 : 0;
    for (const Person& person : people_) {
      const auto truth = box_of(person, target.frame.captured, camera->second, target.frame.camera);
      if (truth) {
        person_error = std::min(person_error, centre_error(*truth, target.frame.camera));
        best_overlap = std::max(best_overlap, target.box ? overlap(*truth, *target.box) : 0.0);
      }
    }
  }
  ++frames_;
  person_error_sum_ += person_error;
  const bool on_target = best_overlap >= least_overlap;
  if (on_target) {
    ++frames_on_target_;
    centre_error_sum_ += centre_error(*target.box, target.frame.camera);
    tracked_.on_target(target.frame.captured);
  }
  if (target.box) {
    keep({target, on_target});
  }
  const ImageBox box = target.box.value_or(ImageBox{});
  link_.log("target", {{"captured_s", to_seconds(target.frame.captured)},
                       {"x_px", box.x_px},
                       {"y_px", box.y_px},
                       {"width_px", box.width_px},
                       {"height_px", box.height_px},
                       {"overlap", best_overlap}});
}

MissionFailure TrackingScore::objection() const {
  return tracked_s() < link_.brief().settings.photography.success_s ? MissionFailure::target_lost
                                                                    : MissionFailure::none;
}

void TrackingScore::keep(const Kept& seen) {
  const MissionTime at = seen.target.frame.captured;
  const bool is_due = !kept_at_ || to_seconds(at - *kept_at_) >= keep_every_s;
  if (!kept_.empty() && kept_.back().target.frame.captured != *kept_at_) {
    kept_.pop_back();
  }
  kept_.push_back(seen);
  kept_at_ = is_due ? at : *kept_at_;
}

std::vector<MissionFrame> TrackingScore::frames() const {
  std::vector<MissionFrame> frames;
  for (const Kept& kept : kept_) {
    const ColourFrame& frame = kept.target.frame;
    frames.push_back(boxed(frame.image.value(), *kept.target.box, kept.on_target,
                           "at " + rounded(to_seconds(frame.captured), 1) + " s, " +
                               (kept.on_target ? "on the person" : "beside the person")));
  }
  return frames;
}

std::map<std::string, double> TrackingScore::figures() const {
  const auto share = [](double part, std::uint64_t whole) {
    return whole == 0 ? 0.0 : 100.0 * part / static_cast<double>(whole);
  };
  const std::uint64_t wrong = frames_with_box_ - frames_on_target_;
  return {{"tracked_s", tracked_s()},
          {"mean_centre_error_percent", share(centre_error_sum_, frames_on_target_)},
          {"mean_person_error_percent", share(person_error_sum_, frames_)},
          {"wrong_box_percent", share(static_cast<double>(wrong), frames_with_box_)}};
}

}  // namespace flyball
