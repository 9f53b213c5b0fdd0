// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/newest_map.h"

namespace flyball {

void NewestMap::note(const MapRevision& revision, MissionTime published) {
  revision_ = revision;
  latency_ = published - revision.captured;
  unused_capture_ = revision.captured;
  bounds_.published(revision, published);
}

std::optional<MapUse> NewestMap::first_use(MissionTime now) {
  const auto captured = std::exchange(unused_capture_, std::nullopt);
  if (!captured) {
    return std::nullopt;
  }
  return MapUse{bounds_.budget_use(), to_seconds(now - *captured)};
}

}  // namespace flyball
