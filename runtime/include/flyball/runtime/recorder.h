// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a mission leaves behind: named channels of rows, and a hash over their fields.

#include "flyball/runtime/time.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace flyball {

using FieldValue = std::variant<double, std::int64_t, std::string>;

struct Field {
  std::string_view name;  ///< With unit; a literal.
  FieldValue value;
};

/// Hash over fields, never over memory: names, types, values and order count; -0.0 equals 0.0.
/// FNV-1a, 64 bit.
class TraceHash {
 public:
  void add(std::uint64_t bits);
  void add(std::string_view text);
  void add(double value);
  [[nodiscard]] std::uint64_t value() const { return hash_; }
  [[nodiscard]] std::string hex() const;

 private:
  std::uint64_t hash_{0xcbf29ce484222325ULL};
};

class Recorder {
 public:
  Recorder() = default;
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;
  virtual ~Recorder() = default;
  /// Appends one row. Only mission quantities: host time belongs in the summary.
  virtual void record(MissionTime at, std::string_view channel, const std::vector<Field>& row) = 0;
};

/// Keeps all rows in memory, in order, with their hash. When they fill `most_bytes`, one last row
/// says so; what follows is hashed and not kept.
class MemoryRecorder final : public Recorder {
 public:
  /// A policy that is asked every .45 ms leaves a megabyte a second.
  static constexpr std::size_t usual_most_bytes = std::size_t{1} << 30U;
  MemoryRecorder() : MemoryRecorder{usual_most_bytes} {}
  explicit MemoryRecorder(std::size_t most_bytes) : most_bytes_{most_bytes} {}

  struct Row {
    MissionTime at;
    std::string channel;
    std::vector<Field> fields;
  };
  void record(MissionTime at, std::string_view channel, const std::vector<Field>& row) override;
  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }
  [[nodiscard]] const TraceHash& hash() const { return hash_; }
  [[nodiscard]] bool is_full() const { return is_full_; }

 private:
  std::size_t most_bytes_;
  std::size_t bytes_{};
  bool is_full_{};
  std::vector<Row> rows_;
  TraceHash hash_;
};

}  // namespace flyball
