// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Tables out of what map_bench measured.

#include "map_pipeline.h"
#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

namespace flyball::bench {

struct Insertion {
  std::string scene;
  int width_px;
  int height_px;
  int level;
  std::string front_end;
  bool writes_record;
  std::string simd;
};
inline constexpr const char* question_kinds[] = {"point", "way", "body", "segment"};

struct Question {
  std::string scene;
  int level;
  std::string kind;
  bool stock;
};
[[nodiscard]] std::string insertion_name(const Insertion& insertion);
[[nodiscard]] std::string question_name(const Question& question);

[[nodiscard]] std::string inflation_name(const std::string& scene);

/// Takes the argument that begins so out of the arguments: what follows that, if it is there.
[[nodiscard]] std::optional<std::string> take_option(int& argc,
                                                     char** argv,
                                                     const std::string& option);

/// Prints every run, and keeps the least time of each benchmark's repetitions.
class TableReporter final : public benchmark::ConsoleReporter {
 public:
  TableReporter() : benchmark::ConsoleReporter{OO_Tabular} {}
  void ReportRuns(const std::vector<Run>& runs) override;
  /// False when the file cannot be written.
  [[nodiscard]] bool write(const std::string& file, const Plan& plan) const;
  /// Whether any answer was unlike stock's.
  [[nodiscard]] bool has_differences() const;

 private:
  struct Least {
    double time;  ///< In the benchmark's unit.
    std::map<std::string, double> counters;
  };
  [[nodiscard]] const Least* find(const std::string& name) const;
  void write_insertions(std::ostream& out, const Plan& plan, const std::string& simd) const;
  void write_row(std::ostream& out, Insertion row) const;
  void write_questions(std::ostream& out, const Plan& plan) const;
  void write_revisions(std::ostream& out) const;

  std::map<std::string, Least> least_{};
};

}  // namespace flyball::bench
