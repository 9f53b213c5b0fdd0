// SPDX-License-Identifier: BSD-3-Clause
//
// Who talks to whom, as the dataflow figures of MAVBench (MICRO 2018) have it: sensors, perception,
// planning, control; planners are services (s), all else topics (t).

#include "flyball/simulation/mission.h"

#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using Names = std::vector<std::string>;

Names split(const std::string& list) {
  Names names;
  std::istringstream words{list};
  for (std::string word; words >> word;) {
    names.push_back(word.back() == ',' || word.back() == ':' ? word.substr(0, word.size() - 1)
                                                             : word);
  }
  return names;
}

/// The printed graph, read back: who writes and who reads a topic.
struct Talk {
  std::map<std::string, Names> writers;
  std::map<std::string, Names> readers;
  std::set<std::string> topics;
};

Talk talk_of(const std::string& text) {
  Talk talk;
  std::istringstream lines{text};
  std::string node;
  for (std::string line; std::getline(lines, line);) {
    const Names words = split(line);
    if (words.size() < 2) {
      continue;
    }
    if (words[0] == "node") {
      node = words[1];
      if (words[2] == "on") {
        talk.readers[words[3]].push_back(node);
      }
    } else if (words[0] == "topic") {
      talk.topics.insert(words[1]);
    } else if (words[0] == "reads" || words[0] == "writes") {
      auto& side = words[0] == "reads" ? talk.readers : talk.writers;
      for (std::size_t i = 1; i < words.size(); ++i) {
        side[words[i]].push_back(node);
      }
    }
  }
  return talk;
}

/// The figures of the paper show how data flows. These topics carry what steers that flow:
/// settings, orders, reports and the record.
const std::set<std::string> steering{"knobs", "mission_state", "end",       "outcome",
                                     "log",   "guidance",      "navigator", "map_use",
                                     "lanes", "localization",  "map_hints", "tracked_time"};

/// Each as `t: who -> whom`. What no node writes or reads comes from or goes to the vehicle.
std::set<std::string> edges_of(const std::string& workload) {
  Scenario scenario;
  scenario.mission.workload = workload;
  const auto text = describe_graph(scenario, false);
  EXPECT_TRUE(text.ok()) << text.error().message;
  const Talk talk = talk_of(text.ok() ? *text : "");
  const auto named = [](const std::map<std::string, Names>& side, const std::string& topic) {
    const auto found = side.find(topic);
    return found == side.end() ? Names{"vehicle"} : found->second;
  };
  std::set<std::string> edges;
  for (const std::string& topic : talk.topics) {
    if (steering.count(topic) > 0) {
      continue;
    }
    const bool is_service = topic.find('.') != std::string::npos;
    for (const std::string& from : named(talk.writers, topic)) {
      for (const std::string& to : named(talk.readers, topic)) {
        if (to == "govern") {  // It looks at everything.
          continue;
        }
        edges.insert((is_service ? "s: " : "t: ") + from + " -> " + to);
      }
    }
  }
  return edges;
}

TEST(Dataflow, of_scanning_goes_from_the_fix_over_the_lawnmower_to_the_set_points) {
  const std::set<std::string> paper{"t: vehicle -> localize", "s: follow -> coverage",
                                    "s: coverage -> smooth",  "t: smooth -> follow",
                                    "t: localize -> follow",  "t: follow -> vehicle"};
  const std::set<std::string> mission{"t: localize -> mission", "t: vehicle -> mission",
                                      "t: mission -> vehicle", "t: localize -> pictures",
                                      "t: pictures -> mission"};
  std::set<std::string> all = paper;
  all.insert(mission.begin(), mission.end());
  std::set<std::string> found = edges_of("scanning");
  found.erase("t: vehicle -> vehicle");   // The depth camera's images, which nobody reads, ...
  found.erase("t: localize -> vehicle");  // ... and earlier poses, for which nobody asks.
  EXPECT_EQ(found, all);
}

TEST(Dataflow, of_package_delivery_goes_from_the_camera_over_map_and_plan_to_the_set_points) {
  const std::set<std::string> paper{
      "t: vehicle -> localize", "t: vehicle -> slam_load", "t: vehicle -> points",
      "t: points -> map",       "t: localize -> map",      "t: map -> check",
      "s: follow -> plan",      "s: plan -> smooth",       "t: smooth -> follow",
      "t: localize -> follow",  "t: follow -> vehicle"};
  // Whoever looks at the map reads a revision of it.
  const std::set<std::string> mission{"t: map -> plan",        "t: map -> smooth",
                                      "t: check -> follow",    "t: localize -> mission",
                                      "t: vehicle -> mission", "t: mission -> vehicle"};
  std::set<std::string> all = paper;
  all.insert(mission.begin(), mission.end());
  EXPECT_EQ(edges_of("package_delivery"), all);
}

}  // namespace
}  // namespace flyball
