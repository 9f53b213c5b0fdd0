// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What the virtual executor keeps of an edge computer.

#include "flyball/runtime/edge.h"
#include "flyball/runtime/work.h"

#include "link.h"
#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

namespace flyball {

struct EdgeComputer {
  EdgeComputer(EdgeModel of, std::size_t topics)
      : model{std::move(of)},
        up{model.link, model.seed, "uplink"},
        down{model.link, model.seed, "downlink"},
        known(topics) {}

  /// On one core.
  [[nodiscard]] Duration job_time(std::string_view kernel, const Work& work) const {
    return from_seconds(to_seconds(model.platform->job_time(kernel, work, model.point.frequency)) /
                        model.speed_factor);
  }
  /// The message need not be sent again.
  void knows(int topic, std::uint64_t version) {
    std::uint64_t& newest = known[static_cast<std::size_t>(topic)];
    newest = std::max(newest, version);
  }
  [[nodiscard]] bool has(int topic, std::uint64_t version) const {
    return version <= known[static_cast<std::size_t>(topic)];
  }

  EdgeModel model;
  Link up;
  Link down;
  std::vector<std::uint64_t> known;  ///< Newest version of each topic that was there.
};

}  // namespace flyball
