// SPDX-License-Identifier: BSD-3-Clause
// tested-in: referee
#include "simulation/judging/sighting_judge.h"

#include "flyball/records/text_table.h"

#include <algorithm>

namespace flyball {
namespace {

constexpr double found_within_m = 1.0;  // Of a person, along the ground.
constexpr double same_place_m = 1.0;    // Nearer false detections count once.
constexpr std::size_t most_frames = 6;  // For the report; the finding is the last of them.

/// Nobody is close in a world without people.
bool is_close(const std::optional<double>& error_m) {
  return error_m && *error_m <= found_within_m;
}

}  // namespace

SightingJudge::SightingJudge(MissionLink& link,
                             const std::vector<Person>& people,
                             Executor& executor,
                             const SearchTopics& topics)
    : link_{link}, people_{people} {
  executor.subscribe<Sightings>(topics.sightings, [this](const Sightings& seen) { saw(seen); });
  executor.subscribe<Finding>(topics.finding, [this](const Finding& what) { found(what); });
}

void SightingJudge::saw(const Sightings& seen) {
  for (const Sighting& sighting : seen.people) {
    const auto error_m = distance_to_person_m(seen.frame.captured, sighting.p_W);
    const bool is_real = is_close(error_m);
    std::vector<Field> row{{"x_m", sighting.p_W.x()},
                           {"y_m", sighting.p_W.y()},
                           {"real", is_real ? 1.0 : 0.0},
                           {"score", sighting.score}};
    if (error_m) {
      row.push_back({"error_m", *error_m});
    }
    row.push_back({"captured_s", to_seconds(seen.frame.captured)});
    link_.log("sighting", std::move(row));
    if (!is_real && is_new(sighting.p_W)) {
      mistaken_W_.push_back(sighting.p_W);
      if (frames_.size() + 1 < most_frames) {
        keep(seen.frame, sighting.box, false, "nobody");
      }
    }
  }
}

void SightingJudge::found(const Finding& finding) {
  error_m_ = distance_to_person_m(finding.frame.captured, finding.p_W);
  found_s_ = to_seconds(finding.at);
  const bool is_right = is_close(error_m_);
  keep(finding.frame, finding.last.box, is_right,
       !error_m_ ? "reported as found"
                 : (is_right ? "the person, " : "reported as found, ") + rounded(*error_m_, 2) +
                       (is_right ? " m from the place given" : " m from the nearest person"));
}

MissionFailure SightingJudge::objection() const {
  return !found_s_             ? MissionFailure::not_found
         : !is_close(error_m_) ? MissionFailure::false_alarm
                               : MissionFailure::none;
}

std::map<std::string, double> SightingJudge::figures() const {
  std::map<std::string, double> figures{
      {"false_positives", static_cast<double>(mistaken_W_.size())}};
  if (error_m_) {
    figures["position_error_m"] = *error_m_;
  }
  if (is_close(error_m_)) {
    figures["time_to_find_s"] = *found_s_;
  }
  return figures;
}

void SightingJudge::keep(const ColourFrame& frame,
                         const ImageBox& box,
                         bool is_right,
                         const std::string& what) {
  frames_.push_back(boxed(frame.image.value(), box, is_right,
                          "at " + rounded(to_seconds(frame.captured), 1) + " s: " + what));
}

std::optional<double> SightingJudge::distance_to_person_m(MissionTime at, const Vec3& p_W) const {
  std::optional<double> nearest_m;
  for (const Person& person : people_) {
    const double distance_m = (person.at(at).foot_W - p_W).head<2>().norm();
    nearest_m = std::min(nearest_m.value_or(distance_m), distance_m);
  }
  return nearest_m;
}

bool SightingJudge::is_new(const Vec3& p_W) const {
  return std::none_of(mistaken_W_.begin(), mistaken_W_.end(),
                      [&](const Vec3& old_W) { return (old_W - p_W).norm() < same_place_m; });
}

}  // namespace flyball
