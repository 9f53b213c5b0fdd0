/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef FLYBALL_GOVERNORS_PLUGIN_ABI_H
#define FLYBALL_GOVERNORS_PLUGIN_ABI_H

/** @file
 * What a policy in a shared library and its host say to each other. Pure C: no type of C++, no
 * exception and no memory crosses; whoever allocated frees.
 *
 * A library exports one function, `flyball_policy`. Every structure begins with its size in bytes
 * as its writer knew it, and grows at its end only: a reader believes what lies within that size
 * and takes zero for the rest. So a library keeps working with a newer host, and with an older one
 * down to the first version of each structure.
 *
 * The host supplies time, random numbers and a log. A library that reads a clock or makes its own
 * randomness gives up that equal missions have equal records.
 *
 * It runs in a process of its own. It may read files until `create` has returned; from then on a
 * request for a file, and at any time one for the network, another process or shared memory, ends
 * it. Standard output and error lead nowhere: `log` is heard. It may have threads.
 *
 * C++ has plugin_policy.h on top of this.
 */

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
  flyball_abi_version = 6,   /* Goes up when a structure grows. */
  flyball_wish_capacity = 16 /* For good: the array stands inside a structure. */
};

/** As `flyball::MissionPhase`. */
enum {
  flyball_phase_take_off = 0,
  flyball_phase_cruise = 1,
  flyball_phase_land = 2,
  flyball_phase_wait = 3
};

/** As `flyball::Reason`. */
enum {
  flyball_reason_fixed = 0,
  flyball_reason_density = 1,
  flyball_reason_deadline = 2,
  flyball_reason_energy = 3,
  flyball_reason_load = 4,
  flyball_reason_fallback = 5
};

/** What the host offers; it outlives the policy. Each function takes `context` first. */
typedef struct FlyballHost {
  uint32_t struct_size;
  uint32_t abi_version;
  void* context;
  /** Mission time of the decision that is being made; 0 before the first. */
  int64_t (*now_ns)(void* context);
  /** The next number of a stream that the mission's seed determines. */
  uint64_t (*random)(void* context);
  /** One line for the mission's record. */
  void (*log)(void* context, const char* text);
} FlyballHost;

/** A number that a preset may set. */
typedef struct FlyballParameter {
  uint32_t struct_size;
  uint32_t required; /* Not 0: there is no default, `fallback` is an example. */
  const char* name;  /* With its unit as suffix: spread_m. */
  const char* description;
  double fallback;
  double min;
  double max;
} FlyballParameter;

/** A knob that may be turned. Legal are `legal`, ascending, or, where it is empty, [min, max]. */
typedef struct FlyballKnob {
  uint32_t struct_size;
  uint32_t legal_count;
  const char* name; /* map.resolution_m */
  const char* unit;
  const double* legal;
  double min;
  double max;
  double fallback; /* The mission's default. */
  double value;    /* In force at the start. */
} FlyballKnob;

/** One clock of the computer, with what it draws at it [W]: `idle_w` + busy cores * `busy_core_w`.
 */
typedef struct FlyballClock {
  uint32_t struct_size;
  uint32_t reserved;
  double frequency_hz;
  double idle_w;      /* The whole computer with no core busy; 0: nobody knows its power. */
  double busy_core_w; /* What each busy core adds. */
} FlyballClock;

/** From `at_c` on, and until it is cooler than `at_c - hysteresis_k`, clocks end at `cap_hz`. */
typedef struct FlyballTrip {
  uint32_t struct_size;
  uint32_t reserved;
  double at_c;
  double hysteresis_k;
  double cap_hz;
} FlyballTrip;

/** The computer that the policy flies on, as `flyball::BoardModel`; what is 0 is not known. */
typedef struct FlyballBoard {
  uint32_t struct_size;
  uint32_t max_cores;
  uint32_t clock_count;
  uint32_t trip_count;
  const FlyballClock* const* clocks; /* Ascending. */
  const FlyballTrip* const* trips;   /* Ascending; none: it never gets too hot. */
  double switching_s;                /* How long a change of the clock takes. */
  double ambient_c;                  /* These three describe its heat where `resistance_k_w` > 0: */
  double resistance_k_w;             /* time_constant_s dT/dt = ambient_c + resistance_k_w P - T. */
  double time_constant_s;
} FlyballBoard;

/** What a policy is started with; valid during `create` only. */
typedef struct FlyballStart {
  uint32_t struct_size;
  uint32_t knob_count;
  const FlyballKnob* const* knobs; /* A wish names a knob by its place in this list. */
  const double* parameters;        /* One for each of the policy's, in its order. */
  uint32_t parameter_count;
  uint32_t refusal_size; /* Bytes that `refusal` has room for. */
  char* refusal;         /* Why `create` returns NULL: one sentence. */
  /* Version 3 ends here. */

  const FlyballBoard* board; /* NULL: nothing is known. */
} FlyballStart;

/** As `flyball::Stage`, the places in `FlyballObservation::stages`. */
enum {
  flyball_stage_map = 0,
  flyball_stage_plan = 1,
  flyball_stage_detect = 2,
  flyball_stage_track = 3,
  flyball_stage_localize = 4,
  flyball_stage_explore = 5,
  flyball_stage_count = 6 /* For good: the array stands inside a structure. */
};

/** As `flyball::StageUse`; for good, too. */
typedef struct FlyballStage {
  int64_t latency_ns;
  double load;
  double gigacycles;
} FlyballStage;

/** What a decision knows; as `flyball::Observation`, where every member is explained. */
typedef struct FlyballObservation {
  uint32_t struct_size;
  uint32_t phase;
  int64_t now_ns;
  double speed_m_s;
  double known_free_m;
  double obstacle_density;
  double density_ahead;
  double nearest_obstacle_m;
  double distance_to_goal_m;
  double tracking_error_m;
  double speed_limit_m_s;
  double map_resolution_m;
  uint64_t map_revision;
  int64_t latency_ns;
  int64_t latency_bound_ns;
  uint32_t deadline_misses;
  uint32_t queue_drops;
  uint32_t planner_failures;
  int32_t cores;
  double frequency_hz;
  double busy_cores;
  double busiest_core_load;
  double computer_power_w;
  double rotor_power_w;
  double battery_percent;
  double max_deceleration_m_s2;
  double narrowest_gap_m;
  double gap_distance_m;
  double mean_gap_m;
  /* Version 1 ends here. */

  double temperature_c;
  double trip_c;
  /* Version 2 ends here. */

  int64_t map_age_ns;
  /* Version 4 ends here. */

  double headroom_m;
  uint32_t progress_unit; /* As `flyball::ProgressUnit`: 0 none, 1 m, 2 m^2, 3 m^3, 4 s. */
  uint32_t reserved;
  double progress;
  double cpu_power_w;
  double gpu_power_w;
  double memory_power_w;
  double soc_power_w;
  FlyballStage stages[flyball_stage_count];
  /* Version 5 ends here. */

  int64_t map_within_ns;
  double slower_zone_m;
  double map_range_m;
} FlyballObservation;

typedef struct FlyballWish {
  uint32_t knob; /* Its place in FlyballStart's list. */
  uint32_t reserved;
  double value;
} FlyballWish;

/** What it sets; comes zeroed, but for `struct_size`. */
typedef struct FlyballDecision {
  uint32_t struct_size;
  uint32_t reason;
  uint32_t wish_count; /* More than `flyball_wish_capacity` is a fault. */
  uint32_t reserved;
  FlyballWish wishes[flyball_wish_capacity];
} FlyballDecision;

/** The policy itself; static storage. */
typedef struct FlyballPolicy {
  uint32_t struct_size;
  uint32_t abi_version; /* `flyball_abi_version` of the header that it was built with. */
  const char* name;
  const char* description;
  const FlyballParameter* const* parameters;
  uint32_t parameter_count;
  uint32_t reserved;
  /** @return  The policy's own state, or NULL with a sentence in `start->refusal`. */
  void* (*create)(const FlyballHost* host, const FlyballStart* start);
  void (*destroy)(void* policy);
  /** @return  0, or anything else when it cannot decide. */
  int32_t (*decide)(void* policy, const FlyballObservation* seen, FlyballDecision* decision);
  /* The first version ends here; what follows may be absent or NULL. */

  /** How often it wants to be asked, .001 to 3600; 0: as often as the scenario says. */
  double (*period_s)(void* policy);
} FlyballPolicy;

/** The one entry point. */
#if defined(__GNUC__)
__attribute__((visibility("default")))
#endif
const FlyballPolicy*
flyball_policy(void);

#ifdef __cplusplus
}
#endif

#endif
