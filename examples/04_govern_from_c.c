/* SPDX-License-Identifier: BSD-3-Clause */
/* Govern a loop in plain C: your sensor, your kernel, your knob; the governor from a shared
 * library. A vehicle maps what lies around it, the finer the dearer, 60 m over open ground and 60 m
 * through a thicket. The program checks that the governor kept the map coarse in the open and fine
 * in the thicket, that this saved a third of the work, and that FLYBALL_SHADOW=1 leaves the loop
 * alone.
 *
 *     cc -std=c99 04_govern_from_c.c $(pkg-config --cflags --libs flyball_governor) -o govern
 *
 * All that the governor adds stands between lines `governor {` and `governor }`. */

#include <stdio.h>
#include <stdlib.h>

/* governor { */
#include <flyball/governors/governor.h>
/* governor } */

enum { side_max = 94 }; /* Cells on a side of 14 m, at .15 m. */

/* The loop's own setting. */
static double cell_m = 0.15;

/* Whether a pillar stands on this metre of ground: one in 64 in the open, every second one in the
 * thicket. */
static int is_pillar(int x_m, int y_m) {
  const unsigned mixed =
      ((unsigned)x_m * 73856093U ^ (unsigned)(y_m + 64) * 19349663U) * 2654435761U;
  return x_m > 60 ? (mixed >> 16) % 2 == 0 : (mixed >> 16) % 16 == 0 && x_m % 4 == 0;
}

/* The kernel: updates each cell around the vehicle. What it costs comes back, in cells. */
static int map_around(double x_m, double* density) {
  static unsigned char grid[side_max * side_max];
  const int side = (int)(14.0 / cell_m);
  int occupied = 0;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const int is_occupied = is_pillar((int)(x_m + column * cell_m), (int)(row * cell_m) - 7);
      grid[row * side + column] = (unsigned char)is_occupied;
      occupied += grid[row * side + column];
    }
  }
  *density = (double)occupied / (side * side);
  return side * side;
}

/* governor { */
static int32_t set_cell_size(void* context, double value) {
  (void)context;
  cell_m = value;
  return 0;
}

static FlyballGovernor* open_governor(void) {
  static const double legal_m[] = {0.15, 0.80};
  const FlyballGovernorKnob knob = {.struct_size = sizeof knob,
                                    .name = "map.resolution_m",
                                    .unit = "m",
                                    .description = "Edge of a cell",
                                    .legal = legal_m,
                                    .legal_count = 2,
                                    .start = 0.15,
                                    .apply = set_cell_size};
  const FlyballGovernorStage mapping = {.struct_size = sizeof mapping, .name = "mapping"};
  const FlyballGovernorSettings settings = {.struct_size = sizeof settings, .policy = "density"};
  FlyballGovernor* governor = flyball_governor_create();
  if (flyball_governor_add_knob(governor, &knob) ||
      flyball_governor_add_stage(governor, &mapping) ||
      flyball_governor_open(governor, &settings) ||
      flyball_governor_observe(governor, "phase", flyball_governor_cruise)) {
    printf("wrong: %s\n", flyball_governor_last_error(governor));
  }
  return governor;
}
/* governor } */

typedef struct Flight {
  int steps_open, coarse_open, steps_thicket, fine_thicket;
  double cells;
} Flight;

static Flight fly(void) {
  Flight flight = {0, 0, 0, 0, 0.0};
  const double period_s = 0.25;
  /* governor { */
  FlyballGovernor* governor = open_governor();
  /* governor } */
  cell_m = 0.15;
  for (int i = 0; i < 240; ++i) {
    const double now_s = i * period_s;
    const double x_m = 2.0 * now_s; /* 2 m/s */
    double density = 0.0;
    /* governor { */
    flyball_governor_begin(governor, 0, now_s);
    /* governor } */
    flight.cells += map_around(x_m, &density);
    /* governor { */
    flyball_governor_end(governor, 0, now_s + 0.1, NULL,
                         0); /* A made-up clock, as a test has it. */
    flyball_governor_observe(governor, "obstacle_density", density);
    flyball_governor_decide(governor, now_s + 0.1, NULL);
    /* governor } */
    if (x_m < 46.0) {
      ++flight.steps_open;
      flight.coarse_open += cell_m == 0.80;
    } else if (x_m > 60.0) {
      ++flight.steps_thicket;
      flight.fine_thicket += cell_m == 0.15;
    }
  }
  /* governor { */
  flyball_governor_close(governor);
  /* governor } */
  return flight;
}

int main(void) {
  static char shadow[] = "FLYBALL_SHADOW=1";
  const Flight governed = fly();
  const double coarse = 100.0 * governed.coarse_open / governed.steps_open;
  const double fine = 100.0 * governed.fine_thicket / governed.steps_thicket;
  extern int putenv(char* text); /* POSIX; what an operator would type before the command. */
  putenv(shadow);
  const Flight ungoverned = fly();
  printf("open: coarse %.0f %% of the time; thicket: fine %.0f %% of the time\n", coarse, fine);
  printf("cells updated: %.0f; in shadow, always fine: %.0f\n", governed.cells, ungoverned.cells);
  const int right = coarse > 70.0 && fine > 70.0 && 3.0 * governed.cells < 2.0 * ungoverned.cells &&
                    ungoverned.coarse_open == 0;
  puts(right ? "right" : "wrong");
  return right ? EXIT_SUCCESS : EXIT_FAILURE;
}
