// Quantities as users write them: a bare number in SI (angles in degrees), or a number with a unit, "4 km", "12 kN m2".
//
// A unit is a product of symbols with optional SI prefix and integer power, joined by blanks, "*" or "/"; "/" divides by
// the one symbol that follows it: "kg/m3", "m/s^2", "N s", "N/m/s". Values come out in SI, angles in radians.
#pragma once

#include <string>
#include <string_view>
#include <variant>

namespace hawser {

/// Exponents of the base units; an angle is kept apart from a plain number.
struct Dimension {
  int kilogram = 0, metre = 0, second = 0, radian = 0;
  bool operator==(const Dimension&) const = default;
};

/// A kind of quantity that a key holds.
struct Kind {
  const char* name;     // "length"
  const char* unit;     // of a bare number
  const char* example;  // of a value with a unit
  Dimension dimension;
};

namespace kinds {
inline constexpr Kind number{"plain number", "", "0.5", {}};
inline constexpr Kind length{"length", "m", "4 km", {0, 1, 0, 0}};
inline constexpr Kind area{"area", "m2", "0.5 m2", {0, 2, 0, 0}};
inline constexpr Kind volume{"volume", "m3", "0.2 m3", {0, 3, 0, 0}};
inline constexpr Kind time{"time", "s", "2 min", {0, 0, 1, 0}};
inline constexpr Kind speed{"speed", "m/s", "1.2 kn", {0, 1, -1, 0}};
inline constexpr Kind acceleration{"acceleration", "m/s2", "9.81 m/s2", {0, 1, -2, 0}};
inline constexpr Kind angle{"angle", "deg", "30 deg", {0, 0, 0, 1}};
inline constexpr Kind mass{"mass", "kg", "2 t", {1, 0, 0, 0}};
inline constexpr Kind mass_per_length{"mass per length", "kg/m", "2.5 kg/m", {1, -1, 0, 0}};
inline constexpr Kind density{"density", "kg/m3", "1025 kg/m3", {1, -3, 0, 0}};
inline constexpr Kind force{"force", "N", "15 kN", {1, 1, -2, 0}};
inline constexpr Kind force_per_length{"force per length", "N/m", "12 N/m", {1, 0, -2, 0}};
inline constexpr Kind force_per_area{"force per area", "N/m2", "3 kN/m2", {1, -1, -2, 0}};
inline constexpr Kind force_times_time{"force times time", "N s", "2 kN s", {1, 1, -1, 0}};
inline constexpr Kind damping_per_area{"force times time per area", "N s/m2", "100 N s/m2", {1, -1, -1, 0}};
inline constexpr Kind moment{"moment", "N m", "2 kN m", {1, 2, -2, 0}};
inline constexpr Kind bending_stiffness{"bending stiffness", "N m2", "12 kN m2", {1, 3, -2, 0}};
}  // namespace kinds

/// The name of the kind that has this dimension, "something else" if none has.
std::string kind_of(const Dimension&);

struct BadQuantity {
  std::string reason;  // what is wrong with the text, "`kgg` is not a unit: did you mean `kg`?"
};

/// Reads a number with a unit and converts it from that unit; the unit must have the kind's dimension.
std::variant<double, BadQuantity> parse_quantity(std::string_view text, const Kind& kind);

/// A bare number of the kind in SI: degrees become radians, anything else is unchanged.
double from_bare(double value, const Kind& kind);

}  // namespace hawser
