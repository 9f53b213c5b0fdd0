// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Copies of what five boards show below /sys and /proc, as far as a governor looks at it. The
/// files of clocks and cores are named as in facts of the boards' kernels; values are examples.

#include "scratch_folder.h"
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace flyball::fake {

class Tree {
 public:
  void put(const std::string& path, const std::string& content) const {
    const std::string file = folder_.path() + path;
    std::filesystem::create_directories(std::filesystem::path{file}.parent_path());
    std::ofstream{file} << content;
  }
  [[nodiscard]] std::string root() const { return folder_.path(); }
  [[nodiscard]] std::string get(const std::string& path) const {
    return folder_.content(path.substr(1));
  }
  /// Every file below /sys with its content.
  [[nodiscard]] std::map<std::string, std::string> all() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator{folder_.path("sys")}) {
      if (entry.is_regular_file()) {
        const std::string path = entry.path().string().substr(folder_.path().size() - 1);
        files[path] = get(path);
      }
    }
    return files;
  }

 private:
  ScratchFolder folder_;
};

inline const std::string cpu = "/sys/devices/system/cpu";

struct ClockFiles {
  std::string folder;
  std::string cpus;
  std::string clocks_khz;  ///< Ascending; empty: the driver lists none.
  std::string lowest_khz;
  std::string highest_khz;
  std::string driver;
  std::string governor;
  std::string governors;
};

inline void put_clock(const Tree& tree, const ClockFiles& clock) {
  const std::string folder = cpu + clock.folder;
  if (!clock.clocks_khz.empty()) {
    tree.put(folder + "/scaling_available_frequencies", clock.clocks_khz + " \n");
  }
  tree.put(folder + "/related_cpus", clock.cpus + "\n");
  tree.put(folder + "/affected_cpus", clock.cpus + "\n");
  tree.put(folder + "/cpuinfo_min_freq", clock.lowest_khz + "\n");
  tree.put(folder + "/cpuinfo_max_freq", clock.highest_khz + "\n");
  tree.put(folder + "/scaling_min_freq", clock.lowest_khz + "\n");
  tree.put(folder + "/scaling_max_freq", clock.highest_khz + "\n");
  tree.put(folder + "/scaling_cur_freq", clock.highest_khz + "\n");
  tree.put(folder + "/scaling_driver", clock.driver + "\n");
  tree.put(folder + "/scaling_governor", clock.governor + "\n");
  tree.put(folder + "/scaling_available_governors", clock.governors + " \n");
  tree.put(folder + "/scaling_setspeed", "<unsupported>\n");
}

/// Cores 0 to `count` - 1; those of `off` are off-line. cpu0 has no switch.
inline void put_cores(const Tree& tree, int count, const std::vector<int>& off = {}) {
  std::string online;
  for (int id = 0; id < count; ++id) {
    bool is_on = true;
    for (const int other : off) {
      is_on = is_on && other != id;
    }
    const std::string folder = cpu + "/cpu" + std::to_string(id);
    tree.put(folder + "/topology/core_id", std::to_string(id) + "\n");
    if (id > 0) {
      tree.put(folder + "/online", is_on ? "1\n" : "0\n");
    }
    if (is_on) {
      online += (online.empty() ? "" : ",") + std::to_string(id);
    }
  }
  tree.put(cpu + "/present", "0-" + std::to_string(count - 1) + "\n");
  tree.put(cpu + "/online", online + "\n");
}

inline void put_zone(const Tree& tree,
                     int number,
                     const std::string& type,
                     const std::string& temperature,
                     const std::string& passive = "") {
  const std::string folder = "/sys/class/thermal/thermal_zone" + std::to_string(number);
  tree.put(folder + "/type", type + "\n");
  tree.put(folder + "/temp", temperature + "\n");
  tree.put(folder + "/trip_point_0_type", "critical\n");
  tree.put(folder + "/trip_point_0_temp", "101000\n");
  if (!passive.empty()) {
    tree.put(folder + "/trip_point_1_type", "passive\n");
    tree.put(folder + "/trip_point_1_temp", passive + "\n");
  }
}

inline void put_iio_rail(const Tree& tree,
                         const std::string& chip,
                         int channel,
                         const std::string& label,
                         const std::string& milliwatts) {
  const std::string folder = "/sys/bus/i2c/drivers/ina3221x/" + chip;
  tree.put(folder + "/rail_name_" + std::to_string(channel), label + "\n");
  tree.put(folder + "/in_power" + std::to_string(channel) + "_input", milliwatts + "\n");
}

inline void put_hwmon_rail(const Tree& tree,
                           const std::string& chip,
                           int channel,
                           const std::string& label,
                           const std::vector<std::string>& mv_ma) {
  const std::string folder = "/sys/bus/i2c/drivers/ina3221/" + chip;
  const std::string number = std::to_string(channel);
  tree.put(folder + "/in" + number + "_label", label + "\n");
  tree.put(folder + "/in" + number + "_input", mv_ma[0] + "\n");
  tree.put(folder + "/curr" + number + "_input", mv_ma[1] + "\n");
}

inline void put_process(const Tree& tree, int pid, const std::string& comm) {
  tree.put("/proc/" + std::to_string(pid) + "/comm", comm + "\n");
}

inline const std::string tx2_clocks =
    "345600 499200 652800 806400 960000 1113600 1267200 1420800 1574400 1728000 1881600 2035200";
inline const std::string tx2_governors =
    "interactive conservative ondemand userspace powersave "
    "performance schedutil";

inline void plant_tx2_commons(const Tree& tree) {
  tree.put("/proc/sys/kernel/osrelease", "4.4.38-tegra\n");
  put_cores(tree, 6, {1, 2});  // nvpmodel's default mode: no Denver cores
  put_zone(tree, 0, "BCPU-therm", "42500", "95500");
  put_zone(tree, 1, "MCPU-therm", "43000", "95500");
  put_zone(tree, 2, "GPU-therm", "-256");
  put_zone(tree, 3, "PMIC-Die", "100000", "99000");
}

/// L4T R28: cpufreq's folders stand with the cores, power monitors are iio devices.
inline void plant_tx2_r28(const Tree& tree) {
  plant_tx2_commons(tree);
  tree.put("/proc/device-tree/model", std::string{"quill\0", 6});
  for (const int id : {0, 3, 4, 5}) {
    put_clock(tree, {"/cpu" + std::to_string(id) + "/cpufreq", "0 3 4 5", tx2_clocks, "345600",
                     "2035200", "tegra_cpufreq", "schedutil", tx2_governors});
  }
  put_iio_rail(tree, "0-0041/iio:device1", 0, "VDD_IN", "3952");
  put_iio_rail(tree, "0-0041/iio:device1", 1, "VDD_SYS_CPU", "840");
  put_iio_rail(tree, "0-0041/iio:device1", 2, "VDD_SYS_DDR", "611");
  put_iio_rail(tree, "0-0040/iio:device0", 0, "VDD_SYS_GPU", "152");
  put_iio_rail(tree, "0-0040/iio:device0", 1, "VDD_SYS_SOC", "534");
}

/// L4T R32 with Linux's own ina3221 driver: folders of policies, hwmon.
inline void plant_tx2_r32(const Tree& tree) {
  plant_tx2_commons(tree);
  tree.put("/proc/sys/kernel/osrelease", "4.9.253-tegra\n");
  tree.put("/proc/device-tree/model", std::string{"NVIDIA Jetson TX2 Developer Kit\0", 32});
  put_clock(tree, {"/cpufreq/policy0", "0 3 4 5", tx2_clocks, "345600", "2035200", "tegra_cpufreq",
                   "schedutil", tx2_governors});
  put_hwmon_rail(tree, "0-0041/hwmon/hwmon1", 1, "VDD_IN", {"19008", "208"});
  put_hwmon_rail(tree, "0-0041/hwmon/hwmon1", 2, "VDD_SYS_CPU", {"19000", "44"});
  put_hwmon_rail(tree, "0-0041/hwmon/hwmon1", 3, "NC", {"0", "0"});
  tree.put("/sys/bus/i2c/drivers/ina3221/0-0041/hwmon/hwmon1/in7_label", "sum of shunt voltages\n");
}

/// Orin NX: two clusters with a clock each.
inline void plant_orin(const Tree& tree) {
  tree.put("/proc/sys/kernel/osrelease", "5.15.136-tegra\n");
  tree.put("/proc/device-tree/model",
           std::string{"NVIDIA Jetson Orin NX Engineering Reference Developer Kit\0", 58});
  put_cores(tree, 8);
  const std::string clocks = "115200 729600 1190400 1497600 1984000";
  const std::string governors = "conservative ondemand userspace powersave performance schedutil";
  put_clock(tree, {"/cpufreq/policy0", "0 1 2 3", clocks, "115200", "1984000", "tegra194",
                   "schedutil", governors});
  put_clock(tree, {"/cpufreq/policy4", "4 5 6 7", clocks, "115200", "1984000", "tegra194",
                   "schedutil", governors});
  put_zone(tree, 0, "cpu-thermal", "51000", "99000");
  put_zone(tree, 1, "cv0-thermal", "-256000");
  put_hwmon_rail(tree, "1-0040/hwmon/hwmon3", 1, "VDD_IN", {"5032", "1200"});
  put_hwmon_rail(tree, "1-0040/hwmon/hwmon3", 2, "VDD_CPU_GPU_CV", {"5032", "264"});
  put_hwmon_rail(tree, "1-0040/hwmon/hwmon3", 3, "VDD_SOC", {"5032", "328"});
  put_process(tree, 301, "nvpmodel");
}

inline void plant_pi5(const Tree& tree) {
  tree.put("/proc/sys/kernel/osrelease", "6.6.31+rpt-rpi-2712\n");
  tree.put("/proc/device-tree/model", std::string{"Raspberry Pi 5 Model B Rev 1.0\0", 31});
  put_cores(tree, 4);
  put_clock(tree,
            {"/cpufreq/policy0", "0 1 2 3",
             "1500000 1600000 1700000 1800000 1900000 2000000 2100000 2200000 2300000 2400000",
             "1500000", "2400000", "cpufreq-dt", "ondemand",
             "conservative ondemand userspace powersave performance schedutil"});
  put_zone(tree, 0, "cpu-thermal", "48250");
  tree.put("/sys/class/hwmon/hwmon0/name", "cpu_thermal\n");
  tree.put("/sys/class/hwmon/hwmon1/name", "rpi_volt\n");
}

/// intel_pstate in its active mode: a policy per core, two governors, no list of clocks.
inline void plant_x86(const Tree& tree) {
  tree.put("/proc/sys/kernel/osrelease", "6.1.0-28-amd64\n");
  tree.put("/sys/class/dmi/id/product_name", "NUC11TNKi5\n");
  put_cores(tree, 4);
  for (int id = 0; id < 4; ++id) {
    put_clock(tree, {"/cpufreq/policy" + std::to_string(id), std::to_string(id), "", "400000",
                     "4200000", "intel_pstate", "powersave", "performance powersave"});
  }
  put_zone(tree, 0, "x86_pkg_temp", "47000");
  put_zone(tree, 1, "acpitz", "27800", "95000");
  for (const auto& [name, domain] : std::map<std::string, std::string>{
           {"intel-rapl:0", "package-0"}, {"intel-rapl:0:0", "core"}, {"intel-rapl:1", "psys"}}) {
    const std::string folder = "/sys/class/powercap/" + name;
    tree.put(folder + "/name", domain + "\n");
    tree.put(folder + "/energy_uj", "262000000000\n");
    tree.put(folder + "/max_energy_range_uj", "262143328850\n");
  }
  put_process(tree, 812, "thermald");
  put_process(tree, 640, "power-profiles-");
  put_process(tree, 1, "systemd");
}

}  // namespace flyball::fake
