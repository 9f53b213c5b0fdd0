// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/soft_errors.h"

#include "flyball/runtime/random.h"
#include "flyball/runtime/text/listed.h"

#include "scenario/computer_strain.h"
#include <cmath>
#include <cstdio>
#include <cstring>
#include <type_traits>

namespace flyball {
namespace {

// No world reaches farther from its origin.
constexpr double readable_m = 10e3;

Plausibility::Use use_of(const std::string& detector) {
  return {detector == "range" || detector == "both", detector == "rate" || detector == "both"};
}

/// Counts the numbers of a name and, if it is told to, flips one bit of one of them.
class BitFlip final : public NumberVisitor {
 public:
  static constexpr std::uint64_t none = ~std::uint64_t{};
  explicit BitFlip(std::string variable, std::uint64_t target = none, std::uint64_t random = 0)
      : variable_{std::move(variable)}, target_{target}, random_{random} {}

  void visit(std::string_view name, Quantity /*quantity*/, double& number) override {
    meet<std::uint64_t>(name, number);
  }
  void visit(std::string_view name, Quantity /*quantity*/, float& number) override {
    meet<std::uint32_t>(name, number);
  }
  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] bool is_readable() const { return std::abs(after_) <= readable_m; }
  [[nodiscard]] std::string told() const {
    char text[128];
    std::snprintf(text, sizeof text, "bit %d of %s: %.9g became %.9g", bit_, name_.c_str(), before_,
                  after_);
    return text;
  }

 private:
  template <class Bits, class Number>
  void meet(std::string_view name, Number& number) {
    if (variable_ != "any" && variable_ != name) {
      return;
    }
    if (count_++ != target_) {
      return;
    }
    Bits bits{};
    static_assert(sizeof bits == sizeof number);
    std::memcpy(&bits, &number, sizeof bits);
    bit_ = static_cast<int>(random_ % (8 * sizeof bits));
    bits ^= Bits{1} << static_cast<unsigned>(bit_);
    before_ = static_cast<double>(number);
    std::memcpy(&number, &bits, sizeof bits);
    after_ = static_cast<double>(number);
    name_ = std::string{name};
  }

  std::string variable_;
  std::uint64_t target_;
  std::uint64_t random_;
  std::uint64_t count_{};
  int bit_{};
  double before_{};
  double after_{};
  std::string name_{};
};

}  // namespace

SoftErrors::SoftErrors(MissionLink& link,
                       const Scenario& scenario,
                       const Graph& graph,
                       Executor& executor,
                       const EventQueue& queue)
    : link_{link},
      scenario_{scenario},
      graph_{graph},
      executor_{executor},
      queue_{queue},
      plausibility_{link.brief(), use_of(scenario.faults.detector)} {
  for (std::size_t i = 0; i < scenario.events.size(); ++i) {
    if (scenario.events[i].kind != "bit_flip") {
      continue;
    }
    Flip& flip = flips_.emplace_back();
    flip.event = i;
    for (std::size_t topic = 0; topic < graph.topics().size(); ++topic) {
      if (graph.topics()[topic].name == scenario.events[i].topic) {
        flip.topic = static_cast<int>(topic);
      }
    }
  }
}

Status SoftErrors::check() const {
  const auto can_be_hit = [](const TopicSpec& topic) {
    return topic.with_numbers != nullptr ? topic.name : std::string{};
  };
  for (const Flip& flip : flips_) {
    if (flip.topic < 0 ||
        graph_.topics()[static_cast<std::size_t>(flip.topic)].with_numbers == nullptr) {
      return Error{ErrorCode::invalid_input,
                   "events." + std::to_string(flip.event + 1) + ".topic = \"" +
                       scenario_.events[flip.event].topic +
                       "\" is no topic of this mission whose messages can be hit; there are: " +
                       listed(graph_.topics(), can_be_hit)};
    }
  }
  return Done{};
}

void SoftErrors::start() {
  if (is_used()) {
    executor_.filter_messages(
        [this](int topic, const Message& message) { return pass(topic, message); });
  }
}

Message SoftErrors::pass(int topic, const Message& message) {
  const TopicSpec& spec = graph_.topics()[static_cast<std::size_t>(topic)];
  Message passed = message;
  for (Flip& flip : flips_) {
    const bool is_due = flip.topic == topic && !flip.is_done &&
                        is_active(scenario_.events[flip.event], queue_.now());
    if (is_due && passed) {
      passed = flipped(flip, spec, passed);
    }
  }
  // Nobody follows set-points before and after, and take-off moves the reference at once.
  if (!passed || link_.phase() != MissionPhase::cruise) {
    return passed;
  }
  if (const std::string why = plausibility_.refused(spec, passed.get(), queue_.now());
      !why.empty()) {
    ++refused_;
    link_.event("refused a message of " + spec.name + ": " + why);
    return nullptr;
  }
  return passed;
}

Message SoftErrors::flipped(Flip& flip, const TopicSpec& topic, const Message& message) {
  const ComputerEvent& event = scenario_.events[flip.event];
  BitFlip counted{event.variable};
  (void)topic.with_numbers(message.get(), counted);
  if (counted.count() == 0) {
    return message;  // An empty path; the next message is hit.
  }
  flip.is_done = true;
  RandomStream random{scenario_.seed, "bit_flip",
                      static_cast<std::uint64_t>(event.draw) * 101 + flip.event};
  const std::uint64_t target = random.next() % counted.count();
  BitFlip hit{event.variable, target, random.next()};
  Message changed = topic.with_numbers(message.get(), hit);
  ++flipped_;
  const bool is_lost = !hit.is_readable();
  lost_ += is_lost ? 1 : 0;
  link_.event("bit_flip in " + topic.name + ", " + hit.told() +
              (is_lost ? "; its reader does not survive that" : ""));
  return is_lost ? nullptr : changed;
}

}  // namespace flyball
