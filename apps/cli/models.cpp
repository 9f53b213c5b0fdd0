// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/scenario/models.h"

#include "flyball/records/text_table.h"

#include "commands.h"
#include "console.h"
#include "flight_options.h"
#include <memory>

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

std::string state_of(const Result<std::string>& found) {
  if (found) {
    return "right: " + *found;
  }
  return found.error().code == ErrorCode::not_found ? "absent" : "WRONG";
}

int list_models(const std::string& folder) {
  const auto models = known_models();
  if (!models) {
    return refuse({models.error()});
  }
  std::vector<std::vector<std::string>> lines{{"FILE", "BYTES", "SHA-256", "STATE"}};
  std::vector<Error> wrong;
  for (const KnownModel& model : *models) {
    const auto found = find_model(model.file, folder);
    lines.push_back({model.file, std::to_string(model.bytes), model.sha256, state_of(found)});
    if (!found && found.error().code != ErrorCode::not_found) {
      wrong.push_back(found.error());
    }
  }
  print(aligned(lines));
  std::string looked;
  for (const std::string& in : model_folders(folder)) {
    looked += "  " + in + "\n";
  }
  print("From " + models->front().source + ". Looked for in\n" + looked);
  return wrong.empty() ? exit_success : refuse(wrong);
}

}  // namespace

void add_models(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand(
      "models", "prints which networks' weights are known, and checks those that are here");
  const auto folder = std::make_shared<std::string>("shipped");  // Owners: the parser's callbacks.
  refuse_empty(
      *command->add_option("--folder", *folder, "folder that is searched first")->type_name("DIR"));
  command->callback([folder, &exit_code] { exit_code = list_models(*folder); });
}

}  // namespace flyball
