-- SPDX-License-Identifier: BSD-3-Clause
--
-- The largest cells that leave the narrowest gap ahead open, and a fixed range for each size. The policy
-- gap_switch is the same rule, and its file (policies/gap_switch.cpp) says why each step is there.
--   flyball policy check examples/policies/gap_switch.lua
--   flyball run delivery_mixed --policy examples/policies/gap_switch.lua

description = "The largest cells that the narrowest gap ahead allows, a fixed range for each"

parameters = {
  {name = "fine_m", default = 0.15, min = 0.05, max = 2, description = "Smallest cells; the next levels are 2 and 4 times that."},
  {name = "range_m", default = 10, min = 2, max = 100, description = "Range with the smallest cells."},
  {name = "range_2_m", default = 15, min = 2, max = 100, description = "Range at the second level."},
  {name = "range_3_m", default = 22, min = 2, max = 100, description = "Range at the third level."},
  {name = "body_m", default = 0.71, min = 0.1, max = 5, description = "Width of the vehicle with its tube at a crawl."},
  {name = "narrow_m_s", default = 2, min = 0, max = 50, description = "A speed limit that means narrow gaps."},
  {name = "near_m", default = 8, min = 0, max = 100, description = "From farther on, gaps are looked at on the second level."},
  {name = "min_fine_s", default = 2, min = 0, max = 3600, description = "Smaller cells last at least this long."},
}

local past_the_gap_m = 3
local rounding = 1e-9 -- a difference is not exact

local settings, cells_m, ranges_m
local level, finest_on_m, needed_at_s, last_s

function start(given, knobs)
  for _, needed in ipairs({"map.resolution_m", "map.range_m"}) do
    if not knobs[needed] then
      error("there is no knob " .. needed)
    end
  end
  settings = given
  cells_m = {given.fine_m, 2 * given.fine_m, 4 * given.fine_m}
  ranges_m = {given.range_m, given.range_2_m, given.range_3_m}
  level, finest_on_m, needed_at_s, last_s = #cells_m, 0, 0, 0
end

local function open_level(seen)
  for i = #cells_m, 2, -1 do
    local lost_m = 2 * math.max(0, cells_m[i] - seen.map_resolution_m)
    if seen.narrowest_gap_m - lost_m >= settings.body_m + 2 * cells_m[i] - rounding then
      return i
    end
  end
  return 1
end

local function wanted_level(seen)
  local open = open_level(seen)
  local wanted = open
  if open == 1 and seen.gap_distance_m > settings.near_m then
    wanted = 2
  elseif open == 1 then
    finest_on_m = math.max(finest_on_m, seen.gap_distance_m + past_the_gap_m)
  end
  if seen.planner_failures > 0 then
    finest_on_m = math.max(finest_on_m, settings.near_m)
  end
  if seen.speed_limit_m_s <= settings.narrow_m_s then
    local is_within = level == 1 and seen.speed_m_s <= settings.narrow_m_s
    wanted = is_within and 1 or math.min(wanted, 2)
  end
  return (finest_on_m > 0 or seen.planner_failures > 0) and 1 or wanted
end

local function move_to(wanted, seen)
  if wanted <= level then
    needed_at_s = seen.now_s
    level = wanted
  elseif seen.now_s - needed_at_s >= settings.min_fine_s - rounding then
    while wanted > level and seen.nearest_obstacle_m < 0.5 * settings.body_m + 2 * cells_m[wanted] do
      wanted = wanted - 1
    end
    level = wanted
  end
end

function decide(seen)
  finest_on_m = math.max(0, finest_on_m - math.max(0, seen.speed_m_s) * (seen.now_s - last_s))
  last_s = seen.now_s
  move_to(wanted_level(seen), seen)
  return {["map.resolution_m"] = cells_m[level], ["map.range_m"] = ranges_m[level]}, "density"
end
