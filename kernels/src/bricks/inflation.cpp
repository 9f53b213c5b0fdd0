// SPDX-License-Identifier: BSD-3-Clause
// tested-in: inflated_window
#include "inflation.h"

#include "box_words.h"
#include <algorithm>
#include <array>

namespace flyball {
namespace {

constexpr int bricks_in_word = 16;

/// Word n gets nibble n of every word: rows of cells out of bricks that stand side by side.
void transpose(std::array<std::uint64_t, bricks_in_word>& words) {
  constexpr std::array<std::uint64_t, 4> lower{0x0f0f0f0f0f0f0f0f, 0x00ff00ff00ff00ff,
                                               0x0000ffff0000ffff, 0x00000000ffffffff};
  for (std::size_t stage = 0; stage < 4; ++stage) {
    const std::size_t apart = std::size_t{1} << stage;
    const std::size_t shift = 4 * apart;
    for (std::size_t i = 0; i < words.size(); ++i) {
      if ((i & apart) == 0) {
        const std::uint64_t swap = (words[i] >> shift ^ words[i + apart]) & lower[stage];
        words[i + apart] ^= swap;
        words[i] ^= swap << shift;
      }
    }
  }
}

int bricks_around(int cells) {
  return (cells + 3) / 4;
}

}  // namespace

CellReach::CellReach(const Cylinder& body, double cell_m) {
  const Cylinder whole = solid(body);
  const auto gap_of = [&](int cells) { return std::max(cells - 1, 0) * cell_m; };
  while (gap_of(up + 1) < whole.half_height_m - touch_m && up <= Inflation::most_reach) {
    ++up;
  }
  const double reach_m = whole.radius_m - touch_m;
  const auto is_reached = [&](int x, int y) {
    return gap_of(x) * gap_of(x) + gap_of(y) * gap_of(y) < reach_m * reach_m &&
           x <= Inflation::most_reach + 1 && y <= Inflation::most_reach + 1;
  };
  for (int y = 0; is_reached(0, y); ++y) {
    int x = 0;
    while (is_reached(x + 1, y)) {
      ++x;
    }
    half_width.push_back(x);
  }
}

void Inflation::grow(const Aabb& box_W, const Cylinder& body, InflatedWindow& window) {
  const Lattice& lattice = source_.map.lattice();
  const CellReach reach{body, lattice.cell_m(0)};
  margin_ = {bricks_in_word, bricks_around(reach.across()), bricks_around(reach.up)};
  const double margin_m = (most_reach + 2) * lattice.cell_m(0);
  const Vec3 margin = Vec3::Constant(margin_m);
  if (!lattice.contains(box_W.min - margin) || !lattice.contains(box_W.max + margin) ||
      (box_W.max - box_W.min).minCoeff() < 0.0 || reach.across() > most_reach ||
      reach.up > most_reach) {
    window.lay_out({});
    return;
  }
  const CellKey first = lattice.cell(box_W.min).above(brick_level);
  const CellKey last = lattice.cell(box_W.max).above(brick_level);
  const CellKey bricks{last.x - first.x + 1, last.y - first.y + 1, last.z - first.z + 1};
  const int origin = Lattice::half_keys;
  window.lay_out({lattice.cell_m(0),
                  {4 * first.x - origin, 4 * first.y - origin, 4 * first.z - origin},
                  {4 * bricks.x, 4 * bricks.y, 4 * bricks.z}});
  first_near_ = margin_.x - bricks_around(reach.across());
  last_near_ = margin_.x + bricks.x - 1 + bricks_around(reach.across());
  const int words = (bricks.x + bricks_in_word - 1) / bricks_in_word;
  read({first.x - margin_.x, first.y - margin_.y, first.z - margin_.z},
       {words + 2, bricks.y + 2 * margin_.y, bricks.z + 2 * margin_.z});
  for (int z = 0; z < 4 * bricks.z; ++z) {
    const auto plane = static_cast<std::size_t>(z);
    join_planes(plane, reach.up);
    int width = 0;
    for (int across = reach.across(); across >= 0; --across) {  // wider and wider
      for (const int to = reach.half_width[static_cast<std::size_t>(across)]; width < to;) {
        const int more = std::min(to - width, 2 * width + 1);
        widen(static_cast<unsigned>(more));
        width += more;
      }
      join_rows(static_cast<std::size_t>(across), plane, window);
    }
  }
}

/// @param size  Words along x, bricks along y and z.
void Inflation::read(const CellKey& first, const CellKey& size) {
  seen_.rows = plane_.rows = before_.rows = 4 * static_cast<std::size_t>(size.y);
  seen_.words = plane_.words = before_.words = static_cast<std::size_t>(size.x);
  seen_.resize(4 * static_cast<std::size_t>(size.z));
  plane_.resize(1);
  before_.resize(1);
  for (int z = 0; z < size.z; ++z) {
    for (int y = 0; y < size.y; ++y) {
      for (int word = 0; word < size.x; ++word) {
        read_sixteen(first, {word, y, z});
      }
    }
  }
}

/// @param at  Word, and brick along y and z, counted from the first.
void Inflation::read_sixteen(const CellKey& first, const CellKey& at) {
  std::array<std::uint64_t, bricks_in_word> words{};
  for (int i = 0; i < bricks_in_word; ++i) {
    const int brick = bricks_in_word * at.x + i;
    const bool is_near = brick >= first_near_ && brick <= last_near_;
    words[static_cast<std::size_t>(i)] =
        is_near ? obstructed({first.x + brick, first.y + at.y, first.z + at.z}) : 0;
  }
  transpose(words);
  for (std::size_t z = 0; z < 4; ++z) {
    std::uint64_t* column =
        seen_.column(4 * static_cast<std::size_t>(at.z) + z, static_cast<std::size_t>(at.x)) +
        4 * static_cast<std::size_t>(at.y);
    std::copy_n(&words[4 * z], 4, column);
  }
}

std::uint64_t Inflation::obstructed(const CellKey& brick) const {
  const Chunk& chunk = source_.map.chunk_at(brick.above(chunk_level - brick_level));
  const std::size_t number = brick_number(brick);
  const std::uint64_t occupied = occupied_at(source_.level, chunk, number);
  std::uint64_t unknown = 0;
  if (source_.by == Obstruction::occupied_or_unknown) {
    unknown = chunk.masks[number].unknown;
    if (unknown != 0 && !source_.clear.is_empty()) {
      unknown &= ~source_.clear.cells_inside(source_.map.lattice(), brick);
    }
  }
  return occupied | unknown;
}

void Inflation::join_planes(std::size_t plane, int up) {
  const std::size_t size = seen_.plane_size();
  const std::size_t middle = plane + 4 * static_cast<std::size_t>(margin_.z);
  std::copy_n(seen_.column(middle, 0), size, plane_.bits.data());
  for (std::size_t away = 1; away <= static_cast<std::size_t>(up); ++away) {
    source_.map.loops().join_words(plane_.bits.data(), seen_.column(middle + away, 0),
                                   seen_.column(middle - away, 0), size);
  }
}

/// @param cells  1 to 63, to either side.
void Inflation::widen(unsigned cells) {
  std::swap(plane_.bits, before_.bits);
  for (std::size_t word = 0; word < plane_.words; ++word) {
    const std::uint64_t* at = before_.column(0, word);
    // The outermost words are margins: what would come from beyond them is too far to be reached.
    const std::uint64_t* left = word > 0 ? before_.column(0, word - 1) : at;
    const std::uint64_t* right = word + 1 < plane_.words ? before_.column(0, word + 1) : at;
    source_.map.loops().widen_words({at, left, right, plane_.rows}, cells, plane_.column(0, word));
  }
}

/// Adds the rows that are `across` away on either side.
void Inflation::join_rows(std::size_t across, std::size_t plane, InflatedWindow& window) {
  const auto rows = static_cast<std::size_t>(window.layout().cells[1]);
  const std::size_t words = plane_.words - 2;
  const std::size_t middle = 4 * static_cast<std::size_t>(margin_.y);
  for (std::size_t word = 0; word < words; ++word) {
    const std::uint64_t* from = plane_.column(0, word + 1) + middle;
    std::uint64_t* out = window.words() + (plane * words + word) * rows;
    source_.map.loops().join_words(out, from + across, from - across, rows);
  }
}

}  // namespace flyball
