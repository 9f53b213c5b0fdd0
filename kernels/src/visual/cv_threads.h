// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// OpenCV works on the thread that calls it. Only for .cpp files.

#include <opencv2/core/utility.hpp>

namespace flyball {

/// For the whole process, so that results do not depend on the host's cores. Each kernel that uses
/// OpenCV calls it when it is made or configured, and never in a job: OpenCV sets up an arena of
/// oneTBB here, under a lock that spins and yields. With real-time priorities a more urgent job on
/// the same core would wait for the lock for ever, because it never lets the holder run.
inline void keep_opencv_on_this_thread() {
  cv::setNumThreads(1);
}

}  // namespace flyball
