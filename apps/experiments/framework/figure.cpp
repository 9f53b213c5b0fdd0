// SPDX-License-Identifier: BSD-3-Clause

#include "experiments/framework/figure.h"

#include "flyball/records/text_table.h"

#include "studies/plots/csv.h"

namespace flyball {
namespace {

using Rows = std::vector<std::vector<std::string>>;

void add_value(std::vector<std::string> row,
               const std::optional<MedianInterval>& value,
               Rows& rows) {
  row.push_back(value ? csv_number(value->median) : "");
  row.push_back(value ? csv_number(value->lo) : "");
  row.push_back(value ? csv_number(value->hi) : "");
  rows.push_back(std::move(row));
}

/// Tells the kinds of content apart, for `std::visit`.
struct RowsOf {
  Rows operator()(const LinePlot& plot) const {
    Rows rows{{"line", plot.x_title, plot.title, "lo", "hi"}};
    for (const PlottedLine& line : plot.lines) {
      for (std::size_t i = 0; i < plot.places.size(); ++i) {
        add_value({line.name, plot.places[i]}, line.values[i], rows);
      }
    }
    return rows;
  }
  Rows operator()(const HeatMap& map) const {
    Rows rows{{map.y_title, map.x_title, "flights", map.title, "lo", "hi"}};
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      const std::size_t columns = map.x_values.size();
      add_value({map.y_values[i / columns], map.x_values[i % columns], map.cells[i].under},
                map.cells[i].value, rows);
    }
    return rows;
  }
  Rows operator()(const DotPlot& plot) const {
    Rows rows{{"name", plot.title, "lo", "hi"}};
    for (const PlottedValue& value : plot.values) {
      add_value({value.name}, value.value, rows);
    }
    return rows;
  }
  Rows operator()(const CellPicture& picture) const {
    Rows rows{{"x_m", "y_m", "state"}};
    const auto centre = [&](double least_m, std::size_t i) {
      return csv_number(least_m + picture.square_m * (static_cast<double>(i) + 0.5));
    };
    for (std::size_t i = 0; i < picture.squares.size(); ++i) {
      rows.push_back({centre(picture.least_x_m, i % picture.columns),
                      centre(picture.least_y_m, i / picture.columns),
                      to_string(picture.squares[i])});
    }
    return rows;
  }
  Rows operator()(const TextTable& table) const { return table.rows; }
};

struct HtmlOf {
  std::string operator()(const LinePlot& plot) const { return line_plot_svg(plot); }
  std::string operator()(const HeatMap& map) const { return heat_map_svg(map); }
  std::string operator()(const DotPlot& plot) const {
    return dot_plot_svg(plot.title, plot.values);
  }
  std::string operator()(const CellPicture& picture) const { return cell_picture_svg(picture); }
  std::string operator()(const TextTable& table) const {
    std::string rows;
    for (const auto& row : table.rows) {
      const std::string cell = &row == &table.rows.front() ? "th" : "td";
      rows += "<tr>";
      for (const std::string& text : row) {
        rows += "<" + cell + ">" + html_text(text) + "</" + cell + ">";
      }
      rows += "</tr>\n";
    }
    return "<h3>" + html_text(table.title) + "</h3>\n" + html_table(rows);
  }
};

}  // namespace

std::string to_html(const Figure& figure) {
  return "<figure>" + std::visit(HtmlOf{}, figure.content) + "<figcaption>" +
         html_text(figure.caption) + "</figcaption></figure>\n";
}

std::string to_csv(const Figure& figure) {
  std::string csv;
  for (const auto& row : std::visit(RowsOf{}, figure.content)) {
    csv += csv_row(row);
  }
  return csv;
}

}  // namespace flyball
