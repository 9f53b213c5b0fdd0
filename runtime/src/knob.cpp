// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/knob.h"

#include "flyball/runtime/text/listed.h"
#include "flyball/runtime/text/number_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <utility>

namespace flyball {

namespace {

std::string legal_values(const KnobSpec& spec) {
  if (spec.legal.empty()) {
    return short_number_text(spec.min) + " to " + short_number_text(spec.max);
  }
  return listed(spec.legal, [&spec, label = spec.labels.begin()](double value) mutable {
    return short_number_text(value) + (label != spec.labels.end() ? " (" + *label++ + ")" : "");
  });
}

bool has_sound_values(const KnobSpec& spec) {
  if (!std::isfinite(spec.min) || !std::isfinite(spec.max) || spec.min > spec.max) {
    return false;
  }
  const auto is_out = [&spec](double value) { return !(value >= spec.min && value <= spec.max); };
  return std::none_of(spec.legal.begin(), spec.legal.end(), is_out) &&
         std::adjacent_find(spec.legal.begin(), spec.legal.end(), std::greater_equal<>{}) ==
             spec.legal.end();
}

}  // namespace

Status check_declaration(const KnobSpec& spec) {
  const auto wrong = [&spec](const std::string& what) {
    return Error{ErrorCode::invalid_input, "knob \"" + spec.name + "\" " + what};
  };
  const std::size_t dot = spec.name.find('.');
  if (dot == std::string::npos || dot == 0 || dot + 1 == spec.name.size()) {
    return wrong("needs a name of two parts, as in map.range_m");
  }
  if (spec.unit.empty() || spec.owner.empty() || spec.description.empty()) {
    return wrong("needs a unit, an owner and a description");
  }
  if (!has_sound_values(spec)) {
    return wrong("needs finite limits, and legal values within them in ascending order");
  }
  if (!spec.is_legal(spec.fallback)) {
    return wrong("cannot be " + short_number_text(spec.fallback) + " " + spec.unit +
                 " at first; legal: " + legal_values(spec));
  }
  if (!spec.labels.empty() && spec.labels.size() != spec.legal.size()) {
    return wrong("has " + std::to_string(spec.labels.size()) + " labels for " +
                 std::to_string(spec.legal.size()) + " legal values");
  }
  if (spec.follows == spec.name) {
    return wrong("cannot follow itself");
  }
  return Done{};
}

double KnobSpec::nearest(double wish) const {
  FLYBALL_ASSERT(std::isfinite(wish), "knob %s, wish=%g", name.c_str(), wish);
  if (legal.empty()) {
    return std::clamp(wish, min, max);
  }
  // Far outside, the differences below all round to the same number.
  wish = std::clamp(wish, legal.front(), legal.back());
  double best = legal.front();
  for (const double value : legal) {
    if (std::abs(value - wish) < std::abs(best - wish)) {
      best = value;
    }
  }
  return best;
}

bool KnobSpec::is_legal(double value) const {
  if (legal.empty()) {
    return value >= min && value <= max;  // false for NaN
  }
  return std::find(legal.begin(), legal.end(), value) != legal.end();
}

KnobSettings::KnobSettings(std::vector<KnobSpec> specs) : specs_{std::move(specs)} {
  for (const KnobSpec& knob : specs_) {
    FLYBALL_ASSERT(spec(knob.name) == &knob, "two knobs \"%s\"", knob.name.c_str());
    FLYBALL_ASSERT(knob.is_legal(knob.fallback), "knob %s, default %g is not legal",
                   knob.name.c_str(), knob.fallback);
    values_.push_back(knob.fallback);
  }
}

const KnobSpec* KnobSettings::spec(std::string_view name) const {
  const auto found = std::find_if(specs_.begin(), specs_.end(),
                                  [name](const KnobSpec& knob) { return knob.name == name; });
  return found == specs_.end() ? nullptr : &*found;
}

double KnobSettings::value(std::string_view name) const {
  const KnobSpec* knob = spec(name);
  FLYBALL_ASSERT(knob != nullptr, "no knob \"%.*s\"", static_cast<int>(name.size()), name.data());
  return values_[static_cast<std::size_t>(knob - specs_.data())];
}

Status KnobSettings::set(std::string_view name, double value) {
  const KnobSpec* knob = spec(name);
  if (knob == nullptr) {
    return Error{ErrorCode::not_found,
                 "no knob \"" + std::string{name} + "\"; try: flyball list knobs"};
  }
  if (!knob->is_legal(value)) {
    return Error{ErrorCode::invalid_input, "knob " + knob->name + " cannot be " +
                                               short_number_text(value) + " " + knob->unit +
                                               "; legal: " + legal_values(*knob)};
  }
  values_[static_cast<std::size_t>(knob - specs_.data())] = value;
  return Done{};
}

}  // namespace flyball
