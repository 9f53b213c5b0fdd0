// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What most tests include, read once for all test programs: a third of the time that a test takes
/// to compile. A test includes what it uses all the same.

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <gtest/gtest.h>
