-- SPDX-License-Identifier: BSD-3-Clause
--
-- Turns the knobs that exchange kernels and leave out frames to and fro, each second: first to the
-- other end of their range, then back. switched_kernels_test.cpp.

description = "Other kernels and fewer frames, every other second"

local per_second = 4 -- Decisions, at the usual period.
local turned = { -- Each to the end of its range that is not where it begins.
  ["planner.kind"] = "max",
  ["detector.kind"] = "max",
  ["camera.rate_hz"] = "min",
  ["localizer.rate_hz"] = "min",
}
local other = {min = "max", max = "min"}
local there
local decisions = 0

function start(given, knobs)
  there = knobs
end

function decide(seen)
  local is_turned = math.floor(decisions / per_second) % 2 == 0
  decisions = decisions + 1
  local wishes = {}
  for name, far in pairs(turned) do
    local knob = there[name]
    if knob then
      wishes[name] = knob[is_turned and far or other[far]]
    end
  end
  return wishes, "fixed"
end
