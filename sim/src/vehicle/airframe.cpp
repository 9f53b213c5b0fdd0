// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/sim/airframe.h"

#include "flyball/runtime/text/number_text.h"
#include "flyball/runtime/text/toml_text.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>

#include <toml++/toml.h>

namespace flyball {
namespace {

constexpr double pi = 3.14159265358979323846;

/// Takes values out of a table, and notes wrong values and unknown keys.
class Reader {
 public:
  explicit Reader(const toml::table& table) : table_{table} {}

  void read(const char* key, double& value) {
    const toml::node* node = find(key);
    if (node == nullptr) {
      return;
    }
    const auto number = node->value<double>();
    number ? (void)(value = *number) : complain(key, "a number");
  }

  void read(const char* key, int& value) {
    const toml::node* node = find(key);
    if (node == nullptr) {
      return;
    }
    const auto number = node->value_exact<int64_t>();
    constexpr std::int64_t most = std::numeric_limits<int>::max();
    number&& std::abs(static_cast<double>(*number)) <= static_cast<double>(most)
        ? (void)(value = static_cast<int>(*number))
        : complain(key, "an integer");
  }

  void read(const char* key, std::string& value) {
    const toml::node* node = find(key);
    if (node == nullptr) {
      return;
    }
    const auto words = node->value<std::string>();
    words ? (void)(value = *words) : complain(key, "a text");
  }

  /// `count` numbers; an optional key may be absent.
  void read_list(const char* key, double* values, std::size_t count, bool optional) {
    if (optional && !table_.contains(key)) {
      asked_.insert(key);
      return;
    }
    const toml::node* node = find(key);
    if (node == nullptr) {
      return;
    }
    const toml::array* list = node->as_array();
    if (list == nullptr || list->size() != count || !list->is_homogeneous<double>()) {
      complain(key, "a list of " + std::to_string(count) + " numbers with decimal points");
      return;
    }
    for (std::size_t i = 0; i < count; ++i) {
      values[i] = *list->get(i)->value<double>();
    }
  }

  /// What is wrong so far, one sentence each.
  std::vector<std::string> complaints() {
    for (const auto& [key, node] : table_) {
      if (asked_.count(std::string{key.str()}) == 0) {
        complaints_.push_back("unknown key \"" + std::string{key.str()} + "\"");
      }
    }
    return complaints_;
  }

 private:
  const toml::node* find(const char* key) {
    asked_.insert(key);
    const toml::node* node = table_.get(key);
    if (node == nullptr) {
      complaints_.push_back(std::string{key} + " is missing");
    }
    return node;
  }
  void complain(const char* key, const std::string& wanted) {
    complaints_.push_back(std::string{key} + " must be " + wanted);
  }

  const toml::table& table_;
  std::set<std::string> asked_;
  std::vector<std::string> complaints_;
};

Airframe read(Reader& reader) {
  Airframe a;
  reader.read("name", a.name);
  reader.read("mass_kg", a.mass_kg);
  reader.read("rotor_mass_kg", a.rotor_mass_kg);
  reader.read("arm_m", a.arm_m);
  reader.read("rotor_diameter_m", a.rotor_diameter_m);
  reader.read("thrust_coefficient", a.thrust_coefficient);
  reader.read("power_coefficient", a.power_coefficient);
  reader.read("max_rotor_rpm", a.max_rotor_rpm);
  reader.read("rotor_lag_s", a.rotor_lag_s);
  reader.read_list("body_size_m", a.body_size_m.data(), 3, false);
  reader.read("body_diameter_m", a.body_diameter_m);
  reader.read("body_height_m", a.body_height_m);
  reader.read("drag_area_m2", a.drag_area_m2);
  reader.read_list("power_b", a.power_b.data(), a.power_b.size(), true);
  reader.read("battery_v", a.battery_v);
  reader.read("battery_ah", a.battery_ah);
  reader.read("battery_cells", a.battery_cells);
  return a;
}

struct Limit {
  const char* key;
  double value;
  double most;
};

// Far above any vehicle that somebody carries, far below what overflows in the equations of motion.
constexpr double most_kg = 1000.0;
constexpr double most_m = 100.0;
constexpr double most_m2 = 100.0;
constexpr double most_coefficient = 10.0;
constexpr double most_rpm = 1e6;
constexpr double most_lag_s = 10.0;
constexpr double most_v = 1000.0;
constexpr double most_ah = 1e4;
constexpr double most_cells = 1000.0;
constexpr double most_power_b = 1e6;

std::vector<Limit> limits_of(const Airframe& a) {
  return {{"mass_kg", a.mass_kg, most_kg},
          {"arm_m", a.arm_m, most_m},
          {"rotor_diameter_m", a.rotor_diameter_m, most_m},
          {"thrust_coefficient", a.thrust_coefficient, most_coefficient},
          {"power_coefficient", a.power_coefficient, most_coefficient},
          {"max_rotor_rpm", a.max_rotor_rpm, most_rpm},
          {"rotor_lag_s", a.rotor_lag_s, most_lag_s},
          {"body_size_m", a.body_size_m.x(), most_m},
          {"body_size_m", a.body_size_m.y(), most_m},
          {"body_size_m", a.body_size_m.z(), most_m},
          {"body_diameter_m", a.body_diameter_m, most_m},
          {"body_height_m", a.body_height_m, most_m},
          {"battery_v", a.battery_v, most_v},
          {"battery_ah", a.battery_ah, most_ah},
          {"battery_cells", static_cast<double>(a.battery_cells), most_cells}};
}

std::vector<std::string> physics_complaints(const Airframe& airframe) {
  std::vector<std::string> complaints;
  for (const Error& error : airframe.validate()) {
    complaints.push_back(error.message);
  }
  return complaints;
}

Error all_of(const std::string& path, const std::vector<std::string>& complaints) {
  std::string message = "airframe file \"" + path + "\": ";
  for (std::size_t i = 0; i < complaints.size(); ++i) {
    message += (i == 0 ? "" : "; ") + complaints[i];
  }
  return {ErrorCode::invalid_input, message};
}

constexpr double spare = 1.2;  // Chosen: what is left of the thrust climbs and tilts the vehicle.

double lift_n(const Airframe& airframe) {
  return 4.0 * airframe.thrust_per_n2() * std::pow(airframe.max_rotor_rev_s(), 2);
}

}  // namespace

Vec3 Airframe::inertia_kg_m2() const {
  const Vec3 square = body_size_m.cwiseAbs2();
  const double box_mass_kg = mass_kg - 4.0 * rotor_mass_kg;
  const Vec3 box = box_mass_kg / 12.0 *
                   Vec3{square.y() + square.z(), square.x() + square.z(), square.x() + square.y()};
  // In the X layout each rotor stands arm / sqrt(2) from the x and from the y axis.
  const double rotors = 4.0 * rotor_mass_kg * arm_m * arm_m;
  return box + rotors * Vec3{0.5, 0.5, 1.0};
}

std::array<Vec3, 4> Airframe::rotor_points_B() const {
  const double l = arm_m / std::sqrt(2.0);
  return {Vec3{l, l, 0.0}, Vec3{l, -l, 0.0}, Vec3{-l, -l, 0.0}, Vec3{-l, l, 0.0}};
}

std::array<Vec3, 4> Airframe::foot_points_B() const {
  std::array<Vec3, 4> feet_B = rotor_points_B();
  for (Vec3& foot_B : feet_B) {
    foot_B = {0.5 * foot_B.x(), 0.5 * foot_B.y(), -0.5 * body_height_m};
  }
  return feet_B;
}

double Airframe::thrust_per_n2() const {
  return thrust_coefficient * air_density_kg_m3 * std::pow(rotor_diameter_m, 4);
}

double Airframe::torque_per_n2() const {
  return power_per_n3() / (2.0 * pi);
}

double Airframe::power_per_n3() const {
  return power_coefficient * air_density_kg_m3 * std::pow(rotor_diameter_m, 5);
}

std::vector<Error> Airframe::validate() const {
  std::vector<Error> errors;
  const auto require = [&errors](bool good, const std::string& sentence) {
    if (!good) {
      errors.push_back({ErrorCode::invalid_input, sentence});
    }
  };
  for (const Limit& limit : limits_of(*this)) {
    require(limit.value > 0.0 && limit.value <= limit.most,  // False for NaN.
            std::string{limit.key} + " = " + short_number_text(limit.value) +
                " must be > 0 and at most " + short_number_text(limit.most));
  }
  require(drag_area_m2 >= 0.0 && drag_area_m2 <= most_m2,
          "drag_area_m2 = " + short_number_text(drag_area_m2) + " must be >= 0 and at most " +
              short_number_text(most_m2));
  require(std::all_of(power_b.begin(), power_b.end(),
                      [](double b) { return std::abs(b) <= most_power_b; }),
          "power_b must hold numbers from " + short_number_text(-most_power_b) + " to " +
              short_number_text(most_power_b));
  require(rotor_mass_kg >= 0.0 && 4.0 * rotor_mass_kg < mass_kg,
          "four rotors of " + short_number_text(rotor_mass_kg) +
              " kg must weigh >= 0 and less than mass_kg = " + short_number_text(mass_kg));
  const double needed_n = spare * mass_kg * gravity_m_s2;
  require(most_payload_kg() > 0.0, "the rotors' " + short_number_text(lift_n(*this)) +
                                       " N must exceed " + short_number_text(spare) +
                                       " times the weight, " + short_number_text(needed_n) + " N");
  return errors;
}

double Airframe::hover_rev_s(double carried_kg) const {
  return std::sqrt((mass_kg + carried_kg) * gravity_m_s2 / (4.0 * thrust_per_n2()));
}

double Airframe::most_payload_kg() const {
  return lift_n(*this) / (spare * gravity_m_s2) - mass_kg;
}

Result<Airframe> load_airframe(const std::string& path) {
  std::error_code missing;
  if (!std::filesystem::is_regular_file(path, missing)) {
    return Error{ErrorCode::not_found, "no airframe file \"" + path + "\""};
  }
  try {
    std::ifstream file{path};
    const std::string content{std::istreambuf_iterator<char>{file}, {}};
    if (const auto fault = fault_of_toml(content)) {
      return all_of(path, {"line " + std::to_string(fault->line) + ": " + fault->what});
    }
    const toml::table table = toml::parse(content);
    Reader reader{table};
    Airframe airframe = read(reader);
    std::vector<std::string> complaints = reader.complaints();
    if (complaints.empty()) {
      complaints = physics_complaints(airframe);
    }
    if (!complaints.empty()) {
      return all_of(path, complaints);
    }
    return airframe;
  } catch (const toml::parse_error& error) {
    return all_of(path, {"line " + std::to_string(error.source().begin.line) + ": " +
                         std::string{error.description()}});
  }
}

}  // namespace flyball
