// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/records/timeline.h"

#include "flyball/mcap/protobuf.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <string_view>

namespace flyball {
namespace {

/// Numbers of the fields and kinds, as Perfetto's .proto files have them.
namespace field {
constexpr int packet = 1;
constexpr int timestamp = 8;
constexpr int sequence = 10;
constexpr int track_event = 11;
constexpr int track_descriptor = 60;
namespace descriptor {
constexpr int uuid = 1;
constexpr int name = 2;
constexpr int process = 3;
constexpr int parent = 5;
constexpr int counter = 8;
}  // namespace descriptor
namespace process {
constexpr int pid = 1;
constexpr int name = 6;
}  // namespace process
namespace event {
constexpr int kind = 9;
constexpr int track = 11;
constexpr int name = 23;
constexpr int double_value = 44;
}  // namespace event
}  // namespace field

enum class EventKind : std::uint8_t { begin = 1, end = 2, instant = 3, counter = 4 };

constexpr std::uint64_t process_track = 1;
constexpr std::uint64_t clock_track = 2;

std::uint64_t core_track(int core) {
  return 10 + static_cast<std::uint64_t>(core + 1);
}

std::uint64_t node_track(int core, int node) {
  return 100'000 + static_cast<std::uint64_t>(core + 1) * 1'000 + static_cast<std::uint64_t>(node);
}

std::string packet(const Protobuf& content) {
  return Protobuf{}.message(field::packet, content).bytes();
}

std::string event(MissionTime at, const Protobuf& what) {
  const auto ns = static_cast<std::uint64_t>(at.time_since_epoch().count());
  return packet(Protobuf{}
                    .number(field::timestamp, ns)
                    .number(field::sequence, 1)
                    .message(field::track_event, what));
}

Protobuf event_on(std::uint64_t track, EventKind kind) {
  Protobuf what;
  what.number(field::event::kind, static_cast<std::uint64_t>(kind));
  what.number(field::event::track, track);
  return what;
}

std::string slice(std::uint64_t track, std::string_view name, MissionTime from, MissionTime to) {
  return event(from, event_on(track, EventKind::begin).text(field::event::name, name)) +
         event(to, event_on(track, EventKind::end));
}

std::string descriptor(const Protobuf& what) {
  return packet(Protobuf{}.number(field::sequence, 1).message(field::track_descriptor, what));
}

std::string named_track(std::uint64_t uuid, std::uint64_t parent, const std::string& name) {
  return descriptor(Protobuf{}
                        .number(field::descriptor::uuid, uuid)
                        .text(field::descriptor::name, name)
                        .number(field::descriptor::parent, parent));
}

std::string process_descriptor(const std::string& name) {
  const Protobuf process =
      Protobuf{}.number(field::process::pid, 1).text(field::process::name, name);
  return descriptor(Protobuf{}
                        .number(field::descriptor::uuid, process_track)
                        .message(field::descriptor::process, process));
}

std::string clock_descriptor() {
  return descriptor(Protobuf{}
                        .number(field::descriptor::uuid, clock_track)
                        .text(field::descriptor::name, "granted clock [GHz]")
                        .number(field::descriptor::parent, process_track)
                        .message(field::descriptor::counter, Protobuf{}));
}

}  // namespace

void Timeline::begin(const Graph& graph) {
  graph_ = graph.name();
  for (const Node& node : graph.nodes()) {
    nodes_.push_back({node.spec.name, node.spec.deadline});
  }
}

void Timeline::note(const JobRecord& job) {
  const NodeName& spec = nodes_[static_cast<std::size_t>(job.node)];
  const std::uint64_t uuid = node_track(job.core, job.node);
  Track& track = tracks_[{job.core, job.node}];
  // A message may wait while the node's last job runs: the wait is shown from there on.
  const MissionTime released = std::max(job.released, track.until);
  if (released < job.started) {
    track.packets += slice(uuid, "waits", released, job.started);
  }
  const MissionTime started = std::max(job.started, track.until);
  if (started < job.ended) {
    track.packets +=
        slice(uuid, job.killed ? spec.name + " (killed)" : spec.name, started, job.ended);
  }
  if (job.missed) {
    track.packets +=
        event(job.released + spec.deadline,
              event_on(uuid, EventKind::instant).text(field::event::name, "deadline missed"));
  }
  track.until = std::max(track.until, job.ended);
  if (job.clock.value() != clock_.value() && job.clock.value() > 0.0) {
    clock_ = job.clock;
    clock_packets_ +=
        event(job.started, event_on(clock_track, EventKind::counter)
                               .real(field::event::double_value, clock_.value() * 1e-9));
  }
}

std::string Timeline::bytes() const {
  std::string all = process_descriptor("flyball " + graph_) + clock_descriptor();
  std::set<int> cores;
  for (const auto& [place, track] : tracks_) {
    const auto& [core, node] = place;
    if (cores.insert(core).second) {
      all += named_track(core_track(core), process_track,
                         core < 0 ? "modeled computer" : "core " + std::to_string(core));
    }
    all += named_track(node_track(core, node), core_track(core),
                       nodes_[static_cast<std::size_t>(node)].name);
    all += track.packets;
  }
  return all + clock_packets_;
}

}  // namespace flyball
