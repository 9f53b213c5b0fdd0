// SPDX-License-Identifier: BSD-3-Clause
#include "world/scan_file.h"

#include "world/missing_file.h"
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace flyball {
namespace {

using Index = ScanGrid::Index;

constexpr int tree_depth = 16;  // OctoMap's keys have 16 bits an axis.
constexpr int tree_centre = 1 << (tree_depth - 1);
// Where Debian's liboctomap-dev puts its examples.
constexpr const char* example_folder = "/usr/share/doc/liboctomap-dev/examples/data/";

constexpr double least_cell_m = 0.01;
constexpr double widest_cell_m = 10.0;

struct Leaf {
  Index low;
  int size;
  CellState state;
};

Index corner_of(const Index& low, int half, int child) {
  return low + half * Index{child & 1, (child >> 1) & 1, (child >> 2) & 1};
}

// Node by node, depth first.
class TreeReader {
 public:
  explicit TreeReader(std::istream& stream) : stream_{stream} {}

  // `.bt`: two bytes hold two bits for each of eight children. False when the data ends early or
  // the tree is too deep.
  bool read_states(const Index& low, int size) {  // NOLINT(misc-no-recursion): at most 16 deep
    std::array<char, 2> bytes{};
    if (size < 2 || !stream_.read(bytes.data(), bytes.size())) {
      return false;
    }
    const unsigned bits = static_cast<unsigned char>(bytes[0]) |
                          static_cast<unsigned>(static_cast<unsigned char>(bytes[1])) << 8U;
    const int half = size / 2;
    bool good = true;
    for (int child = 0; child < 8 && good; ++child) {
      const Index corner = corner_of(low, half, child);
      switch ((bits >> (2U * static_cast<unsigned>(child))) & 3U) {
        case 1:
          leaves.push_back({corner, half, CellState::free});
          break;
        case 2:
          leaves.push_back({corner, half, CellState::occupied});
          break;
        case 3:
          good = read_states(corner, half);
          break;
        default:
          break;
      }
    }
    return good;
  }

  // `.ot`: log-odds and one bit for each of eight children, which follow. False as above, and where
  // log-odds are not finite.
  bool read_log_odds(const Index& low, int size) {  // NOLINT(misc-no-recursion): at most 16 deep
    std::array<char, 5> bytes{};
    if (size < 1 || !stream_.read(bytes.data(), bytes.size())) {
      return false;
    }
    float log_odds = 0.0F;
    std::memcpy(&log_odds, bytes.data(), sizeof log_odds);
    const unsigned children = static_cast<unsigned char>(bytes[4]);
    if (children == 0) {
      leaves.push_back({low, size, log_odds >= 0.0F ? CellState::occupied : CellState::free});
    }
    bool good = std::isfinite(log_odds);
    for (int child = 0; child < 8 && good; ++child) {
      if ((children >> static_cast<unsigned>(child) & 1U) != 0) {
        good = read_log_odds(corner_of(low, size / 2, child), size / 2);
      }
    }
    return good;
  }

  std::vector<Leaf> leaves;

 private:
  std::istream& stream_;
};

struct ScanHeader {
  bool is_octree{};
  bool has_log_odds{};
  double resolution_m{};
};

// Leaves the stream at the first byte of the tree.
ScanHeader read_header(std::istream& stream) {
  ScanHeader header;
  std::string line;
  std::getline(stream, line);
  header.has_log_odds = line.rfind("# Octomap OcTree file", 0) == 0;
  if (!header.has_log_odds && line.rfind("# Octomap OcTree binary file", 0) != 0) {
    return header;
  }
  while (std::getline(stream, line) && line != "data") {
    std::istringstream words{line};
    std::string key;
    words >> key;
    if (key == "res") {
      words >> header.resolution_m;
    } else if (key == "id") {
      std::string id;
      words >> id;
      header.is_octree = id == "OcTree";
    }
  }
  header.is_octree = header.is_octree && stream;
  return header;
}

Error unreadable_scan(const std::string& path, const std::string& why) {
  return {ErrorCode::invalid_input, "map file \"" + path + "\" " + why};
}

Result<ScanGrid> grid_of(const std::string& path,
                         double resolution_m,
                         const std::vector<Leaf>& leaves) {
  if (leaves.empty()) {
    return unreadable_scan(path, "is empty");
  }
  Index low = leaves.front().low;
  Index high = low;
  for (const Leaf& leaf : leaves) {
    low = low.cwiseMin(leaf.low);
    high = high.cwiseMax(leaf.low + Index::Constant(leaf.size - 1));
  }
  if ((high - low + Index::Ones()).cast<double>().prod() > most_grid_cells) {
    return unreadable_scan(path,
                           "has an extent of more than 2e8 cells; crop it or use a coarser one");
  }
  ScanGrid grid{resolution_m, low, high};
  for (const Leaf& leaf : leaves) {
    for_each_cell(leaf.low, leaf.low + Index::Constant(leaf.size - 1),
                  [&](const Index& cell) { grid.set(cell, leaf.state); });
  }
  return grid;
}

}  // namespace

std::string scan_path(const std::string& file) {
  std::error_code failed;
  const bool is_example = file.find('/') == std::string::npos &&
                          !std::filesystem::exists(file, failed) &&
                          std::filesystem::exists(example_folder + file, failed);
  return is_example ? example_folder + file : file;
}

Result<ScanGrid> read_scan(const std::string& path) {
  std::error_code failed;
  std::ifstream stream{path, std::ios::binary};
  if (!stream || !std::filesystem::is_regular_file(path, failed)) {
    return missing_file("map file", path);
  }
  const ScanHeader header = read_header(stream);
  if (!header.is_octree) {
    return unreadable_scan(path, "is no OcTree of OctoMap's (.bt or .ot)");
  }
  if (!(header.resolution_m >= least_cell_m && header.resolution_m <= widest_cell_m)) {
    return unreadable_scan(path, "has cells that are not between 0.01 and 10 m");
  }
  TreeReader tree{stream};
  const Index low = Index::Constant(-tree_centre);
  const bool good = header.has_log_odds ? tree.read_log_odds(low, 2 * tree_centre)
                                        : tree.read_states(low, 2 * tree_centre);
  if (!good) {
    return unreadable_scan(path, "ends early or is damaged");
  }
  return grid_of(path, header.resolution_m, tree.leaves);
}

}  // namespace flyball
