// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/plausibility.h"

#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

namespace flyball {
namespace {

// Chosen: beyond all that vehicles and worlds of these missions do, so that nothing true is
// refused.
constexpr double around_site_m = 10.0;
constexpr double most_m_s = 30.0;   // Twice the speed to which eq. 1 is valid, 15 m/s.
constexpr double most_m_s2 = 40.0;  // Twice what a thrust to weight ratio of 3 leaves, 20 m/s^2.
constexpr double most_rad = 2.0 * M_PI;
constexpr double most_rad_s = 6.0;
constexpr double most_path_m = 5000.0;
// What a sum of noise and corrections may add to a change.
constexpr double slack_m = 0.5;
constexpr double slack_m_s = 2.0;
constexpr double slack_rad = 0.2;

bool is_stream(const std::string& topic) {
  return topic == "setpoint" || topic == "pose";
}

/// The numbers of a message with what they are.
class Numbers final : public NumberVisitor {
 public:
  struct Number {
    std::string_view name;
    Quantity quantity;
    double value;
  };
  void visit(std::string_view name, Quantity quantity, double& number) override {
    all.push_back({name, quantity, number});
  }
  void visit(std::string_view name, Quantity quantity, float& number) override {
    all.push_back({name, quantity, static_cast<double>(number)});
  }
  std::vector<Number> all{};
};

/// The largest magnitude.
double most_of(Quantity quantity, const Brief& brief) {
  switch (quantity) {
    case Quantity::position:
      return brief.site.bounds_W.max.cwiseAbs()
                 .cwiseMax(brief.site.bounds_W.min.cwiseAbs())
                 .maxCoeff() +
             around_site_m;
    case Quantity::reach:
      return brief.settings.camera.max_range_m + around_site_m;
    case Quantity::distance:
      return most_path_m;
    case Quantity::velocity:
      return most_m_s;
    case Quantity::acceleration:
      return most_m_s2;
    case Quantity::angle:
      return most_rad;
    case Quantity::rate:
      return most_rad_s;
    case Quantity::other:
      break;
  }
  return std::numeric_limits<double>::max();
}

/// The largest change in `dt_s`; infinite for what may jump.
double most_change(Quantity quantity, double dt_s) {
  switch (quantity) {
    case Quantity::position:
      return most_m_s * dt_s + slack_m;
    case Quantity::velocity:
      return most_m_s2 * dt_s + slack_m_s;
    case Quantity::angle:
      return most_rad_s * dt_s + slack_rad;
    default:
      return std::numeric_limits<double>::infinity();
  }
}

double change(Quantity quantity, double before, double now) {
  return std::abs(quantity == Quantity::angle ? wrap_angle(now - before) : now - before);
}

std::string described(const Numbers::Number& number, const char* what) {
  char text[96];
  std::snprintf(text, sizeof text, "%s %.6g is out of its %s", std::string{number.name}.c_str(),
                number.value, what);
  return text;
}

}  // namespace

std::string Plausibility::refused(const TopicSpec& topic, const void* message, MissionTime now) {
  if (topic.with_numbers == nullptr || !(use_.range || use_.rate)) {
    return {};
  }
  Numbers numbers;
  (void)topic.with_numbers(message, numbers);
  std::string why;
  for (const auto& number : numbers.all) {
    if (use_.range && why.empty() &&
        !(std::abs(number.value) <= most_of(number.quantity, brief_))) {
      why = described(number, "range");
    }
  }
  if (!is_stream(topic.name)) {
    return why;
  }
  Stream& stream = streams_[topic.name];
  const double dt_s = to_seconds(now - stream.at);
  for (std::size_t i = 0; use_.rate && i < stream.numbers.size() && i < numbers.all.size(); ++i) {
    const auto& number = numbers.all[i];
    const double changed = change(number.quantity, stream.numbers[i], number.value);
    if (why.empty() && !(changed <= most_change(number.quantity, dt_s))) {
      why = described(number, "rate");
    }
  }
  if (!why.empty() && ++stream.refused_in_row <= most_in_row) {
    return why;
  }
  stream = {now, {}, 0};
  for (const auto& number : numbers.all) {
    stream.numbers.push_back(number.value);
  }
  return {};
}

}  // namespace flyball
