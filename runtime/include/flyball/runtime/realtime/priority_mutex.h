// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A lock whose holder runs at the priority of whoever waits for it.

#include "flyball/runtime/assert.h"

#include <pthread.h>

namespace flyball {

/// Without priority inheritance, a planner's thread that holds the lock and is interrupted by a map
/// would make the path follower wait for both.
class PriorityMutex {
 public:
  PriorityMutex() {
    pthread_mutexattr_t attributes;
    pthread_mutexattr_init(&attributes);
    pthread_mutexattr_setprotocol(&attributes, PTHREAD_PRIO_INHERIT);
    const int failed = pthread_mutex_init(&mutex_, &attributes);
    pthread_mutexattr_destroy(&attributes);
    FLYBALL_ASSERT(failed == 0, "pthread_mutex_init: error %d", failed);
  }
  PriorityMutex(const PriorityMutex&) = delete;
  PriorityMutex& operator=(const PriorityMutex&) = delete;
  ~PriorityMutex() { pthread_mutex_destroy(&mutex_); }

  void lock() { pthread_mutex_lock(&mutex_); }
  void unlock() { pthread_mutex_unlock(&mutex_); }

 private:
  pthread_mutex_t mutex_{};
};

}  // namespace flyball
