// Lines in a current and behind a ship against independent solutions (data/reference/static_current_*, static_tow_*,
// static_S2_initial_state, static_laying_zero_bottom_tension). Drag is per UNSTRETCHED length: the values named so are used.
//
// Tolerance: the largest of what the file asks, twice the error that order 4 predicts from n and 2n elements, and rounding
// (2 F_floor of theory 6.1 in forces; f L / (4 T) in positions). Each test also bounds the tolerance itself.
#include <gtest/gtest.h>

#include "tests/support/reference_case.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/static_solution.hpp"

namespace hawser::test {
namespace {

const std::string unstretched = " [drag per unstretched length]";

struct Noise {
  double force = 0.0, position = 0.0;  // N, m
  void add(const StaticSolution& s, double least_tension) {
    force = std::max(force, 2.0 * s.report.roundoff_floor);
    position = std::max(position, 0.25 * force * s.model->lines[0].length / least_tension);
  }
};

void expect(const char* what, double got, double expected, double tolerance, double largest) {
  EXPECT_LE(tolerance, largest) << what;
  EXPECT_NEAR(got, expected, tolerance) << what;
}

class FixedEnds : public ::testing::TestWithParam<const char*> {
 protected:
  static void add_current(const std::string& name, SceneBuilder& b) {
    if (name == "static_current_uniform_fixed_ends") b.current(0.0, {0.5, 0, 0});
    if (name == "static_current_crossflow_fixed_ends") b.current(0.0, {0, 0.6, 0});
    // linear in z, also below the lower end: u_x = 0.2 + 0.8 (1 + z/3000)
    if (name == "static_current_linear_shear_fixed_ends") b.current(0.0, {1.0, 0, 0}).current(-6000.0, {-0.6, 0, 0});
  }
};

TEST_P(FixedEnds, EndForcesAndStationsMeetTheReference) {
  const std::string name = GetParam();
  const ReferenceCase reference(name);
  Noise noise;
  const auto values = [&](int n) {
    SceneBuilder b;
    b.type(u40()).fixed("a", {0, 0, -3000}).fixed("b", {3000, 0, 0}).line("a", "b").section("U40", 5000.0, n);
    add_current(name, b);
    const StaticSolution s(b.scene);
    noise.add(s, s.line.tension_from);
    // what the line exerts on its `from` point is its internal force there, on `to` the opposite
    std::vector<double> v{s.line.force_from.x(), s.line.force_from.y(), s.line.force_from.z(),
                          -s.line.force_to.x(),  -s.line.force_to.y(),  -s.line.force_to.z()};
    for (int k = 0; k <= 10; ++k)
      for (const double x : s.station(500.0 * k).position) v.push_back(x);
    return v;
  };
  const Numbers got = refined(values, 500);
  const auto stations = reference.value<Table>("stations s/L=0..1 step .1: [Tx,Ty,Tz,x,y,z]" + unstretched);
  for (int k = 0; k < 3; ++k) {
    const double asked = reference.tolerance("force vector at sL" + unstretched, 0.0);
    expect("force at s = 0", got.value[k], stations.front()[k], std::max({asked, got.error[k], noise.force}), 1e-4);
    expect("force at s = L", got.value[3 + k], stations.back()[k], std::max({asked, got.error[3 + k], noise.force}), 1e-4);
  }
  for (std::size_t i = 6; i < got.value.size(); ++i)
    expect("position", got.value[i], stations[(i - 6) / 3][3 + (i - 6) % 3], std::max({1e-6, got.error[i], noise.position}), 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Static, FixedEnds,
                         ::testing::Values("static_current_uniform_fixed_ends", "static_current_crossflow_fixed_ends",
                                           "static_current_linear_shear_fixed_ends"),
                         [](const auto& test) { return std::string(test.param).substr(15); });

/// A body towed at U in +x through still water.
struct Tow {
  ReferenceCase reference;
  double U, L;
  LineType type;
  BodySpec body;

  explicit Tow(const std::string& name) : reference(name), U(reference.parameter("U")), L(reference.parameter("L")), type(u40()) {
    type.name = "tow";
    type.wet_weight = reference.parameter("w").get<double>();
    type.diameter = reference.parameter("d");
    type.drag_normal = reference.parameter("Cdn");
    type.drag_tangential = reference.parameter("Cdt");
    body.wet_weight = reference.parameter("body_wet_weight").get<double>();
    body.drag_area = reference.parameter("body_CdA");
  }

  /// Top tension and force, depth and layback, then x, z, T of the stations from the body.
  std::vector<double> values(double EA, int n) {
    type.EA = EA;
    const StaticSolution s(SceneBuilder()
                               .type(type)
                               .towed("ship", {0, 0, 0}, {U, 0, 0})
                               .free("body", {-0.9 * L, 0, -0.3 * L}, body)
                               .line("body", "ship")
                               .section("tow", L, n)
                               .scene);
    noise.add(s, s.line.tension_from);
    const Vec3 tail = s.station(0.0).position;
    std::vector<double> v{s.line.tension_to, -s.line.force_to.x(), -s.line.force_to.z(), -tail.z(), -tail.x()};
    for (int k = 0; k <= 10; ++k) {
      const Station station = s.station(0.1 * k * L);
      v.insert(v.end(), {station.position.x() - tail.x(), station.position.z() - tail.z(), station.tension});
    }
    return v;
  }

  void compare(const Numbers& got, const std::string& variant, double force_bound, double position_bound) const {
    const auto T = reference.value<std::vector<double>>("top Tx,Tz" + variant);
    const double expected[] = {reference.value("top tension" + variant), T[0], T[1], reference.value("depth of tow (top z - body z)" + variant),
                               reference.value("layback (top x - body x)" + variant)};
    for (int i = 0; i < 5; ++i) {
      const double tolerance = std::max({1e-14 * expected[i], got.error[i], i < 3 ? noise.force : noise.position});
      expect("top", got.value[i], expected[i], tolerance, i < 3 ? force_bound : position_bound);
    }
    const auto stations = reference.value<Table>("stations [s from body, x, z, T]" + variant);
    for (int k = 0; k <= 10; ++k)
      for (int i = 0; i < 3; ++i) {
        const std::size_t at = 5 + 3 * k + i;
        expect("station", got.value[at], stations[k][1 + i], std::max({1e-8, got.error[at], i < 2 ? noise.position : noise.force}),
               i < 2 ? position_bound : force_bound);
      }
  }

  Noise noise;
};

TEST(StaticTow, NeutralElasticCableMeetsTheReference) {
  Tow tow("static_tow_neutral_cable_elastic");
  tow.compare(refined([&](int n) { return tow.values(2.0e6, n); }, 800), unstretched, 1e-4, 1e-4);
}

TEST(StaticTow, NeutralInextensibleCableMeetsTheReference) {
  Tow tow("static_tow_neutral_cable_inext");
  tow.compare(inextensible([&](double EA) { return refined([&](int n) { return tow.values(EA, n); }, 800); }, 1e8), "", 1e-3, 1e-3);
}

TEST(StaticTow, HeavyInextensibleCableMeetsTheReference) {
  Tow tow("static_tow_heavy_cable_inext");
  tow.compare(inextensible([&](double EA) { return refined([&](int n) { return tow.values(EA, n); }, 1600); }, 1e9), "", 1e-2, 1e-2);
}

TEST(StaticTow, InitialStateOfSceneS2MeetsTheReference) {
  const ReferenceCase reference("static_S2_initial_state");
  Noise noise;
  const auto values = [&](int n) {
    const StaticSolution s(SceneBuilder()
                               .type(u40())
                               .current(0.0, {0.5, 0, 0})
                               .fixed("top", {0, 0, 0})
                               .free("clump", {0, 0, -4000}, weight(15000.0))
                               .line("top", "clump")
                               .section("U40", 4000.0, n)
                               .scene);
    noise.add(s, 15000.0);
    const Vec3 clump = s.station(4000.0).position;
    std::vector<double> v{s.line.tension_from, std::abs(s.line.force_from.x()), std::abs(s.line.force_from.z()), -clump.z(), clump.x()};
    for (int k = 0; k <= 10; ++k) v.push_back(s.station(4000.0 - 400.0 * k).tension);
    return v;
  };
  const Numbers got = refined(values, 200);
  const auto T = reference.value<std::vector<double>>("top Tx,Tz" + unstretched);
  const double expected[] = {reference.value("top tension" + unstretched), T[0], T[1], reference.value("depth of tow (top z - body z)" + unstretched),
                             reference.value("layback (top x - body x)" + unstretched)};
  for (int i = 0; i < 5; ++i)
    expect("top", got.value[i], expected[i], std::max({1e-14 * expected[i], got.error[i], i < 3 ? noise.force : noise.position}), 1e-4);
  const auto stations = reference.value<Table>("stations [s from body, x, z, T]" + unstretched);
  for (int k = 0; k <= 10; ++k) expect("tension", got.value[5 + k], stations[k][3], std::max({1e-8, got.error[5 + k], noise.force}), 1e-3);
}

TEST(StaticTow, TowThroughAPowerLawCurrentMeetsTheReference) {
  const ReferenceCase reference("static_tow_powerlaw_shear");
  // The current is a table of 2 m rows, linear between them: off by at most h^2/8 max|u''| = 0.5 * 9.4e-9 * 0.8 m/s here
  // (|u''| = 0.8 (1/7)(6/7) (1 + z/3500)^(-13/7) / 3500^2), 3e-9 of the relative flow of 2.3 m/s. Drag follows twice over:
  // 6e-9 of forces up to 35 kN and of depths up to 940 m, taken four times.
  constexpr double table = 4.0 * 6e-9;
  Noise noise;
  BodySpec body = weight(5000.0);
  body.drag_area = 1.0;
  const auto values = [&](int n) {
    SceneBuilder b;
    for (double z = -1200.0; z <= 0.0; z += 2.0) b.current(z, {-0.8 * std::pow((z + 3500.0) / 3500.0, 1.0 / 7.0), 0, 0});
    b.type(u40()).towed("ship", {0, 0, 0}, {1.5, 0, 0}).free("body", {-2800, 0, -900}, body).line("body", "ship").section("U40", 3000.0, n);
    const StaticSolution s(b.scene);
    noise.add(s, s.line.tension_from);
    const Vec3 tail = s.station(0.0).position;
    return std::vector<double>{s.line.tension_from, s.line.tension_to, -s.line.force_to.x(), -s.line.force_to.z(), tail.x(), tail.z()};
  };
  const Numbers got = refined(values, 1600);
  const auto position = reference.value<std::vector<double>>("body position" + unstretched);
  const auto force = reference.value<std::vector<double>>("force vector at top (on the cable end, Tx,Ty,Tz)" + unstretched);
  const double expected[] = {
      reference.value("T_body" + unstretched), reference.value("T_top" + unstretched), force[0], force[2], position[0], position[2]};
  for (int i = 0; i < 6; ++i) {
    const double tolerance = std::max({1e-6, got.error[i], i < 4 ? noise.force + table * 35e3 : noise.position + table * 3000.0});
    expect("tow", got.value[i], expected[i], tolerance, 2e-3);
  }
}

TEST(StaticTow, CableLaidWithoutBottomTensionLiesStraightAtTheCriticalAngle) {
  const ReferenceCase reference("static_laying_zero_bottom_tension");
  const double L = reference.value("suspended length"), angle = reference.value("critical angle from horizontal");
  LineType type = u40();
  type.drag_tangential = 0.0;
  for (const int n : {3, 100}) {
    const StaticSolution s(SceneBuilder()
                               .type(type)
                               .current(0.0, {reference.parameter("U").get<double>(), 0, 0})
                               .fixed("ship", {0, 0, 0})
                               .free("tail", {4000, 0, -2000})
                               .line("ship", "tail")
                               .section("U40", L, n)
                               .scene);
    // A straight line with linear tension lies in the space of the elements, and since weight and drag act per unstretched
    // length its tension does not depend on EA: only rounding is left. A transverse noise f turns the line by f/(w l) at
    // its free end, where nothing but the weight of an element holds it.
    const double noise = 2.0 * s.report.roundoff_floor;
    EXPECT_NEAR(s.line.tension_from, reference.value("top tension"), noise + 1e-14 * 23770.0) << n;
    const Vec3 chord = s.station(L).position;
    EXPECT_NEAR(std::atan2(-chord.z(), chord.x()), angle, noise / (11.885 * L / n) + 1e-15) << n;
  }
}

}  // namespace
}  // namespace hawser::test
