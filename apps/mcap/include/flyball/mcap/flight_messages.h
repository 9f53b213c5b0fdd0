// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What the record of a flight holds, as protobuf messages: Foxglove's where it has some
/// (github.com/foxglove/foxglove-sdk, schemas), otherwise ours.

#include "flyball/flight/mission_topics.h"
#include "flyball/mcap/message_schema.h"
#include "flyball/runtime/executor.h"

#include <string>
#include <string_view>
#include <vector>

namespace flyball {

/// Frames of reference, as messages name them.
inline constexpr std::string_view world_frame{"world"};
inline constexpr std::string_view body_frame{"body"};

/// All messages below, and what they consist of.
[[nodiscard]] std::vector<MessageSchema> flight_schemas();

/// A cell of the map that became occupied, or that is so no longer.
struct CellChange {
  Vec3 centre_W{Vec3::Zero()};
  bool is_occupied{};
};

/// `foxglove.PoseInFrame`
[[nodiscard]] std::string pose_message(MissionTime at, const Pose& X_WB);
/// `foxglove.FrameTransform`: the body in the world.
[[nodiscard]] std::string transform_message(MissionTime at, const Pose& X_WB);
/// `foxglove.PosesInFrame`: places in their order; each one looks to the next.
[[nodiscard]] std::string path_message(MissionTime at, const std::vector<Vec3>& path_W);
/// `foxglove.PointCloud`: centres with the cells' size and 1 or 0 as `occupied`.
[[nodiscard]] std::string cells_message(MissionTime at,
                                        double size_m,
                                        const std::vector<CellChange>& cells);
/// `foxglove.Log`
[[nodiscard]] std::string log_message(MissionTime at, const std::string& what);
/// `flyball.Knobs`
[[nodiscard]] std::string knobs_message(MissionTime at, const KnobsInForce& knobs);
/// `flyball.Job`, at its end.
[[nodiscard]] std::string job_message(const JobRecord& job, const Graph& graph);
/// `flyball.Decision`, of a row of channel `decision`.
[[nodiscard]] std::string decision_message(const LogRow& row);
/// `flyball.Power`, of a row of channel `state`.
[[nodiscard]] std::string power_message(const LogRow& row);
/// `flyball.Row`: any row of the log.
[[nodiscard]] std::string row_message(const LogRow& row);

}  // namespace flyball
