-- SPDX-License-Identifier: BSD-3-Clause
--
-- Random and extreme wishes for every knob, now and then none that makes sense at all: whatever it
-- says, the vehicle may lose time but must not touch anything. A test flies some missions with it;
-- for many (200 of these: no collision, 140 end by the limit of time; 2 minutes on one core):
--   flyball compare delivery_forest --policies tests/closed_loop/wild.lua --seeds 1..200 --set kernels.mapper=flyball
--     --set kernels.mapper_parameters.cost_of=octomap --set world.goal_distance_m=20 --set world.width_m=20
--     --set camera.width_px=32 --set camera.height_px=18 --set mission.time_limit_s=40

description = "Random and extreme wishes"

local all

function start(given, knobs)
  all = knobs
end

local function wish(knob)
  local dice = math.random(7)
  if dice == 1 then return knob.min end
  if dice == 2 then return knob.max end
  if dice == 3 then return 1e300 end
  if dice == 4 then return -1e300 end
  if dice == 5 then return knob.min + (knob.max - knob.min) * math.random() end
  if dice == 6 then return knob.default end
  return nil
end

function decide(seen)
  local wishes = {}
  for name, knob in pairs(all) do
    wishes[name] = wish(knob)
  end
  local dice = math.random(60)
  if dice == 1 then wishes["map.range_m"] = 0 / 0 end
  if dice == 2 then error("no idea") end
  if dice == 3 then wishes["map.colour"] = 7 end
  if dice == 4 then while true do end end
  return wishes, "fixed"
end
