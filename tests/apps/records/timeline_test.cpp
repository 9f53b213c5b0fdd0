// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/records/timeline.h"

#include <chrono>
#include <cstring>
#include <map>
#include <optional>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

MissionTime at_ms(int ms) {
  return MissionTime{std::chrono::milliseconds{ms}};
}

/// A message as protobuf's documentation describes it: written against that, not against what is
/// tested.
struct Fields {
  explicit Fields(std::string_view bytes) {
    while (!bytes.empty()) {
      const std::uint64_t key = take_number(bytes);
      const int field = static_cast<int>(key >> 3U);
      if ((key & 7U) == 0) {
        numbers[field] = take_number(bytes);
      } else if ((key & 7U) == 1) {
        std::memcpy(&reals[field], bytes.data(), 8);
        bytes.remove_prefix(8);
      } else if ((key & 7U) == 2) {
        const std::uint64_t size = take_number(bytes);
        if (size > bytes.size()) {
          throw std::out_of_range{"a text that does not end"};
        }
        texts.emplace_back(field, std::string{bytes.substr(0, size)});
        bytes.remove_prefix(size);
      } else {
        throw std::out_of_range{"a kind that is none"};
      }
    }
  }
  static std::uint64_t take_number(std::string_view& bytes) {
    std::uint64_t value = 0;
    for (unsigned shift = 0;; shift += 7) {
      const auto byte = static_cast<unsigned char>(bytes.at(0));
      bytes.remove_prefix(1);
      value |= static_cast<std::uint64_t>(byte & 0x7fU) << shift;
      if (byte < 0x80U) {
        return value;
      }
    }
  }
  [[nodiscard]] std::optional<Fields> message(int field) const {
    const std::string* found = text(field);
    return found != nullptr ? std::optional{Fields{*found}} : std::nullopt;
  }
  [[nodiscard]] const std::string* text(int field) const {
    for (const auto& [number, value] : texts) {
      if (number == field) {
        return &value;
      }
    }
    return nullptr;
  }
  std::map<int, std::uint64_t> numbers{};
  std::map<int, double> reals{};
  std::vector<std::pair<int, std::string>> texts{};
};

struct Slice {
  std::string name{};
  std::uint64_t begin_ms{};
  std::uint64_t end_ms{};
  bool operator==(const Slice& other) const {
    return name == other.name && begin_ms == other.begin_ms && end_ms == other.end_ms;
  }
};

/// What Perfetto would show, by the name of the track; times that fall or ends without a beginning
/// fail the test.
struct Shown {
  explicit Shown(const std::string& bytes) {
    for (const auto& [field, packet] : Fields{bytes}.texts) {
      EXPECT_EQ(field, 1);
      take(Fields{packet});
    }
  }
  void take(const Fields& packet) {
    EXPECT_EQ(packet.numbers.at(10), 1U);
    if (const auto track = packet.message(60)) {
      const auto process = track->message(3);
      names[track->numbers.at(1)] = process ? *process->text(6) : *track->text(2);
      parents[names[track->numbers.at(1)]] =
          track->numbers.count(5) > 0 ? names.at(track->numbers.at(5)) : "";
      return;
    }
    const auto event = packet.message(11);
    ASSERT_TRUE(event);
    const std::uint64_t ms = packet.numbers.at(8) / 1'000'000;
    const std::string& track = names.at(event->numbers.at(11));
    switch (event->numbers.at(9)) {
      case 1:
        EXPECT_FALSE(slices[track].size() > 0 && slices[track].back().end_ms > ms) << track;
        slices[track].push_back({*event->text(23), ms, 0});
        break;
      case 2:
        slices[track].back().end_ms = ms;
        break;
      case 3:
        instants[track].push_back({*event->text(23), ms, ms});
        break;
      default:
        counter.emplace_back(ms, event->reals.at(44));
    }
  }
  std::map<std::uint64_t, std::string> names{};
  std::map<std::string, std::string> parents{};
  std::map<std::string, std::vector<Slice>> slices{};
  std::map<std::string, std::vector<Slice>> instants{};
  std::vector<std::pair<std::uint64_t, double>> counter{};
};

struct TimelineTest : testing::Test {
  TimelineTest() {
    NodeSpec spec;
    spec.name = "map";
    spec.trigger = OnPeriod{std::chrono::seconds{1}, Duration{}};
    spec.deadline = std::chrono::milliseconds{20};
    graph.node(spec, [](JobContext&) { return Work{}; });
    spec.name = "plan";
    graph.node(spec, [](JobContext&) { return Work{}; });
    timeline.begin(graph);
  }
  static JobRecord job(int node, int released, int started, int ended, int core = -1) {
    JobRecord record;
    record.node = node;
    record.released = at_ms(released);
    record.started = at_ms(started);
    record.ended = at_ms(ended);
    record.core = core;
    return record;
  }
  Graph graph{"delivery"};
  Timeline timeline{};
};

TEST_F(TimelineTest, shows_waits_and_jobs_of_each_node) {
  timeline.note(job(0, 10, 12, 15));
  timeline.note(job(1, 10, 10, 40));
  timeline.note(job(0, 13, 16, 200));  // Released while the first one ran.
  const Shown shown{timeline.bytes()};
  EXPECT_EQ(shown.slices.at("map"),
            (std::vector<Slice>{
                {"waits", 10, 12}, {"map", 12, 15}, {"waits", 15, 16}, {"map", 16, 200}}));
  EXPECT_EQ(shown.slices.at("plan"), (std::vector<Slice>{{"plan", 10, 40}}));
  EXPECT_EQ(shown.parents.at("map"), "modeled computer");
  EXPECT_EQ(shown.parents.at("modeled computer"), "flyball delivery");
}

TEST_F(TimelineTest, shows_cores_late_and_killed_jobs_and_the_clock) {
  JobRecord late = job(0, 10, 12, 50, 3);
  late.missed = late.killed = true;
  late.clock = Hertz{2e9};
  timeline.note(late);
  JobRecord next = job(1, 60, 60, 61, 3);
  next.clock = Hertz{2e9};
  timeline.note(next);
  next = job(1, 70, 70, 71, 4);
  next.clock = Hertz{0.345e9};
  timeline.note(next);
  const Shown shown{timeline.bytes()};
  EXPECT_EQ(shown.parents.at("map"), "core 3");
  EXPECT_EQ(shown.slices.at("map").back(), (Slice{"map (killed)", 12, 50}));
  EXPECT_EQ(shown.instants.at("map"), (std::vector<Slice>{{"deadline missed", 30, 30}}));
  ASSERT_EQ(shown.counter.size(), 2U);
  EXPECT_EQ(shown.counter[0], (std::pair<std::uint64_t, double>{12, 2.0}));
  EXPECT_EQ(shown.counter[1], (std::pair<std::uint64_t, double>{70, 0.345e9 * 1e-9}));
}

}  // namespace
}  // namespace flyball
