// The chain and the band solver take no memory between analyze and the last solve.
#include <gtest/gtest.h>

#include "solver/linear/linear_solver.hpp"
#include "tests/solver/linear/allocation_counter.hpp"
#include "tests/solver/linear/random_chains.hpp"

namespace hawser {

namespace {

class NoAllocation : public testing::TestWithParam<LinearSolverKind> {};

TEST_P(NoAllocation, AfterAnalyze) {
  const std::vector<test::Shape> shapes = {{6, 50}, {3, 20}, {7, 15}};
  BlockTridiagonal a = test::random_matrix(test::Kind::positive_definite, shapes, 1);
  std::vector<double> b = test::random_vector(a.dofs(), 2);
  const auto solver = make_linear_solver(GetParam());
  solver->analyze(a);
  const long before = test::allocations_so_far();
  for (const Symmetry declared : {Symmetry::unknown, Symmetry::symmetric, Symmetry::unknown}) {
    a.declare(declared);
    EXPECT_EQ(solver->factorize(a).status, FactorStatus::ok);
    solver->solve(b);
  }
  EXPECT_EQ(test::allocations_so_far(), before);
}

INSTANTIATE_TEST_SUITE_P(OwnSolvers, NoAllocation, testing::Values(LinearSolverKind::chain, LinearSolverKind::band),
                         [](const auto& instance) { return std::string(name_of(instance.param)); });

}  // namespace

}  // namespace hawser
