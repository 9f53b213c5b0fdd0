// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Says whether two hosts compute with the same numerics.

#include <string>

namespace flyball {

/// Hash of probes of libm, the depth camera and Eigen. Equal fingerprints mean equal trace
/// hashes; different ones mean "different numerics" (another CPU class or library), not an error.
[[nodiscard]] std::string numeric_fingerprint();

}  // namespace flyball
