// SPDX-License-Identifier: BSD-3-Clause
//
// MRPT's geodetic conversions as one C function.

#include <exception>

#include <mrpt/topography/conversions.h>

namespace {

/// From latitude [rad], longitude [rad] and height [m].
mrpt::topography::TGeodeticCoords coordinates(const double* place) {
  constexpr double degrees_per_rad = 180.0 / 3.14159265358979323846;
  return {place[0] * degrees_per_rad, place[1] * degrees_per_rad, place[2]};
}

}  // namespace

/// Writes the place in W [m], east, north and up of the origin on WGS-84; whether it could.
extern "C" bool flyball_geodetic_to_enu(const double* place, const double* origin, double* p_W) {
  try {
    mrpt::math::TPoint3D p;
    mrpt::topography::geodeticToENU_WGS84(coordinates(place), p, coordinates(origin));
    p_W[0] = p.x;
    p_W[1] = p.y;
    p_W[2] = p.z;
    return true;
  } catch (const std::exception&) {
    return false;
  }
}
