// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/sim/airframe.h"

#include "built_data.h"
#include "scratch_folder.h"
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include <gtest/gtest.h>

namespace flyball {
namespace {

const std::string folder = kit::built_data() + "/airframes/";

std::string text_of(const std::string& path) {
  std::stringstream text;
  text << std::ifstream{path}.rdbuf();
  return text.str();
}

/// What comes of the Matrice's file with one piece of its text replaced.
Result<Airframe> load_altered(const std::string& from, const std::string& to) {
  std::string text = text_of(folder + "matrice_100.toml");
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  const ScratchFolder scratch;
  return load_airframe(scratch.file("altered.toml", text));
}

TEST(Airframe, every_shipped_file_loads_under_its_own_name) {
  int found = 0;
  for (const auto& entry : std::filesystem::directory_iterator{folder}) {
    const auto airframe = load_airframe(entry.path().string());
    ASSERT_TRUE(airframe.ok()) << airframe.error().message;
    EXPECT_EQ(airframe->name, entry.path().stem().string());
    ++found;
  }
  EXPECT_GE(found, 3);
}

TEST(Airframe, the_default_vehicle_hovers_as_derived_from_its_coefficients) {
  const auto a = load_airframe(folder + "matrice_100.toml");
  ASSERT_TRUE(a.ok());
  // T = C_T rho n^2 D^4 = m g / 4, written out with the datasheet's numbers.
  const double n = std::sqrt(2.431 * 9.80665 / (4.0 * 0.109919 * 1.225 * std::pow(0.3302, 4)));
  EXPECT_NEAR(60.0 * n, 3662.0, 2.0);
  EXPECT_NEAR(a->hover_rev_s(0.0), n, 1e-9);
  EXPECT_NEAR(a->hover_rev_s(3.0 * 2.431), 2.0 * n, 1e-9);  // Four times the weight.
  EXPECT_NEAR(4.0 * a->thrust_per_n2() * n * n, 2.431 * 9.80665, 1e-9);
  EXPECT_NEAR(4.0 * a->power_per_n3() * n * n * n, 176.0, 1.0);
  // Torque times angular speed is power.
  constexpr double two_pi = 6.283185307179586;
  EXPECT_NEAR(a->torque_per_n2() * n * n * two_pi * n, a->power_per_n3() * n * n * n, 1e-12);
  EXPECT_NEAR(std::pow(a->max_rotor_rev_s() / n, 2), 2.17, 0.01);  // Thrust to weight
  EXPECT_NEAR(2.0 * a->body().radius_m, 0.65, 1e-12);
}

TEST(Airframe, inertia_is_that_of_a_box_with_four_masses) {
  Airframe a;
  a.mass_kg = 1.6;
  a.rotor_mass_kg = 0.1;
  a.arm_m = 0.3;
  a.body_size_m = {0.3, 0.2, 0.1};
  // Box of 1.2 kg: m (b^2 + c^2) / 12; masses at (+-.3, +-.3) / sqrt(2).
  EXPECT_NEAR(a.inertia_kg_m2().x(), 0.1 * 0.05 + 0.4 * 0.045, 1e-12);
  EXPECT_NEAR(a.inertia_kg_m2().y(), 0.1 * 0.10 + 0.4 * 0.045, 1e-12);
  EXPECT_NEAR(a.inertia_kg_m2().z(), 0.1 * 0.13 + 0.4 * 0.09, 1e-12);
}

TEST(Airframe, knows_when_eq_1_was_not_fitted_for_it) {
  EXPECT_TRUE(load_airframe(folder + "solo.toml")->has_regression());
  EXPECT_FALSE(load_airframe(folder + "f450.toml")->has_regression());
}

TEST(Airframe, all_unknown_missing_and_mistyped_keys_are_in_one_message) {
  const auto loaded = load_altered("mass_kg = 2.431", "mas_kg = 2.431\nbattery_ah = \"big\"\n#");
  ASSERT_FALSE(loaded.ok());
  EXPECT_EQ(loaded.error().code, ErrorCode::invalid_input);
  // Two battery_ah lines are an error of the format, found first.
  EXPECT_NE(loaded.error().message.find("battery_ah"), std::string::npos) << loaded.error().message;

  const auto renamed = load_altered("battery_ah = 4.5", "batery_ah = 4.5\ncolour = 3");
  ASSERT_FALSE(renamed.ok());
  for (const char* part : {"batery_ah", "colour", "battery_ah is missing", "altered.toml"}) {
    EXPECT_NE(renamed.error().message.find(part), std::string::npos) << renamed.error().message;
  }

  const auto mistyped = load_altered("battery_cells = 6", "battery_cells = 5.5");
  ASSERT_FALSE(mistyped.ok());
  EXPECT_NE(mistyped.error().message.find("battery_cells must be an integer"), std::string::npos);
}

TEST(Airframe, impossible_values_are_refused_with_both_sides_of_the_inequality) {
  const auto negative = load_altered("arm_m = 0.325", "arm_m = -0.325");
  ASSERT_FALSE(negative.ok());
  EXPECT_NE(negative.error().message.find("arm_m = -0.325 must be > 0"), std::string::npos);

  const auto weak = load_altered("max_rotor_rpm = 5400.0", "max_rotor_rpm = 3700.0");
  ASSERT_FALSE(weak.ok());
  EXPECT_NE(weak.error().message.find("must exceed 1.2 times the weight"), std::string::npos);

  const auto short_list = load_altered("[0.252, 0.190, 0.131]", "[0.252, 0.190]");
  ASSERT_FALSE(short_list.ok());
  EXPECT_NE(short_list.error().message.find("a list of 3 numbers"), std::string::npos);
}

TEST(Airframe, values_beyond_any_vehicle_are_refused_before_they_overflow) {
  const std::pair<const char*, const char*> damages[] = {
      {"battery_cells = 6", "battery_cells = 4294967302"},  // 6, cut to 32 bits
      {"battery_cells = 6", "battery_cells = -9223372036854775808"},
      {"drag_area_m2 = ", "drag_area_m2 = inf # "},
      {"drag_area_m2 = ", "drag_area_m2 = 1e300 # "},
      {"arm_m = 0.325", "arm_m = 1e200"},
      {"mass_kg = 2.431", "mass_kg = nan"},
      {"[0.252, 0.190, 0.131]", "[0.252, 1e200, 0.131]"},
      {"[0.252, 0.190, 0.131]", "[0.252, nan, 0.131]"},
      {"power_b = [-2.595", "power_b = [nan"},
      {"power_b = [-2.595", "power_b = [-1e300"}};
  for (const auto& [right, wrong] : damages) {
    const auto loaded = load_altered(right, wrong);
    ASSERT_FALSE(loaded.ok()) << wrong;
    const std::string key{wrong, std::string{wrong}.find_first_of(" [")};
    EXPECT_NE(loaded.error().message.find(key.empty() ? "body_size_m" : key), std::string::npos)
        << loaded.error().message;
  }
}

TEST(Airframe, a_text_that_its_parser_must_not_see_is_refused_with_its_line) {
  const auto header = load_altered("name = \"matrice_100\"", "[=]");
  ASSERT_FALSE(header.ok());
  EXPECT_NE(header.error().message.find("line 4: the name of a table"), std::string::npos)
      << header.error().message;
}

TEST(Airframe, a_missing_file_is_not_found_and_a_broken_one_names_its_line) {
  EXPECT_EQ(load_airframe(folder + "no_such.toml").error().code, ErrorCode::not_found);
  const auto broken = load_altered("name = \"matrice_100\"", "name = = 3");
  ASSERT_FALSE(broken.ok());
  EXPECT_EQ(broken.error().code, ErrorCode::invalid_input);
  EXPECT_NE(broken.error().message.find("line 4"), std::string::npos) << broken.error().message;
}

}  // namespace
}  // namespace flyball
