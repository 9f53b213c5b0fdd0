// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/tuning.h"

#include "flyball/records/text_table.h"
#include "flyball/runtime/text/number_text.h"
#include "flyball/studies/policy_trouble.h"
#include "flyball/studies/statistics.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>

namespace flyball {
namespace {

Error wrong(const std::string& text, const std::string& why) {
  return {ErrorCode::invalid_input,
          "--try " + text + " " + why + "; give for example range_m=7,15,25"};
}

std::string quoted(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    safe += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
  }
  return '"' + safe + '"';
}

/// Whether the policy itself brought the vehicle to its goal.
bool counts(const Summary& flight) {
  return has_succeeded(flight) && flight.policy_faults == 0;
}

PolicyTrouble trouble_of(const std::vector<Candidate>& candidates) {
  PolicyTrouble trouble;
  for (const Candidate& candidate : candidates) {
    for (const Summary& flight : candidate.flights) {
      trouble.add(flight);
    }
  }
  return trouble;
}

}  // namespace

Result<TriedParameter> read_tried(const std::string& text) {
  const std::size_t equals = text.find('=');
  TriedParameter tried;
  tried.name = text.substr(0, equals);
  if (equals == std::string::npos || tried.name.empty()) {
    return wrong(text, "names no parameter");
  }
  for (std::size_t at = equals + 1; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    double value = 0.0;
    const auto [end, failed] = std::from_chars(text.data() + at, text.data() + comma, value);
    if (failed != std::errc{} || end != text.data() + comma || !std::isfinite(value)) {
      return wrong(text, "has a value that is no number");
    }
    tried.values.push_back(value);
    at = comma + 1;
  }
  const std::set<double> distinct(tried.values.begin(), tried.values.end());
  if (distinct.size() != tried.values.size()) {
    return wrong(text, "has a value twice");
  }
  return tried;
}

Result<std::vector<TriedParameter>> read_all_tried(const std::vector<std::string>& texts) {
  std::vector<TriedParameter> all;
  std::set<std::string> names;
  for (const std::string& text : texts) {
    auto tried = read_tried(text);
    if (!tried) {
      return tried.error();
    }
    if (!names.insert(tried->name).second) {
      return wrong(text, "names a parameter that another --try has; give all its values in one");
    }
    all.push_back(std::move(*tried));
  }
  return all;
}

int Candidate::failures() const {
  return static_cast<int>(flights.size()) -
         static_cast<int>(std::count_if(flights.begin(), flights.end(), counts));
}

double Candidate::median_energy_j() const {
  std::vector<double> energies_j;
  for (const Summary& flight : flights) {
    if (counts(flight)) {
      energies_j.push_back(flight.energy_total_j());
    }
  }
  return energies_j.empty() ? 0.0 : median_of(std::move(energies_j));
}

double Candidate::mean_energy_j() const {
  double sum_j = 0.0;
  double count = 0.0;
  for (const Summary& flight : flights) {
    if (counts(flight)) {
      sum_j += flight.energy_total_j();
      count += 1.0;
    }
  }
  return count > 0.0 ? sum_j / count : 0.0;
}

std::vector<Candidate> combinations(const std::vector<TriedParameter>& tried) {
  std::vector<Candidate> all(1);
  for (const TriedParameter& parameter : tried) {
    std::vector<Candidate> longer;
    for (const Candidate& candidate : all) {
      for (const double value : parameter.values) {
        longer.push_back(candidate);
        longer.back().parameters[parameter.name] = value;
      }
    }
    all = std::move(longer);
  }
  return all;
}

bool is_better(const Candidate& a, const Candidate& b) {
  const int more = a.failures() - b.failures();
  return more != 0 ? more < 0 : a.mean_energy_j() < b.mean_energy_j();
}

std::vector<TuningRound> tuning_rounds(std::size_t candidates, std::size_t seeds) {
  std::size_t halvings = 0;
  while ((candidates >> (halvings + 1U)) >= 2 && (seeds >> (halvings + 1U)) >= 1) {
    ++halvings;
  }
  std::vector<TuningRound> rounds;
  for (std::size_t i = 0; i <= halvings; ++i) {
    const std::size_t half = std::size_t{1} << i;
    rounds.push_back(
        {std::max<std::size_t>(1, seeds >> (halvings - i)), (candidates + half - 1) / half});
  }
  return rounds;
}

std::string preset_text(const std::string& policy,
                        const std::string& description,
                        const std::map<std::string, ParameterValue>& parameters) {
  std::string text = "description = " + quoted(description) + "\npolicy = " + quoted(policy) +
                     "\n\n[parameters]\n";
  for (const auto& [name, value] : parameters) {
    const auto* number = std::get_if<double>(&value);
    text += name + " = " +
            (number != nullptr ? number_text(*number) : quoted(std::get<std::string>(value))) +
            "\n";
  }
  return text;
}

std::string preset_text(const std::string& policy,
                        const std::string& description,
                        const Candidate& candidate) {
  return preset_text(policy, description,
                     std::map<std::string, ParameterValue>{candidate.parameters.begin(),
                                                           candidate.parameters.end()});
}

std::string parameters_text(const Candidate& candidate) {
  std::string text;
  for (const auto& [name, value] : candidate.parameters) {
    text += (text.empty() ? "" : " ") + name + "=" + number_text(value);
  }
  return text;
}

std::string to_text(const std::string& policy, const std::vector<Candidate>& ranked) {
  std::vector<std::vector<std::string>> lines{{"success", "energy kJ", "parameters"}};
  for (const Candidate& candidate : ranked) {
    const auto flown = static_cast<int>(candidate.flights.size());
    lines.push_back(
        {std::to_string(flown - candidate.failures()) + "/" + std::to_string(flown),
         candidate.failures() == flown ? "-" : rounded(candidate.mean_energy_j() * 1e-3, 2),
         parameters_text(candidate)});
  }
  const std::string trouble = trouble_of(ranked).text(policy);
  return aligned(lines) +
         (trouble.empty() ? "" : trouble + "\nSuch flights count as failed, whoever ended them.\n");
}

std::string to_json(const std::string& scenario,
                    const std::string& policy,
                    const std::vector<Candidate>& ranked) {
  using Json = nlohmann::ordered_json;
  Json json{{"scenario", scenario}, {"policy", policy}, {"candidates", Json::array()}};
  for (const Candidate& candidate : ranked) {
    const auto flown = static_cast<int>(candidate.flights.size());
    json["candidates"].push_back(
        {{"parameters", candidate.parameters},
         {"n", flown},
         {"succeeded", flown - candidate.failures()},
         {"policy_faults", trouble_of({candidate}).faults},
         {"mean_energy_j",
          candidate.failures() == flown ? Json{nullptr} : Json(candidate.mean_energy_j())}});
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace flyball
