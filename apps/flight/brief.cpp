// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/brief.h"

#include <algorithm>

namespace flyball {

Cylinder Brief::body_at(double speed_m_s) const {
  const double tube_m = tube.radius_m(speed_m_s);
  return {body.radius_m + tube_m, body.half_height_m + tube_m + tube.extra_height_m};
}

double Brief::arrival_error_m() const {
  constexpr double least_m = 0.1;  // Chosen: the simulated vehicle comes nearer in a second.
  return std::max(least_m, tube.at_rest_m);
}

}  // namespace flyball
