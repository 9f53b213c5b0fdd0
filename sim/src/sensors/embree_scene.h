// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What the colour camera does with Embree. One thread and a fixed instruction set: the same image
/// on every host of a CPU class. Only for .cpp files.

#include "flyball/runtime/assert.h"

#include "world/solid_mesh.h"
#include <algorithm>
#include <array>
#include <cstdint>

#include <Eigen/Core>
#include <embree3/rtcore.h>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace flyball {

#if defined(__SSE__)
// sse, avx, avx2 and avx512 kernels round differently, so one is named; every x86 that Embree's own
// packages support has avx.
constexpr const char* device_settings = "isa=avx,threads=1,set_affinity=0";

// Embree is much slower on denormal numbers, which no depth needs; the caller's mode comes back.
class FlushDenormals {
 public:
  FlushDenormals() : saved_{_mm_getcsr()} { _mm_setcsr(saved_ | 0x8040U); }  // FTZ | DAZ
  ~FlushDenormals() { _mm_setcsr(saved_); }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned saved_;
};
#else
constexpr const char* device_settings = "threads=1,set_affinity=0";
struct FlushDenormals {};
#endif

constexpr int lanes = 8;      // Embree's avx kernels are 8 wide.
constexpr int tile_rows = 2;  // A packet is a tile of 4 x 2 pixels: rays that hit the same solids.
constexpr int tile_columns = lanes / tile_rows;

struct Ray {
  Eigen::Vector3f origin;
  Eigen::Vector3f direction;
  float range;
};

/// Of a tile: its first pixel.
struct Corner {
  int x;
  int y;
};

struct EmbreeDevice {
  RTCDevice handle{rtcNewDevice(device_settings)};
  EmbreeDevice() {
    FLYBALL_ASSERT(handle != nullptr, "Embree error %d for \"%s\"",
                   static_cast<int>(rtcGetDeviceError(nullptr)), device_settings);
  }
  ~EmbreeDevice() { rtcReleaseDevice(handle); }
  EmbreeDevice(const EmbreeDevice&) = delete;
  EmbreeDevice& operator=(const EmbreeDevice&) = delete;
};

/// Adds the quads as the scene's next geometry; nothing for a mesh without.
inline void attach_quads(RTCDevice device, RTCScene scene, const SolidMesh& mesh) {
  if (mesh.quads.empty()) {
    return;
  }
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           sizeof(mesh.vertices_W[0]), mesh.vertices_W.size());
  void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4,
                                          sizeof(mesh.quads[0]), mesh.quads.size());
  FLYBALL_ASSERT(vertices != nullptr && indices != nullptr, "Embree has no memory for %zu quads",
                 mesh.quads.size());
  std::copy(mesh.vertices_W.begin(), mesh.vertices_W.end(),
            static_cast<std::array<float, 3>*>(vertices));
  std::copy(mesh.quads.begin(), mesh.quads.end(),
            static_cast<std::array<std::uint32_t, 4>*>(indices));
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

}  // namespace flyball
