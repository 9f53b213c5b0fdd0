// SPDX-License-Identifier: BSD-3-Clause

#include "scenario/scenario_keys.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <string_view>
#include <utility>

namespace flyball {
namespace {

struct UnitSuffix {
  std::string_view suffix;
  std::string_view unit;
};

// Longer ones first: `_m_s` ends in `_s`. Units that no key has are here too, so that a key with
// the wrong one is recognised.
constexpr std::array<UnitSuffix, 46> unit_suffixes{{
    {"_mbit_s", "Mbit/s"}, {"_bit_s", "bit/s"}, {"_k_w", "K/W"},      {"_c", "degrees Celsius"},
    {"_1_m2", "1/m^2"},    {"_rad_s", "rad/s"}, {"_deg_s", "deg/s"},  {"_m_s2", "m/s^2"},
    {"_km_h", "km/h"},     {"_m_s", "m/s"},     {"_mph", "mph"},      {"_percent", "%"},
    {"_seconds", "s"},     {"_minutes", "min"}, {"_meters", "m"},     {"_metres", "m"},
    {"_degrees", "deg"},   {"_radians", "rad"}, {"_per_m2", "1/m^2"}, {"_rad", "rad"},
    {"_deg", "deg"},       {"_ghz", "GHz"},     {"_mhz", "MHz"},      {"_khz", "kHz"},
    {"_hz", "Hz"},         {"_min", "min"},     {"_ms", "ms"},        {"_us", "us"},
    {"_ns", "ns"},         {"_kg", "kg"},       {"_lb", "lb"},        {"_km", "km"},
    {"_cm", "cm"},         {"_mm", "mm"},       {"_ft", "ft"},        {"_px", "px"},
    {"_kw", "kW"},         {"_mw", "mW"},       {"_wh", "Wh"},        {"_ah", "Ah"},
    {"_m", "m"},           {"_s", "s"},         {"_h", "h"},          {"_g", "g"},
    {"_w", "W"},           {"_j", "J"},
}};

/// Letters added, left out, exchanged for others, or two neighbours in the wrong order (optimal
/// string alignment), because that is how people mistype.
std::size_t edits_between(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before;  // Two rows up.
  std::vector<std::size_t> above(b.size() + 1);
  std::iota(above.begin(), above.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::vector<std::size_t> row(b.size() + 1, i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t same = a[i - 1] == b[j - 1] ? 0 : 1;
      row[j] = std::min({row[j - 1] + 1, above[j] + 1, above[j - 1] + same});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before[j - 2] + 1);
      }
    }
    before = std::move(above);
    above = std::move(row);
  }
  return above.back();
}

/// As many edits would turn a name into anything.
std::size_t most_edits(const std::string& name) {
  return name.size() / 3 + 1;
}

std::string after_dot(const std::string& key) {
  const std::size_t dot = key.rfind('.');
  return dot == std::string::npos ? key : key.substr(dot + 1);
}

/// With the dot; empty without one.
std::string section_of(const std::string& key) {
  return key.substr(0, key.size() - after_dot(key).size());
}

/// Of the same section, or else of another one, where also the name behind the dot must be near:
/// long sections are alike in many letters.
std::string nearest_key(const std::string& unknown, const std::vector<std::string>& known) {
  std::vector<std::string> near;
  for (const std::string& key : known) {
    if (edits_between(after_dot(unknown), after_dot(key)) <= most_edits(after_dot(unknown))) {
      near.push_back(key);
    }
  }
  std::vector<std::string> beside;
  std::copy_if(
      near.begin(), near.end(), std::back_inserter(beside),
      [&unknown](const std::string& key) { return section_of(key) == section_of(unknown); });
  return nearest_name(unknown, beside.empty() ? near : beside);
}

bool begins_with(const std::string& text, const std::string& beginning) {
  return text.compare(0, beginning.size(), beginning) == 0;
}

/// `world.density` of `world.density_1_m2`, `rang` of `map.range_m`; with one match only.
std::string abbreviated(const std::string& unknown, const std::vector<std::string>& known) {
  constexpr std::size_t shortest = 4;
  std::string match;
  for (const std::string& key : known) {
    if (after_dot(unknown).size() < shortest ||
        !(begins_with(key, unknown) || begins_with(after_dot(key), unknown))) {
      continue;
    }
    if (!match.empty()) {
      return {};
    }
    match = key;
  }
  return match;
}

std::string same_stem(const std::string& unknown, const std::vector<std::string>& known) {
  const KeyParts wanted = parts_of(unknown);
  for (const std::string& key : known) {
    const KeyParts has = parts_of(key);
    if (has.stem == wanted.stem) {
      return "did you mean " + key +
             (has.unit.empty() ? ", without a unit?" : ", in " + has.unit + "?");
    }
  }
  return {};
}

}  // namespace

KeyParts parts_of(const std::string& key) {
  for (const auto& [suffix, unit] : unit_suffixes) {
    if (key.size() > suffix.size() &&
        key.compare(key.size() - suffix.size(), suffix.size(), suffix) == 0) {
      return {key.substr(0, key.size() - suffix.size()), std::string{unit}};
    }
  }
  return {key, {}};
}

std::string nearest_name(const std::string& wanted, const std::vector<std::string>& names) {
  std::string nearest;
  std::size_t fewest = most_edits(wanted);
  for (const std::string& name : names) {
    const std::size_t edits = edits_between(wanted, name);
    if (edits < fewest || (edits == fewest && nearest.empty())) {
      fewest = edits;
      nearest = name;
    }
  }
  return nearest;
}

std::string suggest_key(const std::string& unknown, const std::vector<std::string>& known) {
  if (std::string unit = same_stem(unknown, known); !unit.empty()) {
    return unit;
  }
  // The right name under the wrong section comes before a similar name.
  std::vector<std::string> elsewhere;
  std::copy_if(known.begin(), known.end(), std::back_inserter(elsewhere),
               [&unknown](const std::string& key) { return after_dot(key) == after_dot(unknown); });
  std::string near = nearest_name(unknown, elsewhere);
  if (near.empty() && !elsewhere.empty()) {
    near = elsewhere.front();
  }
  if (near.empty()) {
    near = abbreviated(unknown, known);
  }
  if (near.empty()) {
    near = nearest_key(unknown, known);
  }
  return near.empty() ? std::string{} : "did you mean " + near + "?";
}

std::string name_meant(const std::string& wanted, const std::vector<std::string>& names) {
  const std::string near = nearest_name(wanted, names);
  return near.empty() ? "" : "did you mean " + near + "? ";
}

}  // namespace flyball
