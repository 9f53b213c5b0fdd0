// SPDX-License-Identifier: BSD-3-Clause
// tested-in: governor_decisions
#include "decision_line.h"

#include "flyball/runtime/observation_fields.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdio>

namespace flyball {
namespace {

class Line {
 public:
  explicit Line(std::array<char, 8192>& text) : text_{text} { text_[0] = '\0'; }

  void add(const char* name, const char* value) { grow("%s=%s ", name, value); }
  void add(const char* name, double value) { grow("%s=%s ", name, number(value).data()); }
  void add_in_force(const char* name, double value) {
    grow("%s.in_force=%s ", name, number(value).data());
  }
  void add_quoted(const char* name, const char* value) { grow("%s=\"%s\" ", name, value); }
  void end() {
    if (size_ > 0) {
      text_[size_ - 1] = '\0';
    }
  }

 private:
  /// As `%.17g`, but with a point whatever the host's locale.
  static std::array<char, 32> number(double value) {
    std::array<char, 32> text{};
    std::to_chars(text.begin(), text.end() - 1, value, std::chars_format::general, 17);
    return text;
  }

  template <class... Values>
  void grow(const char* format, Values... values) {
    const std::size_t left = text_.size() - size_;
    const int wanted = std::snprintf(text_.data() + size_, left, format, values...);
    size_ += std::min(static_cast<std::size_t>(std::max(wanted, 0)), left - 1);
  }

  std::array<char, 8192>& text_;
  std::size_t size_{};
};

}  // namespace

void write_decision_line(std::array<char, 8192>& line,
                         const FlyballGovernorDecision& answer,
                         const CallersKnobs& knobs,
                         const Observation& seen) noexcept {
  Line words{line};
  words.add("t_s", to_seconds(seen.now));
  words.add("mode", to_string(knobs.mode()));
  words.add("reason", answer.reason);
  words.add("fallback", answer.fallback);
  for (const CallersKnobs::Knob& knob : knobs.all()) {
    words.add(knob.spec.name.c_str(), knob.decided);
    if (knob.in_force != knob.decided) {
      words.add_in_force(knob.spec.name.c_str(), knob.in_force);
    }
  }
  for (const ObservationField& field : observation_fields()) {
    if (const double value = field.get(seen); value != 0.0) {
      words.add(field.name, value);
    }
  }
  if (*answer.why != '\0') {
    words.add_quoted("why", answer.why);
  }
  words.end();
}

}  // namespace flyball
