// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// When the simulator's cameras compute their pictures.

namespace flyball {

/// The pictures are the same; what differs is who waits for them.
enum class Rendering {
  when_looked_at,  ///< When somebody first looks, if ever: that job takes longer on the host.
  at_once,         ///< When they are taken, so that no job pays for them.
  /// In real time: depth at once, and colour pictures, which take many times as long, on a thread
  /// of their own that leaves the simulator its times. They are published when they are ready.
  as_cameras_do,
};

}  // namespace flyball
