// SPDX-License-Identifier: BSD-3-Clause
#include "maps/octree_file.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>

namespace flyball {
namespace {

namespace fs = std::filesystem;

constexpr int deepest = 16;  // OctoMap's keys have 16 bits

Error invalid(const std::string& path, const std::string& what) {
  return {ErrorCode::invalid_input, "map file \"" + path + "\" " + what};
}

struct Header {
  bool is_binary{};
  std::uint64_t nodes{};
  double resolution_m{};
  std::size_t bytes{};  ///< Where the tree begins.
  std::string id{};     ///< The kind of tree.
};

std::string_view next_line(std::string_view text, std::size_t& at) {
  const std::size_t end = text.find('\n', at);
  const std::string_view line = text.substr(at, end - at);
  at = end == std::string_view::npos ? text.size() : end + 1;
  return line;
}

bool starts_with(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

/// A line of a name and a value.
Status read_setting(const std::string& path, std::string_view line, Header& header) {
  std::istringstream words{std::string{line}};
  std::string name;
  words >> name;
  if (name == "id") {
    words >> header.id;
  } else if (name == "size") {
    words >> header.nodes;
  } else if (name == "res") {
    words >> header.resolution_m;
  } else if (!name.empty() && name[0] != '#') {
    return invalid(path, "has a line in its header that is no setting of an OctoMap file");
  }
  if (words.fail()) {
    return invalid(path, "has a header whose \"" + name + "\" cannot be read");
  }
  return Done{};
}

/// Lines of settings, up to `data`.
Result<Header> read_header(const std::string& path, std::string_view content) {
  Header header;
  std::size_t at = 0;
  const std::string_view first = next_line(content, at);
  header.is_binary = starts_with(first, "# Octomap OcTree binary file");
  if (!header.is_binary && !starts_with(first, "# Octomap OcTree file")) {
    return invalid(path, "does not begin as an OctoMap file does");
  }
  while (at < content.size()) {
    const std::string_view line = next_line(content, at);
    if (line == "data") {
      header.bytes = at;
      break;
    }
    if (const Status read = read_setting(path, line, header); !read) {
      return read.error();
    }
  }
  if (header.bytes == 0) {
    return invalid(path, "ends before its data");
  }
  if (header.id != "OcTree") {
    return invalid(path, "holds a tree of another kind than OcTree");
  }
  if (!std::isfinite(header.resolution_m) || header.resolution_m < 0.01 ||
      header.resolution_m > 10.0) {
    return invalid(path, "has cells that are not between 0.01 and 10 m");
  }
  return header;
}

/// Walks a tree in a file, without building it.
class TreeCheck {
 public:
  TreeCheck(std::string_view bytes, bool is_binary) : bytes_{bytes}, is_binary_{is_binary} {}

  /// What is wrong; empty when nothing is.
  [[nodiscard]] std::string fault(std::uint64_t nodes) {
    if (nodes > 0) {
      nodes_ = 1;
      is_binary_ ? inner_node(0) : node(0);
    }
    if (fault_.empty() && nodes_ != nodes) {
      fault_ = "has " + std::to_string(nodes_) + " nodes and says " + std::to_string(nodes);
    }
    if (fault_.empty() && at_ != bytes_.size()) {
      fault_ = "has " + std::to_string(bytes_.size() - at_) + " bytes after its tree";
    }
    return fault_;
  }

 private:
  bool take(void* to, std::size_t bytes) {
    if (bytes_.size() - at_ < bytes) {
      fault_ = "ends within its tree";
      return false;
    }
    std::memcpy(to, bytes_.data() + at_, bytes);
    at_ += bytes;
    return true;
  }

  bool may_have_children(int depth, bool any) {
    if (!any) {
      fault_ = "has an inner node without children";
    } else if (depth == deepest) {
      fault_ = "has a tree of over 16 levels";
    }
    return fault_.empty();
  }

  /// `.bt`: two bits for each child: 1 free, 2 occupied, 3 an inner node, which follows.
  void inner_node(int depth) {
    std::uint8_t low = 0;
    std::uint8_t high = 0;
    if (!take(&low, 1) || !take(&high, 1)) {
      return;
    }
    const unsigned children = low | static_cast<unsigned>(high) << 8U;
    if (!may_have_children(depth, children != 0)) {
      return;
    }
    for (unsigned child = 0; child < 8 && fault_.empty(); ++child) {
      const unsigned kind = children >> 2 * child & 3U;
      nodes_ += kind != 0 ? 1 : 0;
      if (kind == 3) {
        inner_node(depth + 1);
      }
    }
  }

  /// `.ot`: log-odds, and one bit for each child, which follow.
  void node(int depth) {
    float log_odds = 0.0F;
    std::uint8_t children = 0;
    if (!take(&log_odds, sizeof log_odds) || !take(&children, 1)) {
      return;
    }
    if (!std::isfinite(log_odds)) {
      fault_ = "has a cell whose log-odds are not finite";
      return;
    }
    if (children != 0 && !may_have_children(depth, true)) {
      return;
    }
    for (unsigned child = 0; child < 8 && fault_.empty(); ++child) {
      if ((children >> child & 1U) != 0) {
        ++nodes_;
        node(depth + 1);
      }
    }
  }

  std::string_view bytes_;
  bool is_binary_;
  std::size_t at_{};
  std::uint64_t nodes_{};
  std::string fault_{};
};

/// OctoMap's `writeBinary`, which would also talk about it on standard error.
void write_bt(octomap::OcTree& tree, std::ostream& file) {
  tree.toMaxLikelihood();
  tree.prune();
  file << "# Octomap OcTree binary file\n"
          "# (feel free to add / change comments, but leave the first line as it is!)\n"
          "#\n"
          "id OcTree\n"
       << "size " << tree.size() << "\nres " << tree.getResolution() << "\ndata\n";
  if (tree.size() > 0) {
    tree.writeBinaryData(file);
  }
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

Result<std::unique_ptr<octomap::OcTree>> read_octree(const std::string& path) {
  std::error_code ignored;
  errno = 0;
  std::ifstream file{path, std::ios::binary};
  if (!file && errno != ENOENT && errno != 0) {
    return Error{ErrorCode::unavailable, "cannot read map file \"" + path +
                                             "\": " + std::generic_category().message(errno)};
  }
  if (!file || !fs::is_regular_file(path, ignored)) {
    return Error{ErrorCode::not_found, "no map file \"" + path + "\""};
  }
  try {
    const std::string content{std::istreambuf_iterator<char>{file}, {}};
    const auto header = read_header(path, content);
    if (!header) {
      return header.error();
    }
    const std::string_view tree_bytes = std::string_view{content}.substr(header->bytes);
    TreeCheck check{tree_bytes, header->is_binary};
    if (const std::string fault = check.fault(header->nodes); !fault.empty()) {
      return invalid(path, fault);
    }
    auto tree = std::make_unique<octomap::OcTree>(header->resolution_m);
    std::istringstream checked{std::string{tree_bytes}};
    if (header->nodes > 0) {
      header->is_binary ? tree->readBinaryData(checked) : tree->readData(checked);
    }
    return tree;
  } catch (const std::exception& e) {
    return Error{ErrorCode::failed, "map file \"" + path + "\": " + e.what()};
  }
}

Status write_octree(octomap::OcTree& tree, const std::string& path) {
  const bool is_binary = ends_with(path, ".bt");
  if (!is_binary && !ends_with(path, ".ot")) {
    return Error{ErrorCode::invalid_input,
                 "map file \"" + path + "\" must end in .bt (free or occupied) or .ot (log-odds)"};
  }
  const Error failed{ErrorCode::failed, "cannot write map file \"" + path + "\""};
  const std::string beside = path + ".part";
  try {
    errno = 0;
    std::ofstream file{beside, std::ios::binary};
    is_binary ? write_bt(tree, file) : static_cast<void>(tree.write(file));
    file.close();
    if (!file) {
      const int reason = errno;  // Of the system's call that failed, if one did.
      std::error_code ignored;
      fs::remove(beside, ignored);
      return reason == 0 ? failed
                         : Error{failed.code,
                                 failed.message + ": " + std::generic_category().message(reason)};
    }
    fs::rename(beside, path);
  } catch (const std::exception& e) {
    std::error_code ignored;
    fs::remove(beside, ignored);
    return Error{ErrorCode::failed, failed.message + ": " + e.what()};
  }
  return Done{};
}

}  // namespace flyball
