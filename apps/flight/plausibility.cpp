// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/plausibility.h"

#include <array>
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

std::string described(std::string_view name, double value, const char* what) {
  char text[96];
  std::snprintf(text, sizeof text, "%s %.6g is out of its %s", std::string{name}.c_str(), value,
                what);
  return text;
}

/// Looks at each number once and keeps those of streams only: a cloud has a hundred thousand.
class Judge final : public NumberVisitor {
 public:
  /// Judges ranges.
  void limit(const Brief& brief) {
    for (std::size_t i = 0; i < most_.size(); ++i) {
      most_[i] = most_of(static_cast<Quantity>(i), brief);
    }
    judges_range_ = true;
  }
  /// Judges changes against these numbers.
  void compare(const std::vector<double>& before, double dt_s) {
    before_ = &before;
    dt_s_ = dt_s;
  }
  /// `numbers` will hold all of the message.
  void keep() { keeps_ = true; }

  void visit(std::string_view name, Quantity quantity, double& number) override {
    see(name, quantity, number);
  }
  void visit(std::string_view name, Quantity quantity, float& number) override {
    see(name, quantity, static_cast<double>(number));
  }

  [[nodiscard]] const std::string& why() const {
    return out_of_range_.empty() ? out_of_rate_ : out_of_range_;
  }
  std::vector<double> numbers{};

 private:
  void see(std::string_view name, Quantity quantity, double value) {
    const bool is_in_range = std::abs(value) <= most_[static_cast<std::size_t>(quantity)];
    if (!is_in_range || keeps_) {
      consider(name, quantity, value, is_in_range);
    }
  }
  /// Out of line, so that the numbers of a cloud pass by quickly.
  [[gnu::noinline]] void consider(std::string_view name,
                                  Quantity quantity,
                                  double value,
                                  bool is_in_range) {
    if (!is_in_range && judges_range_ && out_of_range_.empty()) {
      out_of_range_ = described(name, value, "range");
    }
    if (!keeps_) {
      return;
    }
    const std::size_t i = numbers.size();
    if (before_ != nullptr && i < before_->size() && out_of_rate_.empty() &&
        !(change(quantity, (*before_)[i], value) <= most_change(quantity, dt_s_))) {
      out_of_rate_ = described(name, value, "rate");
    }
    numbers.push_back(value);
  }

  std::array<double, static_cast<std::size_t>(Quantity::other) + 1> most_{};
  bool judges_range_{};
  const std::vector<double>* before_{};  ///< Owner: the stream.
  double dt_s_{};
  bool keeps_{};
  std::string out_of_range_{};
  std::string out_of_rate_{};
};

}  // namespace

std::string Plausibility::refused(const TopicSpec& topic, const void* message, MissionTime now) {
  const bool judges = use_.range || (use_.rate && is_stream(topic.name));
  if (topic.with_numbers == nullptr || !judges) {
    return {};
  }
  Judge judge;
  if (use_.range) {
    judge.limit(brief_);
  }
  if (!is_stream(topic.name)) {
    (void)topic.with_numbers(message, judge);
    return judge.why();
  }
  Stream& stream = streams_[topic.name];
  if (use_.rate) {
    judge.compare(stream.numbers, to_seconds(now - stream.at));
  }
  judge.keep();
  (void)topic.with_numbers(message, judge);
  if (!judge.why().empty() && ++stream.refused_in_row <= most_in_row) {
    return judge.why();
  }
  stream = {now, std::move(judge.numbers), 0};
  return {};
}

}  // namespace flyball
