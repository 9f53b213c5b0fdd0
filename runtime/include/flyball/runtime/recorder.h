// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a mission leaves behind: named channels of rows, and a hash over their fields.

#include "flyball/runtime/time.h"

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

/// Keeps all rows in memory, in order, with their hash.
class MemoryRecorder final : public Recorder {
 public:
  struct Row {
    MissionTime at;
    std::string channel;
    std::vector<Field> fields;
  };
  void record(MissionTime at, std::string_view channel, const std::vector<Field>& row) override;
  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }
  [[nodiscard]] const TraceHash& hash() const { return hash_; }

 private:
  std::vector<Row> rows_;
  TraceHash hash_;
};

}  // namespace flyball
