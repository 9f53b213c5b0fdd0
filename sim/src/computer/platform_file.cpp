// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/platform_file.h"

#include "flyball/runtime/text/toml_text.h"

#include "computer/platform_table.h"
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>

#include <toml++/toml.h>

namespace flyball {
namespace {

std::vector<MemoryClock> read_memory_clocks(TableReader& reader,
                                            std::vector<std::string>& problems) {
  std::vector<MemoryClock> clocks;
  for (const toml::table* one : reader.tables_or_none("memory_clocks")) {
    TableReader items{*one, reader.path("memory_clocks"), problems};
    const MemoryClock step{Hertz{items.number("from_hz", 0.0, 1e11)},
                           Hertz{items.number("memory_hz", 0.0, 1e11)}};
    items.reject_unknown();
    if (!clocks.empty() && !(clocks.back().from < step.from)) {
      reader.complain("memory_clocks", "are not ascending");
    }
    clocks.push_back(step);
  }
  return clocks;
}

PowerCost read_power(TableReader& reader, std::vector<std::string>& problems) {
  PowerCost power;
  power.board_w = reader.number("board_w", 0.0, 1000.0);
  power.converter = reader.number("converter", 1.0, 10.0);
  power.soc_w = reader.number("soc_w", 0.0, 1000.0);
  power.memory_w = reader.number("memory_w", 0.0, 1000.0);
  power.cpu_constant_w = reader.number("cpu_constant_w", 0.0, 1000.0);
  power.cpu_linear_w = reader.number("cpu_linear_w", 0.0, 1000.0);
  power.core_linear_w = reader.number("core_linear_w", 0.0, 1000.0);
  power.core_cubic_w = reader.number("core_cubic_w", 0.0, 1000.0);
  power.memory_linear_w = reader.number_or("memory_linear_w", 0.0, 0.0, 1000.0);
  power.idle_core_w = reader.number_or("idle_core_w", 0.0, 0.0, 1000.0);
  power.memory_clocks = read_memory_clocks(reader, problems);
  if (power.memory_linear_w > 0.0 && power.memory_clocks.empty()) {
    reader.complain("memory_linear_w", "needs memory_clocks");
  }
  reader.reject_unknown();
  return power;
}

KernelCost read_kernel(TableReader& reader, std::vector<std::string>& problems) {
  KernelCost cost;
  cost.scale = reader.number_or("scale", 1.0, 0.0, 1e9);
  cost.a = reader.number_or("a", 1.0, 0.0, 1e3);
  cost.b = reader.number_or("b", 0.0, 0.0, 1e3);
  cost.parallel_fraction = reader.number_or("parallel_fraction", 0.0, 0.0, 1.0);
  const std::string on = reader.text_or("on", "cores");
  if (on != "cores" && on != "gpu") {
    reader.complain("on", "= \"" + on + "\" must be \"cores\" or \"gpu\"");
  }
  cost.on_gpu = on == "gpu";
  if (const toml::table* prices = reader.table("seconds_per")) {
    TableReader items{*prices, reader.path("seconds_per"), problems};
    for (const auto& [key, node] : *prices) {
      const std::string name{key.str()};
      cost.seconds_per[name] = items.number(name, 0.0, 1e6);
    }
    if (prices->empty()) {
      reader.complain("seconds_per", "names no work");
    }
  }
  // Both zero would make every job free without anybody noticing.
  if (cost.a + cost.b <= 0.0 || cost.scale <= 0.0) {
    reader.complain("scale, a + b", "must be positive");
  }
  reader.reject_unknown();
  return cost;
}

std::map<std::string, KernelCost, std::less<>> read_kernels(const toml::table& table,
                                                            TableReader& reader,
                                                            std::vector<std::string>& problems) {
  std::map<std::string, KernelCost, std::less<>> kernels;
  for (const auto& [key, node] : table) {
    const std::string name{key.str()};
    if (const toml::table* kernel = reader.table(name)) {
      TableReader items{*kernel, reader.path(name), problems};
      kernels[name] = read_kernel(items, problems);
    }
  }
  return kernels;
}

ThermalTrip read_trip(TableReader& reader) {
  ThermalTrip trip;
  trip.at_c = reader.number("at_c", -50.0, 200.0);
  trip.hysteresis_k = reader.number("hysteresis_k", 0.0, 100.0);
  trip.cap = Hertz{reader.number("cap_hz", 1e6, 1e11)};
  reader.reject_unknown();
  return trip;
}

ThermalModel read_thermal(TableReader& reader, std::vector<std::string>& problems) {
  ThermalModel thermal;
  thermal.ambient_c = reader.number("ambient_c", -60.0, 90.0);
  thermal.resistance_k_w = reader.number("resistance_k_w", 0.01, 1000.0);
  thermal.time_constant_s = reader.number("time_constant_s", 0.1, 1e5);
  for (const toml::table* one : reader.tables_or_none("trips")) {
    TableReader items{*one, reader.path("trips"), problems};
    const ThermalTrip trip = read_trip(items);
    if (!thermal.trips.empty() && thermal.trips.back().at_c >= trip.at_c) {
      reader.complain("trips", "are not ascending");
    }
    thermal.trips.push_back(trip);
  }
  reader.reject_unknown();
  return thermal;
}

GpuModel read_gpu(TableReader& reader) {
  GpuModel gpu;
  gpu.clock = Hertz{reader.number("clock_hz", 1e6, 1e11)};
  gpu.busy_w = reader.number("busy_w", 0.0, 1000.0);
  reader.reject_unknown();
  return gpu;
}

/// Each core that is off takes its idle power off the constant one.
void check_idle_cores(const PlatformModel& model, TableReader& reader) {
  if (model.max_cores * model.power.idle_core_w > model.power.cpu_constant_w) {
    reader.complain("power.idle_core_w",
                    "times max_cores is more than power.cpu_constant_w, of which it is a part");
  }
}

/// Kernels that run on a GPU need one.
void check_gpu(const PlatformModel& model, TableReader& reader) {
  for (const auto& [name, cost] : model.kernels) {
    if (cost.on_gpu && !model.gpu) {
      reader.complain("kernels." + name + ".on", "= \"gpu\" needs a [gpu] table");
    }
  }
}

PlatformModel read_model(const toml::table& file, std::vector<std::string>& problems) {
  TableReader reader{file, "", problems};
  PlatformModel model;
  model.name = reader.text("name");
  const double cores = reader.number("max_cores", 1.0, 1024.0);
  if (cores != std::floor(cores)) {
    reader.complain("max_cores", "is no whole number");
  }
  model.max_cores = static_cast<int>(cores);
  for (const double hz : reader.numbers("frequencies_hz", 1e6, 1e11)) {
    if (!model.frequencies.empty() && !(model.frequencies.back() < Hertz{hz})) {
      reader.complain("frequencies_hz", "is not ascending");
    }
    model.frequencies.emplace_back(hz);
  }
  model.switching_time = from_seconds(reader.number("switching_time_s", 0.0, 10.0));
  if (const toml::table* power = reader.table("power")) {
    TableReader items{*power, "power", problems};
    model.power = read_power(items, problems);
  }
  if (const toml::table* kernels = reader.table("kernels")) {
    TableReader items{*kernels, "kernels", problems};
    model.kernels = read_kernels(*kernels, items, problems);
  }
  if (file.contains("thermal")) {
    if (const toml::table* thermal = reader.table("thermal")) {
      TableReader items{*thermal, "thermal", problems};
      model.thermal = read_thermal(items, problems);
    }
  }
  if (file.contains("gpu")) {
    if (const toml::table* gpu = reader.table("gpu")) {
      TableReader items{*gpu, "gpu", problems};
      model.gpu = read_gpu(items);
    }
  }
  model.memory_contention = reader.number_or("memory_contention", 0.0, 0.0, 100.0);
  check_idle_cores(model, reader);
  check_gpu(model, reader);
  reader.reject_unknown();
  return model;
}

/// @throw toml::parse_error
toml::table parsed(const std::string& path) {
  std::ifstream file{path};
  const std::string content{std::istreambuf_iterator<char>{file}, {}};
  if (const auto fault = fault_of_toml(content)) {
    const auto line = static_cast<toml::source_index>(fault->line);
    throw toml::parse_error{fault->what.c_str(), toml::source_position{line, 1},
                            std::make_shared<const std::string>(path)};
  }
  return toml::parse(content, path);
}

/// Where files are looked for that others are like.
struct Place {
  std::string path;  ///< Of the other file.
  std::string shipped;
};

/// The file that this one is like; empty when it stands alone, or `like` is no text.
std::string base_path(const toml::table& file, const Place& place) {
  const auto base = file["like"].value<std::string>();
  if (!base) {
    return {};
  }
  const auto beside = std::filesystem::path{place.path}.parent_path() / (*base + ".toml");
  const auto shipped = std::filesystem::path{place.shipped} / (*base + ".toml");
  std::error_code failed;
  // A file of one's own may have the name of the shipped one that it is like.
  const bool is_beside = std::filesystem::is_regular_file(beside, failed) &&
                         !std::filesystem::equivalent(beside, place.path, failed);
  const bool is_shipped =
      !place.shipped.empty() && !is_beside && std::filesystem::is_regular_file(shipped, failed);
  return (is_shipped ? shipped : beside).string();
}

/// Why there is nothing that the file could take over; empty: there is, or nothing is asked for.
std::string fault_of_base(const std::string& base) {
  std::error_code failed;
  if (!base.empty() && !std::filesystem::is_regular_file(base, failed)) {
    return "there is no \"" + base + "\"; copy it there, or name one of: flyball list platforms";
  }
  if (!base.empty() && parsed(base).contains("like")) {
    return "\"" + base + "\" is itself like another; name that one";
  }
  return {};
}

/// With what it takes over from the file that it is like.
toml::table completed(toml::table own, const std::string& base) {
  own.erase("like");
  if (base.empty()) {
    return own;
  }
  toml::table all = parsed(base);
  const auto take_over = [](const toml::table& from, toml::table& into) {
    for (const auto& [key, node] : from) {
      into.insert_or_assign(key.str(), node);
    }
  };
  // Kernel by kernel, so that a file that prices one anew keeps the others.
  if (own["kernels"].is_table() && all["kernels"].is_table()) {
    take_over(*own["kernels"].as_table(), *all["kernels"].as_table());
    own.erase("kernels");
  }
  take_over(own, all);
  return all;
}

std::string joined(const std::vector<std::string>& problems) {
  std::string all;
  for (const std::string& problem : problems) {
    all += (all.empty() ? "" : "; ") + problem;
  }
  return all;
}

}  // namespace

Result<PlatformModel> load_platform(const std::string& path, const std::string& shipped) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed) || !std::ifstream{path}) {
    return Error{ErrorCode::not_found,
                 "no platform file \"" + path + "\"; try: flyball list platforms"};
  }
  try {
    toml::table own = parsed(path);
    if (own.contains("like") && !own["like"].is_string()) {
      return Error{
          ErrorCode::invalid_input,
          "platform file \"" + path + "\": like must be the name of another one, in quotes"};
    }
    const std::string base = base_path(own, {path, shipped});
    if (const std::string fault = fault_of_base(base); !fault.empty()) {
      return Error{ErrorCode::invalid_input,
                   "platform file \"" + path + "\" is to be like another, but " + fault};
    }
    const toml::table file = completed(std::move(own), base);
    std::vector<std::string> problems;
    PlatformModel model = read_model(file, problems);
    if (!problems.empty()) {
      return Error{ErrorCode::invalid_input, "platform file \"" + path + "\": " + joined(problems)};
    }
    return model;
  } catch (const toml::parse_error& error) {
    std::ostringstream what;
    what << "platform file \"" << (error.source().path ? *error.source().path : path) << "\", line "
         << error.source().begin.line << ": " << error.description();
    return Error{ErrorCode::invalid_input, what.str()};
  } catch (const std::exception& error) {
    return Error{ErrorCode::failed, "platform file \"" + path + "\": " + error.what()};
  }
}

std::vector<std::string> files_of_platform(const std::string& path, const std::string& shipped) {
  std::vector<std::string> files{path};
  try {
    const std::string base = base_path(parsed(path), {path, shipped});
    if (!base.empty()) {
      files.push_back(base);
    }
  } catch (const toml::parse_error&) {
    return files;  // Reading it says what is wrong.
  }
  return files;
}

}  // namespace flyball
