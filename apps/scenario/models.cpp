// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/scenario/models.h"

#include "flyball/scenario/files.h"

#include "scenario/sha256.h"
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <toml++/toml.h>

namespace flyball {
namespace {

namespace fs = std::filesystem;

std::string list_path() {
  return (fs::path{share_folder("models")} / "known.toml").string();
}

std::string names_of(const std::vector<std::string>& folders) {
  std::string text;
  for (const std::string& folder : folders) {
    text += (text.empty() ? "\"" : ", \"") + folder + "\"";
  }
  return text;
}

Status verify(const KnownModel& model, const std::string& path) {
  std::ifstream file{path, std::ios::binary};
  const std::string content{std::istreambuf_iterator<char>{file}, {}};
  const std::string found = sha256_of(content);
  if (!file || found != model.sha256) {
    return Error{ErrorCode::invalid_input, "\"" + path + "\" is not the " + model.file + " of " +
                                               model.source + ": its SHA-256 is " + found +
                                               ", not " + model.sha256 +
                                               "; put the right file there, see: flyball models"};
  }
  return Done{};
}

}  // namespace

Result<std::vector<KnownModel>> known_models() {
  try {
    const toml::table list = toml::parse_file(list_path());
    std::vector<KnownModel> models;
    const toml::array* entries = list.at("model").as_array();
    if (entries == nullptr || !entries->is_homogeneous<toml::table>()) {
      throw std::out_of_range{"model is no array of tables"};
    }
    for (const toml::node& node : *entries) {
      const toml::table& entry = *node.as_table();
      models.push_back({entry.at("file").value<std::string>().value(),
                        static_cast<std::uint64_t>(entry.at("bytes").value<std::int64_t>().value()),
                        entry.at("sha256").value<std::string>().value(),
                        entry.at("source").value<std::string>().value()});
    }
    return models;
  } catch (const std::exception& error) {
    return Error{ErrorCode::failed,
                 "list of models \"" + list_path() + "\" is broken: " + error.what()};
  }
}

std::vector<std::string> model_folders(const std::string& folder) {
  std::vector<std::string> folders;
  if (folder != "shipped") {
    folders.push_back(folder);
  }
  // Read before any thread is started.
  const char* given = std::getenv("FLYBALL_MODELS");  // NOLINT(concurrency-mt-unsafe)
  if (given != nullptr && *given != '\0') {
    folders.emplace_back(given);
  }
  folders.push_back(share_folder("models"));
  return folders;
}

Result<std::string> find_model(const std::string& file, const std::string& folder) {
  const auto models = known_models();
  if (!models) {
    return models.error();
  }
  const auto model = std::find_if(models->begin(), models->end(),
                                  [&](const KnownModel& known) { return known.file == file; });
  if (model == models->end()) {
    return Error{ErrorCode::not_found,
                 "no model file \"" + file + "\" is known; try: flyball models"};
  }
  const auto folders = model_folders(folder);
  for (const std::string& in : folders) {
    const fs::path path = fs::path{in} / file;
    if (std::error_code failed; !fs::is_regular_file(path, failed)) {
      continue;
    }
    if (const Status same = verify(*model, path.string()); !same) {
      return same.error();
    }
    return path.string();
  }
  return Error{ErrorCode::not_found,
               "no \"" + file + "\" in " + names_of(folders) + "; get it from " + model->source +
                   " and put it into a folder that FLYBALL_MODELS or detector.models_folder names"};
}

}  // namespace flyball
