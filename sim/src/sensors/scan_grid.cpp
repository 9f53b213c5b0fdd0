// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/scan_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <tuple>

namespace flyball {
namespace {

using Index = ScanGrid::Index;

constexpr int tree_depth = 16;  // OctoMap's keys have 16 bits an axis.
constexpr int tree_centre = 1 << (tree_depth - 1);

struct Leaf {
  Index low;
  int size;
  CellState state;
};

// Node by node, depth first: two bytes hold two bits for each of eight children.
class TreeReader {
 public:
  explicit TreeReader(std::istream& stream) : stream_{stream} {}

  // False when the data ends early or the tree is too deep.
  bool read(const Index& low, int size) {  // NOLINT(misc-no-recursion): at most 16 deep
    std::array<char, 2> bytes{};
    if (size < 2 || !stream_.read(bytes.data(), bytes.size())) {
      return false;
    }
    const unsigned bits = static_cast<unsigned char>(bytes[0]) |
                          static_cast<unsigned>(static_cast<unsigned char>(bytes[1])) << 8U;
    const int half = size / 2;
    bool good = true;
    for (int child = 0; child < 8 && good; ++child) {
      const Index corner = low + half * Index{child & 1, (child >> 1) & 1, (child >> 2) & 1};
      switch ((bits >> (2U * static_cast<unsigned>(child))) & 3U) {
        case 1:
          leaves.push_back({corner, half, CellState::free});
          break;
        case 2:
          leaves.push_back({corner, half, CellState::occupied});
          break;
        case 3:
          good = read(corner, half);
          break;
        default:
          break;
      }
    }
    return good;
  }

  std::vector<Leaf> leaves;

 private:
  std::istream& stream_;
};

// Cell size, with the stream at the first byte of the tree; an empty optional-like 0 when it is no
// .bt.
double read_header(std::istream& stream) {
  std::string line;
  std::getline(stream, line);
  if (line.rfind("# Octomap OcTree binary file", 0) != 0) {
    return 0.0;
  }
  double resolution_m = 0.0;
  bool is_octree = false;
  while (std::getline(stream, line) && line != "data") {
    std::istringstream words{line};
    std::string key;
    words >> key;
    if (key == "res") {
      words >> resolution_m;
    } else if (key == "id") {
      std::string id;
      words >> id;
      is_octree = id == "OcTree";
    }
  }
  return stream && is_octree && std::isfinite(resolution_m) ? resolution_m : 0.0;
}

// x runs fastest, then y, then z.
template <class Visit>
void for_each_cell(const Index& low, const Index& high, const Visit& visit) {
  const Index n = high - low + Index::Ones();
  const std::int64_t count = n.cast<std::int64_t>().prod();
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t row = i / n.x();
    visit(low + Index{static_cast<int>(i % n.x()), static_cast<int>(row % n.y()),
                      static_cast<int>(row / n.y())});
  }
}

Error unreadable(const std::string& path, const std::string& why) {
  return {ErrorCode::invalid_input, "map file \"" + path + "\" " + why};
}

// Cells [low, high] of a box while it grows.
struct Block {
  Index low;
  Index high;
};

// Joins blocks that follow each other along `axis` and are equal along the other two.
std::vector<Block> joined(std::vector<Block> blocks, int axis) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  const auto side = [=](const Block& b) {
    return std::tuple{b.low[u], b.high[u], b.low[v], b.high[v]};
  };
  std::sort(blocks.begin(), blocks.end(), [&](const Block& a, const Block& b) {
    return std::tuple{side(a), a.low[axis]} < std::tuple{side(b), b.low[axis]};
  });
  std::vector<Block> out;
  for (const Block& block : blocks) {
    if (!out.empty() && side(out.back()) == side(block) &&
        out.back().high[axis] + 1 == block.low[axis]) {
      out.back().high[axis] = block.high[axis];
    } else {
      out.push_back(block);
    }
  }
  return out;
}

}  // namespace

ScanGrid::ScanGrid(double resolution_m, const Index& low, const Index& high)
    : resolution_m_{resolution_m}, low_{low}, high_{high} {
  states_.assign(offset(high) + 1, CellState::unknown);
}

Aabb ScanGrid::extent_W() const {
  return {low_.cast<double>() * resolution_m_,
          (high_ + Index::Ones()).cast<double>() * resolution_m_};
}

bool ScanGrid::contains(const Index& cell) const {
  return (cell.array() >= low_.array()).all() && (cell.array() <= high_.array()).all();
}

std::size_t ScanGrid::offset(const Index& cell) const {
  const Eigen::Matrix<std::size_t, 3, 1> at = (cell - low_).cast<std::size_t>();
  const Eigen::Matrix<std::size_t, 3, 1> n = (high_ - low_ + Index::Ones()).cast<std::size_t>();
  return (at.z() * n.y() + at.y()) * n.x() + at.x();
}

CellState ScanGrid::state(const Index& cell) const {
  return contains(cell) ? states_[offset(cell)] : CellState::unknown;
}

Result<ScanGrid> read_scan(const std::string& path) {
  std::ifstream stream{path, std::ios::binary};
  if (!stream) {
    return Error{ErrorCode::not_found, "no map file \"" + path + "\""};
  }
  const double resolution_m = read_header(stream);
  if (resolution_m <= 0.0) {
    return unreadable(path, "is no binary OcTree (.bt)");
  }
  TreeReader tree{stream};
  if (!tree.read(Index::Constant(-tree_centre), 2 * tree_centre)) {
    return unreadable(path, "ends early or is damaged");
  }
  if (tree.leaves.empty()) {
    return unreadable(path, "is empty");
  }
  Index low = tree.leaves.front().low;
  Index high = low;
  for (const Leaf& leaf : tree.leaves) {
    low = low.cwiseMin(leaf.low);
    high = high.cwiseMax(leaf.low + Index::Constant(leaf.size - 1));
  }
  if ((high - low + Index::Ones()).cast<double>().prod() > most_grid_cells) {
    return unreadable(path, "has an extent of more than 2e8 cells; crop it or use a coarser one");
  }
  ScanGrid grid{resolution_m, low, high};
  for (const Leaf& leaf : tree.leaves) {
    for_each_cell(leaf.low, leaf.low + Index::Constant(leaf.size - 1),
                  [&](const Index& cell) { grid.set(cell, leaf.state); });
  }
  return grid;
}

std::vector<Aabb> merged_boxes(const ScanGrid& grid,
                               const std::function<bool(const ScanGrid::Index&)>& is_solid) {
  std::vector<Block> cells;
  for_each_cell(grid.low(), grid.high(), [&](const Index& cell) {
    if (is_solid(cell)) {
      cells.push_back({cell, cell});
    }
  });
  std::vector<Aabb> boxes;
  for (const Block& block : joined(joined(joined(std::move(cells), 0), 1), 2)) {
    boxes.push_back({block.low.cast<double>() * grid.resolution_m(),
                     (block.high + Index::Ones()).cast<double>() * grid.resolution_m()});
  }
  return boxes;
}

}  // namespace flyball
