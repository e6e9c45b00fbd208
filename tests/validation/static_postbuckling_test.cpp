// A clamped beam pushed together far beyond its Euler load, against the elastica (data/reference/buckling_elastica_postbuckling_pinned).
//
// A clamped column is four quarters of which a pinned one has two: with the same span and mid height over its length, it carries four times the
// load. The beam lies on a level frictionless bed under its own weight, which keeps it in the plane; the force along the chord and the
// shape do not feel the bed. Tolerance: twice the error that order 4 predicts from n and 2n elements, and the strain P/EA of the beam,
// ten times over, because the reference is inextensible.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/curve.hpp"
#include "tests/support/reference_case.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/static_solution.hpp"

namespace hawser::test {
namespace {

constexpr double L = 10.0, EI = 100.0, EA = 1.0e8, weight_per_metre = 50.0, bed = 5.0e3;

Model pushed(double span, int elements) {
  const double z = -20.0 - weight_per_metre / bed;
  SceneBuilder b;
  b.dry().type(line_type("beam", EA, weight_per_metre, EI)).fixed("a", {0, 0, z}).fixed("b", {span * L, 0, z}).line("a", "b");
  b.section("beam", L, elements).clamp_from({1, 0, 0}).clamp_to({1, 0, 0});
  b.scene.environment.depth = 20.0;
  b.scene.environment.seabed.stiffness = bed;
  return build_model(b.scene);
}

/// A shallow bow to one side: a start in which the beam need not choose.
State bowed(const Model& model) {
  State state = static_start(model, StaticStart::straight);
  const double bow = 0.03 * L;
  for (int i = 0; i < model.lines[0].nodes; ++i) {
    const double angle = 2.0 * std::numbers::pi * model.lines[0].s[i] / L;
    state.q[model.dof(0, i) + 1] += 0.5 * bow * (1.0 - std::cos(angle));
    state.q[model.dof(0, i) + 4] += std::numbers::pi * bow / L * std::sin(angle);
  }
  return state;
}

/// Load over the Euler load and mid height over the length, at every span in turn.
std::vector<double> push_together(const Table& table, std::size_t rows, int elements) {
  CurveWay way{[&](double p) { return std::optional<Model>(pushed(p, elements)); }, {}};
  for (std::size_t i = 0; i < rows; ++i) way.values.push_back(table[i][2]);
  StaticCurve curve(way);
  std::vector<double> values;
  for (std::size_t i = 0; i < rows; ++i) {
    const Model model = pushed(table[i][2], elements);
    State state = bowed(model);
    StaticOptions options;
    options.start = StaticStart::given;
    const CurveReport report = curve.next(Assembler(model), table[i][2], options, state);
    EXPECT_TRUE(report.statics.converged) << "at " << table[i][0] << " degrees: " << report.statics.failure.what;
    EXPECT_EQ(report.branch, 1) << "at " << table[i][0] << " degrees";
    EXPECT_TRUE(report.passed.empty());  // pushed by its span the elastica has no fold
    const double euler = 4.0 * std::numbers::pi * std::numbers::pi * EI / (L * L);
    values.push_back(std::abs(observe_line(model, state, 0).force_to.x()) / euler);
    values.push_back(std::abs(state.q[model.dof(0, elements / 2) + 1]) / L);
  }
  return values;
}

TEST(PostBuckling, AColumnPushedTogetherFollowsTheElastica) {
  const Table table = ReferenceCase("buckling_elastica_postbuckling_pinned").value<Table>("table");
  const std::size_t rows = 7;  // to an end angle of 100 degrees, with the ends at 35 % of the length
  const Numbers got = refined([&](int n) { return push_together(table, rows, n); }, 32);
  for (std::size_t i = 0; i < rows; ++i) {
    const double strain = 4.0 * std::pow(std::numbers::pi / L, 2) * EI * table[i][1] / EA;
    const auto check = [&](std::size_t column, std::size_t k, double sensitivity) {
      const double tolerance = got.error[k] + 10.0 * strain * sensitivity;
      EXPECT_LT(tolerance, 1e-3) << table[i][0];
      EXPECT_NEAR(got.value[k], table[i][column], tolerance) << table[i][0];
    };
    check(1, 2 * i, 1.0);
    check(3, 2 * i + 1, 1.0 / table[i][3]);  // near the Euler load height^2 answers to the span: a strain moves it by strain/height
  }
}

}  // namespace
}  // namespace hawser::test
