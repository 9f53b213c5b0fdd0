-- SPDX-License-Identifier: BSD-3-Clause
--
-- As `fixed_coarse`, with the fewest frames of the camera: switched_kernels_test.cpp.

description = "Large cells, and few frames"

function decide(seen)
  return {["map.resolution_m"] = 0.8, ["camera.rate_hz"] = 2.5}, "fixed"
end
