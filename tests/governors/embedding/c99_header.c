/* SPDX-License-Identifier: BSD-3-Clause */
/* The header alone, as -std=c99 -pedantic -Werror reads it. */

#include "flyball/governors/governor.h"
#include "flyball/governors/plugin_abi.h" /* Both in one file: no name stands in both. */

int main(void) {
  FlyballGovernorDecision decision = {.struct_size = sizeof decision};
  return decision.knob_count == flyball_governor_ok ? 0 : 1;
}
