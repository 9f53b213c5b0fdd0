// SPDX-License-Identifier: BSD-3-Clause
// tested-in: governor_stages
#include "stage_times.h"

#include <algorithm>
#include <utility>

namespace flyball {

void StageTimes::add(StageSpec spec) {
  Stage stage{std::move(spec)};
  stage.counts.resize(stage.spec.work.size());
  stages_.push_back(std::move(stage));
}

void StageTimes::begin(std::size_t stage, MissionTime now) {
  Stage& one = stages_[stage];
  if (one.begun) {  // Given up, which takes back neither the time that it took nor its deadline.
    stop(one, now);
  }
  one.begun = now;
  one.is_late = false;
  one.frame = is_first(stage) ? Frame{now, true} : one.input;
  one.input.is_new = false;
  if (!load_since_) {
    load_since_ = now;
  }
}

void StageTimes::stop(Stage& one, MissionTime now) {
  one.busy += now - std::max(*one.begun, *load_since_);
  note_deadline(one, now);
  one.begun.reset();
}

void StageTimes::note_deadline(Stage& one, MissionTime now) {
  const Duration deadline = one.spec.deadline;
  if (one.begun && !one.is_late && deadline > Duration::zero() && now - *one.begun > deadline) {
    one.is_late = true;
    ++misses_;
  }
}

std::optional<Duration> StageTimes::end(std::size_t stage, MissionTime now, const double* counts) {
  Stage& one = stages_[stage];
  one.last = now - *one.begun;
  one.ended += *one.last;
  stop(one, now);
  if (counts != nullptr) {
    std::copy_n(counts, one.counts.size(), one.counts.begin());
  }
  if (one.spec.is_beside || !one.frame.is_new) {
    return std::nullopt;
  }
  if (Stage* next = after(stage)) {
    next->input = one.frame;
    return std::nullopt;
  }
  captured_ = one.frame.captured;
  return now - one.frame.captured;
}

std::optional<Duration> StageTimes::duration(std::size_t stage) const {
  return stages_[stage].last;
}

double StageTimes::count(std::size_t stage, std::size_t work) const {
  return stages_[stage].counts[work];
}

Duration StageTimes::age_under_way(MissionTime now) const {
  Duration oldest{};
  for (const Stage& one : stages_) {
    if (one.begun && !one.spec.is_beside && one.frame.is_new) {
      oldest = std::max(oldest, now - one.frame.captured);
    }
  }
  return oldest;
}

std::uint32_t StageTimes::take_misses(MissionTime now) {
  for (Stage& one : stages_) {
    note_deadline(one, now);
  }
  return std::exchange(misses_, 0);
}

StageTimes::Load StageTimes::take_load(MissionTime now) {
  Load load;
  if (!load_since_ || now <= *load_since_) {
    return load;
  }
  const Duration elapsed = now - *load_since_;
  for (Stage& one : stages_) {
    if (one.begun) {
      one.busy += now - std::max(*one.begun, *load_since_);
    }
    one.load = ratio(one.ended, elapsed);
    load.busy_cores += ratio(one.busy, elapsed);
  }
  for (const Stage& one : stages_) {
    Duration of_thread{};
    for (const Stage& other : stages_) {
      of_thread += other.spec.thread == one.spec.thread ? other.busy : Duration{};
    }
    load.busiest_core = std::max(load.busiest_core, std::min(1.0, ratio(of_thread, elapsed)));
  }
  for (Stage& one : stages_) {
    one.busy = {};
    one.ended = {};
  }
  load_since_ = now;
  return load;
}

bool StageTimes::is_first(std::size_t stage) const {
  for (std::size_t before = 0; before < stage; ++before) {
    if (!stages_[before].spec.is_beside) {
      return false;
    }
  }
  return true;
}

StageTimes::Stage* StageTimes::after(std::size_t stage) {
  for (std::size_t next = stage + 1; next < stages_.size(); ++next) {
    if (!stages_[next].spec.is_beside) {
      return &stages_[next];
    }
  }
  return nullptr;
}

}  // namespace flyball
