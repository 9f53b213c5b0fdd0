-- SPDX-License-Identifier: BSD-3-Clause
--
-- At each decision every knob is turned to a random legal value, one in four times to an end of its
-- range. Where a range spans decades, each decade is as likely as the next. The vehicle may lose
-- time, but its latency bound must stay one and it must not touch anything: random_knobs_test.cpp.

description = "Every knob at random, at each decision"

local all
local names = {}
-- A plan of a million samples takes the host half a minute, and the vehicle longer than the mission.
local most = {["planner.budget"] = 20000}

function start(given, knobs)
  all = knobs
  for name in pairs(knobs) do
    names[#names + 1] = name
  end
  table.sort(names)
end

local function random_value(name, knob)
  local dice = math.random(8)
  local max = math.min(knob.max, most[name] or knob.max)
  if dice == 1 then return knob.min end
  if dice == 2 then return max end
  if #knob.legal > 0 then return knob.legal[math.random(#knob.legal)] end
  if knob.min > 0 and max > 100 * knob.min then
    return knob.min * (max / knob.min) ^ math.random()
  end
  return knob.min + (max - knob.min) * math.random()
end

function decide(seen)
  local wishes = {}
  for _, name in ipairs(names) do
    wishes[name] = random_value(name, all[name])
  end
  return wishes, "fixed"
end
