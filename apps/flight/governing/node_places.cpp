// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/governing/node_places.h"

#include <string_view>

namespace flyball {
namespace {

constexpr std::string_view offload = "offload.";  // And the name of a node.

}  // namespace

void NodePlaces::apply(const KnobSettings& knobs, Board& board) {
  for (const KnobSpec& spec : knobs.specs()) {
    if (spec.name.rfind(offload, 0) != 0) {
      continue;
    }
    const std::string node = spec.name.substr(offload.size());
    const bool wanted = knobs.value(spec.name) != 0.0;
    const auto told = on_edge_.find(node);
    if (told == on_edge_.end() || told->second != wanted) {
      on_edge_[node] = wanted;
      board.place(node, wanted);
    }
  }
}

}  // namespace flyball
