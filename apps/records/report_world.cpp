// SPDX-License-Identifier: BSD-3-Clause
// tested-in: report

#include "records/report_world.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace flyball {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_boxes = 5000;  // More are drawn as a raster.
constexpr double raster_columns = 800.0;  // About the pixels that the page has for it.
constexpr double least_height_m = 0.3;    // Of what is drawn below the flight; less is ground.

Json corner(const Vec3& p_W) {
  return {json_number(p_W.x()), json_number(p_W.y())};
}

/// Square cells over the bounds, filled where a box is.
class Raster {
 public:
  explicit Raster(const Aabb& bounds_W)
      : bounds_W_{bounds_W}, extent_{bounds_W.max - bounds_W.min} {
    cell_m_ = std::max(0.05, std::max(extent_.x(), extent_.y()) / raster_columns);
    columns_ = static_cast<std::size_t>(std::ceil(extent_.x() / cell_m_)) + 1;
    rows_.assign(static_cast<std::size_t>(std::ceil(extent_.y() / cell_m_)) + 1,
                 std::vector<bool>(columns_));
  }

  void fill(const Aabb& box) {
    const Vec3 from = box.min - bounds_W_.min;
    const Vec3 to = box.max - bounds_W_.min;
    if (to.x() < 0.0 || to.y() < 0.0 || from.x() > extent_.x() || from.y() > extent_.y()) {
      return;
    }
    for (std::size_t y = index(from.y(), rows_.size()); y <= index(to.y(), rows_.size()); ++y) {
      const auto row = rows_[y].begin();
      std::fill(row + static_cast<std::ptrdiff_t>(index(from.x(), columns_)),
                row + static_cast<std::ptrdiff_t>(index(to.x(), columns_)) + 1, true);
    }
  }

  /// Each row lists start and length of its runs.
  [[nodiscard]] Json json() const {
    Json rows = Json::array();
    for (const std::vector<bool>& row : rows_) {
      rows.push_back(runs_of(row));
    }
    return {{"x_m", bounds_W_.min.x()},
            {"y_m", bounds_W_.min.y()},
            {"cell_m", cell_m_},
            {"rows", std::move(rows)}};
  }

 private:
  [[nodiscard]] std::size_t index(double at_m, std::size_t count) const {
    return static_cast<std::size_t>(
        std::clamp(at_m / cell_m_, 0.0, static_cast<double>(count - 1)));
  }
  static Json runs_of(const std::vector<bool>& row) {
    Json runs = Json::array();
    for (auto begin = std::find(row.begin(), row.end(), true); begin != row.end();) {
      const auto end = std::find(begin, row.end(), false);
      runs.push_back(begin - row.begin());
      runs.push_back(end - begin);
      begin = std::find(end, row.end(), true);
    }
    return runs;
  }

  Aabb bounds_W_;
  Vec3 extent_;
  double cell_m_{};
  std::size_t columns_{};
  std::vector<std::vector<bool>> rows_{};
};

Json raster(const Aabb& bounds_W, const std::vector<Aabb>& boxes) {
  Raster cells{bounds_W};
  for (const Aabb& box : boxes) {
    cells.fill(box);
  }
  return cells.json();
}

/// Those boxes and pillars whose lower and upper end are `wanted`.
template <class Wanted>
Json solids_json(const World& world, const Wanted& wanted) {
  std::vector<Aabb> boxes;
  std::copy_if(world.boxes.begin(), world.boxes.end(), std::back_inserter(boxes),
               [&](const Aabb& box) { return wanted(box.min.z(), box.max.z()); });
  Json json;
  if (boxes.size() > most_boxes) {
    json["raster"] = raster(world.bounds_W, boxes);
  } else {
    json["boxes"] = Json::array();
    for (const Aabb& box : boxes) {
      json["boxes"].push_back({json_number(box.min.x()), json_number(box.min.y()),
                               json_number(box.max.x()), json_number(box.max.y())});
    }
  }
  json["pillars"] = Json::array();
  for (const Pillar& pillar : world.pillars) {
    if (wanted(pillar.foot_W.z(), pillar.foot_W.z() + pillar.height_m)) {
      json["pillars"].push_back({json_number(pillar.foot_W.x()), json_number(pillar.foot_W.y()),
                                 json_number(pillar.radius_m)});
    }
  }
  return json;
}

}  // namespace

Json json_number(double value) {
  return std::isfinite(value) ? Json(std::round(value * 1e3) / 1e3) : Json(nullptr);
}

Json world_json(const World& world, const HeightBand& flown, bool has_goal) {
  Json json{{"min", corner(world.bounds_W.min)},
            {"max", corner(world.bounds_W.max)},
            {"start", corner(world.start_W)}};
  if (has_goal) {
    json["goal"] = corner(world.goal_W);
  }
  json.update(solids_json(world, [&](double low_m, double high_m) {
    return high_m > flown.low_m && low_m < flown.high_m;
  }));
  json["low"] = solids_json(world, [&](double, double high_m) {
    return high_m <= flown.low_m && high_m > world.ground_z_m + least_height_m;
  });
  return json;
}

Json map_json(const std::vector<OccupiedCell>& map, const Aabb& bounds_W, const HeightBand& flown) {
  std::vector<Aabb> cells;
  for (const OccupiedCell& cell : map) {
    const Vec3 half = Vec3::Constant(0.5 * cell.size_m);
    const Aabb box{cell.centre_W - half, cell.centre_W + half};
    if (box.max.z() > flown.low_m && box.min.z() < flown.high_m) {
      cells.push_back(box);
    }
  }
  return raster(bounds_W, cells);
}

}  // namespace flyball
