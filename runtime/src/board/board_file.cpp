// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/board/board_file.h"

#include "flyball/runtime/text/number_text.h"
#include "flyball/runtime/text/toml_text.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <set>

#include <toml++/toml.h>

namespace flyball {
namespace {

/// Reads the keys of one table and collects what is wrong with them.
class BoardTable {
 public:
  explicit BoardTable(const toml::table& table) : table_{table} {}

  void text(const char* key, std::string& value) {
    if (const toml::node* node = look_up(key)) {
      if (const auto given = node->value_exact<std::string>(); given && !given->empty()) {
        value = *given;
      } else {
        complain(key, "must be a text that is not empty");
      }
    }
  }

  void flag(const char* key, bool& value) {
    if (const toml::node* node = look_up(key)) {
      if (const auto given = node->value_exact<bool>()) {
        value = *given;
      } else {
        complain(key, "must be true or false");
      }
    }
  }

  void number(const char* key, double min, double max, double& value) {
    if (const toml::node* node = look_up(key)) {
      const auto given = node->is_number() ? node->value<double>() : std::nullopt;
      if (given && *given >= min && *given <= max) {
        value = *given;
      } else {
        complain(key, "must be a number from " + short_number_text(min) + " to " +
                          short_number_text(max));
      }
    }
  }

  void texts(const char* key, std::vector<std::string>& values) {
    for (const toml::node* node : list(key)) {
      if (const auto given = node->value_exact<std::string>(); given && !given->empty()) {
        values.push_back(*given);
      } else {
        complain(key, "must be a list of texts that are not empty");
      }
    }
  }

  void cores(const char* key, std::vector<int>& values) {
    for (const toml::node* node : list(key)) {
      const auto given = node->value_exact<std::int64_t>();
      constexpr int most_cpus = 8192;  // CONFIG_NR_CPUS of the largest kernels.
      const bool is_core = given && *given >= 0 && *given < most_cpus;
      if (is_core && seen_cores_.insert(*given).second) {
        values.push_back(static_cast<int>(*given));
      } else {
        complain(key, "must be a list of numbers of cores, each of them once");
      }
    }
  }

  [[nodiscard]] std::string problems() {
    for (const auto& [key, node] : table_) {
      const std::string name{key.str()};
      if (known_.count(name) == 0) {
        complain(name, "is no key of a board");
      }
    }
    return problems_;
  }

  void complain(const std::string& key, const std::string& what) {
    problems_ += (problems_.empty() ? "" : "; ") + key + " " + what;
  }

 private:
  const toml::node* look_up(const char* key) {
    known_.insert(key);
    return table_.get(key);
  }
  std::vector<const toml::node*> list(const char* key) {
    std::vector<const toml::node*> nodes;
    const toml::node* node = look_up(key);
    if (node != nullptr && !node->is_array()) {
      complain(key, "must be a list");
    } else if (node != nullptr) {
      for (const toml::node& item : *node->as_array()) {
        nodes.push_back(&item);
      }
    }
    return nodes;
  }

  const toml::table& table_;
  std::set<std::string, std::less<>> known_{};
  std::set<std::int64_t> seen_cores_{};
  std::string problems_{};
};

Result<BoardFile> read_board(const toml::table& table, const std::string& path) {
  BoardFile board;
  BoardTable reader{table};
  board.name.clear();
  reader.text("name", board.name);
  if (board.name.empty()) {
    reader.complain("name", "is missing");
  }
  reader.texts("models", board.models);
  reader.cores("core_order", board.core_order);
  reader.cores("cores_if_asked", board.cores_if_asked);
  reader.flag("may_unplug_cores", board.may_unplug_cores);
  reader.texts("input_rails", board.input_rails);
  reader.texts("ignored_zones", board.ignored_zones);
  double step_hz = board.clock_step.value();
  double lowest_hz = board.lowest_kept_clock.value();
  reader.number("clock_step_hz", 1e6, 1e10, step_hz);
  reader.number("lowest_kept_clock_hz", 0.0, 1e11, lowest_hz);
  reader.number("cycles_per_addition", 0.1, 10.0, board.cycles_per_addition);
  board.clock_step = Hertz{step_hz};
  board.lowest_kept_clock = Hertz{lowest_hz};
  if (!board.cores_if_asked.empty() && board.core_order.empty()) {
    reader.complain("cores_if_asked", "needs core_order");
  }
  if (const std::string problems = reader.problems(); !problems.empty()) {
    return Error{ErrorCode::invalid_input, path + ": " + problems};
  }
  return board;
}

}  // namespace

Result<BoardFile> load_board_file(const std::string& path) {
  std::ifstream in{path};
  const std::string text{std::istreambuf_iterator<char>{in}, {}};
  if (!in) {
    return Error{ErrorCode::not_found, "no board file \"" + path + "\"; try: flyball list boards"};
  }
  if (const auto fault = fault_of_toml(text)) {
    return Error{ErrorCode::invalid_input,
                 path + ", line " + std::to_string(fault->line) + ": " + fault->what};
  }
  try {
    return read_board(toml::parse(text), path);
  } catch (const toml::parse_error& error) {
    return Error{ErrorCode::invalid_input, path + ", line " +
                                               std::to_string(error.source().begin.line) + ": " +
                                               std::string{error.description()}};
  }
}

BoardFile board_file_for(const std::vector<BoardFile>& files, const std::string& model) {
  BoardFile best;
  std::size_t best_length = 0;
  for (const BoardFile& file : files) {
    for (const std::string& part : file.models) {
      if (part.size() > best_length && model.find(part) != std::string::npos) {
        best = file;
        best_length = part.size();
      }
    }
  }
  return best;
}

std::vector<int> cores_in_order(const BoardFile& board,
                                const std::vector<int>& present,
                                bool with_cores_if_asked) {
  std::vector<int> order = board.core_order.empty() ? present : board.core_order;
  if (with_cores_if_asked) {
    order.insert(order.end(), board.cores_if_asked.begin(), board.cores_if_asked.end());
  }
  const auto is_absent = [&present](int core) {
    return std::find(present.begin(), present.end(), core) == present.end();
  };
  order.erase(std::remove_if(order.begin(), order.end(), is_absent), order.end());
  return order;
}

}  // namespace flyball
