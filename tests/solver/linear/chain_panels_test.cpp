// Assembly and elimination panel by panel against assembly first and elimination after it.
//
// A plain line gives the same bits: the fronts see the same numbers in the same order. With loads beside the sweep (joints, bodies, contact) the
// sums at a node are formed in another order; what rounding may then change in the solution is bounded by 1e-9 of its largest entry, from
// condition numbers of up to 1e7 seen on these tangents.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "assembly/assembler.hpp"
#include "solver/linear/linear_solver.hpp"
#include "solver/statics.hpp"
#include "tests/solver/linear/random_chains.hpp"
#include "tests/solver/linear/stored_panels.hpp"
#include "tests/support/scene_samples.hpp"

namespace hawser {

namespace {

struct Answer {
  std::vector<double> r, x;
  FactorReport report;
};

/// The catenary start, shaken: every term of the tangent is at work.
State shaken_state(const Model& model) {
  State state = static_start(model, StaticStart::catenary);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (std::size_t i = 0; i < state.q.size(); ++i) {
    state.q[i] += 1e-3 * u(random);
    state.v[i] = 0.3 * u(random);
    state.a[i] = u(random);
  }
  return state;
}

constexpr TangentWeights weights{1.0, 40.0, 1600.0};

Answer apart(const Model& model, const State& state, const TangentFloor& floor) {
  const Assembler assembler(model);
  Tangent tangent = assembler.make_tangent();
  Answer a{std::vector<double>(model.unknowns), std::vector<double>(model.dofs), {}};
  assembler.tangent(state, weights, floor, a.r, tangent);
  assembler.reduce(tangent, a.r, a.x);
  const auto solver = make_linear_solver(LinearSolverKind::chain);
  solver->analyze(tangent.chain);
  a.report = solver->factorize(tangent.chain);
  solver->solve(a.x);
  return a;
}

enum class Factors { kept, spent };

Answer together(const Model& model, const State& state, const TangentFloor& floor, int threads = 1, LinearSolverKind kind = LinearSolverKind::chain,
                Factors factors = Factors::kept) {
  const Assembler assembler(model, threads);
  Tangent tangent = assembler.make_tangent();
  Answer a{std::vector<double>(model.unknowns), std::vector<double>(model.dofs), {}};
  const auto solver = make_linear_solver(kind, threads);
  solver->analyze(tangent.chain);
  TangentPanels panels = assembler.tangent_panels(state, weights, floor, a.r, tangent, a.x);
  a.report = factors == Factors::kept ? solver->factorize_and_solve(panels, a.x) : solver->solve_once(panels, a.x);
  return a;
}

double largest(const std::vector<double>& x) {
  double m = 0.0;
  for (double v : x) m = std::max(m, std::abs(v));
  return m;
}

void expect_near(const std::vector<double>& a, const std::vector<double>& b, double share, const std::string& what) {
  ASSERT_EQ(a.size(), b.size());
  const double bound = share * largest(b);
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], bound) << what << ", unknown " << i;
}

Scene plain_line(int elements, ModelChoice family) {
  Scene scene = test::loaded_line(2, 500.0, 500.0, family);
  LineSpec& line = scene.lines[0];
  line.loads.clear();
  line.sections.pop_back();
  line.sections[0].length = 105.0;
  line.sections[0].elements = elements;
  return scene;
}

Scene with_bed(Scene scene) {
  SeabedSpec bed;
  bed.stiffness = 3.0e3;
  bed.friction_axial = bed.friction_lateral = 0.4;
  bed.slip = 0.5;
  scene.environment.depth = 78.0;
  scene.environment.seabed = bed;
  return scene;
}

}  // namespace

TEST(ChainPanels, GiveTheBitsOfAssemblyBeforeEliminationOnAPlainLine) {
  for (const ModelChoice family : {ModelChoice::bar, ModelChoice::cable, ModelChoice::beam})
    for (const int elements : {1, 2, 3, 31, 63, 64, 65, 66, 127, 128, 129, 130, 191, 192, 193, 300, 500}) {
      const Model model = build_model(plain_line(elements, family));
      const State state = shaken_state(model);
      for (const TangentFloor& floor : {TangentFloor{}, TangentFloor{5.0e3, true, true}}) {
        const Answer a = apart(model, state, floor), b = together(model, state, floor);
        const std::string what = fmt::format("{} elements, family {}", elements, name_of(model.lines[0].family));
        ASSERT_EQ(b.report.status, FactorStatus::ok) << what;
        EXPECT_EQ(a.r, b.r) << what;
        EXPECT_EQ(a.x, b.x) << what;
        EXPECT_EQ(a.report.negative_pivots, b.report.negative_pivots) << what;
        EXPECT_EQ(a.report.smallest_pivot, b.report.smallest_pivot) << what;
        EXPECT_EQ(a.report.largest_pivot, b.report.largest_pivot) << what;
      }
    }
}

TEST(ChainPanels, GiveTheSameBitsWhereFactorsAreNotKept) {
  for (const int elements : {1, 2, 64, 65, 300, 5000}) {
    const Model model = build_model(plain_line(elements, ModelChoice::beam));
    const State state = shaken_state(model);
    const Answer kept = together(model, state, {});
    for (const int threads : {1, 2}) {
      const Answer spent = together(model, state, {}, threads, LinearSolverKind::chain, Factors::spent);
      ASSERT_EQ(spent.report.status, FactorStatus::ok) << elements;
      EXPECT_EQ(kept.r, spent.r) << elements;
      EXPECT_EQ(kept.x, spent.x) << elements;
      EXPECT_EQ(kept.report.negative_pivots, spent.report.negative_pivots) << elements;
    }
  }
}

TEST(ChainPanels, GiveTheBitsOfEachLineByItselfInASceneOfSeveral) {
  const ModelChoice families[] = {ModelChoice::beam, ModelChoice::bar, ModelChoice::cable};
  const int elements[] = {150, 70, 129};
  Scene several = plain_line(elements[0], families[0]);
  for (int k : {1, 2}) {
    several.lines.push_back(plain_line(elements[k], families[k]).lines[0]);
    several.lines[k].name += std::to_string(k);
  }
  const Model model = build_model(several);
  const State state = shaken_state(model);
  const Answer all = together(model, state, {}), first = apart(model, state, {});
  EXPECT_EQ(all.r, first.r);
  EXPECT_EQ(all.x, first.x);
  for (int k = 0; k < 3; ++k) {
    const Model single = build_model(plain_line(elements[k], families[k]));
    const auto from = static_cast<std::ptrdiff_t>(model.chain(k).first_dof), to = from + static_cast<std::ptrdiff_t>(single.dofs);
    const auto part = [&](const std::vector<double>& x) { return std::vector<double>(x.begin() + from, x.begin() + to); };
    State own = single.make_state();
    own.q = part(state.q), own.v = part(state.v), own.a = part(state.a);
    const Answer alone = together(single, own, {});
    EXPECT_EQ(part(all.r), alone.r) << k;
    EXPECT_EQ(part(all.x), alone.x) << k;
  }
}

TEST(ChainPanels, GiveTheSameSolutionWithJointsBodiesAndContact) {
  for (const int elements : {10, 64, 129, 400})
    for (const double EI : {0.0, 500.0})
      for (const bool bed : {false, true}) {
        Scene scene = test::loaded_line(elements, EI, 2.0 * EI);
        if (bed) scene = with_bed(scene);
        const Model model = build_model(scene);
        ASSERT_FALSE(model.joints.empty());
        const State state = shaken_state(model);
        const Answer a = apart(model, state, {}), b = together(model, state, {});
        const std::string what = fmt::format("{} elements, EI {}, bed {}", elements, EI, bed);
        ASSERT_EQ(b.report.status, FactorStatus::ok) << what;
        expect_near(b.r, a.r, 1e-14, what + ": residual");
        expect_near(b.x, a.x, 1e-9, what + ": solution");
      }
}

TEST(ChainPanels, GiveTheSameBitsWithTwoThreads) {
  const Model model = build_model(test::loaded_line(5000, 500.0, 900.0));
  const State state = shaken_state(model);
  const Answer one = together(model, state, {}, 1), two = together(model, state, {}, 2);
  EXPECT_EQ(one.r, two.r);
  EXPECT_EQ(one.x, two.x);
}

TEST(ChainPanels, AreTakenWholeBySolversThatNeedTheMatrix) {
  const Model model = build_model(test::loaded_line(100, 500.0, 900.0));
  const State state = shaken_state(model);
  const Answer a = apart(model, state, {});
  for (const LinearSolverKind kind : {LinearSolverKind::band, LinearSolverKind::umfpack, LinearSolverKind::klu}) {
    const Answer b = together(model, state, {}, 1, kind);
    ASSERT_EQ(b.report.status, FactorStatus::ok);
    expect_near(b.x, a.x, 1e-9, std::string(name_of(kind)));
  }
  EXPECT_EQ(together(model, state, {}, 1, LinearSolverKind::cholmod).report.status, FactorStatus::not_applicable);
}

// 1e-14 is the promise of the contract (linear_solver.hpp).
TEST(ChainPanels, SolveSeveralChainsAndFallBackToExchangesOfRows) {
  const test::Shape shapes[] = {{6, 200}, {3, 130}, {6, 1}, {7, 70}, {3, 2}, {6, 65}, {7, 129}};
  for (const bool regular : {true, false}) {
    BlockTridiagonal a = test::random_matrix(test::Kind::positive_definite, shapes, 7);
    if (!regular) a.D(a.chains()[0], 70)[0] = a.D(a.chains()[0], 0)[0] = 0.0;
    const std::vector<double> b = test::random_vector(a.dofs(), 8);
    const auto solver = make_linear_solver(LinearSolverKind::chain);
    solver->analyze(a);
    std::vector<double> x(a.dofs());
    test::StoredPanels panels(a, b, x);
    const FactorReport report = solver->factorize_and_solve(panels, x);
    ASSERT_EQ(report.status, FactorStatus::ok);
    EXPECT_EQ(report.fell_back, !regular);
    EXPECT_LT(test::backward_error(test::dense(a), x, b), 1e-14);
    std::vector<double> again = b;
    solver->solve(again);
    EXPECT_LT(test::backward_error(test::dense(a), again, b), 1e-14) << "the factors stay";
    test::StoredPanels spent(a, b, again);
    EXPECT_EQ(solver->solve_once(spent, again).fell_back, !regular);
    EXPECT_EQ(again, x) << "the factors do not stay";
  }
}

}  // namespace hawser
