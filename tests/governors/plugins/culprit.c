/* SPDX-License-Identifier: BSD-3-Clause */
/* A policy in plain C that does what its parameter `crime` says: 0 nothing. */

#include "flyball/governors/plugin_abi.h"

#include <math.h>
#include <signal.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
  crime_none,
  crime_nan,
  crime_hang,
  crime_crash,
  crime_memory,
  crime_unknown_knob,
  crime_overflow,
  crime_fail,
  crime_refuse,
  crime_random,
  crime_exit,
  /* These are none. It wishes for what the computer draws, with a core busy at the top clock, ... */
  crime_watts,
  /* ... and for what it is told of the map. */
  crime_map
};

typedef struct Culprit {
  const FlyballHost* host;
  int crime;
  double top_w;
  double trip_c;
} Culprit;

static void* create(const FlyballHost* host, const FlyballStart* start) {
  const int crime = (int)start->parameters[0];
  if (crime == crime_refuse) {
    strncpy(start->refusal, "not today", start->refusal_size - 1);
    return NULL;
  }
  Culprit* self = calloc(1, sizeof(Culprit));
  self->host = host;
  self->crime = crime;
  if (start->struct_size >= sizeof(FlyballStart) && start->board != NULL) {
    const FlyballBoard* board = start->board;
    const FlyballClock* top = board->clock_count > 0 ? board->clocks[board->clock_count - 1] : NULL;
    self->top_w = top != NULL ? top->idle_w + top->busy_core_w : 0.0;
    self->trip_c = board->trip_count > 0 ? board->trips[0]->at_c : 0.0;
  }
  return self;
}

static void destroy(void* self) {
  free(self);
}

static void take_all_memory(void) {
  for (;;) {
    void* block = malloc(1 << 20);
    if (block == NULL) {
      abort();
    }
    memset(block, 1, 1 << 20);
  }
}

static int32_t decide(void* policy, const FlyballObservation* seen, FlyballDecision* decision) {
  const Culprit* self = policy;
  volatile int spin = 1;
  decision->reason = flyball_reason_load;
  decision->wish_count = 1;
  decision->wishes[0].knob = 0;
  decision->wishes[0].value = 0.15;
  switch (self->crime) {
    case crime_nan:
      decision->wishes[0].value = NAN;
      break;
    case crime_hang:
      while (spin) {
      }
      break;
    case crime_crash:
      signal(SIGSEGV, SIG_DFL); /* A sanitizer would make something else of it. */
      raise(SIGSEGV);
      break;
    case crime_memory:
      take_all_memory();
      break;
    case crime_unknown_knob:
      decision->wishes[0].knob = 1000;
      break;
    case crime_overflow:
      decision->wish_count = flyball_wish_capacity + 1;
      break;
    case crime_fail:
      self->host->log(self->host->context, "I cannot");
      return 1;
    case crime_random:
      decision->wishes[0].value = (double)(self->host->random(self->host->context) >> 11) * 0x1p-53;
      self->host->log(self->host->context,
                      self->host->now_ns(self->host->context) == seen->now_ns ? "in time" : "late");
      break;
    case crime_watts:
      decision->wish_count = 2;
      decision->wishes[0].value = self->top_w;
      decision->wishes[1].knob = 1;
      decision->wishes[1].value = self->trip_c;
      break;
    case crime_map:
      decision->wish_count = 2;
      decision->wishes[0].value = seen->map_resolution_m;
      decision->wishes[1].knob = 1;
      decision->wishes[1].value = seen->map_range_m;
      break;
    case crime_exit:
      _exit(7);
    default:
      break;
  }
  return 0;
}

static const FlyballParameter crime = {
    sizeof(FlyballParameter), 0, "crime", "What it does wrong.", 0.0, 0.0, 100.0};
static const FlyballParameter* const parameters[] = {&crime};

static const FlyballPolicy culprit = {
#ifdef OLDER
    /* As built against the header's first version: nothing behind `decide`. */
    offsetof(FlyballPolicy, period_s),
#elif defined(TOO_OLD)
    offsetof(FlyballPolicy, decide),
#else
    sizeof(FlyballPolicy),
#endif
    1, "culprit", "Breaks the contract", parameters, 1, 0, create, destroy, decide,
#ifdef OLDER
    /* Not part of it: whoever calls this has not looked at the size. */
    (double (*)(void*))destroy
#else
    NULL
#endif
};

const FlyballPolicy* flyball_policy(void) {
  return &culprit;
}
