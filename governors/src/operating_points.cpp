// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/operating_points.h"

#include <utility>

namespace flyball {
namespace {

Error refused(const std::string& why) {
  return {ErrorCode::invalid_input, "lattice of operating points: " + why};
}

Status check(const KnobAxis& axis, const KnobSettings& knobs) {
  const KnobSpec* spec = knobs.spec(axis.knob);
  if (spec == nullptr) {
    return refused("there is no knob " + axis.knob + "; try: flyball list knobs");
  }
  if (axis.values.empty()) {
    return refused("no values for " + axis.knob);
  }
  for (const double value : axis.values) {
    if (!spec->is_legal(value)) {
      return refused(axis.knob + " cannot be " + std::to_string(value) + "; nearest is " +
                     std::to_string(spec->nearest(value)));
    }
  }
  return Done{};
}

}  // namespace

Result<OperatingPoints> OperatingPoints::lattice(std::vector<KnobAxis> axes,
                                                 const KnobSettings& knobs,
                                                 std::size_t limit) {
  if (axes.empty()) {
    return refused("no knob is named");
  }
  std::size_t count = 1;
  for (const KnobAxis& axis : axes) {
    if (Status status = check(axis, knobs); !status) {
      return status.error();
    }
    count *= axis.values.size();
    if (count > limit) {
      return refused("more than " + std::to_string(limit) + " combinations");
    }
  }
  OperatingPoints points;
  points.axes_ = std::move(axes);
  points.values_.reserve(count * points.axes_.size());
  for (std::size_t point = 0; point < count; ++point) {
    std::size_t block = count;
    for (const KnobAxis& axis : points.axes_) {
      block /= axis.values.size();
      points.values_.push_back(axis.values[point / block % axis.values.size()]);
    }
  }
  return points;
}

}  // namespace flyball
