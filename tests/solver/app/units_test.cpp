#include "solver/app/units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hawser {
namespace {

struct Written {
  const char* text;
  Kind kind;
  double si;
};

/// A few multiplications of doubles lie between the text and the expectation.
void expect_same(double got, double wanted) { EXPECT_NEAR(got, wanted, 4e-16 * std::abs(wanted)); }

TEST(Units, ConvertEveryKindThatAKeyHolds) {
  const double degree = std::numbers::pi / 180.0;
  const Written cases[] = {
      {"4 km", kinds::length, 4000.0},
      {"40mm", kinds::length, 0.04},
      {"12 ft", kinds::length, 3.6576},
      {"1 nmi", kinds::length, 1852.0},
      {"-3e2 m", kinds::length, -300.0},
      {"+5 cm", kinds::length, 0.05},
      {"2.5 kg/m", kinds::mass_per_length, 2.5},
      {"2.5 t/km", kinds::mass_per_length, 2.5},
      {"1.2 kn", kinds::speed, 1.2 * 1852.0 / 3600.0},
      {"3 knots", kinds::speed, 3.0 * 1852.0 / 3600.0},
      {"36 km/h", kinds::speed, 10.0},
      {"0.5 m s-1", kinds::speed, 0.5},
      {"15 kN", kinds::force, 15000.0},
      {"2 tf", kinds::force, 2 * 9806.65},
      {"40 MN", kinds::force, 4e7},
      {"3 kg m/s2", kinds::force, 3.0},
      {"10 s", kinds::time, 10.0},
      {"12 min", kinds::time, 720.0},
      {"250 ms", kinds::time, 0.25},
      {"2 h", kinds::time, 7200.0},
      {"3 deg", kinds::angle, 3 * degree},
      {"90°", kinds::angle, 90 * degree},
      {"1 rad", kinds::angle, 1.0},
      {"2 kN m2", kinds::bending_stiffness, 2000.0},
      {"2 kN*m^2", kinds::bending_stiffness, 2000.0},
      {"2 kN·m²", kinds::bending_stiffness, 2000.0},
      {"2 N m", kinds::moment, 2.0},
      {"11.9 N/m", kinds::force_per_length, 11.9},
      {"3 kN/m2", kinds::force_per_area, 3000.0},
      {"3 kPa", kinds::force_per_area, 3000.0},
      {"4 kN s", kinds::force_times_time, 4000.0},
      {"4 N s/m2", kinds::damping_per_area, 4.0},
      {"1.025 t/m3", kinds::density, 1025.0},
      {"1.025 g/cm3", kinds::density, 1025.0},
      {"9.81 m/s2", kinds::acceleration, 9.81},
      {"9.81 m/s/s", kinds::acceleration, 9.81},
      {"50 cm2", kinds::area, 0.005},
      {"250 L", kinds::volume, 0.25},
      {"2 t", kinds::mass, 2000.0},
      {"5 %", kinds::number, 0.05},
  };
  for (const Written& c : cases) {
    SCOPED_TRACE(c.text);
    const auto parsed = parse_quantity(c.text, c.kind);
    ASSERT_TRUE(std::holds_alternative<double>(parsed)) << std::get<BadQuantity>(parsed).reason;
    expect_same(std::get<double>(parsed), c.si);
  }
}

TEST(Units, RefuseWithTheReason) {
  struct Bad {
    const char* text;
    Kind kind;
    const char* reason;
  };
  const Bad cases[] = {
      {"4 kg", kinds::length, "`kg` is a unit of mass"},
      {"1.2 kN", kinds::speed, "`kN` is a unit of force"},
      {"3 m", kinds::angle, "`m` is a unit of length"},
      {"3 deg", kinds::number, "`deg` is a unit of angle"},
      {"3 m7", kinds::length, "`m7` is a unit of something else"},
      {"4 kgg", kinds::mass, "`kgg` is not a unit; did you mean `kg`?"},
      {"4 M", kinds::length, "`M` is not a unit"},
      {"4 metres", kinds::length, "`metres` is not a unit"},
      {"4", kinds::length, "a number in quotes needs a unit"},
      {"four km", kinds::length, "does not begin with a number"},
      {"km", kinds::length, "does not begin with a number"},
      {"", kinds::length, "empty text"},
      {"1e999 m", kinds::length, "the number is too large or too small"},
      {"4 kg/", kinds::mass_per_length, "`kg/` ends with `/`"},
      {"4 kg//m", kinds::mass_per_length, "`kg//m` has two `/` in a row"},
      {"4 m^", kinds::length, "`m^` is not a unit"},
      {"4 m99", kinds::length, "`m99` is not a unit"},
  };
  for (const Bad& c : cases) {
    SCOPED_TRACE(c.text);
    const auto parsed = parse_quantity(c.text, c.kind);
    ASSERT_TRUE(std::holds_alternative<BadQuantity>(parsed));
    EXPECT_EQ(std::get<BadQuantity>(parsed).reason.find(c.reason), 0u) << std::get<BadQuantity>(parsed).reason;
  }
}

TEST(Units, BareAnglesAreDegreesAndOtherNumbersSi) {
  EXPECT_DOUBLE_EQ(from_bare(180.0, kinds::angle), std::numbers::pi);
  EXPECT_EQ(from_bare(180.0, kinds::length), 180.0);
  EXPECT_EQ(from_bare(180.0, kinds::number), 180.0);
}

}  // namespace
}  // namespace hawser
