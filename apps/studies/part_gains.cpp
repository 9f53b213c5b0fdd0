// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/part_gains.h"

#include "flyball/records/text_table.h"

#include "studies/plots/page.h"
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include <nlohmann/json.hpp>

namespace flyball {
namespace {

using Json = nlohmann::ordered_json;
using Pairing = std::map<std::pair<std::string, std::uint64_t>, const Summary*>;

/// The flights of one policy by world and seed.
Pairing pairing_of(const std::vector<Summary>& flights, const std::string& policy) {
  Pairing found;
  for (const Summary& flight : flights) {
    if (flight.policy == policy) {
      found[{flight.scenario, flight.seed}] = &flight;
    }
  }
  return found;
}

constexpr double same_percent = 0.1;  // Chosen: less is no gain that anybody would fly for.

/// Sign test: how likely so lopsided a count is, in this direction, where both are equally likely
/// (McNemar 1947, doi:10.1007/BF02295996, exact and one-sided).
double chance_of(int one, int other) {
  const int all = one + other;
  double ways = 1.0;  // To choose k of all.
  double sum = 0.0;
  for (int k = 0; k <= std::min(one, other); ++k) {
    sum += ways;
    ways *= static_cast<double>(all - k) / static_cast<double>(k + 1);
  }
  return sum / std::exp2(all);
}

/// Of the pairs in which both arrive: energy without the part over energy with it. Counts the
/// others.
std::vector<double> ratios_of(const Pairing& whole, const Pairing& without, PartGain& gain) {
  std::vector<double> ratios;
  for (const auto& [place, flight] : without) {
    const auto other = whole.find(place);
    if (other == whole.end()) {
      continue;
    }
    const bool with_it = has_succeeded(*other->second);
    const bool without_it = has_succeeded(*flight);
    if (with_it && without_it) {
      ratios.push_back(flight->energy_total_j() / other->second->energy_total_j());
    } else {
      gain.only_whole += with_it ? 1 : 0;
      gain.only_without += without_it ? 1 : 0;
    }
  }
  return ratios;
}

PartGain gain_of(const std::string& part, const Pairing& whole, const Pairing& without) {
  PartGain gain;
  gain.part = part;
  std::vector<double> percents;
  double sum_of_logs = 0.0;
  for (const double ratio : ratios_of(whole, without, gain)) {
    percents.push_back(100.0 * (ratio - 1.0));
    sum_of_logs += std::log(ratio);
    gain.differ += std::abs(percents.back()) > same_percent ? 1 : 0;
  }
  gain.pairs = static_cast<int>(percents.size());
  gain.energy_percent = bootstrap_median(percents);
  if (!percents.empty()) {
    gain.mean_percent = 100.0 * (std::exp(sum_of_logs / gain.pairs) - 1.0);
  }
  return gain;
}

std::vector<std::vector<std::string>> cells_of(const std::vector<PartGain>& gains) {
  std::vector<std::vector<std::string>> lines;
  for (const PartGain& gain : gains) {
    const auto& percent = gain.energy_percent;
    const std::string median = percent
                                   ? rounded(percent->median, 1) + " [" + rounded(percent->lo, 1) +
                                         ", " + rounded(percent->hi, 1) + "]"
                                   : "-";
    lines.push_back({gain.part, std::to_string(gain.pairs), std::to_string(gain.differ), median,
                     gain.mean_percent ? rounded(*gain.mean_percent, 1) : "-",
                     std::to_string(gain.only_whole), std::to_string(gain.only_without),
                     gain.verdict()});
  }
  return lines;
}

std::vector<std::string> heads(const std::string& whole) {
  return {whole + " without", "pairs",      "differ",       "energy %",
          "mean %",           "fails then", "arrives then", "the part"};
}

}  // namespace

std::string PartGain::verdict() const {
  constexpr double significant = 0.05;
  if (chance_of(only_whole, only_without) <= significant) {
    return only_whole > only_without ? "is needed to arrive" : "keeps from arriving";
  }
  constexpr int least_pairs = 6;  // With fewer, the interval is their whole range (statistics.h).
  if (!energy_percent || pairs < least_pairs) {
    return "too few flights";
  }
  if (energy_percent->lo > same_percent) {
    return "earns its place";
  }
  return energy_percent->hi < -same_percent ? "costs energy" : "nothing beyond its interval";
}

std::vector<PartGain> part_gains(const std::vector<Summary>& flights,
                                 const std::string& whole,
                                 const std::vector<AblatedPolicy>& without) {
  const Pairing of_whole = pairing_of(flights, whole);
  std::vector<PartGain> gains;
  gains.reserve(without.size());
  for (const AblatedPolicy& one : without) {
    gains.push_back(gain_of(one.part, of_whole, pairing_of(flights, one.policy)));
  }
  return gains;
}

std::string to_text(const std::string& whole, const std::vector<PartGain>& gains) {
  std::vector<std::vector<std::string>> lines = cells_of(gains);
  lines.insert(lines.begin(), heads(whole));
  return aligned(lines) +
         "Energy more than that of the whole policy, over all worlds and seeds where both succeed: "
         "median [95 % bootstrap interval], and geometric mean.\n";
}

std::string to_json(const std::vector<PartGain>& gains) {
  Json json = Json::array();
  for (const PartGain& gain : gains) {
    const auto& percent = gain.energy_percent;
    json.push_back({{"part", gain.part},
                    {"pairs", gain.pairs},
                    {"differ", gain.differ},
                    {"median_percent", percent ? Json(percent->median) : Json()},
                    {"lo_percent", percent ? Json(percent->lo) : Json()},
                    {"hi_percent", percent ? Json(percent->hi) : Json()},
                    {"mean_percent", gain.mean_percent ? Json(*gain.mean_percent) : Json()},
                    {"only_whole_succeeds", gain.only_whole},
                    {"only_without_succeeds", gain.only_without},
                    {"verdict", gain.verdict()}});
  }
  return json.dump(2);
}

std::string to_html(const std::string& whole, const std::vector<PartGain>& gains) {
  std::string table =
      "<h2>What each part earns</h2>\n<div class=\"panel\"><div "
      "class=\"table\"><table>";
  const auto row = [&table](const std::vector<std::string>& cells, const char* tag) {
    table += "<tr>";
    for (const std::string& cell : cells) {
      table += std::string{"<"} + tag + ">" + html_text(cell) + "</" + tag + ">";
    }
    table += "</tr>\n";
  };
  row(heads(whole), "th");
  for (const auto& cells : cells_of(gains)) {
    row(cells, "td");
  }
  return table + "</table></div></div>\n";
}

}  // namespace flyball
