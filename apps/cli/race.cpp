// SPDX-License-Identifier: BSD-3-Clause

#include "race.h"

#include "flyball/governors/policy_file.h"
#include "flyball/governors/preset.h"
#include "flyball/records/report.h"
#include "flyball/scenario/files.h"
#include "flyball/scenario/knobs.h"
#include "flyball/scenario/policy_choice.h"
#include "flyball/scenario/shipped_platform.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace flyball {

namespace {

/// Those that were not there before: they go again unless they are kept.
class NewFiles {
 public:
  explicit NewFiles(std::vector<std::string> folders) : folders_{std::move(folders)} {}
  NewFiles(const NewFiles&) = delete;
  NewFiles& operator=(const NewFiles&) = delete;
  ~NewFiles() {
    std::error_code ignored;
    for (const std::string& path : paths_) {
      std::filesystem::remove(path, ignored);
    }
    remove_empty(folders_);  // None, where files are kept.
  }
  void add(const std::string& path) {
    if (!std::filesystem::exists(path)) {
      paths_.push_back(path);
    }
  }
  void keep() { paths_.clear(); }

 private:
  std::vector<std::string> folders_;
  std::vector<std::string> paths_{};
};

/// As the flight itself would refuse it, before anything flies.
Status check_policy(const Scenario& scenario) {
  const auto platform = find_platform(scenario.platform.name);
  if (!platform) {
    return platform.error();
  }
  auto knobs = standard_knobs(scenario);
  if (!knobs) {
    return knobs.error();
  }
  const auto policy =
      start_policy(scenario, KnobSettings{std::move(*knobs)}, board_model_of(*platform));
  return policy ? Status{Done{}} : policy.error();
}

}  // namespace

Result<RacedPolicy> raced_policy(const std::string& name) {
  namespace fs = std::filesystem;
  const auto file = find_shipped("presets", name);
  if (!file) {
    return RacedPolicy{name, {}};  // Whether there is such a policy shows before it flies.
  }
  if (fs::path{*file}.extension() != ".toml") {
    return RacedPolicy{fs::absolute(*file).string(), {}};
  }
  auto preset = load_preset(*file);
  if (!preset) {
    return preset.error();
  }
  if (preset->is_combination()) {
    return Error{ErrorCode::invalid_input, "policy \"" + name + "\" is a combination of \"" +
                                               preset->application + "\" and \"" + preset->clock +
                                               "\"; name one of them"};
  }
  const fs::path beside = fs::absolute(*file).parent_path() / preset->policy;
  return RacedPolicy{is_policy_file(preset->policy) ? beside.string() : preset->policy,
                     std::move(preset->parameters)};
}

/// One candidate with one seed.
struct Race::Heat : StoredFlight {
  Candidate* candidate{};
};

Race::Race(RaceSettings settings, FlightStore& store)
    : settings_{std::move(settings)}, store_{store} {}

/// Under a name that says its parameters: the same candidate has the same file.
std::string Race::preset_file(const Candidate& candidate) const {
  const std::string stem = std::filesystem::path{settings_.policy.policy}.stem().string();
  std::string name = stem + " " + parameters_text(candidate);
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == ' ' || c == '='; }, '-');
  std::replace(name.begin(), name.end(), '.', '_');
  return settings_.presets + "/" + name + ".toml";
}

std::string Race::preset_of(const Candidate& candidate, const std::string& description) const {
  auto parameters = settings_.policy.parameters;
  for (const auto& [name, value] : candidate.parameters) {
    parameters[name] = value;
  }
  return preset_text(settings_.policy.policy, description, parameters);
}

Status Race::write_preset(const Candidate& candidate) const {
  return write_file(preset_file(candidate), preset_of(candidate, "A candidate of a race"));
}

std::variant<std::vector<Race::Heat>, std::vector<Error>> Race::plan(
    const std::vector<Candidate*>& candidates, std::size_t seeds) const {
  auto made = prepare_folder(settings_.presets);
  if (!made) {
    return std::vector{made.error()};
  }
  NewFiles presets{std::move(*made)};
  std::vector<Heat> heats;
  for (Candidate* candidate : candidates) {
    presets.add(preset_file(*candidate));
    if (const Status written = write_preset(*candidate); !written) {
      return std::vector{written.error()};
    }
    if (std::vector<Error> errors = add_heats(*candidate, seeds, heats); !errors.empty()) {
      return errors;
    }
  }
  presets.keep();
  return heats;
}

std::vector<Error> Race::add_heats(Candidate& candidate,
                                   std::size_t seeds,
                                   std::vector<Heat>& heats) const {
  const std::string file = preset_file(candidate);
  const std::size_t first = candidate.flights.size();
  for (std::size_t k = first; k < seeds; ++k) {
    auto planned = plan_flight(settings_.flight, file, settings_.seeds[k], settings_.flights);
    if (auto* errors = std::get_if<std::vector<Error>>(&planned)) {
      return std::move(*errors);
    }
    auto& flight = std::get<PlannedFlight>(planned);
    if (const Status checked = k == first ? check_policy(flight.scenario) : Done{}; !checked) {
      return {checked.error()};
    }
    heats.push_back({{std::move(flight), "", std::nullopt}, &candidate});
  }
  return {};
}

std::optional<int> Race::fly(const std::vector<Candidate*>& candidates, std::size_t seeds) {
  auto planned = plan(candidates, seeds);
  if (const auto* errors = std::get_if<std::vector<Error>>(&planned)) {
    return refuse(*errors);
  }
  has_begun_ = true;
  auto& heats = std::get<std::vector<Heat>>(planned);
  const Flown flown = fly_stored(settings_.batch, store_, pointers_to(heats));
  if (const std::optional<int> code = unfinished(flown)) {
    return code;
  }
  for (const Heat& heat : heats) {
    heat.candidate->flights.push_back(*heat.summary);
  }
  return std::nullopt;
}

std::optional<int> Race::halve(std::vector<Candidate>& candidates, RaceOrder is_better) {
  for (const TuningRound& round : tuning_rounds(candidates.size(), settings_.seeds.size())) {
    note("round: " + std::to_string(round.candidates) + " settings, " +
         std::to_string(round.seeds) + " seeds");
    std::vector<Candidate*> flying;
    for (std::size_t i = 0; i < round.candidates; ++i) {
      flying.push_back(&candidates[i]);
    }
    if (const std::optional<int> code = fly(flying, round.seeds)) {
      return code;
    }
    std::stable_sort(candidates.begin(),
                     candidates.begin() + static_cast<std::ptrdiff_t>(round.candidates), is_better);
  }
  return std::nullopt;
}

}  // namespace flyball
