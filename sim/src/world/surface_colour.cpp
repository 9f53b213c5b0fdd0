// SPDX-License-Identifier: BSD-3-Clause
#include "world/surface_colour.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace flyball {
namespace {

using Colour = Eigen::Vector3f;

constexpr unsigned noise_bits = 8;  // The table repeats after 256 cells.
constexpr unsigned noise_size = 1U << noise_bits;

// Integer arithmetic: the same on every processor.
float random_cell(std::uint32_t cell) {
  cell = (cell ^ 0x5bd1e995U) * 0x9e3779b1U;
  cell ^= cell >> 15U;
  cell *= 0x85ebca6bU;
  cell ^= cell >> 13U;
  return static_cast<float>(cell >> 8U) * 0x1.0p-23F - 1.0F;
}

const std::vector<float>& noise_table() {
  static const std::vector<float> table = [] {
    std::vector<float> cells(std::size_t{noise_size} * noise_size);
    for (std::uint32_t i = 0; i < cells.size(); ++i) {
      cells[i] = random_cell(i);
    }
    return cells;
  }();
  return table;
}

struct Place {
  float u;
  float v;
};

/// The whole number below; `std::floor` is a call of a library on the oldest x86.
std::int32_t floor_of(float x) {
  const auto towards_zero = static_cast<std::int32_t>(x);
  return towards_zero - (x < static_cast<float>(towards_zero) ? 1 : 0);
}

/// Value noise, -1..1: random numbers on a grid of cells, blended between.
float noise(const std::vector<float>& table, Place at) {
  const std::int32_t u0 = floor_of(at.u);
  const std::int32_t v0 = floor_of(at.v);
  const auto i = static_cast<std::uint32_t>(u0);
  const auto j = static_cast<std::uint32_t>(v0);
  const auto cell = [&table](std::uint32_t x, std::uint32_t y) {
    return table[((y & (noise_size - 1U)) << noise_bits) | (x & (noise_size - 1U))];
  };
  const float a = at.u - static_cast<float>(u0);
  const float b = at.v - static_cast<float>(v0);
  return (1.0F - b) * ((1.0F - a) * cell(i, j) + a * cell(i + 1U, j)) +
         b * ((1.0F - a) * cell(i, j + 1U) + a * cell(i + 1U, j + 1U));
}

/// Sum of noise at some cell sizes; a size that a pixel cannot resolve fades away.
class Grain {
 public:
  Grain(Place at, float footprint_m) : table_{noise_table()}, at_{at}, footprint_m_{footprint_m} {}

  [[nodiscard]] float of(float cell_m, float stretch = 1.0F) const {
    const float sharp = std::clamp(2.0F - 2.0F * footprint_m_ / cell_m, 0.0F, 1.0F);
    return sharp <= 0.0F ? 0.0F
                         : sharp * noise(table_, {at_.u / cell_m, at_.v / (stretch * cell_m)});
  }

 private:
  const std::vector<float>& table_;
  Place at_;
  float footprint_m_;
};

/// Coordinates on the surface: level ground from above, all else from its side, v upwards.
Place place_on(const SurfacePoint& point) {
  const Eigen::Vector3f out = point.normal_W.cwiseAbs();
  if (out.z() > std::max(out.x(), out.y())) {
    return {point.p_W.x(), point.p_W.y()};
  }
  return {out.x() > out.y() ? point.p_W.y() : point.p_W.x(), point.p_W.z()};
}

Colour grass(const Grain& grain) {
  const float blades = 0.35F * grain.of(0.025F) + 0.22F * grain.of(0.11F);
  const float patches = 0.18F * grain.of(0.9F) + 0.15F * grain.of(7.3F);
  const Colour dry{0.46F, 0.45F, 0.22F};
  const Colour lush{0.25F, 0.38F, 0.13F};
  const float mix = std::clamp(0.4F + 1.2F * patches, 0.0F, 1.0F);
  return (mix * dry + (1.0F - mix) * lush) * (1.0F + blades);
}

Colour brick(Place at, float footprint_m, const Grain& grain) {
  constexpr float length_m = 0.25F;
  constexpr float height_m = 0.08F;
  constexpr float joint_m = 0.012F;
  const Colour clay{0.55F, 0.30F, 0.22F};
  const Colour mortar{0.66F, 0.63F, 0.58F};
  const float row = std::floor(at.v / height_m);
  const float shifted = at.u / length_m + 0.5F * (row - 2.0F * std::floor(0.5F * row));
  const float column = std::floor(shifted);
  const bool is_joint = at.v - row * height_m < joint_m || (shifted - column) * length_m < joint_m;
  const float own =
      0.2F *
      random_cell(static_cast<std::uint32_t>(static_cast<std::int32_t>(row * 977.0F + column)));
  const float blur = std::clamp(footprint_m / height_m, 0.0F, 1.0F);
  const Colour mean = 0.8F * clay + 0.2F * mortar;
  const Colour sharp = is_joint ? mortar : Colour{clay * (1.0F + own)};
  return (blur * mean + (1.0F - blur) * sharp) * (1.0F + 0.1F * grain.of(0.6F));
}

}  // namespace

Eigen::Vector3f surface_colour(Material material, const SurfacePoint& point) {
  const Place at = place_on(point);
  const Grain grain{at, point.footprint_m};
  switch (material) {
    case Material::grass:
      return grass(grain);
    case Material::brick:
      return brick(at, point.footprint_m, grain);
    case Material::bark:
      return Colour{0.34F, 0.27F, 0.20F} *
             (1.0F + 0.5F * grain.of(0.03F, 5.0F) + 0.25F * grain.of(0.2F));
    case Material::leaves:
      return Colour{0.20F, 0.33F, 0.12F} * (1.0F + 0.6F * grain.of(0.07F) + 0.4F * grain.of(0.3F));
    case Material::wood:
      return Colour{0.55F, 0.40F, 0.25F} *
             (1.0F + 0.15F * grain.of(0.02F, 12.0F) + 0.15F * grain.of(0.12F, 6.0F));
    case Material::gravel:
      return Colour{0.60F, 0.56F, 0.48F} *
             (1.0F + 0.3F * grain.of(0.03F) + 0.1F * grain.of(0.5F) + 0.08F * grain.of(3.1F));
    case Material::asphalt:
      return Colour{0.32F, 0.32F, 0.33F} *
             (1.0F + 0.25F * grain.of(0.02F) + 0.12F * grain.of(1.3F));
    case Material::plaster:
      break;
  }
  return Colour{0.74F, 0.71F, 0.65F} *
         (1.0F + 0.06F * grain.of(0.05F) + 0.1F * grain.of(0.4F) + 0.1F * grain.of(2.3F));
}

Eigen::Vector3f sky_colour(const Eigen::Vector3f& direction_W, const Eigen::Vector3f& to_sun_W) {
  const float up = std::clamp(direction_W.z(), 0.0F, 1.0F);
  const Colour horizon{0.80F, 0.86F, 0.92F};
  const Colour zenith{0.33F, 0.52F, 0.80F};
  const float near = std::max(direction_W.dot(to_sun_W), 0.0F);
  const float glow = near * near * near * near;
  return horizon + std::sqrt(up) * (zenith - horizon) + 0.25F * glow * glow * Colour::Ones();
}

}  // namespace flyball
