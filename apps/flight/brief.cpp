// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/brief.h"

namespace flyball {

Cylinder Brief::body_at(double speed_m_s) const {
  const double tube_m = tube.radius_m(speed_m_s);
  return {body.radius_m + tube_m, body.half_height_m + tube_m + tube.extra_height_m};
}

}  // namespace flyball
