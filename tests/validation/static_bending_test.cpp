// Beams against the elastica, tensioned beams and stiff catenaries (data/reference/static_elastica_*,
// static_heavy_elastica_horizontal, static_tensioned_beam_*, static_stiff_catenary_*, static_slay_overbend_like).
//
// Tolerance: the largest of what the file asks, the error that order 4 predicts from n and 2n elements (twice that; where
// the reference is inextensible, with the remainder of the extrapolation to EA = infinity), and rounding. Axial rounding is
// F_floor (theory 6.1) at a node; it moves a beam by no more than F_floor l / EA along itself, and across itself by the
// deflection of a beam under F_floor, F_floor L^3 / (3 EI). Each test also bounds the tolerance itself.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/reference_case.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/static_solution.hpp"

namespace hawser::test {
namespace {

void expect(const char* what, double got, double expected, double tolerance, double largest) {
  EXPECT_LE(tolerance, largest) << what;
  EXPECT_NEAR(got, expected, tolerance) << what;
}

/// Cantilever of length 1 along +x; weight w or a force P down at the tip, or a moment M about -y (turning down).
struct Cantilever {
  double EA, EI = 1.0, w = 0.0, P = 0.0, M = 0.0;

  Scene scene(int n) const {
    SceneBuilder b;
    b.dry().type(line_type("beam", EA, w, EI)).fixed("clamp", {0, 0, 0}).free("tip", {1, 0, -0.2}, force({0, 0, -P}));
    b.line("clamp", "tip", ModelChoice::beam).section("beam", 1.0, n).clamp_from({1, 0, 0});
    if (M != 0.0) {
      LoadSpec moment;
      moment.at = 1.0;
      moment.body.wet_weight = 0.0;
      moment.moment.constant = {0, M, 0};
      b.scene.lines.back().loads.push_back(moment);
    }
    return b.scene;
  }

  /// The start: straight, or the arc of a circle where an end moment bends it.
  ShapeTable arc() const {
    ShapeTable table;
    for (double s = 0.0; s < 1.0005; s += 1.0 / 64.0) {
      table.s.push_back(s);
      table.position.push_back({std::sin(M / EI * s) * EI / M, 0.0, (std::cos(M / EI * s) - 1.0) * EI / M});
    }
    return table;
  }

  /// Tip angle below the horizontal, tip x, tip drop, clamp moment.
  std::vector<double> values(int n) {
    Scene problem = scene(n);
    if (M != 0.0) problem.lines[0].start = arc();
    const StaticSolution s(problem, M != 0.0 ? StaticStart::given : StaticStart::straight);
    noise = std::max(noise, s.report.roundoff_floor / (3.0 * EI));
    const Vec3 tip = s.station(1.0).position, slope = s.slope(s.last_node());
    return {std::atan2(-slope.z(), slope.x()), tip.x(), -tip.z(), s.line.moment_from.norm()};
  }

  double noise = 0.0;
};

TEST(StaticElastica, ExtensibleCantileverUnderTipForceMeetsTheReference) {
  const ReferenceCase reference("static_elastica_extensible_tipforce");
  for (const auto& row : reference.value<Table>("table")) {
    Cantilever cantilever{row[1], 1.0, 0.0, row[0]};
    const Numbers got = refined([&](int n) { return cantilever.values(n); }, 64);
    for (int i = 0; i < 3; ++i) expect("tip", got.value[i], row[2 + i], std::max({1e-14, got.error[i], cantilever.noise}), i == 0 ? 1e-6 : 1e-7);
  }
}

TEST(StaticElastica, InextensibleCantileverUnderTipForceMeetsTheTable) {
  const ReferenceCase reference("static_elastica_cantilever_tipforce");
  const auto load = reference.parameter("PL2_over_EI").get<std::vector<double>>();
  const auto angle = reference.value<std::vector<double>>("tip_angle"), x = reference.value<std::vector<double>>("tip_x/L (along undeformed axis)");
  const auto y = reference.value<std::vector<double>>("tip_y/L (Mattiasson w/L)"),
             moment = reference.value<std::vector<double>>("clamp_moment ML/EI");
  for (std::size_t k = 0; k < load.size(); ++k) {
    double noise = 0.0;
    const auto elastic = [&](double EA) {
      Cantilever cantilever{EA, 1.0, 0.0, load[k]};
      const Numbers numbers = refined([&](int n) { return cantilever.values(n); }, 64);
      noise = std::max(noise, cantilever.noise);
      return numbers;
    };
    const Numbers got = inextensible(elastic, 1e6 * load[k]);
    const double expected[] = {angle[k], x[k], y[k], moment[k]};
    for (int i = 0; i < 4; ++i)
      expect("tip", got.value[i], expected[i], std::max({1e-14 * std::abs(expected[i]), got.error[i], noise}), 1e-4 * std::max(1.0, 0.01 * load[k]));
  }
}

TEST(StaticElastica, TipMomentBendsACantileverIntoTheArcOfACircle) {
  const ReferenceCase reference("static_elastica_tip_moment");
  const auto turns = reference.parameter("ML_over_2piEI").get<std::vector<double>>();
  const auto x = reference.value<std::vector<double>>("tip_x/L"), y = reference.value<std::vector<double>>("tip_y/L");
  for (std::size_t k = 0; k < turns.size(); ++k) {  // up to two turns
    Cantilever cantilever{1e6, 1.0, 0.0, 0.0, 2.0 * std::numbers::pi * turns[k]};
    const Numbers got = refined([&](int n) { return cantilever.values(n); }, 128);
    expect("x", got.value[1], x[k], std::max({1e-15, got.error[1], cantilever.noise}), 1e-6);
    expect("y", got.value[2], y[k], std::max({1e-15, got.error[2], cantilever.noise}), 1e-6);
    // The clamp carries the moment exactly: rounding F_floor along the line, times its length.
    expect("moment", got.value[3], cantilever.M, std::max(got.error[3], 3.0 * cantilever.noise), 1e-6);
  }
}

TEST(StaticElastica, HeavyCantileverMeetsTheReference) {
  const ReferenceCase reference("static_heavy_elastica_horizontal");
  for (const auto& row : reference.value<Table>("table")) {
    const double K = row[0];
    double noise = 0.0;
    const auto elastic = [&](double EA) {
      Cantilever cantilever{EA, 1.0, K};
      const Numbers numbers = refined([&](int n) { return cantilever.values(n); }, K > 200.0 ? 256 : 64);
      noise = std::max(noise, cantilever.noise);
      return numbers;
    };
    const Numbers got = inextensible(elastic, 1e5 * K);
    for (int i = 0; i < 4; ++i)
      expect("tip", got.value[i], row[1 + i], std::max({1e-13 * row[1 + i], got.error[i], noise}), 1e-4 * std::max(1.0, 0.01 * K));
  }
}

class TensionedBeam : public ::testing::TestWithParam<std::pair<const char*, int>> {};

TEST_P(TensionedBeam, DeflectionAndClampMomentMeetTheLinearReference) {
  const ReferenceCase reference(GetParam().first);
  const int n = GetParam().second;
  const double T = reference.parameter("T"), EI = reference.parameter("EI"), L = reference.parameter("L"), q = reference.parameter("q");
  // The reference is linear in q. Scaled by 1e-3 the slopes are |w'| <= 4 w/L < 1e-4 and the tension changes by EA w'^2/6,
  // below 2e-8 T for EA = 10 T.
  const double scale = 1e-3, EA = 10.0 * T, nonlinear = 2e-8;
  const auto values = [&](int elements) {
    const double unstretched = L / (1.0 + T / EA);
    SceneBuilder b;
    // q acts per stretched length here, the weight per unstretched one; and kappa is per unstretched length, so that the
    // bending energy of w(x) is EI stretch w''^2/2 dx and the moment EI stretch w''.
    const double stretch = 1.0 + T / EA;
    b.dry().type(line_type("beam", EA, q * scale * stretch, EI / stretch)).fixed("a", {0, 0, 0}).fixed("b", {L, 0, 0});
    b.line("a", "b", ModelChoice::beam).section("beam", unstretched, elements).clamp_from({1, 0, 0}).clamp_to({1, 0, 0});
    const StaticSolution s(b.scene);
    std::vector<double> v{s.line.moment_from.norm() / scale};
    for (const double x : reference.value<std::vector<double>>("x")) v.push_back(-s.station(x / stretch).position.z() / scale);
    return v;
  };
  const Numbers got = refined(values, n);
  const auto w = reference.value<std::vector<double>>("w(x)");
  const double moment = reference.value("clamp moment EI w''(0)"), middle = reference.value("w(L/2)");
  expect("moment", got.value[0], moment, got.error[0] + nonlinear * moment, 1e-3 * moment);
  for (std::size_t i = 0; i < w.size(); ++i) expect("w", got.value[1 + i], w[i], got.error[1 + i] + nonlinear * middle, 1e-6 * middle);
}

INSTANTIATE_TEST_SUITE_P(Static, TensionedBeam,
                         ::testing::Values(std::pair{"static_tensioned_beam_U40", 4000}, std::pair{"static_tensioned_beam_low", 100},
                                           std::pair{"static_tensioned_beam_boundary_layer", 4000}),
                         [](const auto& test) { return std::string(test.param.first).substr(22); });

TEST(StaticTensionedBeam, PointForceAtMidspanMeetsTheLinearReference) {
  const ReferenceCase reference("static_tensioned_beam_midforce");
  const double T = reference.parameter("T"), EI = reference.parameter("EI"), L = reference.parameter("L"), P = reference.parameter("P");
  const double scale = 1e-3, EA = 10.0 * T, stretch = 1.0 + T / EA, nonlinear = 2e-8;
  const auto values = [&](int n) {
    const double unstretched = L / stretch;
    SceneBuilder b;
    b.dry().type(line_type("beam", EA, 0.0, EI / stretch)).fixed("a", {0, 0, 0}).fixed("b", {L, 0, 0}).line("a", "b", ModelChoice::beam);
    b.section("beam", unstretched, n).clamp_from({1, 0, 0}).clamp_to({1, 0, 0}).load(0.5 * unstretched, weight(scale * P));
    const StaticSolution s(b.scene);
    return std::vector<double>{-s.station(0.5 * unstretched).position.z() / scale, s.line.moment_from.norm() / scale};
  };
  const Numbers got = refined(values, 4000);
  const double w = reference.value("w(L/2)"), moment = reference.value("clamp moment");
  expect("w", got.value[0], w, got.error[0] + nonlinear * w, 1e-6 * w);
  expect("moment", got.value[1], moment, got.error[1] + nonlinear * moment, 1e-3 * moment);
}

class StiffCatenary : public ::testing::TestWithParam<std::pair<const char*, int>> {};

TEST_P(StiffCatenary, EndForcesMomentsAndStationsMeetTheReference) {
  const ReferenceCase reference(GetParam().first);
  const double EI = reference.parameter("EI"), w = reference.parameter("w"), L = reference.parameter("L");
  const Vec3 from = vector(reference.parameter("end0")), to = vector(reference.parameter("end1"));
  const auto angle = reference.parameter("end_angles").get<std::vector<double>>();
  const double T = std::max(reference.value("force magnitude end0"), reference.value("force magnitude end1")), H = reference.value("H");
  double noise = 0.0;
  const auto elastic = [&](double EA) {
    const auto values = [&](int n) {
      SceneBuilder b;
      b.dry().type(line_type("beam", EA, w, EI)).fixed("a", from).fixed("b", to).line("a", "b", ModelChoice::beam).section("beam", L, n);
      b.clamp_from({std::cos(angle[0]), 0, std::sin(angle[0])}).clamp_to({std::cos(angle[1]), 0, std::sin(angle[1])});
      const StaticSolution s(b.scene);
      noise = std::max(noise, 2.0 * s.report.roundoff_floor);
      std::vector<double> v{s.line.tension_from, s.line.tension_to, std::abs(s.line.force_from.x()), s.line.moment_from.norm(),
                            s.line.moment_to.norm()};
      for (int k = 0; k <= 10; ++k) {
        const Vec3 r = s.station(0.1 * k * L).position;
        v.insert(v.end(), {r.x(), r.z()});
      }
      return v;
    };
    return refined(values, GetParam().second);
  };
  const Numbers got = inextensible(elastic, 1e5 * T);
  const double expected[] = {reference.value("force magnitude end0"), reference.value("force magnitude end1"), H,
                             std::abs(reference.value("moment EI*kappa end0")), std::abs(reference.value("moment EI*kappa end1"))};
  const double layer = std::sqrt(EI / T);  // a force error turns the tangent at the clamp by noise/T: moment sqrt(EI T) noise/T
  for (int i = 0; i < 5; ++i)
    expect("end", got.value[i], expected[i], std::max({1e-11 * expected[i], got.error[i], i < 3 ? noise : noise * layer}), 1e-5 * expected[i]);
  const auto x = reference.value<std::vector<double>>("x"), z = reference.value<std::vector<double>>("z");
  for (int k = 0; k <= 10; ++k) {
    expect("x", got.value[5 + 2 * k], x[k], std::max({1e-9, got.error[5 + 2 * k], 0.25 * noise * L / H}), 1e-5 * L);
    expect("z", got.value[6 + 2 * k], z[k], std::max({1e-9, got.error[6 + 2 * k], 0.25 * noise * L / H}), 1e-5 * L);
  }
}

INSTANTIATE_TEST_SUITE_P(Static, StiffCatenary,
                         ::testing::Values(std::pair{"static_stiff_catenary_clamped_horizontal", 2000},
                                           std::pair{"static_stiff_catenary_pinnedlike_strongEI", 100}, std::pair{"static_slay_overbend_like", 2000}),
                         [](const auto& test) { return std::string(test.param.first).substr(7); });

}  // namespace
}  // namespace hawser::test
