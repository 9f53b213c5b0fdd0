-- SPDX-License-Identifier: BSD-3-Clause
--
-- The two-level switch as a script: a fine map where obstacles stand close, a coarse one in the open.
--   flyball policy check examples/policies/density_switch.lua
--   flyball run delivery_forest --policy examples/policies/density_switch.lua

description = "Fine among obstacles, coarse in the open"

parameters = {
  {name = "fine_m", default = 0.15, min = 0.05, max = 2, description = "Resolution where obstacles are dense."},
  {name = "coarse_m", default = 0.60, min = 0.05, max = 2, description = "Resolution in the open."},
  {name = "enter_density", default = 0.06, min = 0, max = 1, description = "At or above: fine."},
  {name = "leave_density", default = 0.045, min = 0, max = 1, description = "At or below: coarse."},
  {name = "min_fine_s", default = 2, min = 0, max = 3600, description = "Fine lasts at least this long."},
}

local rounding_s = 1e-9 -- a difference of two times is not exact

local settings
local fine_since_s -- nil: coarse

function start(given, knobs)
  if given.fine_m >= given.coarse_m then
    error("fine_m must be below coarse_m")
  end
  if not knobs["map.resolution_m"] then
    error("there is no knob map.resolution_m")
  end
  settings = given
  fine_since_s = nil
end

function decide(seen)
  if not fine_since_s and seen.obstacle_density >= settings.enter_density then
    fine_since_s = seen.now_s
  elseif fine_since_s and seen.obstacle_density <= settings.leave_density
      and seen.now_s - fine_since_s >= settings.min_fine_s - rounding_s then
    fine_since_s = nil
  end
  return {["map.resolution_m"] = fine_since_s and settings.fine_m or settings.coarse_m}, "density"
end
