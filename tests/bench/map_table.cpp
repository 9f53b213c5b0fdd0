// SPDX-License-Identifier: BSD-3-Clause
#include "map_table.h"

#include "map_revisions.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

namespace flyball::bench {
namespace {

constexpr const char* cells_m[] = {"0.15", "0.30", "0.60", "1.20"};

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, value < 10.0 ? "%.2f" : value < 100.0 ? "%.1f" : "%.0f", value);
  return text;
}

}  // namespace

std::string insertion_name(const Insertion& insertion) {
  return insertion.scene + "/" + std::to_string(insertion.width_px) + "x" +
         std::to_string(insertion.height_px) + "/" +
         cells_m[static_cast<std::size_t>(insertion.level)] + "/" + insertion.front_end +
         (insertion.writes_record ? "+record" : "") +
         (insertion.front_end == "stock" ? "" : "/" + insertion.simd);
}

std::string question_name(const Question& question) {
  return "ask/" + question.scene + "/" + cells_m[static_cast<std::size_t>(question.level)] + "/" +
         question.kind + (question.stock ? "/stock" : "/bricks");
}

std::string inflation_name(const std::string& scene) {
  return "inflate/" + scene;
}

std::optional<std::string> take_option(int& argc, char** argv, const std::string& option) {
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.rfind(option, 0) == 0) {
      std::copy(argv + i + 1, argv + argc, argv + i);
      --argc;
      return argument.substr(option.size());
    }
  }
  return std::nullopt;
}

void TableReporter::ReportRuns(const std::vector<Run>& runs) {
  ConsoleReporter::ReportRuns(runs);
  for (const Run& run : runs) {
    if (run.run_type != Run::RT_Iteration || run.error_occurred) {
      continue;
    }
    const std::string& name = run.run_name.function_name;
    const double time = run.GetAdjustedRealTime();
    const auto known = least_.find(name);
    if (known == least_.end() || time < known->second.time) {
      Least& least = least_[name];
      least.time = time;
      for (const auto& [counter, value] : run.counters) {
        least.counters[counter] = value.value;
      }
    }
  }
}

bool TableReporter::has_differences() const {
  return std::any_of(least_.begin(), least_.end(), [](const auto& entry) {
    const auto differing = entry.second.counters.find("differing");
    return differing != entry.second.counters.end() && differing->second > 0.0;
  });
}

bool TableReporter::write(const std::string& file, const Plan& plan) const {
  std::ofstream out{file};
  out << "# Mapping one frame\n\nMilliseconds of CPU time for a frame: ten frames of a flight, "
         "after a frame of warm-up, 20 "
         "m "
         "of range, the least of several runs; in brackets, how many times as fast as stock "
         "`insertPointCloud` in the same run. `+ record`: the OctoMap tree is written too, and is "
         "stock's byte for byte. `knob`: a map of 0.15 m cells that is freed at this level; all "
         "others are maps of this resolution.\n";
  for (const char* simd : {"AVX-512", "AVX2", "portable"}) {
    write_insertions(out, plan, simd);
  }
  write_questions(out, plan);
  write_revisions(out);
  for (const char* scene : {"indoor", "outdoor"}) {
    if (const Least* least = find(inflation_name(scene))) {
      out << "\nInflating 24 x 24 x 6 m (" << scene
          << ", 0.15 m, body of 0.45 m radius): " << rounded(least->time) << " ms.\n";
    }
  }
  if (const Least* least = find("switch")) {
    out << "\nChanging the level and back: " << rounded(least->time) << " ns.\n";
  }
  return static_cast<bool>(out.flush());
}

const TableReporter::Least* TableReporter::find(const std::string& name) const {
  const auto found = least_.find(name);
  return found == least_.end() ? nullptr : &found->second;
}

void TableReporter::write_insertions(std::ostream& out,
                                     const Plan& plan,
                                     const std::string& simd) const {
  out << "\n## " << simd
      << "\n\n| scene | image | m | stock | exact | exact + record | rays | pyramid | knob | cells "
         "(exact) | kB read and written |\n|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const char* scene : {"indoor", "outdoor"}) {
    for (const ImageSize& size : plan.sizes) {
      for (int level = 0; level < plan.levels; ++level) {
        write_row(out, {scene, size.width_px, size.height_px, level, "stock", false, simd});
      }
    }
  }
}

void TableReporter::write_row(std::ostream& out, Insertion row) const {
  const Least* stock = find(insertion_name(row));
  if (stock == nullptr) {
    return;
  }
  out << "| " << row.scene << " | " << row.width_px << "x" << row.height_px << " | "
      << cells_m[static_cast<std::size_t>(row.level)] << " | " << rounded(stock->time) << " |";
  const auto add = [&](const char* front_end, bool writes_record) {
    row.front_end = front_end;
    row.writes_record = writes_record;
    const Least* ours = find(insertion_name(row));
    out << " "
        << (ours == nullptr ? "-"
                            : rounded(ours->time) + " (" + rounded(stock->time / ours->time) + ")")
        << " |";
    return ours;
  };
  const Least* exact = add("exact", false);
  add("exact", true);
  add("rays", false);
  add("pyramid", false);
  add("knob", false);
  if (exact != nullptr) {
    out << " " << rounded(exact->counters.at("cells")) << " | "
        << rounded(1e-3 * exact->counters.at("bytes")) << " |";
  }
  out << "\n";
}

void TableReporter::write_questions(std::ostream& out, const Plan& plan) const {
  out << "\n# Questions\n\nNanoseconds; `differing`: answers unlike stock's, of " << plan.questions
      << " points (`point`: at random in the whole map; `way`: a decimetre apart on straight ways) "
         "and of "
      << plan.questions / 20
      << " bodies and segments (at most 5 m long), at one resolution.\n\n"
         "| scene | m | kind | stock | bricks | times as fast | differing |\n"
         "|---|---|---|---|---|---|---|\n";
  for (const char* scene : {"indoor", "outdoor"}) {
    for (int level = 0; level < plan.levels; ++level) {
      for (const char* kind : question_kinds) {
        const Least* stock = find(question_name({scene, level, kind, true}));
        const Least* ours = find(question_name({scene, level, kind, false}));
        if (stock == nullptr || ours == nullptr) {
          continue;
        }
        const auto differing = ours->counters.find("differing");
        out << "| " << scene << " | " << cells_m[static_cast<std::size_t>(level)] << " | " << kind
            << " | " << rounded(stock->time) << " | " << rounded(ours->time) << " | "
            << rounded(stock->time / ours->time) << " | "
            << (differing == ours->counters.end() ? "-"
                                                  : std::to_string(std::lround(differing->second)))
            << " |\n";
      }
    }
  }
}

void TableReporter::write_revisions(std::ostream& out) const {
  out << "\n# Revisions\n\nA reader on another thread holds a revision of the map, and after each "
         "frame takes the next one. Milliseconds to insert a frame without and with it, "
         "microseconds to hand on a revision (mean and most), MB of the map without and with "
         "it.\n\n"
         "| scene | m | mapper | alone | with a reader | times as long | hand on | most | MB | MB "
         "with a reader |\n|---|---|---|---|---|---|---|---|---|---|\n";
  for (const char* scene : {"indoor", "outdoor"}) {
    for (const RevisedMapper& kind : revised_mappers) {
      for (const char* cells : revised_cells) {
        if (const Least* least = find(revision_name(scene, kind.name, cells))) {
          const auto counter = [&](const char* name) { return rounded(least->counters.at(name)); };
          out << "| " << scene << " | " << cells << " | " << kind.name << " | "
              << counter("alone_ms") << " | " << rounded(least->time) << " | " << counter("times")
              << " | " << counter("hand_on_us") << " | " << counter("most_us") << " | "
              << counter("MB") << " | " << counter("read_MB") << " |\n";
        }
      }
    }
  }
  out << "\n| chunks in the map | hand on, microseconds |\n|---|---|\n";
  for (const int chunks : index_chunks) {
    if (const Least* least = find(index_name(chunks))) {
      out << "| " << chunks << " | " << rounded(least->time) << " |\n";
    }
  }
}

}  // namespace flyball::bench
