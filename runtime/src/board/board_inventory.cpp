// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/board/board_inventory.h"

#include "board/sysfs_text.h"
#include <algorithm>
#include <array>

namespace flyball {
namespace {

constexpr const char* cpu_folder = "/sys/devices/system/cpu";

std::vector<int> present_cpus(const LinuxSystem& system) {
  const auto listed_cpus = text_in(system, std::string{cpu_folder} + "/present");
  std::vector<int> cpus = cpu_list_of(listed_cpus.value_or(""));
  if (!cpus.empty()) {
    return cpus;
  }
  for (const std::string& name : system.entries(cpu_folder)) {
    if (const auto id = number_behind("cpu", name)) {
      cpus.push_back(*id);
    }
  }
  std::sort(cpus.begin(), cpus.end());
  return cpus;
}

std::vector<BoardCore> find_cores(const LinuxSystem& system) {
  const auto online_text = text_in(system, std::string{cpu_folder} + "/online");
  const std::vector<int> online = cpu_list_of(online_text.value_or(""));
  std::vector<BoardCore> cores;
  for (const int id : present_cpus(system)) {
    const std::string file = std::string{cpu_folder} + "/cpu" + std::to_string(id) + "/online";
    BoardCore core{id, std::binary_search(online.begin(), online.end(), id), false};
    if (const auto state = integer_in(system, file)) {
      core.has_switch = true;
      core.is_online = *state != 0;
    }
    cores.push_back(core);
  }
  return cores;
}

/// Folders of cpufreq: one per policy, or, on kernels before 4.4, one per core, of which cores that
/// share a clock have the same.
std::vector<std::string> clock_folders(const LinuxSystem& system) {
  std::vector<std::pair<int, std::string>> found;
  const std::string policies = std::string{cpu_folder} + "/cpufreq";
  for (const std::string& name : system.entries(policies)) {
    if (const auto number = number_behind("policy", name)) {
      found.emplace_back(*number, policies + "/" + name);
    }
  }
  if (found.empty()) {
    for (const int id : present_cpus(system)) {
      found.emplace_back(id, std::string{cpu_folder} + "/cpu" + std::to_string(id) + "/cpufreq");
    }
  }
  std::sort(found.begin(), found.end());
  std::vector<std::string> folders;
  folders.reserve(found.size());
  for (auto& [number, folder] : found) {
    folders.push_back(std::move(folder));
  }
  return folders;
}

std::vector<Hertz> listed_clocks(const LinuxSystem& system, const std::string& folder) {
  std::vector<Hertz> clocks;
  // acpi-cpufreq and others list clocks above the nominal one in a file of their own.
  for (const char* file : {"/scaling_available_frequencies", "/scaling_boost_frequencies"}) {
    for (const std::string& word : words_of(text_in(system, folder + file).value_or(""))) {
      if (const auto clock = clock_of(word)) {
        clocks.push_back(*clock);
      }
    }
  }
  std::sort(clocks.begin(), clocks.end());
  clocks.erase(std::unique(clocks.begin(), clocks.end()), clocks.end());
  return clocks;
}

std::optional<CpufreqPolicy> policy_in(const LinuxSystem& system, const std::string& folder) {
  const auto lowest = clock_in(system, folder + "/cpuinfo_min_freq");
  const auto highest = clock_in(system, folder + "/cpuinfo_max_freq");
  const auto min = clock_in(system, folder + "/scaling_min_freq");
  const auto max = clock_in(system, folder + "/scaling_max_freq");
  if (!lowest || !highest || !min || !max) {
    return std::nullopt;  // All its cores are off-line.
  }
  CpufreqPolicy policy;
  policy.folder = folder;
  policy.cpus = cpu_list_of(text_in(system, folder + "/related_cpus").value_or(""));
  policy.driver = text_in(system, folder + "/scaling_driver").value_or("");
  policy.governor = text_in(system, folder + "/scaling_governor").value_or("");
  policy.governors =
      words_of(text_in(system, folder + "/scaling_available_governors").value_or(""));
  policy.frequencies = listed_clocks(system, folder);
  policy.lowest = *lowest;
  policy.highest = *highest;
  policy.min = *min;
  policy.max = *max;
  return policy;
}

std::vector<CpufreqPolicy> find_policies(const LinuxSystem& system) {
  std::vector<CpufreqPolicy> policies;
  for (const std::string& folder : clock_folders(system)) {
    auto policy = policy_in(system, folder);
    if (!policy) {
      continue;
    }
    const bool is_known =
        std::any_of(policies.begin(), policies.end(),
                    [&](const CpufreqPolicy& other) { return other.cpus == policy->cpus; });
    if (!is_known || policy->cpus.empty()) {
      policies.push_back(std::move(*policy));
    }
  }
  return policies;
}

std::optional<double> lowest_passive_trip_c(const LinuxSystem& system, const std::string& folder) {
  std::optional<double> lowest;
  for (int i = 0;; ++i) {
    const std::string trip = folder + "/trip_point_" + std::to_string(i);
    const auto type = text_in(system, trip + "_type");
    if (!type) {
      return lowest;
    }
    const auto at = integer_in(system, trip + "_temp");
    if (*type == "passive" && at && *at > 0 &&
        (!lowest || 1e-3 * static_cast<double>(*at) < *lowest)) {
      lowest = 1e-3 * static_cast<double>(*at);
    }
  }
}

std::vector<ThermalZone> find_zones(const LinuxSystem& system) {
  const std::string all = "/sys/class/thermal";
  std::vector<ThermalZone> zones;
  for (const std::string& name : system.entries(all)) {
    if (!number_behind("thermal_zone", name)) {
      continue;
    }
    const std::string folder = all + "/" + name;
    zones.push_back({folder, text_in(system, folder + "/type").value_or(name),
                     zone_temperature_c(system, folder), lowest_passive_trip_c(system, folder)});
  }
  return zones;
}

/// L4T's own driver, ina3221x: milliwatts by channel.
void add_iio_rails(const LinuxSystem& system,
                   const std::string& folder,
                   std::vector<PowerRail>& rails) {
  for (int channel = 0; channel < 3; ++channel) {
    const std::string number = std::to_string(channel);
    const auto label = text_in(system, folder + "/rail_name_" + number);
    const std::string file = folder + "/in_power" + number + "_input";
    if (label && !label->empty() && integer_in(system, file)) {
      rails.push_back({*label, file, 1e-3, {}, {}});
    }
  }
}

/// Linux's driver, ina3221: millivolts and milliamperes by channel. Channels without a current are
/// sums of shunt voltages.
void add_hwmon_rails(const LinuxSystem& system,
                     const std::string& folder,
                     std::vector<PowerRail>& rails) {
  for (int channel = 1; channel <= 4; ++channel) {
    const std::string number = std::to_string(channel);
    const auto label = text_in(system, folder + "/in" + number + "_label");
    const std::string voltage = folder + "/in" + number + "_input";
    const std::string current = folder + "/curr" + number + "_input";
    if (label && !label->empty() && *label != "NC" && integer_in(system, voltage) &&
        integer_in(system, current)) {
      rails.push_back({*label, {}, 1e-3, voltage, current});
    }
  }
}

void add_i2c_rails(const LinuxSystem& system,
                   const std::string& chip,
                   std::vector<PowerRail>& rails) {
  for (const std::string& name : system.entries(chip)) {
    if (number_behind("iio:device", name)) {
      add_iio_rails(system, chip + "/" + name, rails);
    }
  }
  for (const std::string& name : system.entries(chip + "/hwmon")) {
    add_hwmon_rails(system, chip + "/hwmon/" + name, rails);
  }
}

/// Power monitors of other makes (ina219, ina226): microwatts.
void add_other_monitors(const LinuxSystem& system, std::vector<PowerRail>& rails) {
  const std::string all = "/sys/class/hwmon";
  for (const std::string& name : system.entries(all)) {
    const std::string folder = all + "/" + name;
    const std::string chip = text_in(system, folder + "/name").value_or("");
    const std::string file = folder + "/power1_input";
    if (chip.rfind("ina", 0) == 0 && integer_in(system, file)) {
      const auto label = text_in(system, folder + "/power1_label");
      rails.push_back({label.value_or(chip), file, 1e-6, {}, {}});
    }
  }
}

std::vector<PowerRail> find_rails(const LinuxSystem& system) {
  std::vector<PowerRail> rails;
  for (const char* driver : {"ina3221x", "ina3221"}) {
    const std::string folder = std::string{"/sys/bus/i2c/drivers/"} + driver;
    for (const std::string& chip : system.entries(folder)) {
      add_i2c_rails(system, folder + "/" + chip, rails);
    }
  }
  add_other_monitors(system, rails);
  return rails;
}

std::vector<EnergyCounter> find_counters(const LinuxSystem& system) {
  const std::string all = "/sys/class/powercap";
  std::vector<EnergyCounter> counters;
  for (const std::string& name : system.entries(all)) {
    const std::string folder = all + "/" + name;
    const auto domain = text_in(system, folder + "/name");
    const auto range = integer_in(system, folder + "/max_energy_range_uj");
    // Sub-domains (intel-rapl:0:1) are parts of what their package counts.
    const bool is_part = std::count(name.begin(), name.end(), ':') > 1;
    if (domain && range && *range > 0 && !is_part) {
      const std::string file = folder + "/energy_uj";
      counters.push_back({*domain, file, *range, integer_in(system, file).has_value()});
    }
  }
  return counters;
}

struct KnownRival {
  const char* comm;  ///< As /proc has it: the first 15 characters.
  const char* name;
  const char* advice;
};

constexpr std::array known_rivals{
    KnownRival{"thermald", "thermald", "stop it: systemctl stop thermald"},
    KnownRival{"power-profiles-", "power-profiles-daemon",
               "stop it: systemctl stop power-profiles-daemon"},
    KnownRival{"nvpmodel", "nvpmodel", "wait until it has ended; its mode stays a limit"},
    KnownRival{"jetson_clocks", "jetson_clocks", "release its clocks: jetson_clocks --restore"},
    KnownRival{"tuned", "tuned", "stop it: systemctl stop tuned"},
    KnownRival{"cpufreqd", "cpufreqd", "stop it: systemctl stop cpufreqd"},
    KnownRival{"auto-cpufreq", "auto-cpufreq", "stop it: systemctl stop auto-cpufreq"},
};

std::string model_of(const LinuxSystem& system) {
  for (const char* file : {"/proc/device-tree/model", "/sys/firmware/devicetree/base/model",
                           "/sys/class/dmi/id/product_name"}) {
    const auto text = text_in(system, file);
    if (text && !text->empty()) {
      return *text;
    }
  }
  return {};
}

}  // namespace

bool CpufreqPolicy::has_set_speed() const {
  return std::find(governors.begin(), governors.end(), "userspace") != governors.end();
}

BoardInventory discover_board(const LinuxSystem& system) {
  BoardInventory found;
  found.model = model_of(system);
  found.kernel = text_in(system, "/proc/sys/kernel/osrelease").value_or("");
  found.policies = find_policies(system);
  found.cores = find_cores(system);
  found.zones = find_zones(system);
  found.rails = find_rails(system);
  found.counters = find_counters(system);
  found.rivals = find_rivals(system);
  return found;
}

std::vector<Rival> find_rivals(const LinuxSystem& system) {
  std::vector<Rival> rivals;
  for (const std::string& name : system.entries("/proc")) {
    const auto pid = integer_of(name);
    if (!pid) {
      continue;
    }
    const auto comm = text_in(system, "/proc/" + name + "/comm");
    for (const KnownRival& known : known_rivals) {
      if (comm && *comm == known.comm) {
        rivals.push_back({static_cast<int>(*pid), known.name, known.advice});
      }
    }
  }
  return rivals;
}

std::optional<double> zone_temperature_c(const LinuxSystem& system, const std::string& folder) {
  constexpr double disconnected_c = -200.0;  // -256, in degrees or in thousandths of them
  const auto millidegrees = integer_in(system, folder + "/temp");
  if (!millidegrees || *millidegrees == -256 ||
      1e-3 * static_cast<double>(*millidegrees) < disconnected_c) {
    return std::nullopt;
  }
  return 1e-3 * static_cast<double>(*millidegrees);
}

std::optional<Watts> rail_power(const LinuxSystem& system, const PowerRail& rail) {
  if (!rail.power_file.empty()) {
    const auto units = integer_in(system, rail.power_file);
    return units ? std::optional{Watts{rail.watts_per_unit * static_cast<double>(*units)}}
                 : std::nullopt;
  }
  const auto millivolts = integer_in(system, rail.voltage_file);
  const auto milliamperes = integer_in(system, rail.current_file);
  if (!millivolts || !milliamperes) {
    return std::nullopt;
  }
  return Watts{1e-6 * static_cast<double>(*millivolts) * static_cast<double>(*milliamperes)};
}

}  // namespace flyball
