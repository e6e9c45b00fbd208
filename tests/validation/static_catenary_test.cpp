// Elastic catenaries against their closed form (data/reference/static_catenary_*, static_vertical_hang_clump,
// static_lazywave_three_segments).
//
// Tolerance of every comparison: the largest of
//   - what the reference file asks,
//   - the discretisation error that order 4 predicts from the change between n and 2n elements (twice that),
//   - rounding: residuals up to the floor of theory 6.1, F_floor, are left at the nodes. The end force adds up n of them
//     with random signs, so force_noise = 2 F_floor; a residual f moves a node by about f L / (4 T), position_noise likewise.
// Each test also bounds the tolerance itself, so that it cannot grow unnoticed.
#include <gtest/gtest.h>

#include "tests/support/reference_case.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/static_solution.hpp"

namespace hawser::test {
namespace {

struct CatenaryCase {
  ReferenceCase reference;
  double L, w;
  Vec3 from, to;

  explicit CatenaryCase(const std::string& name)
      : reference(name),
        L(reference.parameter("L0")),
        w(reference.parameter("w")),
        from(vector(reference.parameter("end_s0"))),
        to(vector(reference.parameter("end_sL0"))) {}

  bool elastic() const { return reference.parameter("EA").is_number(); }
  double tension() const { return std::max(reference.value("T_end_s0"), reference.value("T_end_sL0")); }

  Scene scene(double EA, int n) const {
    return SceneBuilder().dry().type(line_type("cable", EA, w)).fixed("a", from).fixed("b", to).line("a", "b").section("cable", L, n).scene;
  }

  /// T at both ends, H, then x, z, T of the stations.
  std::vector<double> values(double EA, int n) {
    const StaticSolution solution(scene(EA, n));
    noise = std::max(noise, 2.0 * solution.report.roundoff_floor);
    const auto stations = solution.stations(reference.value<std::vector<double>>("stations_s"));
    std::vector<double> result{solution.line.tension_from, solution.line.tension_to, solution.line.force_from.head<2>().norm()};
    for (const Station& s : stations) result.insert(result.end(), {s.position.x(), s.position.z(), s.tension});
    return result;
  }

  double noise = 0.0;  // N, of forces
};

struct CatenaryTest {
  const char* name;
  int n;            // coarse mesh; the values are those of 2n
  double EA_ratio;  // EA over the largest tension, where the reference is inextensible
  double largest;   // bound on the tolerance of forces, relative to the largest tension
};

class Catenary : public ::testing::TestWithParam<CatenaryTest> {};

TEST_P(Catenary, EndForcesAndStationsMeetTheClosedForm) {
  CatenaryCase c(GetParam().name);
  const auto [name_of_case, n, EA_ratio, largest_relative] = GetParam();
  const auto elastic = [&, coarse = n](double EA) { return refined([&](int elements) { return c.values(EA, elements); }, coarse); };
  const Numbers got = c.elastic() ? elastic(c.reference.parameter("EA")) : inextensible(elastic, EA_ratio * c.tension());
  const double T = c.tension(), position_noise = 0.25 * c.noise * c.L / c.reference.value("H");

  const auto check = [&](const char* name, std::size_t i, double expected, double noise, double largest) {
    const double tolerance = std::max({c.reference.tolerance(name, expected), got.error[i], noise});
    EXPECT_LE(tolerance, largest) << name;
    EXPECT_NEAR(got.value[i], expected, tolerance) << name;
  };
  check("T_end_s0", 0, c.reference.value("T_end_s0"), c.noise, largest_relative * T);
  check("T_end_sL0", 1, c.reference.value("T_end_sL0"), c.noise, largest_relative * T);
  check("H", 2, c.reference.value("H"), c.noise, largest_relative * T);
  const auto x = c.reference.value<std::vector<double>>("stations_x"), z = c.reference.value<std::vector<double>>("stations_z");
  const auto tension = c.reference.value<std::vector<double>>("stations_T");
  for (std::size_t i = 0; i < x.size(); ++i) {
    check("stations_x", 3 + 3 * i, x[i], position_noise, 10.0 * largest_relative * c.L);
    check("stations_z", 4 + 3 * i, z[i], position_noise, 10.0 * largest_relative * c.L);
    check("stations_T", 5 + 3 * i, tension[i], c.noise, 10.0 * largest_relative * T);
  }
}

// The taut level span of 100.1 m over 100 m is sensitive: its tension falls by (T/EA)/(L/c - 1) relative when it may stretch.
INSTANTIATE_TEST_SUITE_P(Static, Catenary,
                         ::testing::Values(CatenaryTest{"static_catenary_deep5000_sceneS1", 500, 0, 1e-9},
                                           CatenaryTest{"static_catenary_deep5000_w11885", 500, 0, 1e-9},
                                           CatenaryTest{"static_catenary_inclined_elastic", 160, 0, 1e-9},
                                           CatenaryTest{"static_catenary_inclined_inext", 160, 1e5, 1e-6},
                                           CatenaryTest{"static_catenary_inclined_taut_elastic", 80, 0, 1e-9},
                                           CatenaryTest{"static_catenary_level_slack_L101_inext", 1600, 1e4, 1e-7},
                                           CatenaryTest{"static_catenary_level_taut_elastic", 80, 0, 1e-9},
                                           CatenaryTest{"static_catenary_level_taut_inext", 80, 1e6, 1e-5}),
                         [](const auto& test) { return std::string(test.param.name).substr(16); });

TEST(StaticCatenary, SagOfFiveSpansHasItsClosedForm) {
  const ReferenceCase reference("static_catenary_sagratio5_exact_inext");
  const double L = reference.value("L"), H = reference.value("H"), T = reference.value("T_end");
  const double w = reference.parameter("w"), span = reference.parameter("span"), sag = reference.parameter("sag");
  double noise = 0.0;
  const auto values = [&](double EA, int n) {
    const StaticSolution s(SceneBuilder()
                               .dry()
                               .type(line_type("cable", EA, w))
                               .fixed("a", {0, 0, 0})
                               .fixed("b", {span, 0, 0})
                               .line("a", "b")
                               .section("cable", L, n)
                               .scene);
    noise = std::max(noise, 2.0 * s.report.roundoff_floor);
    return std::vector<double>{s.line.tension_from, s.line.force_from.head<2>().norm(), -s.station(0.5 * L).position.z()};
  };
  const Numbers got = inextensible([&](double EA) { return refined([&](int n) { return values(EA, n); }, 1600); }, 1e4 * T);
  const double expected[] = {T, H, sag}, largest[] = {1e-7 * T, 2e-6 * H, 1e-5 * sag};
  for (int i = 0; i < 3; ++i) {
    const double tolerance = std::max({1e-15 * expected[i], got.error[i], i < 2 ? noise : 0.25 * noise * L / H});
    EXPECT_LE(tolerance, largest[i]) << i;
    EXPECT_NEAR(got.value[i], expected[i], tolerance) << i;
  }
}

TEST(StaticCatenary, VerticalLineWithClumpHasItsClosedFormOnAnyMesh) {
  const ReferenceCase reference("static_vertical_hang_clump");
  const double L = reference.parameter("L0"), EA = reference.parameter("EA"), P = reference.parameter("P_bottom");
  LineType type = line_type("cable", EA, reference.parameter("w"));
  for (const int n : {1, 7, 200}) {
    const StaticSolution s(
        SceneBuilder().dry().type(type).fixed("a", {0, 0, 0}).free("b", {0, 0, -L}, weight(P)).line("a", "b").section("cable", L, n).scene);
    // The solution is quadratic in s and lies in the space of the elements: only rounding is left. Positions: a force error
    // f stretches the line by f L/EA, less than 4 eps of its length.
    const double noise = 2.0 * s.report.roundoff_floor, position = 4.0 * 2.3e-16 * L + noise * L / EA;
    EXPECT_NEAR(s.line.tension_from, reference.value("T_top"), noise + 1e-15 * 62540.0) << n;
    EXPECT_NEAR(s.station(L).position.z(), reference.value("z_bottom"), position) << n;
    const auto z = reference.value<std::vector<double>>("z_at_s=1000,2000,3000 from top");
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(s.station(1000.0 * (k + 1)).position.z(), z[k], position) << n;
  }
}

TEST(StaticCatenary, LazyWaveOfThreeSectionsHasItsClosedForm) {
  const ReferenceCase reference("static_lazywave_three_segments");
  const auto& segments = reference.parameter("segments");
  double noise = 0.0;
  const auto values = [&](int n) {
    SceneBuilder b;
    b.dry().fixed("lower", vector(reference.parameter("lower"))).fixed("upper", vector(reference.parameter("upper"))).line("lower", "upper");
    for (int k = 0; k < 3; ++k) {
      const std::string name = "section" + std::to_string(k);
      b.type(line_type(name, segments[k]["EA"], segments[k]["w"])).section(name, segments[k]["L"], n);
    }
    const StaticSolution s(b.scene);
    noise = std::max(noise, 2.0 * s.report.roundoff_floor);
    const Station first = s.station(150.0), second = s.station(250.0);
    return std::vector<double>{s.line.tension_from, s.line.tension_to,  s.line.force_from.head<2>().norm(), first.position.x(), first.position.z(),
                               second.position.x(), second.position.z()};
  };
  const Numbers got = refined(values, 100);
  const auto joints = reference.value<Table>("joints and upper end [x,z,T]");
  const double H = reference.value("H"), T = joints[2][2];
  const double expected[] = {reference.value("T at lower end"), T, H, joints[0][0], joints[0][1], joints[1][0], joints[1][1]};
  for (int i = 0; i < 7; ++i) {
    const double tolerance = std::max({1e-13 * std::abs(expected[i]), got.error[i], i < 3 ? noise : 0.25 * noise * 370.0 / H});
    EXPECT_LE(tolerance, i < 3 ? 1e-7 * T : 1e-5) << i;
    EXPECT_NEAR(got.value[i], expected[i], tolerance) << i;
  }
}

}  // namespace
}  // namespace hawser::test
