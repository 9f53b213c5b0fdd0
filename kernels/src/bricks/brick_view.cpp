// SPDX-License-Identifier: BSD-3-Clause
#include "brick_view.h"

#include "box_words.h"
#include "brick_walk.h"
#include "inflation.h"
#include "obstacle_columns.h"
#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

constexpr std::uint8_t look_closer = 3;  // at the masks
using Answers = std::array<std::uint8_t, brick_code::count>;

/// What a brick's code says about its cells: their state, or `look_closer`.
constexpr Answers answers_at(int level) {
  Answers answers{};
  for (unsigned code = 0; code < brick_code::count; ++code) {
    const bool is_occupied = (code & brick_code::occupied(std::max(level, brick_level))) != 0;
    const auto state = is_occupied                               ? CellState::occupied
                       : (code & 3U) == brick_code::none_unknown ? CellState::free
                                                                 : CellState::unknown;
    const bool is_vague =
        is_occupied ? level < brick_level : (code & 3U) == brick_code::some_unknown;
    answers[code] = is_vague ? look_closer : static_cast<std::uint8_t>(state);
  }
  return answers;
}

constexpr auto at_once = [](const Aabb&) { return true; };

/// Which columns of cells a body's disc overlaps, as BodyShape::overlaps says it of each cell.
class DiscColumns {
 public:
  DiscColumns(const Lattice& lattice, const BodyShape& shape)
      : lattice_{lattice}, shape_{shape}, core_{core_of(lattice, shape)} {}

  /// Whether any of these cells of a brick is in such a column.
  [[nodiscard]] bool meets(const CellKey& brick, std::uint64_t cells) const {
    if ((cells & core_.cells_of(brick)) != 0) {
      return true;
    }
    const std::uint64_t pairs = cells | cells >> 32U;
    for (std::uint64_t left = (pairs | pairs >> 16U) & 0xffff; left != 0; left &= left - 1) {
      const auto bit = static_cast<int>(lowest_bit(left));
      if (overlaps(4 * brick.x + (bit & 3), 4 * brick.y + (bit >> 2))) {
        return true;
      }
    }
    return false;
  }

 private:
  /// Columns that a square in the disc meets: no sum of squares is needed for them.
  static BoxBricks core_of(const Lattice& lattice, const BodyShape& shape) {
    constexpr double shrink_m = 1e-6;  // far more than the rounding of borders, see touch_m
    const double half_m = std::sqrt(0.5) * shape.body().radius_m - shrink_m;
    const Vec3 half{half_m, half_m, 0.0};
    KeyBox keys{{0, 0, 0}, {-1, -1, -1}};
    if (half_m > 0.0) {
      (void)keys_in(lattice, {shape.focus() - half, shape.focus() + half}, 0.0, keys);
    }
    keys.low[2] = 0;
    keys.high[2] = Lattice::keys - 1;
    return BoxBricks{keys};
  }
  [[nodiscard]] bool overlaps(int x, int y) const {
    return squared_gap_m2(lattice_.side(x), shape_.focus().x()) +
               squared_gap_m2(lattice_.side(y), shape_.focus().y()) <
           shape_.squared_reach_m2();
  }
  static double squared_gap_m2(const std::array<double, 2>& side_m, double x_m) {
    const double gap = gap_m(side_m[0], side_m[1], x_m);
    return gap * gap;
  }
  const Lattice& lattice_;
  const BodyShape& shape_;
  BoxBricks core_;
};

}  // namespace

void BrickView::activate(int level) {
  static constexpr std::array<Answers, BrickCells::coarsest_level + 1> answers{
      answers_at(0), answers_at(1), answers_at(2), answers_at(3), answers_at(4), answers_at(5)};
  level_ = level;
  answers_ = answers[static_cast<std::size_t>(level)].data();
}

std::shared_ptr<const OccupancyView> BrickView::of_revision(
    std::shared_ptr<const BrickCells> cells) const {
  struct Kept {
    Kept(std::shared_ptr<const BrickCells> of_cells, const BrickView& like)
        : cells{std::move(of_cells)}, view{*cells, like} {}
    std::shared_ptr<const BrickCells> cells;  // Owners: see BrickMap::revision.
    BrickView view;
  };
  const auto kept = std::make_shared<const Kept>(std::move(cells), *this);
  return {kept, &kept->view};
}

/// Of a finest cell, at the active level.
inline CellState BrickView::seen_at(const Chunk& chunk, PackedCell cell) const {
  const std::size_t place = packed::brick_place(cell);
  const std::uint8_t answer = answers_[chunk.codes[place]];
  if (answer != look_closer) {
    return static_cast<CellState>(answer);
  }
  const std::size_t brick = packed::brick_number_at[place];
  const unsigned bit = packed::bit(cell);
  // No branch on what is found: 2 where it is occupied, else 1 where it is unknown.
  const std::uint64_t is_occupied = occupied_at(level_, chunk, brick) >> bit & 1U;
  const std::uint64_t is_unknown = chunk.masks[brick].unknown >> bit & 1U;
  return static_cast<CellState>(is_occupied << 1U | (is_unknown & ~is_occupied));
}

// Calls nothing but at its end, so that no register has to be saved for the usual case.
CellState BrickView::state(const Vec3& p_W) const {
  PackedCell cell{};
  if (!packed::pack(p_W, map_.lattice().cells_per_m(), cell)) {
    return unseen_state(p_W);
  }
  const Chunk& chunk = map_.near_chunk(cell);
  if (!chunk.answers(packed::chunk(cell))) {
    return far_state(p_W, cell);
  }
  const CellState seen = seen_at(chunk, cell);
  return clear_.is_empty() || seen != CellState::unknown ? seen : unseen_state(p_W);
}

CellState BrickView::far_state(const Vec3& p_W, PackedCell cell) const {
  const CellState seen = seen_at(map_.chunk_of(cell), cell);
  return seen == CellState::unknown ? unseen_state(p_W) : seen;
}

CellState BrickView::unseen_state(const Vec3& p_W) const {
  return p_W.allFinite() && clear_.contains(p_W) ? CellState::free : CellState::unknown;
}

CellState BrickView::body_state(const Vec3& p_WB, const Cylinder& body) const {
  if (!p_WB.allFinite()) {
    return CellState::unknown;
  }
  const BodyShape shape{p_WB, body};
  if (const auto seen = seen_by(shape)) {
    return *seen == CellState::unknown && !clear_.is_empty() ? beyond_clear(shape) : *seen;
  }
  return BrickWalk{map_, level_}.any_occupied(shape, at_once) ? CellState::occupied
                                                              : beyond_clear(shape);
}

/// Of a body without an obstacle.
CellState BrickView::beyond_clear(const BodyShape& shape) const {
  const auto is_open = [&](const Aabb& part) { return !clear_.cover(part, shape); };
  return BrickWalk{map_, level_}.any_unknown(shape, is_open) ? CellState::unknown : CellState::free;
}

/// The worst state in the body's box, or, where that is not free, in its disc's columns. Nothing
/// for a body too large for words, and at the edge of the lattice.
std::optional<CellState> BrickView::seen_by(const BodyShape& shape) const {
  KeyBox keys;
  if (!keys_in(map_.lattice(), shape.bounds(), touch_m, keys)) {
    return std::nullopt;
  }
  const BoxBricks bricks{keys};
  if (!bricks.fits()) {
    return std::nullopt;
  }
  const BoxWords words{map_, level_, bricks};
  if (!words.may_have_occupied() && !words.may_have_unknown()) {
    return CellState::free;
  }
  return words.is_blank() ? CellState::unknown : seen_by_disc(shape, words);
}

CellState BrickView::seen_by_disc(const BodyShape& shape, const BoxWords& words) const {
  const DiscColumns disc{map_.lattice(), shape};
  bool is_occupied = false;
  bool is_unknown = false;
  (void)words.any_brick([&](const CellKey& brick, std::uint64_t occupied, std::uint64_t unknown) {
    is_occupied = occupied != 0 && disc.meets(brick, occupied);
    is_unknown = is_unknown || (unknown != 0 && disc.meets(brick, unknown));
    return is_occupied || (is_unknown && !words.may_have_occupied());
  });
  return is_occupied ? CellState::occupied : is_unknown ? CellState::unknown : CellState::free;
}

bool BrickView::has_occupied(const Aabb& box) const {
  KeyBox keys;
  if (keys_in(map_.lattice(), box, touch_m, keys)) {
    if (keys.is_empty()) {
      return false;  // thinner than the margin
    }
    const BoxBricks bricks{keys};
    if (bricks.fits()) {
      const BoxWords words{map_, level_, bricks};
      return words.may_have_occupied() &&
             words.any_brick([](const CellKey&, std::uint64_t occupied, std::uint64_t) {
               return occupied != 0;
             });
    }
  }
  return BrickWalk{map_, level_}.any_occupied(BoxShape{box}, at_once);
}

bool BrickView::segment_hits(const Vec3& from, const Vec3& to, const Cylinder& body) const {
  return !from.allFinite() || !to.allFinite() ||
         BrickWalk{map_, level_}.any_occupied(SweepShape{from, to, body}, at_once);
}

double BrickView::obstacle_density(const Vec3& p_W, double radius_m, double half_band_m) const {
  return ObstacleColumns{p_W, radius_m, half_band_m}.density(
      [this](const Aabb& box) { return has_occupied(box); });
}

double BrickView::nearest_obstacle_m(const Vec3& p_W, double limit_m, double half_band_m) const {
  NearestShape shape{p_W, limit_m, half_band_m};
  (void)BrickWalk{map_, level_}.any_occupied(shape, [&](const Aabb& part) {
    shape.shrink_to(part);
    return false;
  });
  return shape.nearest_m();
}

void BrickView::inflate(const Aabb& box_W,
                        const Cylinder& body,
                        Obstruction by,
                        InflatedWindow& window) const {
  Inflation{{map_, clear_, level_, by}}.grow(box_W, body, window);
}

void BrickView::for_each_occupied(const std::function<void(const Aabb& cube)>& show) const {
  const BrickWalk walk{map_, level_};
  for (const Chunk* chunk : map_.chunks()) {
    const BoxShape space{map_.lattice().cube(chunk->key, chunk_level)};
    (void)walk.any_occupied(space, [&](const Aabb& cube) {
      show(cube);
      return false;
    });
  }
}

}  // namespace flyball
