// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/sweep.h"

#include "flyball/runtime/text/number_text.h"
#include "flyball/scenario/override.h"
#include "flyball/studies/policy_trouble.h"

#include "studies/sweep/flight_figures.h"
#include <algorithm>
#include <charconv>
#include <set>
#include <utility>

namespace flyball {
namespace {

Error wrong(const std::string& text, const std::string& why) {
  return {ErrorCode::invalid_input,
          "--over " + text + " " + why + "; give for example map.range_m=5,10,20"};
}

/// Knows, character by character, whether it stands outside brackets, braces and quotes.
class Nesting {
 public:
  void pass(char c) {
    if (quote_ != '\0') {
      quote_ = c == quote_ ? '\0' : quote_;
    } else if (c == '"' || c == '\'') {
      quote_ = c;
    } else {
      depth_ += c == '[' || c == '{' ? 1 : 0;
      depth_ -= c == ']' || c == '}' ? 1 : 0;
    }
  }
  [[nodiscard]] bool is_outside() const { return depth_ == 0 && quote_ == '\0'; }

 private:
  int depth_{};
  char quote_{'\0'};
};

std::vector<std::string> split_values(const std::string& text) {
  std::vector<std::string> values(1);
  Nesting nesting;
  for (const char c : text) {
    nesting.pass(c);
    if (c == ',' && nesting.is_outside()) {
      values.emplace_back();
    } else {
      values.back().push_back(c);
    }
  }
  for (std::string& value : values) {
    value = trimmed(value);
  }
  return values;
}

/// Two numbers may be one value in two spellings: 15 and 15.0.
std::string spelled_alike(const std::string& value) {
  double number = 0.0;
  const auto [end, failed] = std::from_chars(value.data(), value.data() + value.size(), number);
  const bool is_number = failed == std::errc{} && end == value.data() + value.size();
  return is_number ? number_text(number) : value;
}

/// Each point once with each of the axis's values.
std::vector<SweepPoint> along(const SweepAxis& axis, const std::vector<SweepPoint>& points) {
  std::vector<SweepPoint> longer;
  for (const SweepPoint& point : points) {
    for (const std::string& value : axis.values) {
      longer.push_back(point);
      longer.back().values.push_back(value);
    }
  }
  return longer;
}

/// The flights of one point, and what they have in common.
SweepCell cell_of(const Sweep& sweep,
                  const SweepPoint& point,
                  const std::string& command,
                  const std::vector<const Summary*>& flights) {
  SweepCell cell;
  cell.point = point;
  cell.command = command;
  cell.n = static_cast<int>(flights.size());
  std::map<std::string, std::vector<double>> values;
  for (const Summary* flight : flights) {
    if (!has_succeeded(*flight)) {
      const bool has_reason = flight->failure != MissionFailure::none;
      ++cell.failures[std::string{has_reason ? to_string(flight->failure)
                                             : to_string(flight->status)}];
      continue;
    }
    ++cell.succeeded;
    for (const auto& [name, value] : figures_of(*flight)) {
      values[name].push_back(value);
    }
  }
  for (const std::string& name : sweep.figures) {
    cell.figures.push_back(bootstrap_median(values[name]));
  }
  return cell;
}

}  // namespace

Result<SweepAxis> read_axis(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string key = equals == std::string::npos ? "" : key_of(text);
  if (key.empty()) {
    return wrong(text, "names no setting");
  }
  SweepAxis axis{key, split_values(text.substr(equals + 1))};
  std::set<std::string> seen;
  for (const std::string& value : axis.values) {
    if (value.empty()) {
      return wrong(text, "has an empty value");
    }
    if (!seen.insert(spelled_alike(value)).second) {
      return wrong(text, "has the value " + value + " twice");
    }
  }
  return axis;
}

std::string SweepPoint::settings(const std::vector<SweepAxis>& axes) const {
  std::string text;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    text += (text.empty() ? "" : " ") + axes[i].key + "=" + values[i];
  }
  return text;
}

std::vector<SweepPoint> points_of(const std::vector<SweepAxis>& axes,
                                  const std::vector<std::string>& policies) {
  std::vector<SweepPoint> points;
  for (const std::string& policy : policies) {
    std::vector<SweepPoint> of_policy{{policy, {}}};
    for (const SweepAxis& axis : axes) {
      of_policy = along(axis, of_policy);
    }
    points.insert(points.end(), of_policy.begin(), of_policy.end());
  }
  return points;
}

std::vector<std::string> troubles_of(const Sweep& sweep) {
  std::vector<std::string> sentences;
  for (const std::string& policy : sweep.plan.policies) {
    PolicyTrouble trouble;
    for (const SweepFlight& flight : sweep.flights) {
      if (sweep.cells[flight.point].point.policy == policy) {
        trouble.add(flight.summary);
      }
    }
    if (std::string sentence = trouble.text(policy); !sentence.empty()) {
      sentences.push_back(std::move(sentence));
    }
  }
  return sentences;
}

Sweep sweep_of(const SweepPlan& plan,
               const std::vector<std::string>& commands,
               std::vector<SweepFlight> flights) {
  Sweep sweep;
  sweep.plan = plan;
  sweep.flights = std::move(flights);
  const std::vector<SweepPoint> points = points_of(plan.axes, plan.policies);
  std::vector<const Summary*> all;
  std::vector<std::vector<const Summary*>> by_point(points.size());
  for (const SweepFlight& flight : sweep.flights) {
    all.push_back(&flight.summary);
    by_point[flight.point].push_back(&flight.summary);
  }
  sweep.figures = figure_names(all);
  for (std::size_t i = 0; i < points.size(); ++i) {
    sweep.cells.push_back(cell_of(sweep, points[i], commands[i], by_point[i]));
  }
  return sweep;
}

}  // namespace flyball
