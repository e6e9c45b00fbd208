// The kernels of the chain solver: every instruction set, LU and L Delta L^T, 3, 6 and 7 unknowns a node.
#include "solver/linear/chain_kernel.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <span>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/solver/linear/random_chains.hpp"

namespace hawser {

namespace {

using test::Kind;
using test::Shape;

struct Answer {
  std::vector<double> factors, x;
  PivotWatch watch;
};

struct Case {
  const ChainKernel& kernel;
  Factors form;
  BlockTridiagonal a;
  std::vector<double> b;

  const Chain& chain() const { return a.chains()[0]; }
};

/// f on every kernel, form and size; L Delta L^T on the kinds that are symmetric.
void for_each_case(std::span<const Kind> kinds, const std::function<void(const Case&)>& f) {
  for (const ChainKernel* kernel : chain_kernels())
    for (const Factors form : {Factors::lu, Factors::ldlt})
      for (const Kind kind : kinds)
        for (const int block : {3, 6, 7})
          for (const int nodes : {1, 2, 3, 4, 5, 40, 41}) {
            if (form == Factors::ldlt && kind != Kind::positive_definite && kind != Kind::symmetric_indefinite) continue;
            SCOPED_TRACE(
                fmt::format("{}, form {}, {}, {} nodes of {}", kernel->instruction_set, static_cast<int>(form), test::name_of(kind), nodes, block));
            const Shape shape{block, nodes};
            const BlockTridiagonal a = test::random_matrix(kind, {&shape, 1}, 4);
            f({*kernel, form, a, test::random_vector(a.dofs(), 5)});
          }
}

Answer answer_of(const Case& given, std::span<const Front> fronts) {
  const auto& [kernel, form, a, b] = given;
  const Chain& c = given.chain();
  Answer answer{std::vector<double>(a.values().size()), b, {}};
  double *factors = answer.factors.data(), *x = answer.x.data();
  for (const Front front : fronts) kernel.factorize(c.block, c.nodes, form, a.values().data(), factors, front, answer.watch);
  kernel.factorize_middle(c.block, c.nodes, form, a.D(c, c.nodes / 2), factors, answer.watch);
  for (const Front front : fronts) kernel.forward(c.block, c.nodes, form, factors, x, front);
  kernel.solve_middle(c.block, c.nodes, form, factors, x);
  for (const Front front : fronts) kernel.backward(c.block, c.nodes, form, factors, x, front);
  return answer;
}

constexpr std::array together = {Front::both};
constexpr std::array one_by_one = {Front::right, Front::left};

// A few units of roundoff, as nothing grows: the diagonal blocks of a positive definite matrix cannot, and the couplings of these add a fortieth at
// most to the square of the norm. L Delta L^T looks at one half of the diagonal blocks, whose share of it may double.
TEST(ChainKernels, OfAllInstructionSetsSolvePositiveDefiniteSystems) {
  for_each_case(std::array{Kind::positive_definite}, [](const Case& given) {
    const Answer answer = answer_of(given, together);
    EXPECT_LE(test::backward_error(test::dense(given.a), answer.x, given.b), 5e-16);
    EXPECT_EQ(answer.watch.negative, 0);
    EXPECT_GT(answer.watch.smallest, 0.0);
    EXPECT_EQ(answer.watch.not_finite, 0.0);
    EXPECT_LE(answer.watch.growth_squared, given.form == Factors::ldlt ? 2.05 : 1.025);
  });
}

constexpr std::array every_kind = {Kind::positive_definite, Kind::symmetric_indefinite, Kind::unsymmetric};

TEST(ChainKernels, GiveTheSameBitsFrontByFront) {
  for_each_case(every_kind, [](const Case& given) {
    const Answer at_once = answer_of(given, together), in_turn = answer_of(given, one_by_one);
    EXPECT_EQ(at_once.factors, in_turn.factors);
    EXPECT_EQ(at_once.x, in_turn.x);
    EXPECT_EQ(at_once.watch.negative, in_turn.watch.negative);
    EXPECT_EQ(at_once.watch.growth_squared, in_turn.watch.growth_squared);
  });
}

/// Elimination with its right-hand side in runs of `length` nodes of both fronts.
Answer answer_in_runs(const Case& given, Factors form, int length) {
  const auto& [kernel, ignored, a, b] = given;
  const Chain& c = given.chain();
  Answer answer{std::vector<double>(a.values().size()), b, {}};
  double *factors = answer.factors.data(), *x = answer.x.data();
  const int left_nodes = c.nodes / 2, right_nodes = c.nodes - 1 - left_nodes;
  FrontRun left, right;
  while (left.first < left_nodes || right.first < right_nodes) {
    left.count = std::min(length, left_nodes - left.first), right.count = std::min(length + 1, right_nodes - right.first);
    left.values = a.D(c, left.first), right.values = a.D(c, c.nodes - 1 - right.first);
    kernel.eliminate_runs(c.block, c.nodes, form, left, right, factors, x, answer.watch);
  }
  kernel.factorize_middle(c.block, c.nodes, form, a.D(c, left_nodes), factors, answer.watch);
  kernel.solve_middle(c.block, c.nodes, form, factors, x);
  kernel.backward(c.block, c.nodes, form, factors, x, Front::both);
  return answer;
}

TEST(ChainKernels, GiveTheSameBitsWhateverTheyKeepAndInRunsOfAnyLength) {
  for_each_case(every_kind, [](const Case& given) {
    const Answer whole = answer_of(given, together);
    for (const Factors form : {given.form, given.form == Factors::lu ? Factors::spent_lu : given.form})
      for (const int length : {1, 7, 100}) {
        SCOPED_TRACE(fmt::format("form {}, runs of {}", static_cast<int>(form), length));
        const Answer in_runs = answer_in_runs(given, form, length);
        EXPECT_EQ(in_runs.x, whole.x);
        EXPECT_EQ(in_runs.watch.negative, whole.watch.negative);
        EXPECT_EQ(in_runs.watch.smallest, whole.watch.smallest);
        EXPECT_EQ(in_runs.watch.largest, whole.watch.largest);
        EXPECT_NEAR(in_runs.watch.growth_squared, whole.watch.growth_squared, 1e-14 * whole.watch.growth_squared);
      }
  });
}

/// What a symmetric elimination must not read: the couplings that its fronts do not take, and entries of D in packs above the diagonal.
TEST(ChainKernels, ReadOneCouplingOfASymmetricMatrix) {
  for_each_case(std::array{Kind::positive_definite}, [](const Case& given) {
    if (given.form != Factors::ldlt) return;
    Case spoilt = given;
    const Chain& c = given.chain();
    for (int i = 0; i + 1 < c.nodes; ++i) std::fill_n(i < c.nodes / 2 ? spoilt.a.U(c, i) : spoilt.a.L(c, i), c.block * c.block, 1e6);
    EXPECT_EQ(answer_of(spoilt, together).x, answer_of(given, together).x);
  });
}

}  // namespace

}  // namespace hawser
