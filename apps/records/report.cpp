// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/records/report.h"

#include "flyball/records/text_table.h"
#include "flyball/scenario/files.h"

#include <fstream>
#include <iterator>
#include <map>

#include <nlohmann/json.hpp>

namespace flyball {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* template_without_plots =
    "<!doctype html><meta charset=\"utf-8\"><title>{{title}}</title><h1>{{title}}</h1>{{table}}"
    "<p>The plots need the file viewer/report.html, which is not among the program's data.</p>";

std::string viewer_file(const std::string& name) {
  std::ifstream file{share_folder("viewer") + "/" + name};
  return {std::istreambuf_iterator<char>{file}, {}};
}

/// Only the template's own marks are replaced: the pieces are taken apart before any is put in.
std::string filled(const std::string& page, const std::map<std::string, std::string>& parts) {
  std::string text;
  std::size_t at = 0;
  for (std::size_t open = page.find("{{"); open != std::string::npos; open = page.find("{{", at)) {
    const std::size_t close = page.find("}}", open);
    const auto part = close == std::string::npos
                          ? parts.end()
                          : parts.find(page.substr(open + 2, close - open - 2));
    text += page.substr(at, open - at);
    text += part == parts.end() ? "{{" : part->second;
    at = part == parts.end() ? open + 2 : close + 2;
  }
  return text + page.substr(at);
}

/// JSON inside a script element: a `<` in a name must not end the element.
std::string script_json(const Json& json) {
  std::string safe;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    safe += c == '<' ? std::string{"\\u003c"} : std::string{c};
  }
  return safe;
}

/// Flights of one seed share their world: it is written once.
Json page_data(const std::vector<RunPicture>& runs) {
  Json data{{"worlds", Json::array()}, {"runs", Json::array()}};
  std::map<std::string, std::size_t> known;
  for (const RunPicture& run : runs) {
    Json picture = Json::parse(run.json, nullptr, false);
    if (!picture.is_object() || !picture.contains("world")) {
      continue;
    }
    const auto [entry, is_new] = known.emplace(
        picture["world"].dump(-1, ' ', false, Json::error_handler_t::replace), known.size());
    if (is_new) {
      data["worlds"].push_back(picture["world"]);
    }
    picture["world"] = entry->second;
    data["runs"].push_back(std::move(picture));
  }
  return data;
}

}  // namespace

std::string report_page(const std::string& title,
                        const std::vector<RunPicture>& runs,
                        const std::string& table_html) {
  const std::string page = viewer_file("report.html");
  return filled(page.empty() ? template_without_plots : page,
                {{"title", html_text(title)},
                 {"table", table_html},
                 {"script", viewer_file("top_view.js") + viewer_file("knob_rows.js") +
                                viewer_file("report.js")},
                 {"data", script_json(page_data(runs))}});
}

}  // namespace flyball
