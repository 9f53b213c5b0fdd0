// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/decision.h"

namespace flyball {

std::string_view to_string(Reason reason) {
  switch (reason) {
    case Reason::fixed:
      return "fixed";
    case Reason::density:
      return "density";
    case Reason::deadline:
      return "deadline";
    case Reason::energy:
      return "energy";
    case Reason::load:
      return "load";
    case Reason::fallback:
      return "fallback";
  }
  return "unknown";
}

}  // namespace flyball
