// SPDX-License-Identifier: BSD-3-Clause
//
// Two kernels of your own, governed in real time: a mapper, and a planner on its map. A vehicle
// flies over open ground, then through a thicket, as fast as it could stop within what it
// sees, if the next frame takes as long as the governor bounds it. Durations are measured on this
// computer. The program checks that cells are coarse in the open and fine in the thicket, that the
// bound on latency and the speed followed what the kernels really took, and that few frames came
// later than bounded.
//
// All that the governor adds stands between lines `governor {` and `governor }`.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <queue>
#include <thread>
#include <utility>
#include <vector>

// governor {
#include <flyball/governors/governor.h>
// governor }

namespace {

constexpr double range_m = 7.0;
constexpr double sight_m = 4.0;  // What is known to be free ahead.
constexpr double thicket_m = 10.0;

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

using Point = std::pair<double, double>;

/// Pillars on a lattice: close in the thicket, a few before.
std::vector<Point> pillars() {
  std::vector<Point> all{{1.0, -3.0}, {4.0, 2.0}, {6.0, -1.0}};
  for (double x_m = thicket_m; x_m < 40.0; x_m += 1.4) {
    for (double y_m = -6.3; y_m < 7.0; y_m += 1.4) {
      all.emplace_back(x_m, y_m);
    }
  }
  return all;
}

/// What the sensor sees at once: the share of .8 m columns around the vehicle that hold a pillar.
double density_around(const std::vector<Point>& all, double x_m) {
  const auto is_near = [x_m](const Point& one) { return std::abs(one.first - x_m) < range_m; };
  const auto near = static_cast<double>(std::count_if(all.begin(), all.end(), is_near));
  return near * 0.8 * 0.8 / (4.0 * range_m * range_m);
}

struct Grid {
  int side{};
  std::vector<bool> occupied{};
};

/// The first kernel: a cell is occupied where a pillar of .4 m stands in any of its 24 layers.
Grid map_around(const std::vector<Point>& all, double x_m, double cell_m) {
  Grid grid;
  grid.side = static_cast<int>(2.0 * range_m / cell_m);
  for (int i = 0; i < grid.side * grid.side; ++i) {
    const double cell_x_m = x_m - range_m + cell_m * (i % grid.side + 0.5);
    const double cell_y_m = -range_m + cell_m * (i / grid.side + 0.5);
    int layers = 0;
    for (int layer = 0; layer < 24; ++layer) {
      const double lean_m = 0.001 * layer;  // They do not stand quite upright.
      for (const auto& [pillar_x_m, pillar_y_m] : all) {
        const double dx_m = pillar_x_m + lean_m - cell_x_m;
        const double dy_m = pillar_y_m - cell_y_m;
        layers += dx_m * dx_m + dy_m * dy_m < 0.04 ? 1 : 0;
      }
    }
    grid.occupied.push_back(layers > 0);
  }
  return grid;
}

/// The second kernel: cells that a wave from the middle reaches, as a planner's first step.
int plan_on(const Grid& grid) {
  std::vector<bool> reached(grid.occupied.size());
  std::queue<int> open;
  open.push(grid.side / 2 * grid.side + grid.side / 2);
  int count = 0;
  while (!open.empty()) {
    const int cell = open.front();
    open.pop();
    for (const int next : {cell - 1, cell + 1, cell - grid.side, cell + grid.side}) {
      if (next >= 0 && next < grid.side * grid.side && !reached[next] && !grid.occupied[next]) {
        reached[next] = true;
        open.push(next);
        ++count;
      }
    }
  }
  return count;
}

/// What one kind of ground showed.
struct Ground {
  int frames{};
  int matching{};  ///< With the cells that belong there.
  int late{};
  double latency_s{};  ///< Sums.
  double bound_s{};
  double speed_m_s{};
};

class Loop {
 public:
  Loop() {
    // governor {
    static constexpr double cells_m[] = {0.15, 0.80};
    FlyballGovernorKnob knob{};
    knob.struct_size = sizeof knob;
    knob.name = "map.resolution_m";
    knob.unit = "m";
    knob.description = "Edge of a cell";
    knob.legal = cells_m;
    knob.legal_count = 2;
    knob.start = cell_m_;
    knob.context = &cell_m_;
    knob.apply = [](void* cell_m, double value) {
      *static_cast<double*>(cell_m) = value;
      return 0;
    };
    const FlyballGovernorStage mapping{sizeof mapping, 0, "mapping", nullptr, 0.0, 0, 0};
    const FlyballGovernorStage planning{sizeof planning, 0, "planning", nullptr, 0.0, 0, 0};
    FlyballGovernorSettings settings{};
    settings.struct_size = sizeof settings;
    settings.policy = "density";
    decision_.struct_size = sizeof decision_;
    if (flyball_governor_add_knob(governor_, &knob) != 0 ||
        flyball_governor_add_stage(governor_, &mapping) != 0 ||
        flyball_governor_add_stage(governor_, &planning) != 0 ||
        flyball_governor_open(governor_, &settings) != 0) {
      std::printf("wrong: %s\n", flyball_governor_last_error(governor_));
    }
    flyball_governor_observe(governor_, "phase", flyball_governor_cruise);
    flyball_governor_observe(governor_, "max_deceleration_m_s2", 5.0);
    // governor }
  }
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;
  // governor {
  ~Loop() { flyball_governor_close(governor_); }
  // governor }

  /// One frame; then flies on until the next one is due.
  void run_frame(double x_m, Ground& ground, double wanted_m) {
    const double bound_s = decision_.latency_bound_s;
    const double begin_s = now_s();
    // governor {
    flyball_governor_begin(governor_, 0, begin_s);
    // governor }
    const Grid grid = map_around(pillars_, x_m, cell_m_);
    // governor {
    flyball_governor_end(governor_, 0, now_s(), nullptr, 0);
    flyball_governor_begin(governor_, 1, now_s());
    // governor }
    reached_ += plan_on(grid);
    const double end_s = now_s();
    ++ground.frames;
    ground.matching += cell_m_ == wanted_m ? 1 : 0;
    ground.late += end_s - begin_s > bound_s ? 1 : 0;
    ground.latency_s += end_s - begin_s;
    // governor {
    flyball_governor_end(governor_, 1, end_s, nullptr, 0);
    flyball_governor_observe(governor_, "obstacle_density", density_around(pillars_, x_m));
    flyball_governor_observe(governor_, "known_free_m", sight_m);
    flyball_governor_decide(governor_, now_s(), &decision_);
    // governor }
    ground.bound_s += decision_.latency_bound_s;
    ground.speed_m_s += decision_.safe_speed_m_s;
  }
  [[nodiscard]] double speed_m_s() const { return decision_.safe_speed_m_s; }

 private:
  std::vector<Point> pillars_{pillars()};
  double cell_m_{0.15};
  long reached_{};
  // governor {
  FlyballGovernor* governor_{flyball_governor_create()};
  FlyballGovernorDecision decision_{};
  // governor }
};

void print(const char* name, const Ground& ground) {
  std::printf(
      "%s: %d frames, wanted cells in %d, latency %.1f ms, bound %.1f ms, %.2f m/s, %d late\n",
      name, ground.frames, ground.matching, 1e3 * ground.latency_s / ground.frames,
      1e3 * ground.bound_s / ground.frames, ground.speed_m_s / ground.frames, ground.late);
}

}  // namespace

int main() {
  Loop loop;
  Ground open;
  Ground thicket;
  double x_m = 0.0;
  double last_s = now_s();
  while (x_m < 15.0) {
    const bool is_open = x_m < thicket_m - 0.5 * range_m;
    loop.run_frame(x_m, is_open ? open : thicket, is_open ? 0.80 : 0.15);
    std::this_thread::sleep_for(std::chrono::milliseconds{5});
    const double t_s = now_s();
    x_m += loop.speed_m_s() * (t_s - last_s);
    last_s = t_s;
  }
  print("open", open);
  print("thicket", thicket);
  const bool fits = open.matching > 0.7 * open.frames && thicket.matching > 0.7 * thicket.frames;
  const bool follows = thicket.bound_s / thicket.frames > 1.2 * open.bound_s / open.frames &&
                       thicket.speed_m_s / thicket.frames < open.speed_m_s / open.frames;
  const bool holds = open.late + thicket.late < (open.frames + thicket.frames) / 5;
  std::puts(fits && follows && holds ? "right" : "wrong");
  return fits && follows && holds ? 0 : 1;
}
