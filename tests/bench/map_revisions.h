// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What revisions of a map cost: handing one on after each frame, inserting a frame while a reader
/// holds the revision before it, and the memory that this takes.

#include "map_pipeline.h"

namespace flyball::bench {

/// A mapper with its parameters, by a short name.
struct RevisedMapper {
  const char* name;
  const char* mapper;
  const char* layers;     ///< Null: without such a parameter.
  const char* front_end;  ///< The same.
};
inline constexpr RevisedMapper revised_mappers[] = {
    {"pyramid", "flyball", "one", "pyramid"},
    {"exact", "flyball", "one", "exact"},
    {"stock layers", "flyball", "stock", nullptr},
    {"octomap", "octomap", nullptr, nullptr},
};
/// Cell sizes of successive frames: one map of .15 m, or a map of .60 m in turn with it.
inline constexpr const char* revised_cells[] = {"0.15", "0.15 and 0.60"};

[[nodiscard]] std::string revision_name(const std::string& scene,
                                        const std::string& mapper,
                                        const std::string& cells);
/// Of a map with so many chunks, after a change in a hundred of them.
[[nodiscard]] std::string index_name(int chunks);
inline constexpr int index_chunks[] = {500, 2500, 10000};

void register_revisions(const Plan& plan, Scene scene);
void register_indexes(const Plan& plan);

}  // namespace flyball::bench
