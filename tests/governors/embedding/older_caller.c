/* SPDX-License-Identifier: BSD-3-Clause */
/* A program that was written when the header was new, with its declarations as they were then: the
 * first version of each structure. It must go on working, and it is C99. Do not mend it when the
 * header grows. */

#include <stdint.h>
#include <stdio.h>
#include <string.h>

typedef struct FlyballGovernor FlyballGovernor;

typedef struct Knob {
  uint32_t struct_size;
  uint32_t legal_count;
  const char* name;
  const char* unit;
  const char* description;
  const double* legal;
  double min;
  double max;
  double start;
  int32_t (*apply)(void* context, double value);
  void* context;
} Knob;

typedef struct Stage {
  uint32_t struct_size;
  uint32_t work_count;
  const char* name;
  const char* const* work;
} Stage;

typedef struct Settings {
  uint32_t struct_size;
  uint32_t reserved;
  const char* policy;
  const char* parameters;
  void (*record)(void* context, const char* line);
  void* context;
} Settings;

typedef struct Decision {
  uint32_t struct_size;
  uint32_t mode;
  uint32_t knob_count;
  uint32_t must_hover;
  const char* reason;
  const char* fallback;
  const char* why;
  double latency_bound_s;
  double safe_speed_m_s;
  double next_s;
} Decision;

FlyballGovernor* flyball_governor_create(void);
int32_t flyball_governor_add_knob(FlyballGovernor* governor, const Knob* knob);
int32_t flyball_governor_add_stage(FlyballGovernor* governor, const Stage* stage);
int32_t flyball_governor_open(FlyballGovernor* governor, const Settings* settings);
int32_t flyball_governor_begin(FlyballGovernor* governor, uint32_t stage, double now_s);
int32_t flyball_governor_end(
    FlyballGovernor* governor, uint32_t stage, double now_s, const double* counts, uint32_t count);
int32_t flyball_governor_observe(FlyballGovernor* governor, const char* signal, double value);
int32_t flyball_governor_decide(FlyballGovernor* governor, double now_s, Decision* decision);
const char* flyball_governor_last_error(const FlyballGovernor* governor);
void flyball_governor_close(FlyballGovernor* governor);

static int32_t set_cells(void* cells_m, double value) {
  *(double*)cells_m = value;
  return 0;
}

int main(void) {
  static const double legal[] = {0.15, 0.80};
  double cells_m = 0.15;
  FlyballGovernor* governor = flyball_governor_create();
  const Knob knob = {sizeof(Knob), 2,    "map.resolution_m", "m",     "Edge of a cell", legal, 0.0,
                     0.0,          0.15, set_cells,          &cells_m};
  const Stage stage = {sizeof(Stage), 0, "mapping", NULL};
  const Settings settings = {sizeof(Settings), 0, "density", NULL, NULL, NULL};
  Decision decision = {sizeof(Decision), 0, 0, 0, NULL, NULL, NULL, 0.0, 0.0, 0.0};
  const int failed =
      flyball_governor_add_knob(governor, &knob) || flyball_governor_add_stage(governor, &stage) ||
      flyball_governor_open(governor, &settings) ||
      flyball_governor_observe(governor, "phase", 1.0) ||
      flyball_governor_begin(governor, 0, 1.0) || flyball_governor_end(governor, 0, 1.5, NULL, 0) ||
      flyball_governor_decide(governor, 2.0, &decision);
  const double bound_s = decision.latency_bound_s;
  const int right = !failed && cells_m == 0.80 && bound_s > 0.5499 && bound_s < 0.5501 &&
                    decision.knob_count == 1 && strcmp(decision.reason, "density") == 0;
  printf("%s %s\n", right ? "right" : "wrong", flyball_governor_last_error(governor));
  flyball_governor_close(governor);
  return right ? 0 : 1;
}
