/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef FLYBALL_GOVERNORS_GOVERNOR_H
#define FLYBALL_GOVERNORS_GOVERNOR_H

/** @file
 * The governor alone, for a program of any kind: C99 and one shared library, libflyball_governor.
 *
 *     FlyballGovernor* governor = flyball_governor_create();
 *     flyball_governor_add_knob(governor, &cell_size);   // What may be turned, and who turns it.
 *     flyball_governor_add_stage(governor, &mapping);    // What takes time: this is stage 0.
 *     flyball_governor_open(governor, &settings);        // Which policy decides.
 *     flyball_governor_observe(governor, "phase", flyball_governor_cruise);
 *     for (each frame) {
 *       flyball_governor_begin(governor, 0, now_s());
 *       ...
 *       flyball_governor_end(governor, 0, now_s(), NULL, 0);
 *       flyball_governor_observe(governor, "obstacle_density", density);
 *       flyball_governor_decide(governor, now_s(), NULL);  // Calls back for each knob that
 * changes.
 *     }
 *     flyball_governor_close(governor);
 *
 * Time is the caller's: every call that needs it takes it in seconds, from any beginning that
 * lies before the first call, and it never goes back. The library reads no clock (so nothing
 * watches how long a policy takes to decide), starts no thread, prints nothing and, once
 * `flyball_governor_open` has returned, allocates nothing. (A policy that is a library of its own
 * runs in a process of its own, which `open` starts.) One governor may be used from one thread at a
 * time, several governors side by side.
 *
 * Every function returns a code: 0, or why it did nothing; then `flyball_governor_last_error` has
 * the sentence. Nothing that a caller passes ends the program, save a pointer that points nowhere.
 *
 * Every structure begins with its size as its user's header knew it (`sizeof`) and grows at its end
 * only. What an older caller does not have counts as zero, and only what he knows is written. Zero
 * every structure before use: `FlyballGovernorKnob knob = {.struct_size = sizeof knob};` in C.
 *
 * The environment can take the governor's hands off the knobs (any value but empty and "0"):
 * - FLYBALL_DRY_RUN: no callback of a knob is ever called. What is in force stays the start value
 * of each knob, whatever is decided and whatever `granted` is told: the program runs as it would
 *   without a governor.
 * - FLYBALL_SHADOW: no callback of a knob is ever called either, because something else turns the
 *   knobs. What is in force is what `granted` was told last, the start value until then, and
 *   decisions are made for that.
 * In both, decisions are made, returned in `decided` and recorded. If both are set, FLYBALL_SHADOW
 * counts. They are read once, by `open`.
 */

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct FlyballGovernor FlyballGovernor;

/** What every function returns. */
enum {
  flyball_governor_ok = 0,
  flyball_governor_invalid_input = 1,
  flyball_governor_not_found = 2,
  flyball_governor_failed = 3,
  flyball_governor_unavailable = 4
};

/** Values of the signal "phase". A policy lowers the clock while lower latency would not make the
 * vehicle faster, so somebody has to say what the vehicle does. What flies nothing: cruise. */
enum {
  flyball_governor_take_off = 0,
  flyball_governor_cruise = 1,
  flyball_governor_land = 2,
  flyball_governor_wait = 3
};

enum { flyball_governor_governing = 0, flyball_governor_dry_run = 1, flyball_governor_shadow = 2 };

enum {
  flyball_governor_capacity = 16,  /* Knobs at most; for good. */
  flyball_governor_name_bytes = 63 /* Of a knob's, a stage's, a count's name; at most. */
};

/** What a governor may turn. These names policies of Flyball know: map.resolution_m, map.range_m
 * and cpu.frequency_hz, which most of them set; explore.iterations, which mission_energy sets too;
 * and map.rate_hz, planner.budget, cpu.cores and mission.max_speed_m_s, which the policy fixed
 * sets, as it sets all others. `flyball list knobs` prints more, and says what each one means.
 * mission_energy and energy_clock take the start value of map.rate_hz for the rate at which frames
 * come, and 20 Hz where there is no such knob. */
typedef struct FlyballGovernorKnob {
  uint32_t struct_size;
  uint32_t legal_count;
  const char* name; /* In two parts: "map.resolution_m". */
  const char* unit; /* "1" where there is none. */
  const char* description;
  const double* legal; /* Ascending. With `legal_count` 0 every value in [min, max] is legal. */
  double min;          /* `min` and `max` count only then. */
  double max;
  double start; /* In force when the governor opens, and what it falls back to. Legal. */
  /** Puts a value in force and returns 0; anything else says that it could not, and it is asked
   * again at the next decision. It may call `flyball_governor_granted`, where it got another value
   * than it was asked for, and nothing else of this governor. NULL: the caller reads `decided`. */
  int32_t (*apply)(void* context, double value);
  void* context;
  /* The first version may end here. */

  double min_dwell_s; /* It keeps a value at least this long; 0: `min_dwell_s` of the settings. */
  /** A knob added before, with which this one makes one setting: where both are to change, they do
   * so at once or wait together, as map.range_m with map.resolution_m. That one follows none
   * itself. NULL: it stands alone. */
  const char* follows;
} FlyballGovernorKnob;

/** A part of the caller's loop that takes time. Stages are numbered from 0 as they are added, in
 * the order in which a frame passes them: it enters where the first one begins and has left when
 * the last one ends, and the time between is its latency. A stage works on what the one before it
 * finished last, so they may overlap as in a pipeline. */
typedef struct FlyballGovernorStage {
  uint32_t struct_size;
  uint32_t work_count;
  const char* name;
  const char* const* work; /* What it counts: "cells", "rays". */
  double deadline_s;  /* Longer than this is a missed deadline, ended or not; 0: it has none. */
  uint32_t thread;    /* Stages with the same number keep the same core busy. */
  uint32_t is_beside; /* Not 0: frames do not pass it. It costs time and is not part of latency. */
} FlyballGovernorStage;

/** What is known of the computer before it is governed, as `flyball::BoardModel`. Its input power
 * [W] at the clock f [GHz] with n busy cores is
 *     board + converter (soc + memory + cpu_constant + cpu_linear f + n (core_linear f +
 *     core_cubic f^3)) */
typedef struct FlyballGovernorBoard {
  uint32_t struct_size;
  uint32_t max_cores; /* 0: not known. */
  uint32_t clock_count;
  uint32_t reserved;
  const double* clocks_hz; /* Ascending. */
  double switching_s;      /* How long a change of the clock takes. */
  double converter;        /* 1 for a perfect one; 0: nothing is known of its power. */
  double board_w;
  double soc_w;
  double memory_w;
  double cpu_constant_w;
  double cpu_linear_w;
  double core_linear_w;
  double core_cubic_w;
} FlyballGovernorBoard;

typedef struct FlyballGovernorSettings {
  uint32_t struct_size;
  uint32_t reserved;
  /** A name, "density", or a file: a preset ./mine.toml, or a library ./libmine.so, which is code:
   * who names one trusts its author. */
  const char* policy;
  const char* parameters; /* "fine_m = 0.2\ncoarse_m = 0.6" as in a preset; NULL: its defaults. */
  /** Called with one line for each decision, without a newline; NULL: nothing is recorded. It may
   * call nothing of this governor. */
  void (*record)(void* context, const char* line);
  void* context; /* Of `record`. */
  /* The first version may end here. */

  uint64_t seed;          /* Of the random numbers that a policy may draw. */
  double min_dwell_s;     /* Of knobs that do not say it themselves; 0: half a second. */
  double first_latency_s; /* Upper bound on latency until a frame has passed; 0: there is none. */
  /** From command to braking, for `safe_speed_m_s` and for policies that reckon with such a speed;
   * 0: as the guard's .14 s. */
  double reaction_s;
  const FlyballGovernorBoard* board; /* NULL: nothing is known. */
} FlyballGovernorSettings;

/** The answer. Knobs stand in the order in which they were added. Texts stay until the next call
 * of `decide` or `close`. */
typedef struct FlyballGovernorDecision {
  uint32_t struct_size;
  uint32_t mode;        /* flyball_governor_governing, _dry_run or _shadow */
  uint32_t knob_count;  /* Of `decided` and `in_force`. */
  uint32_t must_hover;  /* Not 0: the vehicle shall brake and stand. */
  const char* reason;   /* fixed, density, deadline, energy, load, fallback */
  const char* fallback; /* none, wide_bound, table, safe_static, hover: see governors/README.md */
  const char* why;      /* One sentence; empty for the fallback "none". */
  /** The largest latency of the last 20 frames, times 1.1, and wider while frames come late: two of
   * the last 20 took longer than this bound was before them (the fallback wide_bound). Where the
   * caller observes the signal latency_bound_s himself, that is widened instead. */
  double latency_bound_s;
  /** From which the vehicle stops within the signal known_free_m, braking with
   * max_deceleration_m_s2, if the next frame takes as long as bounded, or as long as the one that
   * is under way has taken already: the guard's rule. 0 while one of the three is not known. */
  double safe_speed_m_s;
  double next_s; /* The policy wants to be asked again after so long; 0: it does not say. */
  double decided[flyball_governor_capacity];
  double in_force[flyball_governor_capacity]; /* After this decision. */
} FlyballGovernorDecision;

enum {
  flyball_governor_signal = 0,   /* What `observe` takes. */
  flyball_governor_knob = 1,     /* What `add_knob` added. */
  flyball_governor_duration = 2, /* NAME.duration_s: the last one of a stage. */
  flyball_governor_work = 3      /* NAME.COUNT: what a stage counted last. */
};

/** One line of the list. Texts and `legal` stay until `close`. */
typedef struct FlyballGovernorEntry {
  uint32_t struct_size;
  uint32_t kind;
  const char* name;
  const char* unit;
  const char* description;
  double value;         /* Observed last, in force, or measured last. */
  uint32_t is_known;    /* 0: there is none yet. */
  uint32_t legal_count; /* These four for knobs only. */
  const double* legal;
  double min;
  double max;
} FlyballGovernorEntry;

/** @return  NULL when there is no memory. */
FlyballGovernor* flyball_governor_create(void);

/** Before `open`. What `knob` and `stage` point to is copied, but for `context`. */
int32_t flyball_governor_add_knob(FlyballGovernor* governor, const FlyballGovernorKnob* knob);
int32_t flyball_governor_add_stage(FlyballGovernor* governor, const FlyballGovernorStage* stage);

/** Starts the policy. May be called again after it has failed, not after it has succeeded. */
int32_t flyball_governor_open(FlyballGovernor* governor, const FlyballGovernorSettings* settings);

/** A stage begins. One that had begun and not ended is given up: its frame is lost, and until now
 * it kept its core busy. */
int32_t flyball_governor_begin(FlyballGovernor* governor, uint32_t stage, double now_s);

/** It ends, having counted so much of each of its `work`, in that order; or nothing: NULL, 0. */
int32_t flyball_governor_end(
    FlyballGovernor* governor, uint32_t stage, double now_s, const double* counts, uint32_t count);

/** A signal by its name, as `list` has them all. What stages tell (latency_s, latency_bound_s,
 * map_revision, map_age_s, deadline_misses, busy_cores, busiest_core_load; of stages named map,
 * plan, detect, track, localize or explore also map_job_s, map_load, map_gigacycles and so on), and
 * what the knobs map.resolution_m, map.range_m, cpu.frequency_hz and cpu.cores tell, need not be
 * observed; who does it anyway is believed from then on. Each `latency_s` is a frame.
 * deadline_misses and queue_drops go back to 0 with each decision.
 *
 * A value that cannot be is refused, and until another one comes (of a stage or a knob, too, for
 * who was never believed before) the next decisions take every knob to its start value, because the
 * policy would decide on something that is not so. */
int32_t flyball_governor_observe(FlyballGovernor* governor, const char* signal, double value);

/** Decides, and puts in force what changed. @param decision  May be NULL.
 * @return  flyball_governor_failed when a knob could not be applied, or `record` threw; all else is
 * done then. */
int32_t flyball_governor_decide(FlyballGovernor* governor,
                                double now_s,
                                FlyballGovernorDecision* decision);

/** What is really in force of a knob, legal or not: the clock that a hot computer grants. */
int32_t flyball_governor_granted(FlyballGovernor* governor, const char* knob, double value);

/** The entry with this number, from 0; flyball_governor_not_found behind the last one. */
int32_t flyball_governor_list(FlyballGovernor* governor,
                              uint32_t number,
                              FlyballGovernorEntry* entry);

/** Why the last call that failed did so, in one sentence; "" before the first one. Never NULL. */
const char* flyball_governor_last_error(const FlyballGovernor* governor);

/** Knobs stay as they are. NULL is allowed. */
void flyball_governor_close(FlyballGovernor* governor);

#ifdef __cplusplus
}
#endif

#endif
