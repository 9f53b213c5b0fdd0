// SPDX-License-Identifier: BSD-3-Clause
#include "board/board_meters.h"

#include "board/sysfs_text.h"
#include <algorithm>
#include <array>
#include <utility>

namespace flyball {
namespace {

constexpr Duration window = std::chrono::seconds{1};

std::optional<PowerRail> input_rail(const std::vector<PowerRail>& rails, const BoardFile& board) {
  std::vector<std::string> names = board.input_rails;
  names.insert(names.end(), {"VDD_IN", "VIN"});  // What boards without a file call it.
  for (const std::string& name : names) {
    for (const PowerRail& rail : rails) {
      if (rail.label == name) {
        return rail;
      }
    }
  }
  return std::nullopt;
}

std::vector<EnergyCounter> counters_named(const std::vector<EnergyCounter>& all,
                                          const std::string& begin) {
  std::vector<EnergyCounter> counters;
  for (const EnergyCounter& counter : all) {
    if (counter.is_readable && counter.name.rfind(begin, 0) == 0) {
      counters.push_back(counter);
    }
  }
  return counters;
}

}  // namespace

PowerMeter::PowerMeter(const LinuxSystem& system,
                       const BoardInventory& found,
                       const BoardFile& board)
    : system_{system}, rail_{input_rail(found.rails, board)} {
  if (rail_) {
    source_ = rail_->label;
    return;
  }
  counters_ = counters_named(found.counters, "psys");
  if (!counters_.empty()) {
    counters_.resize(1);
    source_ = "psys";
    return;
  }
  counters_ = counters_named(found.counters, "package-");
  for (const EnergyCounter& counter : counters_) {
    source_ += counter.name + " ";
  }
  source_ += counters_.empty() ? "" : "(without the board)";
}

std::optional<double> PowerMeter::counted_j() {
  std::vector<long long> now;
  for (const EnergyCounter& counter : counters_) {
    const auto count = integer_in(system_, counter.file);
    if (!count) {
      return std::nullopt;
    }
    now.push_back(*count);
  }
  for (std::size_t i = 0; i < last_uj_.size(); ++i) {
    const long long step = now[i] - last_uj_[i];
    total_j_ += 1e-6 * static_cast<double>(step < 0 ? step + counters_[i].range_uj : step);
  }
  last_uj_ = std::move(now);
  return total_j_;
}

void PowerMeter::sample(Duration now) {
  std::optional<double> value;
  if (rail_) {
    const auto power = rail_power(system_, *rail_);
    value = power ? std::optional{power->value()} : std::nullopt;
  } else if (!counters_.empty()) {
    value = counted_j();
  }
  if (value) {
    readings_.push_back({now, *value});
  } else if (!readings_.empty() && now - readings_.back().at > window) {
    readings_.clear();  // What a counter said before it vanished is no power of today's.
    last_uj_.clear();
  }
  // A counter needs a reading from before the window to have a difference.
  const std::size_t least = rail_ ? 0 : 2;
  while (readings_.size() > least && now - readings_.front().at > window) {
    readings_.pop_front();
  }
}

std::optional<Watts> PowerMeter::power() const {
  if (readings_.empty()) {
    return std::nullopt;
  }
  if (!rail_) {
    const double seconds = to_seconds(readings_.back().at - readings_.front().at);
    const double joules = readings_.back().value - readings_.front().value;
    return seconds > 0.0 ? std::optional{Watts{joules / seconds}} : std::nullopt;
  }
  double sum_w = 0.0;
  for (const Reading& reading : readings_) {
    sum_w += reading.value;
  }
  return Watts{sum_w / static_cast<double>(readings_.size())};
}

RailPower power_by_rail(const LinuxSystem& system, const std::vector<PowerRail>& rails) {
  constexpr std::array<std::pair<const char*, Watts RailPower::*>, 4> parts{
      {{"CPU", &RailPower::cpu},
       {"GPU", &RailPower::gpu},
       {"DDR", &RailPower::memory},
       {"SOC", &RailPower::soc}}};
  RailPower sum;
  for (const PowerRail& rail : rails) {
    Watts RailPower::*part = nullptr;
    int named = 0;
    for (const auto& [name, member] : parts) {
      const bool is_named = rail.label.find(name) != std::string::npos;
      part = is_named ? member : part;
      named += is_named ? 1 : 0;
    }
    if (const auto power = named == 1 ? rail_power(system, rail) : std::nullopt) {
      sum.*part = sum.*part + *power;
    }
  }
  return sum;
}

std::optional<Heat> closest_heat(const LinuxSystem& system,
                                 const std::vector<ThermalZone>& zones,
                                 const BoardFile& board) {
  std::optional<Heat> closest;
  const auto is_closer = [&closest](const Heat& heat) {
    if (!closest || heat.trip_c.has_value() != closest->trip_c.has_value()) {
      return !closest || heat.trip_c.has_value();
    }
    return heat.temperature_c - heat.trip_c.value_or(0.0) >
           closest->temperature_c - closest->trip_c.value_or(0.0);
  };
  for (const ThermalZone& zone : zones) {
    const bool is_ignored = std::find(board.ignored_zones.begin(), board.ignored_zones.end(),
                                      zone.type) != board.ignored_zones.end();
    const auto temperature = is_ignored ? std::nullopt : zone_temperature_c(system, zone.folder);
    if (temperature) {
      const Heat heat{zone.type, *temperature, zone.trip_c};
      closest = is_closer(heat) ? heat : closest;
    }
  }
  return closest;
}

}  // namespace flyball
