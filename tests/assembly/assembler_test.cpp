#include "assembly/assembler.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cstdlib>
#include <random>

#include "assembly/element.hpp"
#include "assembly/observables.hpp"
#include "assembly/seabed.hpp"
#include "tests/support/scene_samples.hpp"
#include "tests/support/shaken_chords.hpp"

namespace hawser {
namespace {

/// A smooth random shape near the chord with velocities, accelerations and joint unknowns of their own.
State random_state(const Model& model, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  State s = test::shaken_chords(model, 1.02, random);
  for (double& v : s.v) v = u(random);
  for (double& a : s.a) a = u(random);
  model.reset_joints(s);
  for (std::size_t i = model.dofs; i < model.unknowns; ++i) s.q[i] += 0.05 * u(random);
  for (std::size_t i = model.dofs; i < model.unknowns; ++i) s.v[i] += 0.05 * u(random);
  return s;
}

struct Setup {
  const char* name;
  double EI_left, EI_right;
  ModelChoice model;
};

class AssemblerOf : public ::testing::TestWithParam<Setup> {
 protected:
  Scene scene(int elements = 150) const { return test::loaded_line(elements, GetParam().EI_left, GetParam().EI_right, GetParam().model); }
};

INSTANTIATE_TEST_SUITE_P(Families, AssemblerOf,
                         ::testing::Values(Setup{"bar", 0, 0, ModelChoice::bar}, Setup{"cable", 0, 0, ModelChoice::automatic},
                                           Setup{"beam", 500.0, 900.0, ModelChoice::automatic},
                                           Setup{"beam_and_cable", 500.0, 0.0, ModelChoice::automatic}),
                         [](const auto& setup) { return setup.param.name; });

/// Away from joints and bodies the node's residual is that of its two elements.
void expect_sum_of_elements(const Model& model, const State& state) {
  std::vector<double> swept(model.unknowns);
  Assembler(model).residual(state, swept);
  const Line& line = model.lines[0];
  double largest = 0.0;
  for (double r : swept) largest = std::max(largest, std::abs(r));
  for (int i = 1; i + 1 < line.nodes; ++i) {
    const auto near = [&](const Joint& j) { return std::abs(j.node - i) <= 1; };
    const auto here = [&](const Body& b) { return b.node == i; };
    if (std::any_of(model.joints.begin(), model.joints.end(), near) || std::any_of(model.bodies.begin(), model.bodies.end(), here)) continue;
    const Vector12 left = element_force(model, state, 0, i - 1), right = element_force(model, state, 0, i);
    const int b = model.chain(0).block;
    for (int c = 0; c < b; ++c) EXPECT_NEAR(swept[model.dof(0, i) + c], left[6 + c] + right[c], 1.0e-13 * largest) << "node " << i;
  }
}

TEST_P(AssemblerOf, ResidualIsTheSumOfItsElements) {
  const Model model = build_model(scene());
  expect_sum_of_elements(model, random_state(model, 1));
}

// Within a section panels read the properties of the one before them.
TEST_P(AssemblerOf, ResidualIsTheSumOfItsElementsInSectionsOfManyPanels) {
  const Model model = build_model(scene(700));
  expect_sum_of_elements(model, random_state(model, 3));
}

// The sweep looks at those rows of a profile that a panel can reach, an element by itself at all of them.
TEST_P(AssemblerOf, ResidualIsTheSumOfItsElementsInAProfileOfManyRows) {
  Scene many = scene();
  many.environment.current.clear();
  for (int k = 0; k < 40; ++k) many.environment.current.push_back({10.0 - 3.0 * k, 0.5 + 0.4 * std::sin(1.7 * k), 0.3 * k});
  const Model model = build_model(many);
  State state = random_state(model, 1);
  expect_sum_of_elements(model, state);
  for (std::size_t i = 2; i < model.dofs; i += model.chain(0).block)
    state.q[i] = 30.0 - 1.5 * (state.q[i] + 80.0);  // from above the first row to below the last
  expect_sum_of_elements(model, state);
}

// The linearised Newton step is exact: R(x + h d) - R(x - h d) over 2h equals the assembled derivative along d = -T^-1 R, so
// the residual falls to zero along it: dR/dh = -R. Central differences, h = 1e-5: truncation h^2 and rounding 1e-16/h of |R|.
TEST_P(AssemblerOf, CondensedTangentLinearisesTheWholeResidual) {
  const Model model = build_model(scene(20));
  const Assembler assembler(model);
  for (const TangentWeights& w : {TangentWeights{1.0, 0.0, 0.0}, TangentWeights{1.0, 30.0, 400.0}, TangentWeights{0.5, 0.0, 100.0}}) {
    State state = random_state(model, 2);
    model.prescribe(state);
    Tangent tangent = assembler.make_tangent();
    std::vector<double> r(model.unknowns), rhs(model.dofs), d(model.unknowns);
    assembler.tangent(state, w, TangentFloor{}, r, tangent);
    assembler.reduce(tangent, r, rhs);
    const std::size_t n = model.dofs;
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
    std::vector<double> e(n), column(n);
    for (std::size_t j = 0; j < n; ++j) {
      std::fill(e.begin(), e.end(), 0.0);
      e[j] = 1.0;
      tangent.chain.multiply(e, column);
      dense.col(j) = Eigen::Map<Eigen::VectorXd>(column.data(), n);
    }
    Eigen::VectorXd x = dense.fullPivLu().solve(Eigen::Map<Eigen::VectorXd>(rhs.data(), n));
    assembler.expand(tangent, std::span<const double>(x.data(), n), d);
    const auto moved = [&](double h) {
      State s = state;
      for (std::size_t i = 0; i < model.unknowns; ++i) {
        s.q[i] += h * w.stiffness * d[i];
        s.v[i] += h * w.damping * d[i];
        s.a[i] += h * w.mass * d[i];
      }
      std::vector<double> out(model.unknowns);
      assembler.residual(s, out);
      assembler.project(out);
      return out;
    };
    const double h = 1.0e-5;
    const auto plus = moved(h), minus = moved(-h);
    assembler.project(r);
    double largest = 0.0;
    for (double value : r) largest = std::max(largest, std::abs(value));
    for (std::size_t i = 0; i < model.unknowns; ++i)
      EXPECT_NEAR((plus[i] - minus[i]) / (2.0 * h), -r[i], 1.0e-5 * largest) << "unknown " << i << " of " << model.dofs;
  }
}

TEST_P(AssemblerOf, SameBitsForAnyNumberOfThreads) {
  const Model model = build_model(scene(serial_below + 500));
  const State state = random_state(model, 3);
  std::vector<std::vector<double>> residuals, values;
  for (int threads : {1, 2, 3, 7}) {
    const Assembler assembler(model, threads);
    Tangent t = assembler.make_tangent();
    std::vector<double> r(model.unknowns);
    assembler.tangent(state, {1.0, 20.0, 300.0}, TangentFloor{}, r, t);
    residuals.push_back(r);
    values.emplace_back(t.chain.values().begin(), t.chain.values().end());
    std::vector<double> alone(model.unknowns);
    assembler.residual(state, alone);
    residuals.push_back(alone);
  }
  for (std::size_t k = 2; k < residuals.size(); ++k) EXPECT_EQ(residuals[k], residuals[k % 2]);
  for (std::size_t k = 1; k < values.size(); ++k) EXPECT_EQ(values[k], values[0]);
}

TEST_P(AssemblerOf, EveryInstructionSetGivesTheSameNumbers) {
  const Model model = build_model(scene());
  const State state = random_state(model, 4);
  std::vector<std::vector<double>> residuals, values;
  for (const char* simd : {"base", "avx2", ""}) {
    setenv("HAWSER_SIMD", simd, 1);
    const Assembler assembler(model);
    Tangent t = assembler.make_tangent();
    std::vector<double> r(model.unknowns);
    assembler.tangent(state, {1.0, 20.0, 300.0}, TangentFloor{}, r, t);
    residuals.push_back(r);
    values.emplace_back(t.chain.values().begin(), t.chain.values().end());
  }
  unsetenv("HAWSER_SIMD");
  const auto expect_close = [](const std::vector<double>& a, const std::vector<double>& b) {
    double largest = 0.0;
    for (double x : a) largest = std::max(largest, std::abs(x));
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1.0e-13 * largest);  // rounding of different orders and fused products
  };
  for (int k : {1, 2}) {
    expect_close(residuals[0], residuals[k]);
    expect_close(values[0], values[k]);
  }
}

void expect_what_each_element_shows(const Model& model, const State& state) {
  const LineResult seen = observe_line(model, state, 0);
  double largest = 0.0, least = 1.0e300;
  for (double x : seen.tension_right) largest = std::max(largest, std::abs(x));
  std::vector<double> curvature(model.lines[0].nodes, 0.0);
  for (int i = 0; i < model.lines[0].elements; ++i) {
    const Observed<double> alone = observe_element(model, state, 0, i);
    EXPECT_NEAR(seen.tension_right[i], alone.tension[0], 1.0e-13 * largest) << i;  // rounding of fused products and of the root's estimate
    EXPECT_NEAR(seen.tension_left[i + 1], alone.tension[1], 1.0e-13 * largest) << i;
    for (int end = 0; end < 2; ++end) curvature[i + end] = std::max(curvature[i + end], alone.curvature[end]);
    for (double x : alone.strain_tension) least = std::min(least, x);
  }
  EXPECT_NEAR(seen.least_strain_tension, least, 1.0e-13 * model.element.EA[0]);
  for (std::size_t i = 0; i < curvature.size(); ++i) EXPECT_NEAR(seen.curvature[i], curvature[i], 1.0e-13 * seen.curvature_max) << i;
}

TEST_P(AssemblerOf, ObservedInPacksIsWhatEachElementShows) {
  const Model model = build_model(scene());
  expect_what_each_element_shows(model, random_state(model, 6));
}

TEST_P(AssemblerOf, ObservedInPacksOnASeabedIsWhatEachElementShows) {
  Scene on_bed = scene();
  on_bed.environment.depth = 50.0;
  const Model model = build_model(on_bed);
  const State state = random_state(model, 6);
  ASSERT_GT(observe_seabed(model, state, 0).length, 10.0);
  expect_what_each_element_shows(model, state);
}

TEST(Assembler, FlooredTangentIsExactWhereTheTensionIsAboveTheFloor) {
  const Model model = build_model(test::loaded_line(40, 0.0, 0.0));
  State state = model.make_state();
  const Vec3 a = model.points[0].position, t = (model.points[1].position - a) / model.lines[0].length * 1.2;
  for (int i = 0; i < model.lines[0].nodes; ++i)
    for (int c = 0; c < 3; ++c) {
      state.q[model.dof(0, i) + c] = a[c] + t[c] * model.lines[0].s[i];
      state.q[model.dof(0, i) + 3 + c] = t[c];
    }
  model.reset_joints(state);
  const Assembler assembler(model);
  Tangent exact = assembler.make_tangent(), low = assembler.make_tangent(), high = assembler.make_tangent();
  std::vector<double> r(model.unknowns), again(model.unknowns);
  assembler.tangent(state, {}, TangentFloor{}, r, exact);
  assembler.tangent(state, {}, TangentFloor{10.0, true, false}, again, low);
  assembler.tangent(state, {}, TangentFloor{1.0e7, false, false}, again, high);
  EXPECT_EQ(r, again);  // the residual never changes
  EXPECT_TRUE(std::equal(exact.chain.values().begin(), exact.chain.values().end(), low.chain.values().begin()));
  EXPECT_FALSE(std::equal(exact.chain.values().begin(), exact.chain.values().end(), high.chain.values().begin()));
}

TEST(Assembler, ClampHoldsTheDirectionOfTheSlopeAndNotItsLength) {
  Scene scene = test::loaded_line(10, 500.0, 500.0);
  scene.lines[0].from_end = {true, Vec3(1.0, 2.0, 2.0)};
  const Model model = build_model(scene);
  const Assembler assembler(model);
  std::vector<double> r(model.unknowns, 1.0);
  assembler.project(r);
  EXPECT_EQ(r[0], 0.0);
  const Vec3 slope(r[3], r[4], r[5]), direction = Vec3(1.0, 2.0, 2.0) / 3.0;
  EXPECT_NEAR((slope - direction * (5.0 / 3.0)).norm(), 0.0, 1.0e-15);
}

}  // namespace
}  // namespace hawser
