// SPDX-License-Identifier: BSD-3-Clause
//
// Jobs that run on the edge computer: what they read travels there, they are served there, and
// what they publish travels back. Each step is an event, so that the cores on board are free
// meanwhile.

#include "virtual_computer.h"

namespace flyball {

void VirtualComputer::place(int node, bool on_edge) {
  nodes[index(node)].is_offloaded = on_edge;
}

ComputePlace VirtualComputer::place_of(int node) const {
  if (edge && nodes[index(node)].is_offloaded) {
    return ComputePlace::edge;
  }
  return platform.runs_on_gpu(spec(node).cost) ? ComputePlace::gpu : ComputePlace::board;
}

void VirtualComputer::send_inputs() {
  if (!edge) {
    return;
  }
  for (const int node : nodes_by_urgency(ComputePlace::edge)) {
    if (!nodes[index(node)].job->has_started) {
      send_inputs(node);
    }
  }
}

void VirtualComputer::send_inputs(int node) {
  compute(node);  // What is read now is what is sent.
  travel(node, edge->up.send(queue.now(), input_bytes(node)), &VirtualComputer::arrive);
}

double VirtualComputer::input_bytes(int node) {
  std::vector<MessageVersion> inputs = nodes[index(node)].job->record.reads;
  for (const int topic : spec(node).writes) {  // What it told before is what it knows.
    inputs.push_back({topic, exchange.version(topic)});
  }
  double bytes = 0.0;
  for (const auto& [topic, version] : inputs) {
    // An older message of a queue is taken to be as large as the newest one.
    if (const VersionedMessage& newest = exchange.newest(topic);
        newest.message && !edge->has(topic, version)) {
      bytes += graph.topics()[index(topic)].wire_bytes(newest.message.get());
      edge->knows(topic, version);
    }
  }
  return bytes;
}

void VirtualComputer::arrive(int node) {
  nodes[index(node)].job->is_in_transit = false;
  request_dispatch();
}

void VirtualComputer::send_outputs(int node) {
  advance();
  Job& job = *nodes[index(node)].job;
  job.is_done = true;
  job.share = 0.0;
  job.speed = 0.0;
  double bytes = 0.0;
  for (const auto& [topic, message] : job.outputs) {
    bytes += graph.topics()[index(topic)].wire_bytes(message.get());
  }
  travel(node, edge->down.send(queue.now(), bytes), &VirtualComputer::end_job);
  request_dispatch();  // Its share of the edge computer is free.
}

void VirtualComputer::travel(int node,
                             MissionTime arrival,
                             void (VirtualComputer::*then)(int node)) {
  Job& job = *nodes[index(node)].job;
  job.is_in_transit = true;
  at(arrival, EventOrder::job, [node, then, id = job.id](VirtualComputer& computer) {
    if (const auto& present = computer.nodes[index(node)].job; present && present->id == id) {
      (computer.*then)(node);
    }
  });
}

}  // namespace flyball
