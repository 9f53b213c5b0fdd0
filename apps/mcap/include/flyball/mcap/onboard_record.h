// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The record of a flight as an MCAP file: what the graph publishes, and how its jobs ran.

#include "flyball/mcap/record_thread.h"
#include "flyball/runtime/camera_spec.h"
#include "flyball/runtime/executor.h"

#include <functional>
#include <map>
#include <memory>
#include <string>

namespace flyball {

/// A flight that is recorded. Graph and executor outlive the flight.
struct RecordedGraph {
  const Graph& graph;
  Executor& executor;
  std::function<MissionTime()> now{};  ///< Called by the executor's listeners.
  DepthCameraSpec camera{};            ///< Whose frames the map is made of.
};

/// Channels: see apps/mcap/README.md. A channel whose topic the graph does not have stays empty.
class OnboardRecord {
 public:
  /// @param metadata  Tables of texts; each has a name.
  /// @error Those of `RecordThread::open`.
  static Result<std::unique_ptr<OnboardRecord>> open(
      const std::string& path,
      WhenFull when_full,
      const std::map<std::string, std::map<std::string, std::string>>& metadata);
  ~OnboardRecord();
  OnboardRecord(const OnboardRecord&) = delete;
  OnboardRecord& operator=(const OnboardRecord&) = delete;

  /// Listens from now on. On the thread that owns the executor, once, before it runs; the record
  /// outlives the executor.
  void connect(const RecordedGraph& flight);
  /// To be called when nothing is published any more.
  /// @error That of `RecordThread::close`.
  Status close();
  /// Complete after `close`.
  [[nodiscard]] RecordCounts counts() const;

 private:
  struct Parts;
  explicit OnboardRecord(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace flyball
