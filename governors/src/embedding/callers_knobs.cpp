// SPDX-License-Identifier: BSD-3-Clause
// tested-in: governor_knobs
#include "callers_knobs.h"

#include <cmath>
#include <cstring>
#include <string>
#include <utility>

namespace flyball {
namespace {

Error wrong(const std::string& what) {
  return {ErrorCode::invalid_input, what};
}

/// @pre The texts are there.
KnobSpec spec_of(const FlyballGovernorKnob& given) {
  KnobSpec spec;
  spec.name = given.name;
  spec.unit = given.unit;
  spec.owner = "caller";
  spec.description = given.description;
  spec.fallback = given.start;
  spec.min = given.min;
  spec.max = given.max;
  if (given.legal_count > 0) {
    spec.legal.assign(given.legal, given.legal + given.legal_count);
    spec.min = spec.legal.front();
    spec.max = spec.legal.back();
  }
  if (given.min_dwell_s > 0.0) {
    spec.min_dwell = from_seconds(given.min_dwell_s);
  }
  spec.follows = given.follows != nullptr ? given.follows : "";
  return spec;
}

}  // namespace

const char* to_string(KnobMode mode) {
  switch (mode) {
    case KnobMode::governing:
      return "governing";
    case KnobMode::dry_run:
      return "dry_run";
    case KnobMode::shadow:
      return "shadow";
  }
  return "governing";
}

Status check_name(const char* what, const char* name) {
  if (name == nullptr || *name == '\0') {
    return wrong(std::string{what} + " needs a name");
  }
  if (std::strlen(name) > flyball_governor_name_bytes) {
    return wrong(std::string{what} + "'s name has more than " +
                 std::to_string(flyball_governor_name_bytes) + " bytes: " + name);
  }
  for (const char* letter = name; *letter != '\0'; ++letter) {
    if (const auto byte = static_cast<unsigned char>(*letter); byte <= 0x20 || byte == 0x7f) {
      return wrong(std::string{what} + "'s name has a space or a control character: " + name);
    }
  }
  return Done{};
}

Status CallersKnobs::add(const FlyballGovernorKnob& given) {
  if (Status named = check_name("a knob", given.name); !named) {
    return named;
  }
  const std::string knob = "knob \"" + std::string{given.name} + "\" ";
  if (given.unit == nullptr || given.description == nullptr) {
    return wrong(knob + "needs a unit (\"1\" where there is none) and a description");
  }
  if (given.legal_count > 0 && given.legal == nullptr) {
    return wrong(knob + "has " + std::to_string(given.legal_count) +
                 " legal values, but legal is NULL");
  }
  if (!std::isfinite(given.min_dwell_s) || given.min_dwell_s < 0.0) {
    return wrong(knob + "needs a min_dwell_s that is finite and not negative");
  }
  if (index(given.name)) {
    return wrong(knob + "was added already");
  }
  if (given.follows != nullptr && !index(given.follows)) {
    return wrong(knob + "follows \"" + given.follows + "\", which was not added before it");
  }
  if (given.follows != nullptr && !knobs_[*index(given.follows)].spec.follows.empty()) {
    return wrong(knob + "follows \"" + given.follows + "\", which follows \"" +
                 knobs_[*index(given.follows)].spec.follows + "\" itself; follow that one");
  }
  if (knobs_.size() == flyball_governor_capacity) {
    return wrong(knob + "is one too many: a governor has at most " +
                 std::to_string(flyball_governor_capacity));
  }
  KnobSpec spec = spec_of(given);
  if (Status sound = check_declaration(spec); !sound) {
    return sound;
  }
  knobs_.push_back(
      {std::move(spec), given.apply, given.context, given.start, given.start, given.start});
  return Done{};
}

std::optional<std::size_t> CallersKnobs::index(std::string_view name) const {
  for (std::size_t i = 0; i < knobs_.size(); ++i) {
    if (knobs_[i].spec.name == name) {
      return i;
    }
  }
  return std::nullopt;
}

KnobSettings CallersKnobs::settings() const {
  std::vector<KnobSpec> specs;
  for (const Knob& knob : knobs_) {
    specs.push_back(knob.spec);
  }
  return KnobSettings{std::move(specs)};
}

void CallersKnobs::grant(std::size_t knob, double value) {
  if (mode_ != KnobMode::dry_run) {
    knobs_[knob].in_force = value;
  }
}

const CallersKnobs::Knob* CallersKnobs::put_in_force(const Decision& decision) noexcept {
  for (const auto& [name, value] : decision) {
    if (const auto knob = index(name)) {
      knobs_[*knob].decided = value;
    }
  }
  const Knob* failed = nullptr;
  for (Knob& knob : knobs_) {
    const bool is_due = mode_ == KnobMode::governing && knob.decided != knob.asked;
    if (is_due && !apply(knob) && failed == nullptr) {
      failed = &knob;
    }
  }
  return failed;
}

bool CallersKnobs::apply(Knob& knob) noexcept {
  const double before = knob.in_force;
  knob.in_force = knob.decided;  // Before the call, which may say that something else was granted.
  if (knob.apply != nullptr) {
    try {
      if (knob.apply(knob.context, knob.decided) != 0) {
        knob.in_force = before;
        return false;
      }
    } catch (...) {  // A callback in C++ should not, but an embedder's mistake must not end it.
      knob.in_force = before;
      return false;
    }
  }
  knob.asked = knob.decided;
  return true;
}

}  // namespace flyball
