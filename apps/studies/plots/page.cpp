// SPDX-License-Identifier: BSD-3-Clause
// tested-in: tournament

#include "studies/plots/page.h"

#include "flyball/records/text_table.h"

namespace flyball {
namespace {

// The look of viewer/report.html.
constexpr const char* page_head = R"(<!doctype html>
<!-- SPDX-License-Identifier: BSD-3-Clause -->
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<style>
  body { font: 14px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; color: #22303c;
         background: #f5f7f9; margin: 0 auto; padding: 28px 24px 40px; max-width: 1120px; }
  h1 { font-size: 22px; font-weight: 600; } h2 { font-size: 18px; font-weight: 600; }
  h3 { font-size: 14px; font-weight: 600; margin: 14px 0 2px; }
  .panel { background: #fff; border: 1px solid #dfe5ea; border-radius: 8px; padding: 14px 18px;
           margin: 0 0 16px; }
  .table { overflow-x: auto; padding-bottom: 4px; }
  .plots { display: flex; flex-wrap: wrap; gap: 18px 28px; }
  .panel > svg, .plots > svg { max-width: 100%; }
  svg text { font-size: 12px; fill: #22303c; }
  table { border-collapse: collapse; white-space: nowrap; width: 100%; }
  th, td { text-align: right; padding: 5px 10px; border-bottom: 1px solid #dfe5ea;
           vertical-align: top; font-variant-numeric: tabular-nums; }
  td small { display: block; color: #6b7a88; font-size: 12px; }
  th { color: #6b7a88; font-weight: 500; white-space: normal; vertical-align: bottom; }
  th:first-child, td:first-child { text-align: left; padding-left: 0; }
  .note, footer { color: #6b7a88; font-size: 12.5px; margin: 10px 0 0; }
  @page { size: landscape; margin: 12mm; }
  @media print {  /* A wide table is wrapped, because nobody can scroll on paper. */
    body { font-size: 10px; max-width: none; padding: 0; background: #fff; }
    .panel { border: 0; padding: 0; } .table { overflow: visible; }
    td, th { padding: 3px 5px; } table { white-space: normal; } td small { font-size: 9px; }
    .note, footer { font-size: 9.5px; }
  }
</style>
)";

}  // namespace

std::string page_begin(const std::string& title) {
  return page_head + std::string{"<title>"} + html_text(title) +
         " - Flyball</title></head><body>\n<h1>" + html_text(title) + "</h1>\n";
}

std::string page_end(const std::string& footer) {
  return "<footer>" + html_text(footer) + "</footer>\n</body></html>\n";
}

}  // namespace flyball
