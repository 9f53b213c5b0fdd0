// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/world.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

// Distance from `x` to the interval.
double outside(double x, double low, double high) {
  return std::max({low - x, x - high, 0.0});
}

// Gap between two intervals, the first given by centre and half length.
double gap(double centre, double half, double low, double high) {
  return std::max({low - centre - half, centre - half - high, 0.0});
}

// std::hypot guards against overflow that metres cannot reach, at several times the cost.
double length(double a, double b) {
  return std::sqrt(a * a + b * b);
}

// The body is disc x interval and so is each solid (rectangle or disc, x interval): the distance of
// two such products splits exactly into a horizontal and a vertical part.
double distance(const Vec3& p_WB, const Cylinder& body, const Aabb& box) {
  const double dx = outside(p_WB.x(), box.min.x(), box.max.x());
  const double dy = outside(p_WB.y(), box.min.y(), box.max.y());
  const double across = std::max(length(dx, dy) - body.radius_m, 0.0);
  return length(across, gap(p_WB.z(), body.half_height_m, box.min.z(), box.max.z()));
}

double distance(const Vec3& p_WB, const Cylinder& body, const Pillar& pillar) {
  const double between = (p_WB - pillar.foot_W).head<2>().norm();
  const double across = std::max(between - body.radius_m - pillar.radius_m, 0.0);
  const double foot = pillar.foot_W.z();
  return length(across, gap(p_WB.z(), body.half_height_m, foot, foot + pillar.height_m));
}

Aabb extent(const Pillar& pillar) {
  const Vec3 side{pillar.radius_m, pillar.radius_m, 0.0};
  return {pillar.foot_W - side, pillar.foot_W + side + Vec3{0.0, 0.0, pillar.height_m}};
}

// Columns that an extent touches, inside the grid by construction.
struct Cells {
  int x0{};
  int x1{};
  int y0{};
  int y1{};
};

struct Grid {
  Vec3 origin;
  double cell_m;
  int nx;
  int ny;

  [[nodiscard]] Cells cells(const Aabb& box) const {
    const auto index = [this](double from_origin, int n) {
      return std::clamp(static_cast<int>(std::floor(from_origin / cell_m)), 0, n - 1);
    };
    return {index(box.min.x() - origin.x(), nx), index(box.max.x() - origin.x(), nx),
            index(box.min.y() - origin.y(), ny), index(box.max.y() - origin.y(), ny)};
  }
};

// Indices of the extents, sorted by column; `first[c]` is where column c begins.
void sort_into(const Grid& grid,
               const std::vector<Aabb>& extents,
               std::vector<int>& first,
               std::vector<int>& items) {
  std::vector<std::vector<int>> in(static_cast<std::size_t>(grid.nx) *
                                   static_cast<std::size_t>(grid.ny));
  for (std::size_t i = 0; i < extents.size(); ++i) {
    const Cells at = grid.cells(extents[i]);
    const int wide = at.x1 - at.x0 + 1;
    for (int n = 0; n < wide * (at.y1 - at.y0 + 1); ++n) {
      const int column = (at.y0 + n / wide) * grid.nx + at.x0 + n % wide;
      in[static_cast<std::size_t>(column)].push_back(static_cast<int>(i));
    }
  }
  for (const auto& column : in) {
    first.push_back(static_cast<int>(items.size()));
    items.insert(items.end(), column.begin(), column.end());
  }
  first.push_back(static_cast<int>(items.size()));
}

Grid grid_around(const std::vector<Aabb>& boxes, const std::vector<Aabb>& pillars) {
  if (boxes.empty() && pillars.empty()) {
    return {Vec3::Zero(), 4.0, 1, 1};
  }
  Eigen::AlignedBox2d all;
  for (const auto* extents : {&boxes, &pillars}) {
    for (const Aabb& box : *extents) {
      all.extend(Eigen::Vector2d{box.min.head<2>()});
      all.extend(Eigen::Vector2d{box.max.head<2>()});
    }
  }
  // About one solid per column, between half the door's width and a block's size: finer columns
  // only multiply the entries of long walls, coarser ones the solids to look at. A file may place
  // two solids 20 km apart: then columns are wider, so that their number stays bounded.
  constexpr double most_columns = 4e6;  // 130 MB while they are sorted.
  const Eigen::Vector2d size = all.sizes();
  const double solids = static_cast<double>(boxes.size() + pillars.size());
  const double cell_m = std::max(std::clamp(std::sqrt(size.x() * size.y() / solids), 0.4, 4.0),
                                 std::sqrt(size.x() * size.y() / most_columns));
  const auto count = [cell_m](double length) { return static_cast<int>(length / cell_m) + 1; };
  return {Vec3{all.min().x(), all.min().y(), 0.0}, cell_m, count(size.x()), count(size.y())};
}

template <class Look>
void for_each_in_ring(int cx, int cy, int ring, const Look& look) {
  for (int i = -ring; i <= ring; ++i) {
    look(cx + i, cy - ring);
    if (ring > 0) {
      look(cx + i, cy + ring);
    }
  }
  for (int j = 1 - ring; j < ring; ++j) {
    look(cx - ring, cy + j);
    look(cx + ring, cy + j);
  }
}

}  // namespace

Clearance::Clearance(const World& world)
    : ground_z_m_{world.ground_z_m},
      has_ground_{world.has_ground},
      boxes_{world.boxes},
      pillars_{world.pillars} {
  std::vector<Aabb> pillar_extents;
  for (const Pillar& pillar : pillars_) {
    pillar_extents.push_back(extent(pillar));
  }
  const Grid grid = grid_around(boxes_, pillar_extents);
  origin_ = grid.origin;
  cell_m_ = grid.cell_m;
  columns_x_ = grid.nx;
  columns_y_ = grid.ny;
  std::vector<int> first_box;
  std::vector<int> first_pillar;
  sort_into(grid, boxes_, first_box, boxes_in_);
  sort_into(grid, pillar_extents, first_pillar, pillars_in_);
  for (std::size_t i = 0; i < first_box.size(); ++i) {
    columns_.push_back({first_box[i], first_pillar[i]});
  }
}

double Clearance::nearest_in(int column,
                             const Vec3& p_WB,
                             const Cylinder& body,
                             double best_m) const {
  const auto c = static_cast<std::size_t>(column);
  const double reach_m = body.half_height_m + best_m;
  for (int i = columns_[c].first_box; i < columns_[c + 1].first_box; ++i) {
    const Aabb& box = boxes_[static_cast<std::size_t>(boxes_in_[static_cast<std::size_t>(i)])];
    if (outside(p_WB.z(), box.min.z(), box.max.z()) < reach_m) {
      best_m = std::min(best_m, distance(p_WB, body, box));
    }
  }
  for (int i = columns_[c].first_pillar; i < columns_[c + 1].first_pillar; ++i) {
    const auto pillar = static_cast<std::size_t>(pillars_in_[static_cast<std::size_t>(i)]);
    best_m = std::min(best_m, distance(p_WB, body, pillars_[pillar]));
  }
  return best_m;
}

double Clearance::distance_m(const Vec3& p_WB,
                             const Cylinder& body,
                             double limit_m,
                             bool ignore_ground) const {
  double best_m = limit_m;
  if (has_ground_ && !ignore_ground) {
    const double above = p_WB.z() - body.half_height_m - ground_z_m_;
    best_m = std::min(best_m, std::max(above, 0.0));
  }
  // Rings of columns around the body's own (which may lie outside the grid), nearest first.
  const double x = std::clamp((p_WB.x() - origin_.x()) / cell_m_, -1e6, 1e6);
  const double y = std::clamp((p_WB.y() - origin_.y()) / cell_m_, -1e6, 1e6);
  const int cx = static_cast<int>(std::floor(x));
  const int cy = static_cast<int>(std::floor(y));
  const double to_edge = std::min({x - cx, 1.0 - (x - cx), y - cy, 1.0 - (y - cy)});
  const int first = std::max({0, -cx, cx - columns_x_ + 1, -cy, cy - columns_y_ + 1});
  const int last = std::max({cx, columns_x_ - 1 - cx, cy, columns_y_ - 1 - cy});
  const auto look = [&](int i, int j) {
    if (i >= 0 && i < columns_x_ && j >= 0 && j < columns_y_) {
      best_m = nearest_in(j * columns_x_ + i, p_WB, body, best_m);
    }
  };
  for (int ring = first; ring <= last; ++ring) {
    const double ring_m = ring == 0 ? 0.0 : (ring - 1 + to_edge) * cell_m_;
    if (best_m <= 0.0 || ring_m - body.radius_m >= best_m) {
      break;
    }
    for_each_in_ring(cx, cy, ring, look);
  }
  return std::max(best_m, 0.0);
}

double distance_to_people_m(const std::vector<Person>& people,
                            MissionTime now,
                            const Vec3& p_WB,
                            const Cylinder& body,
                            double limit_m) {
  for (const Person& person : people) {
    const Pillar taken{person.at(now).foot_W, person.radius_m, person.height_m};
    limit_m = std::min(limit_m, distance(p_WB, body, taken));
  }
  return limit_m;
}

}  // namespace flyball
