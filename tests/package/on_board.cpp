// SPDX-License-Identifier: BSD-3-Clause
//
// What flies, and no simulator: prints the topics that a vehicle has to serve.

#include <cstdio>

#include <flyball/flight/vehicle_port.h>

int main() {
  flyball::Graph graph{"on_board"};
  const auto vehicle = flyball::add_vehicle_topics(graph, {true, false});
  for (const auto& topic : graph.topics()) {
    std::puts(topic.name.c_str());
  }
  return vehicle.setpoint.index >= 0 ? 0 : 1;
}
