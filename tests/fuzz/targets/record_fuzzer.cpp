// SPDX-License-Identifier: BSD-3-Clause
//
// A run's folder as replay reads it: trace, scenario and summary, with lines of dashes between.

#include "flyball/records/summary.h"
#include "flyball/studies/replay.h"

#include "input_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const InputFolder folder;
  auto pieces = pieces_of(text_of(bytes, size));
  pieces.resize(3);
  folder.write("trace.jsonl", pieces[0]);
  folder.write("mission.toml", pieces[1]);
  folder.write("summary.json", pieces[2]);
  const auto flight = flyball::read_flight(folder.path());
  if (!flight) {
    require(!flight.error().message.empty(), "what is refused is refused in words");
  } else {
    // Each row of a trace takes some 20 bytes, and rows come at 10 Hz.
    require(flight->decisions <= 1000 + 100 * size,
            "no more decisions than the trace has time for");
  }
  flyball::Summary summary;
  if (flyball::from_json(std::string{pieces[2]}, summary)) {
    flyball::Summary again;
    require(flyball::from_json(flyball::to_json(summary), again), "what is written can be read");
  }
  return 0;
}
