// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A policy in a shared library, written in C++: a class, and one line that exports it.
///
///     class Mine final : public flyball::PluginPolicy { ... };
///     const FlyballPolicy* flyball_policy() { return flyball::PluginEntry<Mine>::policy(); }
///
/// Header-only on top of plugin_abi.h, so that the library links nothing of Flyball. `Mine` has
/// `static flyball::PluginDescription description()` and a constructor that takes `(const
/// flyball::PluginHost&, const flyball::PluginStart&)` and throws what it has to refuse.

#include "flyball/governors/plugin_abi.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace flyball {

/// Reads what lies within the writer's size and takes zero for the rest.
template <class Struct>
[[nodiscard]] Struct readable_copy(const Struct* given) {
  Struct copy{};
  std::uint32_t written = 0;
  std::memcpy(&written, given, sizeof written);
  std::memcpy(&copy, given, std::min<std::size_t>(written, sizeof copy));
  return copy;
}

struct PluginParameter {
  std::string name;
  double fallback{};
  double min{};
  double max{};
  std::string description;
  bool required{};
};

struct PluginDescription {
  std::string name;
  std::string description;
  std::vector<PluginParameter> parameters{};
};

/// Time, random numbers and a log, from the host.
class PluginHost {
 public:
  explicit PluginHost(const FlyballHost* host) : host_{readable_copy(host)} {}
  [[nodiscard]] std::int64_t now_ns() const { return host_.now_ns(host_.context); }
  [[nodiscard]] std::uint64_t random() const { return host_.random(host_.context); }
  /// In [0, 1).
  [[nodiscard]] double uniform() const { return static_cast<double>(random() >> 11U) * 0x1.0p-53; }
  void log(const std::string& line) const { host_.log(host_.context, line.c_str()); }

 private:
  FlyballHost host_;
};

/// A knob's place among the host's knobs.
struct PluginKnob {
  std::uint32_t index{};
  FlyballKnob spec{};  ///< Valid during the constructor only.
};

/// The computer that the policy flies on; what is 0 or empty is not known.
struct PluginBoard {
  FlyballBoard numbers{};              ///< Its pointers are valid during the constructor only.
  std::vector<FlyballClock> clocks{};  ///< Ascending.
  std::vector<FlyballTrip> trips{};    ///< Ascending.
};

/// Parameters, knobs and the computer, in the constructor.
class PluginStart {
 public:
  PluginStart(const FlyballStart* start, const PluginDescription& described)
      : start_{readable_copy(start)}, described_{described} {}

  /// @throws std::invalid_argument when nothing has this name.
  [[nodiscard]] double parameter(const std::string& name) const {
    for (std::size_t i = 0; i < described_.parameters.size(); ++i) {
      if (described_.parameters[i].name == name && i < start_.parameter_count) {
        return start_.parameters[i];
      }
    }
    throw std::invalid_argument{"there is no parameter " + name};
  }
  [[nodiscard]] std::optional<PluginKnob> find_knob(const std::string& name) const {
    for (std::uint32_t i = 0; i < start_.knob_count; ++i) {
      if (start_.knobs[i]->name == name) {
        return PluginKnob{i, readable_copy(start_.knobs[i])};
      }
    }
    return std::nullopt;
  }
  /// @throws std::invalid_argument when nothing has this name.
  [[nodiscard]] PluginKnob knob(const std::string& name) const {
    if (const auto found = find_knob(name)) {
      return *found;
    }
    throw std::invalid_argument{"there is no knob " + name};
  }

  /// All unknown where an older host does not tell.
  [[nodiscard]] PluginBoard board() const {
    PluginBoard board;
    if (start_.board == nullptr) {
      return board;
    }
    board.numbers = readable_copy(start_.board);
    for (std::uint32_t i = 0; i < board.numbers.clock_count; ++i) {
      board.clocks.push_back(readable_copy(board.numbers.clocks[i]));
    }
    for (std::uint32_t i = 0; i < board.numbers.trip_count; ++i) {
      board.trips.push_back(readable_copy(board.numbers.trips[i]));
    }
    return board;
  }

 private:
  FlyballStart start_;
  const PluginDescription& described_;
};

/// What a decision sets.
class PluginWishes {
 public:
  explicit PluginWishes(FlyballDecision* decision) : decision_{decision} {}
  void because(std::uint32_t reason) { decision_->reason = reason; }
  void set(const PluginKnob& knob, double value) {
    if (decision_->wish_count < flyball_wish_capacity) {
      decision_->wishes[decision_->wish_count] = {knob.index, 0, value};
    }
    ++decision_->wish_count;
  }

 private:
  FlyballDecision* decision_;
};

class PluginPolicy {
 public:
  PluginPolicy() = default;
  PluginPolicy(const PluginPolicy&) = delete;
  PluginPolicy& operator=(const PluginPolicy&) = delete;
  virtual ~PluginPolicy() = default;

  virtual void decide(const FlyballObservation& seen, PluginWishes& wishes) = 0;
  /// How often it wants to be asked; 0: as often as the scenario says.
  [[nodiscard]] virtual double period_s() const { return 0.0; }
};

/// `Mine` as the C structure that the host reads. No exception leaves it.
template <class Mine>
class PluginEntry {
 public:
  [[nodiscard]] static const FlyballPolicy* policy() {
    static const PluginEntry entry;
    return &entry.policy_;
  }

 private:
  PluginEntry() {
    for (const PluginParameter& one : described_.parameters) {
      parameters_.push_back({sizeof(FlyballParameter), one.required ? 1U : 0U, one.name.c_str(),
                             one.description.c_str(), one.fallback, one.min, one.max});
    }
    for (const FlyballParameter& one : parameters_) {
      pointers_.push_back(&one);
    }
    policy_ = {sizeof(FlyballPolicy),
               flyball_abi_version,
               described_.name.c_str(),
               described_.description.c_str(),
               pointers_.data(),
               static_cast<std::uint32_t>(pointers_.size()),
               0,
               create,
               destroy,
               decide,
               period_s};
  }

  struct Made {
    Made(const FlyballHost* given, const FlyballStart* start)
        : host{given}, mine{host, PluginStart{start, described()}} {}
    PluginHost host;
    Mine mine;
  };

  static const PluginDescription& described() {
    static const PluginDescription description = Mine::description();
    return description;
  }
  static void* create(const FlyballHost* host, const FlyballStart* start) {
    std::string why = "an exception of no known type";
    try {
      return new Made{host, start};
    } catch (const std::exception& error) {
      why = error.what();
    } catch (...) {  // NOLINT(bugprone-empty-catch): `why` says it
    }
    const std::size_t room = start->refusal_size;
    if (room > 0) {
      const std::size_t length = std::min(why.size(), room - 1);
      std::memcpy(start->refusal, why.data(), length);
      start->refusal[length] = '\0';
    }
    return nullptr;
  }
  static void destroy(void* made) { delete static_cast<Made*>(made); }
  static std::int32_t decide(void* made,
                             const FlyballObservation* seen,
                             FlyballDecision* decision) {
    auto* const self = static_cast<Made*>(made);
    try {
      PluginWishes wishes{decision};
      self->mine.decide(readable_copy(seen), wishes);
      return 0;
    } catch (const std::exception& error) {
      self->host.log(std::string{"threw: "} + error.what());
    } catch (...) {
      self->host.log("threw an exception of no known type");
    }
    return 1;
  }
  static double period_s(void* made) {
    auto* const self = static_cast<Made*>(made);
    try {
      return self->mine.period_s();
    } catch (...) {
      self->host.log("period_s threw an exception; the scenario's period is taken");
    }
    return 0.0;
  }

  const PluginDescription& described_{described()};
  std::vector<FlyballParameter> parameters_{};
  std::vector<const FlyballParameter*> pointers_{};
  FlyballPolicy policy_{};
};

}  // namespace flyball
