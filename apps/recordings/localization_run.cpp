// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/recordings/localization_run.h"

#include "flyball/kernels/localizer.h"
#include "flyball/runtime/text/listed.h"

#include <algorithm>

namespace flyball {
namespace {

Status check_inputs(const Recording& recording, const LocalizerInputs& inputs) {
  const bool has_depth = std::all_of(recording.frames.begin(), recording.frames.end(),
                                     [](const RecordedFrame& f) { return !f.depth_file.empty(); });
  if (inputs.depth && !has_depth) {
    return Error{ErrorCode::invalid_input,
                 "the recording has no depth images, and this localizer needs them; try "
                 "--localizer visual_inertial"};
  }
  if (inputs.imu && recording.imu.empty()) {
    return Error{
        ErrorCode::invalid_input,
        std::string{recording.lacks_gyro ? "the recording has an accelerometer but no gyroscope.txt"
                                         : "the recording has no inertial measurements"} +
            ", and this localizer needs them; try --localizer visual_slam"};
  }
  return Done{};
}

void add(const VisualFix& fix, double uncertain_above_m, LocalizationRun& run) {
  ++run.frames;
  run.lost += fix.tracked ? 0 : 1;
  run.keyframes = fix.keyframes;
  run.loops_closed = fix.loops_closed;
  if (fix.tracked) {
    run.path.push_back({fix.captured, fix.X_WB});
    run.sigma_m_last = fix.sigma_m();
    run.uncertain += fix.sigma_m() <= uncertain_above_m ? 0 : 1;
  }
}

}  // namespace

Result<std::unique_ptr<Localizer>> make_seeing_localizer(const std::string& name,
                                                         const Plugins& plugins) {
  auto localizer = plugins.make<Localizer>(name);
  if (localizer && localizer->inputs().images) {
    return localizer;
  }
  const auto seeing = [&plugins](const std::string& other) {
    const auto made = plugins.make<Localizer>(other);
    return made && made->inputs().images ? other : "";
  };
  return Error{localizer ? ErrorCode::invalid_input : ErrorCode::not_found,
               (localizer ? "localizer \"" + name + "\" looks at no images"
                          : "no localizer \"" + name + "\"") +
                   "; there are: " + listed(plugins.names<Localizer>(), seeing)};
}

Result<LocalizationRun> localize(const Recording& recording,
                                 Localizer& localizer,
                                 const std::function<bool()>& stop,
                                 double uncertain_above_m) {
  if (const Status fits = check_inputs(recording, localizer.inputs()); !fits) {
    return fits.error();
  }
  localizer.start({});
  LocalizationRun run;
  Work work;
  double busy_ms = 0.0;
  auto imu = recording.imu.begin();
  for (std::size_t i = 0; i < recording.frames.size() && !stop(); ++i) {
    const auto frame = load_frame(recording, i);
    if (!frame) {
      return frame.error();
    }
    const HostTime begun = HostTime::clock::now();
    for (; imu != recording.imu.end() && imu->stamp <= frame->captured; ++imu) {
      localizer.add_imu_sample(*imu);
    }
    const auto fix = localizer.track_frame(*frame, work);
    const double frame_ms =
        1e3 * std::chrono::duration<double>(HostTime::clock::now() - begun).count();
    if (!fix) {
      return fix.error();
    }
    add(*fix, uncertain_above_m, run);
    busy_ms += frame_ms;
    run.frame_ms_max = std::max(run.frame_ms_max, frame_ms);
  }
  run.frame_ms_mean = run.frames > 0 ? busy_ms / run.frames : 0.0;
  run.error = absolute_trajectory_error(run.path, recording.truth);
  return run;
}

}  // namespace flyball
