// SPDX-License-Identifier: BSD-3-Clause
// tested-in: governor_bad_input
//
// The functions of governor.h: what C can do wrong ends here, and no exception gets out.

#include "flyball/governors/governor.h"

#include "embedded_governor.h"
#include "sized_structure.h"
#include <cstddef>
#include <exception>

namespace {

template <class Body>
std::int32_t guarded(FlyballGovernor* governor, Body body) noexcept {
  if (governor == nullptr) {
    return flyball_governor_invalid_input;
  }
  try {
    return body();
  } catch (const std::exception& error) {
    return governor->error().set(flyball_governor_failed, "%s", error.what());
  } catch (...) {
    return governor->error().set(flyball_governor_failed, "something threw no std::exception");
  }
}

/// What a structure must be for the library to look into it.
struct Structure {
  const char* name;
  std::size_t least;  ///< Size of its first version.
};

template <class T>
std::int32_t check(FlyballGovernor& governor, const T* given, const Structure& structure) {
  if (given == nullptr) {
    return governor.error().set(flyball_governor_invalid_input, "the %s is NULL", structure.name);
  }
  if (const std::uint32_t size = flyball::size_of_given(given); size < structure.least) {
    return governor.error().set(flyball_governor_invalid_input,
                                "the %s has a struct_size of %u; set it to sizeof(%s)",
                                structure.name, size, structure.name);
  }
  return flyball_governor_ok;
}

}  // namespace

FlyballGovernor* flyball_governor_create(void) {
  try {
    return new FlyballGovernor{};
  } catch (...) {
    return nullptr;
  }
}

int32_t flyball_governor_add_knob(FlyballGovernor* governor, const FlyballGovernorKnob* knob) {
  return guarded(governor, [&] {
    const auto code =
        check(*governor, knob, {"FlyballGovernorKnob", offsetof(FlyballGovernorKnob, min_dwell_s)});
    return code != flyball_governor_ok ? code : governor->add_knob(flyball::read_sized(knob));
  });
}

int32_t flyball_governor_add_stage(FlyballGovernor* governor, const FlyballGovernorStage* stage) {
  return guarded(governor, [&] {
    const auto code = check(*governor, stage,
                            {"FlyballGovernorStage", offsetof(FlyballGovernorStage, deadline_s)});
    return code != flyball_governor_ok ? code : governor->add_stage(flyball::read_sized(stage));
  });
}

int32_t flyball_governor_open(FlyballGovernor* governor, const FlyballGovernorSettings* settings) {
  return guarded(governor, [&] {
    const auto code = check(*governor, settings,
                            {"FlyballGovernorSettings", offsetof(FlyballGovernorSettings, seed)});
    return code != flyball_governor_ok ? code : governor->open(flyball::read_sized(settings));
  });
}

int32_t flyball_governor_begin(FlyballGovernor* governor, uint32_t stage, double now_s) {
  return guarded(governor, [&] { return governor->begin(stage, now_s); });
}

int32_t flyball_governor_end(
    FlyballGovernor* governor, uint32_t stage, double now_s, const double* counts, uint32_t count) {
  return guarded(governor, [&] {
    return counts == nullptr && count != 0
               ? governor->error().set(flyball_governor_invalid_input,
                                       "%u counts, but they are NULL", count)
               : governor->end(stage, now_s, counts, count);
  });
}

int32_t flyball_governor_observe(FlyballGovernor* governor, const char* signal, double value) {
  return guarded(governor, [&] { return governor->observe(signal, value); });
}

int32_t flyball_governor_decide(FlyballGovernor* governor,
                                double now_s,
                                FlyballGovernorDecision* decision) {
  return guarded(governor, [&] {
    if (decision != nullptr) {
      if (const auto code =
              check(*governor, decision,
                    {"FlyballGovernorDecision", offsetof(FlyballGovernorDecision, decided)})) {
        return code;
      }
    }
    const std::int32_t code = governor->decide(now_s);
    const bool has_decided = code == flyball_governor_ok || code == flyball_governor_failed;
    if (decision != nullptr && has_decided) {
      flyball::write_sized(decision, governor->answer());
    }
    return code;
  });
}

int32_t flyball_governor_granted(FlyballGovernor* governor, const char* knob, double value) {
  return guarded(governor, [&] { return governor->granted(knob, value); });
}

int32_t flyball_governor_list(FlyballGovernor* governor,
                              uint32_t number,
                              FlyballGovernorEntry* entry) {
  return guarded(governor, [&] {
    if (const auto code = check(
            *governor, entry, {"FlyballGovernorEntry", offsetof(FlyballGovernorEntry, is_known)})) {
      return code;
    }
    FlyballGovernorEntry found{};
    const std::int32_t code = governor->list(number, found);
    if (code == flyball_governor_ok) {
      flyball::write_sized(entry, found);
    }
    return code;
  });
}

const char* flyball_governor_last_error(const FlyballGovernor* governor) {
  return governor != nullptr ? governor->error().text() : "the governor is NULL";
}

void flyball_governor_close(FlyballGovernor* governor) {
  if (governor != nullptr && !governor->is_calling_back()) {
    delete governor;
  }
}
